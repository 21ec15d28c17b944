//! A striker that hits a pane goes on through it.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::sync::Arc;

use crate::common::baked::pane;
use crate::common::{at, body, box_asset, slicer, unbreakable, world};
use frangible::Breakable;
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig};

const PANE: Vec3 = Vec3::new(0.15, 0.15, 0.002);

/// Speed of a ball along z after 0.1 s, having met a pane of 0.45 kg; where it is then.
fn after_the_pane(mass: f32, speed: f32, breaks: bool) -> (f32, f32) {
    let mut world = world(false);
    let pane = box_asset(PANE, [4, 4, 1]);
    world
        .insert(
            body(&pane),
            RigidBodyBuilder::dynamic().pose(at(0.0, 0.0, 0.0)),
        )
        .unwrap();
    let ball = Ball { mass, radius: 0.01 };
    let start = at(0.013, 0.021, -0.3);
    let ball = world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            start,
            Vector::new(0.0, 0.0, speed),
        )
        .unwrap();
    world.set_break_function(if breaks {
        slicer(PANE, [12, 12, 1], 0.0, 0.2)
    } else {
        unbreakable()
    });
    let steps = (2.0 * 0.3 / speed / world.config().dt) as usize + 12;
    for _ in 0..steps {
        world.step().unwrap();
    }
    let ball = &world.physics.bodies[ball];
    (ball.linvel().z, ball.translation().z)
}

#[test]
fn a_ball_goes_on_through_the_pane_it_breaks() {
    for (mass, speed) in [(0.1, 8.0), (0.1, 30.0), (0.3, 60.0)] {
        let (through, z) = after_the_pane(mass, speed, true);
        let (bounced, _) = after_the_pane(mass, speed, false);
        println!(
            "{mass} kg at {speed} m/s: through the broken pane {through:.2} m/s, off the whole one {bounced:.2} m/s"
        );
        assert!(z > 0.02, "the ball is at z = {z}");
        assert!(through > 0.6 * speed, "{speed} m/s fell to {through} m/s");
        assert!(bounced < 0.5 * through);
    }
}

/// What a ball of steel of 0.1 kg has lost of its speed, m/s, 0.2 s after it could have met a baked pane, with so many steps per second.
fn lost(pane: &Breakable, seed: u64, speed: f32, rate: f32) -> f64 {
    let mut config = WorldConfig::plain();
    (config.gravity, config.dt) = (Vector::ZERO, 1.0 / rate);
    let mut world = BreakableWorld::new(config).unwrap();
    world
        .insert(
            pane.body(seed),
            RigidBodyBuilder::dynamic().pose(at(0.0, 0.0, 0.0)),
        )
        .unwrap();
    let ball = Ball {
        mass: 0.1,
        radius: 0.0145,
    };
    let (start, velocity) = (at(0.01, 0.005, -0.1), Vector::Z * speed);
    let ball = world
        .insert_ball(ball, SurfaceProperties::STEEL, start, velocity)
        .unwrap();
    let mut broke = false;
    for _ in 0..((0.2 + 0.1 / speed) * rate) as usize {
        let (momentum, energy) = (world.momentum(), world.kinetic_energy());
        broke |= !world.step().unwrap().is_empty();
        let change = (world.momentum() - momentum).length();
        assert!(change < 1e-5 * momentum.length(), "{change} N·s");
        let made = world.kinetic_energy() - energy;
        assert!(made < 1e-4 * energy, "{made} J of {energy} J were made");
    }
    assert!(broke, "seed {seed} holds at {speed} m/s");
    f64::from(speed - world.physics.bodies[ball].linvel().z)
}

#[test]
fn a_ball_loses_the_same_whatever_the_length_of_a_step() {
    let pane = Breakable::uniform(Arc::clone(pane())).unwrap();
    for speed in [8.0, 12.0, 20.0, 30.0] {
        for seed in 0..3 {
            let losses = [60.0, 120.0, 240.0].map(|rate| lost(&pane, seed, speed, rate));
            println!("seed {seed}, {speed} m/s: {losses:.4?} m/s lost");
            let [least, most] = [f64::min, f64::max].map(|of| losses.into_iter().reduce(of));
            assert!(most.unwrap() < 1.01 * least.unwrap(), "{losses:?}");
        }
    }
}
