//! The blow's impulse counts in the world, not the engine's.

use crate::common::baked::{block, pane};
use crate::common::{at, body, relative, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::geometry::SharedShape;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{
    Ball, BreakEvent, BreakableWorld, Breaking, HeldEvent, SurfaceProperties, WorldConfig,
};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Throws a ball at a body at rest along −z, straight above `place`, and steps until it was looked at.
fn throw(
    asset: &std::sync::Arc<frangible::Asset>,
    top: f32,
    place: [f32; 2],
    ball: Ball,
    speed: f32,
) -> (BreakableWorld, RigidBodyHandle, RigidBodyHandle) {
    let mut world = world(false);
    // Every contact is integrated, however harmless.
    world.fracture_config_mut().culling = false;
    let body = world
        .insert(body(asset), RigidBodyBuilder::dynamic())
        .unwrap();
    let start = at(place[0], place[1], top + ball.radius + 0.01);
    let velocity = Vector::new(0.0, 0.0, -speed);
    let ball = world
        .insert_ball(ball, SurfaceProperties::STEEL, start, velocity)
        .unwrap();
    (world, body, ball)
}

fn step_to_hit(world: &mut BreakableWorld) -> (Vec<BreakEvent>, Vec<HeldEvent>) {
    for _ in 0..60 {
        world.step().unwrap();
        let looked_at = |e: &HeldEvent| !e.report.contacts.is_empty();
        if !world.breaks().is_empty() || world.held().iter().any(looked_at) {
            return (world.breaks().to_vec(), world.held().to_vec());
        }
    }
    panic!("nothing was hit");
}

/// Speed along a normal, m/s, of a place in the world.
fn speed_at(world: &BreakableWorld, body: RigidBodyHandle, point: Vec3, normal: Vec3) -> f32 {
    world.physics.bodies[body]
        .velocity_at_point(point)
        .dot(normal)
}

#[test]
fn a_ball_leaves_a_body_that_holds_as_the_blow_says() {
    let (thin, thick) = (pane(), block());
    let mut found = Vec::new();
    let (steel, speed) = (7800.0, 0.7);
    for (asset, top, place, radius) in [
        (thin, 0.002, [0.01, 0.02], 0.012_f32),
        (thick, 0.025, [0.012, -0.009], 0.008),
    ] {
        let mass = 4.0 / 3.0 * std::f32::consts::PI * radius.powi(3) * steel;
        let marble = Ball { mass, radius };
        let (mut world, body, ball) = throw(asset, top, place, marble, speed);
        let momentum = world.momentum();
        let energy = world.kinetic_energy();
        let (breaks, held) = step_to_hit(&mut world);
        assert!(breaks.is_empty(), "{} broke", asset.name());
        let answer = &held[0].report.contacts[0];
        // Body and world frame are the same but for what the step turned.
        let (point, normal) = (answer.point, answer.normal);
        let leaving = |world: &BreakableWorld| {
            speed_at(world, body, point, normal) - speed_at(world, ball, point, normal)
        };
        let leaves = leaving(&world);
        println!(
            "{}: the engine gave {:.6} N·s, the blow {:.6} N·s in {:.0} µs; it leaves at {leaves:.4} m/s, says the blow {:.4} m/s",
            asset.name(),
            held[0].contacts[0].impulse,
            answer.impulse,
            1e6 * answer.duration,
            answer.departure_speed,
        );
        // Rapier may have let a per mille of the approach through, or pushed out of an overlap.
        let error = (f64::from(leaves) - answer.departure_speed).abs();
        assert!(error < 0.01 * f64::from(speed), "{error} m/s apart");
        assert!(relative(momentum, world.momentum()) < 1e-6);
        assert!(world.kinetic_energy() <= energy * (1.0 + 1e-6));
        found.push(f64::from(leaves / held[0].contacts[0].approach_speed));
        // It goes on its way.
        for _ in 0..10 {
            world.step().unwrap();
        }
        assert!(world.kinetic_energy() <= energy * (1.0 + 1e-6));
        let later = leaving(&world);
        assert!((later - leaves).abs() < 0.02, "later {later} m/s");
    }
    let [on_the_pane, on_the_block] = found[..] else {
        panic!()
    };
    // Zener: a thin wide wall swallows the blow; a block of five centimetres throws it back.
    assert!(on_the_pane.abs() < 0.2, "restitution {on_the_pane}");
    assert!(on_the_block > 0.9, "restitution {on_the_block}");
}

#[test]
fn a_ball_keeps_the_speed_that_the_blow_left_it() {
    for (mass, radius, speed) in [(0.03, 0.01, 30.0), (0.1, 0.014, 40.0)] {
        let ball = Ball { mass, radius };
        let (mut world, _, ball) = throw(pane(), 0.002, [0.02, 0.01], ball, speed);
        let (breaks, _) = step_to_hit(&mut world);
        let event = breaks.first().expect("the pane breaks");
        let answer = &event.fracture.report.contacts[0];
        let left = f64::from(speed) - answer.impulse / f64::from(mass);
        let now = -f64::from(world.physics.bodies[ball].linvel().z);
        println!(
            "{mass} kg at {speed} m/s: the blow took {:.4} N·s in {:.0} µs and left {left:.2} m/s; after the step {now:.2} m/s",
            answer.impulse,
            1e6 * answer.duration
        );
        // Pieces heavier than the plug, and the cracks' price, may take a little more; nothing gives the ball speed back.
        assert!(now <= left + 1e-3 * f64::from(speed));
        assert!(now >= left - 0.15 * f64::from(speed));
    }
}

/// Pseudo-random numbers in −1..1.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f32 {
        self.0 = (self.0)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    fn vector(&mut self) -> Vector {
        Vector::new(self.roll(), self.roll(), self.roll())
    }
}

/// A pane or block, and what flies at it: balls, a plain box, or another breakable body.
fn random_scene(seed: u64, breaking: Breaking) -> BreakableWorld {
    let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    for _ in 0..4 {
        dice.roll();
    }
    let mut config = WorldConfig::default();
    config.gravity = Vector::ZERO;
    config.breaking = breaking;
    let mut world = BreakableWorld::new(config).unwrap();
    let assets = [pane(), block()];
    let target = assets[seed as usize % 2];
    let pose = Pose::new(Vector::ZERO, 3.0 * dice.vector());
    let drift = dice.vector();
    let spin = 3.0 * dice.vector();
    world
        .insert(
            body(target),
            RigidBodyBuilder::dynamic()
                .pose(pose)
                .linvel(drift)
                .angvel(spin),
        )
        .unwrap();
    for side in [-1.0_f32, 1.0] {
        let speed = 8.0 + 15.0 * dice.roll().abs();
        let way = Vector::new(0.1 * dice.roll(), 0.1 * dice.roll(), -side).normalize();
        let start = Vector::new(0.05 * dice.roll(), 0.05 * dice.roll(), side * 0.32);
        match (seed / 2 + u64::from(side > 0.0)) % 3 {
            0 => {
                let ball = Ball {
                    mass: 0.01 + 0.2 * dice.roll().abs(),
                    radius: 0.012,
                };
                let at = Pose::from_translation(start);
                world.insert_ball(ball, SurfaceProperties::STEEL, at, speed * way)
            }
            1 => {
                let half = Vector::new(0.03, 0.02, 0.01);
                let shape = SharedShape::cuboid(half.x, half.y, half.z);
                let pose = Pose::new(start, dice.vector());
                world.insert_rigid(shape, 0.1, SurfaceProperties::STONE, pose, speed * way)
            }
            _ => {
                let pose = Pose::new(start, 3.0 * dice.vector());
                let spin = dice.vector();
                let other = assets[(seed as usize / 4) % 2];
                world.insert(
                    body(other),
                    RigidBodyBuilder::dynamic()
                        .pose(pose)
                        .linvel(speed * way)
                        .angvel(spin),
                )
            }
        }
        .unwrap();
    }
    world
}

/// Bodies that broke and blows that held in a scene; how much energy rose in a step at most, with a break in it and without.
fn play(seed: u64) -> (u64, u64, [f64; 2]) {
    let after = Breaking::AfterStep {
        budget: usize::MAX,
        delay: 0,
    };
    let breaking = if seed % 3 == 2 {
        after
    } else {
        Breaking::InsideStep
    };
    let mut world = random_scene(seed, breaking);
    let momentum = world.momentum();
    let scale: f64 = (world.physics.bodies.iter())
        .map(|(_, b)| f64::from(b.mass() * b.linvel().length()))
        .sum();
    let start = world.kinetic_energy();
    let mut energy = start;
    let mut rises = [0.0_f64; 2];
    for step in 0..16 {
        let asked = world.impact_counts().asked;
        world.step().unwrap();
        let now = world.kinetic_energy();
        let cracks: f64 = world.breaks().iter().map(|e| e.energy_paid).sum();
        let rise = (now + cracks) / energy - 1.0;
        // A break gains nothing but rounding, and no step gains what was lost before. Other steps are the engine's, whose
        // restitution at several contacts at once gains up to 13 % here between three bodies, and up to 20 % among pieces that lost more in the
        // steps before, where no blow is asked for (measured); of two bodies alone it is taken back.
        let among_pieces = world.physics.bodies.len() > 3 && world.impact_counts().asked == asked;
        let (kind, limit) = match (world.breaks().is_empty(), among_pieces) {
            (false, _) => (0, 1e-5),
            (true, false) => (1, 0.15),
            (true, true) => (1, 0.25),
        };
        rises[kind] = rises[kind].max(rise);
        assert!(
            rise < limit && now <= start * (1.0 + 5e-3),
            "scene {seed}, step {step}, {breaking:?}: {start}, {energy} → {now} + {cracks} J"
        );
        energy = now;
        let drift = (world.momentum() - momentum).length() / scale;
        assert!(drift < 1e-5, "scene {seed}, step {step}: P {drift:e}");
    }
    let counts = world.impact_counts();
    (counts.broke, counts.asked - counts.broke, rises)
}

#[test]
fn twenty_scenes_keep_momentum_and_gain_no_energy() {
    // Baked before: a thread of the pool that baked one could be given a scene meanwhile that waits for the same.
    let _ = (pane(), block());
    let scenes: Vec<_> = (0..20).into_par_iter().map(play).collect();
    let broke: u64 = scenes.iter().map(|s| s.0).sum();
    let held: u64 = scenes.iter().map(|s| s.1).sum();
    let most = |k: usize| scenes.iter().map(|s| s.2[k]).fold(0.0, f64::max);
    println!(
        "{broke} broke, {held} blows held; energy rose by {:.1e} at most in breaks, {:.1e} in other steps",
        most(0),
        most(1)
    );
    assert!(broke > 10 && held > 10);
}

#[test]
fn two_bodies_that_meet_and_hold_take_the_mean_of_their_blows() {
    let mut world = world(false);
    world.fracture_config_mut().culling = false;
    let one = world
        .insert(body(pane()), RigidBodyBuilder::dynamic())
        .unwrap();
    let pose = Pose::new(Vector::new(0.01, 0.02, 0.09), Vector::new(0.9, 0.6, 0.2));
    let down = Vector::new(0.0, 0.0, -1.0);
    let other = world
        .insert(
            body(block()),
            RigidBodyBuilder::dynamic().pose(pose).linvel(down),
        )
        .unwrap();
    let (momentum, energy) = (world.momentum(), world.kinetic_energy());
    let (breaks, held) = step_to_hit(&mut world);
    assert!(breaks.is_empty());
    assert_eq!(held.len(), 2, "both are asked");
    let blow = |handle: RigidBodyHandle| {
        let event = held.iter().find(|e| e.body == handle).unwrap();
        let contacts = event.report.contacts.iter();
        contacts.map(|c| c.impulse).sum::<f64>()
    };
    let mean = 0.5 * (blow(one) + blow(other));
    let given = (world.physics.bodies[one].linvel().as_dvec3() * pane().mass().mass).length();
    println!(
        "pane {:.4}, block {:.4}, mean {mean:.4}, given {given:.4} N·s",
        blow(one),
        blow(other)
    );
    assert!((given / mean - 1.0).abs() < 0.1, "{given} N·s, not {mean}");
    assert!((world.momentum() - momentum).length() < 1e-6 * momentum.length());
    assert!(world.kinetic_energy() <= energy * (1.0 + 1e-6));
}
