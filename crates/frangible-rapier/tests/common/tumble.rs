//! Bodies that tumble down stairs.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::f32::consts::TAU;
use std::sync::Arc;

use frangible::{Asset, Breakable, Material};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, LoadCounts, SurfaceProperties, WorldConfig};

/// Bodies on the stairs.
pub(crate) const BODIES: usize = 20;

/// Steps of the stairs: how many, their height and depth, m.
const STAIRS: (usize, f32, f32) = (8, 0.1, 0.25);

/// A body of the table: shape and material, with few modes.
pub(crate) fn baked(name: &str) -> Arc<Asset> {
    let (shape, material, coarser) = match name {
        "brick" => (Shape::block([0.21, 0.1, 0.05]), "brick", 1.8),
        "glass block" => (Shape::block([0.1, 0.1, 0.05]), "glass", 2.0),
        "drinking glass" => (Shape::drinking_glass(), "glass", 1.5),
        _ => (Shape::bowl(), "porcelain", 1.5),
    };
    let mut size = shape.fracture_size().unwrap();
    size.edge *= coarser;
    let spec = BakeSpec {
        modes: 60,
        fracture: Some(size),
        ..BakeSpec::new(name, shape, Material::preset(material).unwrap())
    };
    Arc::new(bake(&spec).unwrap())
}

/// Outcome of letting twenty of these bodies fall on stone stairs and tumble down them.
pub(crate) struct Tumble {
    pub(crate) impacts: LoadCounts,
    pub(crate) rests: LoadCounts,
    pub(crate) broken: usize,
    pub(crate) at_rest: bool,
}

/// Lets bodies, these kinds in turn, fall `height` m on the uppermost steps and tumble down for `seconds`.
pub(crate) fn tumble(kinds: &[Arc<Asset>], height: f32, seconds: f32) -> Tumble {
    let mut world = BreakableWorld::new(WorldConfig::default()).unwrap();
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    let (steps, rise, depth) = STAIRS;
    for i in 0..steps {
        let top = rise * (steps - i) as f32;
        let half = Vector::new(0.5 * depth, 0.5 * top, 2.0);
        let at = Pose::translation(depth * i as f32, 0.5 * top, 0.0);
        world
            .insert_fixed_box(half, at, SurfaceProperties::STONE)
            .unwrap();
    }
    let kinds: Vec<Breakable> = kinds
        .iter()
        .map(|asset| Breakable::uniform(Arc::clone(asset)).unwrap())
        .collect();
    for i in 0..BODIES {
        let (row, column) = (i / 10, i % 10);
        let turn = TAU * (0.618 * i as f32).fract();
        let reach = 0.12;
        let at = Vector::new(
            depth * row as f32,
            rise * steps as f32 + reach + height,
            0.3 * (column as f32 - 4.5),
        );
        let pose = Pose::new(at, Vector::new(turn, 0.5 * turn, 0.3));
        let body = kinds[i % kinds.len()].body(i as u64);
        let (forward, spin) = (Vector::new(0.8, 0.0, 0.0), Vector::new(0.0, 0.0, -4.0));
        world
            .insert(
                body,
                RigidBodyBuilder::dynamic()
                    .pose(pose)
                    .linvel(forward)
                    .angvel(spin),
            )
            .unwrap();
    }
    let mut broken = 0;
    let dt = world.physics.integration_parameters.dt;
    for _ in 0..(seconds / dt).round() as usize {
        broken += world.step().unwrap().len();
    }
    Tumble {
        impacts: world.impact_counts(),
        rests: world.rest_counts(),
        broken,
        at_rest: world.at_rest(),
    }
}
