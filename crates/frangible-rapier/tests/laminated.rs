//! Films hold the pieces of a laminated pane in the world.

use std::sync::{Arc, OnceLock};

use frangible::{Asset, Breakable, Material};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig};

const SIDE: f64 = 0.4;

/// A pane of laminated glass, held along its four edges.
fn pane() -> &'static Arc<Asset> {
    static PANE: OnceLock<Arc<Asset>> = OnceLock::new();
    PANE.get_or_init(|| {
        let shape = Shape::plate(SIDE, SIDE, 4.96e-3);
        let rim = 0.01;
        let edges =
            (0..2).flat_map(|axis| [Region::below(axis, rim), Region::above(axis, SIDE - rim)]);
        let spec = BakeSpec {
            modes: 60,
            fracture: Some(shape.size_for(16_000.0).expect("a size")),
            supports: edges.map(Support::clamped).collect(),
            ..BakeSpec::new(
                "pane",
                shape,
                Material::preset("laminated-glass").expect("a preset"),
            )
        };
        Arc::new(bake(&spec).expect("a baked pane"))
    })
}

/// State of the pane and of the ball of 5 kg after a blow.
struct Left {
    pieces: usize,
    /// Films that hold after the break, and at the end.
    bonds: [usize; 2],
    /// Share of the pane's mass that is no farther than this from its plane at the end.
    near: f64,
    /// Speed of the ball at the end, along its way, m/s.
    speed: f32,
}

/// Throws the ball at the pane, whose film bears so much, and follows it for a third of a second.
fn thrown(strength: f64, speed: f32) -> Left {
    let mut asset = Asset::clone(pane());
    let laminate = &mut asset.parts_mut().material.laminate;
    laminate.as_mut().expect("a laminate").strength = strength;
    let mut config = WorldConfig::default();
    config.gravity = Vector::ZERO;
    let mut world = BreakableWorld::new(config).unwrap();
    let body = Breakable::new(Arc::new(asset)).unwrap().body(1);
    world.insert(body, RigidBodyBuilder::fixed()).unwrap();
    let ball = Ball {
        mass: 5.0,
        radius: 0.08,
    };
    let start = Pose::new(Vector::new(0.02, 0.01, 0.1), Vector::ZERO);
    let way = Vector::new(0.0, 0.0, -speed);
    let ball = world
        .insert_ball(ball, SurfaceProperties::WOOD, start, way)
        .unwrap();
    let mut broken: Option<(Vec<RigidBodyHandle>, usize)> = None;
    for _ in 0..80 {
        world.step().unwrap();
        if let Some(event) = world.breaks().first() {
            broken.get_or_insert((event.fragments.clone(), world.film_bonds()));
        }
    }
    let (fragments, bonds) = broken.expect("the pane breaks");
    let bodies = || {
        fragments
            .iter()
            .filter_map(|&h| world.physics.bodies.get(h))
    };
    let mass = |far: f32| -> f64 {
        let here = bodies().filter(|b| b.translation().z.abs() <= far);
        here.map(|b| f64::from(b.mass_properties().local_mprops.mass()))
            .sum()
    };
    Left {
        pieces: fragments.len(),
        bonds: [bonds, world.film_bonds()],
        near: mass(0.1) / mass(f32::INFINITY),
        speed: -world.physics.bodies[ball].linvel().z,
    }
}

#[test]
fn a_film_throws_back_a_ball_that_goes_through_without_it() {
    let held = thrown(20e6, 8.0);
    let loose = thrown(1.0, 8.0);
    for (name, left) in [("film", &held), ("no film", &loose)] {
        let Left {
            pieces,
            bonds,
            near,
            speed,
        } = left;
        println!("{name}: {pieces} pieces, {bonds:?} bonds, {near:.2} near, ball {speed:.1} m/s");
    }
    assert!(held.pieces > 10 && held.pieces == loose.pieces);
    assert!(held.bonds[0] >= held.pieces - 1);
    // Some bonds tear, most hold; a film without strength is torn by a push.
    assert!(2 * held.bonds[1] > held.bonds[0] && loose.bonds[1] == 0);
    assert!(held.near > 0.99 && loose.near < 0.5);
    assert!(held.speed < 0.0 && loose.speed > 6.0);
}

#[test]
fn a_film_slows_a_ball_that_tears_it() {
    let (held, loose) = (thrown(20e6, 16.0), thrown(1.0, 16.0));
    assert!(held.pieces > 10 && held.pieces == loose.pieces);
    assert!(held.bonds[1] > 0 && held.bonds[1] < held.bonds[0]);
    assert!(
        held.speed > 0.0 && held.speed < loose.speed - 1.0,
        "{} and {} m/s",
        held.speed,
        loose.speed
    );
}
