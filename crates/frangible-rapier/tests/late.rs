//! Verdicts that come when the body has changed, or do not come at all.

use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex};

use crate::common::baked::pane;
use crate::common::{at, body, box_asset};
use frangible::glam::Vec3;
use frangible::internals::{BodyState, fracture_at};
use frangible::{Body, Contact, FractureConfig, Outcome};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::geometry::ColliderBuilder;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{
    Ball, BreakableWorld, Breaking, SurfaceProperties, WorldConfig, WorldError,
};

const DELAY: usize = 3;

/// A world without gravity that judges blows elsewhere, and a pane in it with a ball on its way to it.
fn world(delay: usize) -> (BreakableWorld, RigidBodyHandle) {
    let mut config = WorldConfig::default();
    config.gravity = Vector::ZERO;
    config.record_held = true;
    config.breaking = Breaking::AfterStep {
        budget: usize::MAX,
        delay,
    };
    let mut world = BreakableWorld::new(config).unwrap();
    let plate = (world.insert(
        body(pane()),
        RigidBodyBuilder::dynamic().pose(at(0.0, 0.0, 0.0)),
    ))
    .unwrap();
    let ball = Ball {
        mass: 0.05,
        radius: 0.01,
    };
    let fast = Vector::new(0.0, 0.0, 6.0);
    let steel = SurfaceProperties::STEEL;
    world
        .insert_ball(ball, steel, at(0.03, 0.02, -0.1), fast)
        .unwrap();
    (world, plate)
}

/// The step in which the ball hits.
fn step_of_blow() -> usize {
    let (mut world, _) = world(0);
    world.set_break_function(|_: &Body, _: &[Contact], _: &FractureConfig| Ok(held(None)));
    let blow = (0..30).find(|_| {
        world.step().unwrap();
        !world.held().is_empty()
    });
    blow.unwrap()
}

fn held(state: Option<BodyState>) -> Outcome {
    Outcome::Held {
        margin: 2.0,
        report: Default::default(),
        state: state.map(Box::new),
    }
}

/// Impulses that crack the pane and leave it whole, N·s, and the cracks.
fn cracking() -> Vec<(f32, BodyState)> {
    let (plate, config) = (body(pane()), FractureConfig::default());
    let mut found: Vec<(f32, BodyState)> = Vec::new();
    for k in 0..60 {
        let impulse = 0.01 * 1.12_f32.powi(k);
        let push = Vec3::NEG_Z * impulse;
        let outcome = fracture_at(&plate, Vec3::new(0.05, 0.0, 0.002), push, &config).unwrap();
        if let Outcome::Held {
            state: Some(state), ..
        } = outcome
            && found.iter().all(|(_, other)| *other != *state)
        {
            found.push((impulse, *state));
        }
    }
    found
}

#[test]
fn a_verdict_on_a_body_that_has_cracked_since_is_asked_for_anew() {
    let cracking = cracking();
    assert!(cracking.len() > 1, "{}", cracking.len());
    let (_, late) = cracking[0].clone();
    let (impulse, meanwhile) = cracking[1].clone();
    let (mut world, plate) = world(DELAY);
    let seen = Arc::new(Mutex::new(Vec::new()));
    let (asked, verdict) = (Arc::clone(&seen), late.clone());
    world.set_break_function(move |body: &Body, _: &[Contact], _: &FractureConfig| {
        let mut asked = asked.lock().unwrap();
        asked.push(body.state().clone());
        Ok(held((asked.len() == 1).then(|| verdict.clone())))
    });
    for _ in 0..=step_of_blow() {
        world.step().unwrap();
    }
    let place = Vector::new(0.05, 0.0, 0.002);
    let push = Vector::new(0.0, 0.0, -impulse);
    world.fracture_at(plate, place, push).unwrap();
    for _ in 0..=DELAY {
        world.step().unwrap();
    }
    let now = world.breakable(plate).unwrap().state().clone();
    let seen = seen.lock().unwrap();
    assert_eq!(seen.len(), 2, "the blow is judged again");
    assert!(seen[0] == BodyState::default() && seen[1] == now);
    assert!(now != late && now.to_bytes().len() == meanwhile.to_bytes().len());
}

#[test]
fn a_judge_that_panics_elsewhere_is_an_error_and_the_body_stays() {
    let (mut world, plate) = world(DELAY);
    let (say, said) = channel();
    world.set_break_function(move |_: &Body, _: &[Contact], _: &FractureConfig| {
        say.send(()).unwrap();
        panic!("as the test wants");
    });
    for _ in 0..=step_of_blow() {
        world.step().unwrap();
    }
    // The world's own thread would take what no other had begun with.
    said.recv().unwrap();
    let errors: Vec<WorldError> = (0..30).filter_map(|_| world.step().err()).collect();
    assert!(
        matches!(errors[..], [WorldError::JudgeFailed]),
        "{errors:?}"
    );
    assert!(world.breakable(plate).is_some());
}

#[test]
fn a_body_of_two_balls_touches_with_both() {
    let half = Vec3::new(0.2, 0.2, 0.01);
    let mut config = WorldConfig::default();
    config.gravity = Vector::ZERO;
    config.breaking = Breaking::AfterStep {
        budget: usize::MAX,
        delay: 0,
    };
    let mut world = BreakableWorld::new(config).unwrap();
    let places = Arc::new(Mutex::new(Vec::new()));
    let heard = Arc::clone(&places);
    world.set_break_function(move |_: &Body, contacts: &[Contact], _: &FractureConfig| {
        let mut heard = heard.lock().unwrap();
        heard.extend(contacts.iter().map(|c| c.point));
        Ok(held(None))
    });
    let plate = body(&box_asset(half, [4, 4, 1]));
    (world.insert(plate, RigidBodyBuilder::dynamic().pose(at(0.0, 0.0, 0.0)))).unwrap();
    let dumbbell = RigidBodyBuilder::dynamic()
        .translation(Vector::new(0.0, 0.0, 0.2))
        .linvel(Vector::new(0.0, 0.0, -5.0));
    let dumbbell = world.physics.bodies.insert(dumbbell);
    for x in [-0.1, 0.1] {
        let ball = ColliderBuilder::ball(0.02).translation(Vector::new(x, 0.0, 0.0));
        let physics = &mut world.physics;
        (physics.colliders).insert_with_parent(ball, dumbbell, &mut physics.bodies);
    }
    for _ in 0..30 {
        world.step().unwrap();
    }
    let places = places.lock().unwrap();
    for x in [-0.1, 0.1] {
        let near = |p: &&Vec3| (p.x - x).abs() < 0.01 && p.y.abs() < 0.01;
        assert_eq!(places.iter().filter(near).count(), 1, "{places:?}");
    }
    assert_eq!(places.len(), 2, "{places:?}");
}
