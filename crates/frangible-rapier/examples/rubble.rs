//! The pieces of a broken bowl become one fixed body, until a ball hits it: `cargo run --release -p frangible-rapier --example rubble`.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::error::Error;

use frangible::{Breakable, Material};
use frangible_bake::pieces::Pieces;
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{AtRest, Ball, BreakableWorld, SurfaceProperties, WorldConfig};

fn main() -> Result<(), Box<dyn Error>> {
    let spec = BakeSpec::for_games("bowl", Shape::bowl(), Material::preset("porcelain")?)?;
    let kind = Breakable::new(bake(&spec)?)?;

    // Pieces that rest are one body with one collider; those of two grams and more can break again, by modes of their own.
    let mut config = WorldConfig::default();
    config.at_rest = AtRest::Merge;
    let mut world = BreakableWorld::new(config)?.with_piece_model(Pieces::default());
    world.insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)?;
    let aslant = Pose::from_parts(Vector::Y * 0.8, Rotation::from_rotation_x(0.6));
    world.insert(kind.body(1), RigidBodyBuilder::dynamic().pose(aslant))?;
    run(&mut world, 1200)?;

    // A ball of one kilogram comes down on the heaviest of the pieces that rest.
    let bodies = &world.physics.bodies;
    let merged = world.merged().map(|merged| &bodies[merged.piece]);
    let target = merged.max_by(|a, b| a.mass().total_cmp(&b.mass()));
    let above = target.ok_or("no piece rests")?.translation() + Vector::Y;
    let steel = SurfaceProperties::STEEL;
    let ball = Ball {
        mass: 1.0,
        radius: 0.031,
    };
    world.insert_ball(
        ball,
        steel,
        Pose::from_translation(above),
        Vector::NEG_Y * 6.0,
    )?;
    run(&mut world, 1200)
}

/// Steps the world, and says what broke and what rests in the end.
fn run(world: &mut BreakableWorld, steps: usize) -> Result<(), Box<dyn Error>> {
    for _ in 0..steps {
        for event in world.step()? {
            println!("something broke into {} pieces", event.fragments.len());
        }
    }
    println!("{} pieces are merged", world.merged().count());
    Ok(())
}
