//! Blasts and scripted blows: momentum, breaks, errors.

use crate::common::baked::{block, pane};
use crate::common::{at, body, unbreakable, world};
use frangible::glam::{DVec3, Vec3};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{Ball, BreakCause, BreakableWorld, SurfaceProperties, WorldError};

fn with_pane(pose: Pose) -> (BreakableWorld, RigidBodyHandle) {
    let mut world = world(false);
    let handle = world
        .insert(body(pane()), RigidBodyBuilder::dynamic().pose(pose))
        .unwrap();
    (world, handle)
}

/// ∫ I/d cos θ dA over a square plate of side 0.3 m at distance h from its middle, N·s.
fn on_the_pane(impulse: f64, h: f64) -> f64 {
    let n = 300;
    let width = 0.3 / f64::from(n);
    let place = |i: i32| (f64::from(i) + 0.5) * width - 0.15;
    let cells = (0..n).flat_map(|i| (0..n).map(move |j| (place(i), place(j))));
    cells
        .map(|(x, y)| impulse * h / (x * x + y * y + h * h) * width * width)
        .sum()
}

#[test]
fn a_blast_gives_a_pane_its_momentum_whether_it_holds_or_breaks() {
    for (impulse, breaks) in [(0.05_f32, false), (200.0, true)] {
        let pose = Pose::new(Vector::new(1.0, 2.0, -1.0), Vector::new(0.3, 0.8, -0.2));
        let (mut world, handle) = with_pane(pose);
        let h = 0.25;
        let origin = pose * Vector::new(0.0, 0.0, -(h + 0.002));
        world.blast(origin, impulse, 2e-3).unwrap();
        let events = world.step().unwrap().to_vec();
        assert_eq!(events.len(), usize::from(breaks));
        assert_eq!(world.breakable(handle).is_none(), breaks);
        let expected =
            pose.rotation * Vec3::Z * on_the_pane(f64::from(impulse), f64::from(h)) as f32;
        let momentum = world.momentum().as_vec3();
        println!(
            "{impulse} Pa·s: {momentum} N·s, {} pieces",
            world.physics.bodies.len()
        );
        assert!(
            (momentum - expected).length() < 0.02 * expected.length(),
            "{momentum}, not {expected} N·s"
        );
        if let Some(event) = events.first() {
            assert_eq!(event.cause, BreakCause::Blast);
            assert!(event.energy_paid > 0.0);
            assert!(event.kinetic_after <= event.kinetic_before + event.work);
        }
    }
}

#[test]
fn a_blast_throws_balls_away_and_leaves_what_is_fixed() {
    let mut world = world(false);
    let floor = world
        .insert_fixed_box(Vector::ONE, at(0.0, -2.0, 0.0), SurfaceProperties::STONE)
        .unwrap();
    let ball = Ball {
        mass: 0.5,
        radius: 0.02,
    };
    let still = Vector::ZERO;
    let ball = world
        .insert_ball(ball, SurfaceProperties::STEEL, at(2.02, 0.0, 0.0), still)
        .unwrap();
    world.blast(Vector::ZERO, 200.0, 1e-3).unwrap();
    world.step().unwrap();
    let velocity = world.physics.bodies[ball].linvel();
    let expected = 2.0 / 3.0 * std::f32::consts::PI * 0.02 * 0.02 * 100.0 / 0.5;
    assert!((velocity - Vector::X * expected).length() < 1e-3 * expected);
    assert_eq!(*world.physics.bodies[floor].position(), at(0.0, -2.0, 0.0));
}

#[test]
fn a_scripted_blow_adds_exactly_its_impulse() {
    for (asset, impulse, breaks) in [
        (pane(), Vector::new(0.0, 0.08, 0.4), true),
        (block(), Vector::new(1e-3, 0.0, -1e-3), false),
    ] {
        let mut world = world(false);
        world.set_break_function(unbreakable());
        let velocity = Vector::new(1.0, 0.0, 0.5);
        let handle = world
            .insert(
                body(asset),
                RigidBodyBuilder::dynamic()
                    .pose(at(0.0, 1.0, 0.0))
                    .linvel(velocity),
            )
            .unwrap();
        let start = world.momentum();
        let point = Vector::new(0.03, 1.02, 0.0);
        world.fracture_at(handle, point, impulse).unwrap();
        let events = world.step().unwrap().to_vec();
        assert_eq!(events.len(), usize::from(breaks), "{}", asset.name());
        let gained = world.momentum() - start;
        let rounding = 1e-4 * world.momentum().length();
        assert!(
            (gained - impulse.as_dvec3()).length() < rounding,
            "{gained}, not {impulse} N·s"
        );
        for event in &events {
            assert_eq!(event.cause, BreakCause::Script);
            assert!(event.contacts.is_empty() && event.strikers.is_empty());
            assert!(event.kinetic_after <= event.kinetic_before + event.work);
        }
    }
}

#[test]
fn pushes_that_make_no_sense_are_refused() {
    let (mut world, handle) = with_pane(Pose::IDENTITY);
    let nan = Vector::new(0.0, f32::NAN, 0.0);
    assert!(world.blast(nan, 1.0, 1.0).is_err());
    assert!(world.blast(Vector::ZERO, 0.0, 1.0).is_err());
    assert!(world.blast(Vector::ZERO, 1.0, -1.0).is_err());
    assert!(world.fracture_at(handle, nan, Vector::X).is_err());
    assert!(
        world
            .fracture_at(handle, Vector::ZERO, Vector::ZERO)
            .is_err()
    );
    let floor = world
        .insert_fixed_box(Vector::ONE, at(0.0, -2.0, 0.0), SurfaceProperties::STONE)
        .unwrap();
    assert!(matches!(
        world.fracture_at(floor, Vector::ZERO, Vector::X),
        Err(WorldError::NoBody { .. })
    ));
    assert!(world.step().unwrap().is_empty());
    assert_eq!(world.momentum(), DVec3::ZERO);
}
