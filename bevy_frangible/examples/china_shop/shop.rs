//! The shop: a thousand things on boards, the settings of their simulation, and the ball.

use std::sync::Arc;

use avian3d::prelude::*;
use bevy::prelude::*;
use bevy_frangible::frangible::Material;
use bevy_frangible::frangible::internals::PieceModel;
use bevy_frangible::prelude::*;
use frangible_bake::pieces::Pieces;
use frangible_bake::{BakeSpec, Shape, bake};

/// Boards, one behind the other and one above the other, and things on each: along and across.
const RACKS: usize = 5;
const BOARDS: usize = 5;
const PLACES: [usize; 2] = [20, 2];
/// Distances between racks, boards and things, m.
const RACK: f32 = 1.2;
const BOARD: f32 = 0.4;
const PLACE: f32 = 0.17;
/// A ball of steel, m and m/s. It has no weight, so that it is over the board all the way.
const RADIUS: f32 = 0.08;
const SPEED: f32 = 8.0;

/// Rules of breaking.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rules {
    /// Otherwise things break after the step and within a budget.
    pub inside: bool,
    /// Pieces break again.
    pub again: bool,
}

/// Edge lengths of a board, m.
#[derive(Component)]
#[allow(dead_code, reason = "only what draws it asks")]
pub struct Board(pub Vec3);

/// The ball, of a radius, m.
#[derive(Component)]
#[allow(dead_code, reason = "only what draws it asks")]
pub struct Ball(pub f32);

/// Sets the options that a scene of hundreds of bodies needs.
pub fn rules(app: &mut App, rules: Rules) {
    app.insert_resource(BreakAgain {
        model: rules
            .again
            .then(|| Arc::new(Pieces::default()) as Arc<dyn PieceModel>),
        ..BreakAgain::default()
    })
    .insert_resource(match rules.inside {
        true => Breaking::InsideStep,
        false => Breaking::for_games(),
    })
    .insert_resource(ColliderDetail {
        whole: (1, 32),
        hull_volume_ratio: 3.0,
        ..ColliderDetail::default()
    })
    .insert_resource(SubstepCount(4))
    .insert_resource(DebrisBudget {
        pieces: 500,
        dust_mass: 1e-3,
        ..DebrisBudget::default()
    });
}

/// A kind of thing, and the height of its centre of mass above its foot, m.
fn baked(name: &str, shape: Shape) -> Result<(FrangibleAsset, f32), Box<dyn std::error::Error>> {
    let spec = BakeSpec {
        modes: 40,
        fracture: Some(shape.size_for(1500.0)?),
        analysis: Some(shape.size_for(1500.0)?),
        ..BakeSpec::new(name, shape, Material::preset("porcelain")?)
    };
    let asset = bake(&spec)?;
    let lowest = asset.fracture().positions.iter().map(|p| p.z);
    let foot = -lowest.fold(f32::INFINITY, f32::min);
    Ok((FrangibleAsset::new(asset)?, foot))
}

/// The kinds of things, each with the height of its centre of mass, m.
pub fn kinds() -> Result<Vec<(FrangibleAsset, f32)>, Box<dyn std::error::Error>> {
    Ok(vec![
        baked("bowl", Shape::bowl())?,
        baked("vase", Shape::vase())?,
        baked("glass", Shape::drinking_glass())?,
    ])
}

/// Puts so many things on boards.
pub fn furnish(world: &mut World, kinds: &[(FrangibleAsset, f32)], things: usize) {
    let mut assets = world.resource_mut::<Assets<FrangibleAsset>>();
    let kinds: Vec<_> = (kinds.iter())
        .map(|(asset, foot)| (assets.add(asset.clone()), foot))
        .collect();
    let size = Vec3::new(PLACES[0] as f32 * PLACE, 0.02, PLACES[1] as f32 * PLACE);
    let mut put = 0;
    for (rack, board) in (0..RACKS).flat_map(|r| (0..BOARDS).map(move |b| (r, b))) {
        let middle = Vec3::new(0.0, BOARD * board as f32, RACK * rack as f32);
        let under = Transform::from_translation(middle - Vec3::Y * (0.5 * size.y));
        let of_wood = Collider::cuboid(size.x, size.y, size.z);
        world.spawn((RigidBody::Static, of_wood, under, Board(size)));
        for (i, j) in (0..PLACES[0]).flat_map(|i| (0..PLACES[1]).map(move |j| (i, j))) {
            if put == things {
                return;
            }
            let (asset, foot) = &kinds[(3 * i + j + board + rack) % kinds.len()];
            let along = (i as f32 - 0.5 * (PLACES[0] - 1) as f32) * PLACE;
            let across = (j as f32 - 0.5 * (PLACES[1] - 1) as f32) * PLACE;
            let upright = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
            let at = middle + Vec3::new(along, **foot, across);
            world.spawn((
                Breakable(asset.clone()),
                Seed(put as u64),
                Transform::from_translation(at).with_rotation(upright),
            ));
            put += 1;
        }
    }
}

/// Throws the ball along the third board of the second rack, from the left.
pub fn throw(world: &mut World) -> Result<(), Box<dyn std::error::Error>> {
    let steel = Material::preset("steel")?;
    let start = Vec3::new(-3.0, 2.0 * BOARD + 0.12, RACK + 0.5 * PLACE);
    world.spawn((
        Ball(RADIUS),
        RigidBody::Dynamic,
        Collider::sphere(RADIUS),
        ColliderDensity(steel.density as f32),
        MadeOf(steel),
        SweptCcd::default(),
        // Else Avian lets it bounce off the board's edge, which it passes.
        SpeculativeMargin(0.02),
        GravityScale(0.0),
        Transform::from_translation(start),
        LinearVelocity(Vec3::X * SPEED),
    ));
    Ok(())
}
