//! A drinking glass falls on a stone floor and breaks: `cargo run --release -p frangible-rapier --example glass`.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::error::Error;
use std::f32::consts::FRAC_PI_2;
use std::sync::Arc;

use frangible::{Breakable, Material};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{BreakableWorld, SurfaceProperties, WorldConfig};

fn main() -> Result<(), Box<dyn Error>> {
    // Once for each kind of object; a game does it beforehand and loads the file.
    let spec = BakeSpec::for_games("glass", Shape::drinking_glass(), Material::preset("glass")?)?;
    let asset = bake(&spec)?;
    let kind = Breakable::new(Arc::new(asset))?;

    // The world has y up, and shapes of revolution have z up.
    let mut world = BreakableWorld::new(WorldConfig::default())?;
    world.insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)?;
    let upright = Rotation::from_rotation_x(-FRAC_PI_2);
    let tilted = Rotation::from_rotation_z(2.5) * upright;
    let pose = Pose::from_parts(Vector::new(0.0, 1.2, 0.0), tilted);
    let glass = world.insert(kind.body(1), RigidBodyBuilder::dynamic().pose(pose))?;

    for _ in 0..480 {
        world.step()?;
        for event in world.breaks() {
            assert_eq!(event.parent, glass);
            println!(
                "{} pieces after {:.2} s, {:.3} J of cracks",
                event.fragments.len(),
                world.time(),
                event.fracture.report.fracture_energy
            );
            // Each fragment is a rigid body of the world, with a mesh to draw.
            let pieces = event.fragments.iter().zip(&event.fracture.fragments);
            for (handle, fragment) in pieces.take(5) {
                let at = world.physics.bodies[*handle].translation();
                println!(
                    "  {:6.2} g at {:+.3} {:+.3} {:+.3} m, {} triangles",
                    1e3 * fragment.mass.mass,
                    at.x,
                    at.y,
                    at.z,
                    fragment.mesh.triangles.len()
                );
            }
        }
    }
    Ok(())
}
