//! Fragments that break again, and the budget for debris.

use std::sync::Arc;
use std::time::Duration;

use crate::common::{Log, app, ball, body, motion, ready};
use avian3d::prelude::*;
use bevy::prelude::*;
use bevy_frangible::prelude::*;
use bevy_frangible::{BreakableBody, Broken};
use frangible_bake::pieces::Pieces;

fn pieces() -> BreakAgain {
    let mut model = Pieces::default();
    (model.elements, model.modes) = (Some(150), 20);
    BreakAgain {
        model: Some(Arc::new(model)),
        delay: Duration::from_millis(150),
        // The pane has few tetrahedra, and the ball leaves many pieces of it.
        least_tets: 20,
        ..BreakAgain::default()
    }
}

fn update(app: &mut App, count: usize) {
    for _ in 0..count {
        app.update();
    }
}

/// A pane that one ball breaks, and half a second later the largest shard.
fn twice(again: BreakAgain) -> (App, Log, Entity, Entity) {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO))
        .insert_resource(again);
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    ball(&mut app, Vec3::new(0.01, 0.005, 0.1), Vec3::NEG_Z * 12.0);
    update(&mut app, 60);
    let world = app.world();
    let largest = world.get::<Fragments>(pane).unwrap().iter().next().unwrap();
    let (at, turn) = (
        world.get::<Position>(largest).unwrap().0,
        world.get::<Rotation>(largest).unwrap().0,
    );
    // Its centre of mass may be beside it.
    let near = world.get::<BreakableBody>(largest).map(|body| {
        let near = body.0.nearest_on_surface(Default::default()).position;
        1.2 * Vec3::from_array(near.to_array())
    });
    let at = at + turn * near.unwrap_or_default();
    let flies = world.get::<LinearVelocity>(largest).unwrap().0;
    ball(&mut app, at + Vec3::Z * 0.06, flies + Vec3::NEG_Z * 20.0);
    (app, log, pane, largest)
}

#[test]
fn a_shard_breaks_again_and_its_pieces_are_all_of_it() {
    let (mut app, log, pane, shard) = twice(pieces());
    let world = app.world();
    let body = &world
        .get::<BreakableBody>(shard)
        .expect("it is breakable")
        .0;
    assert_eq!(body.generation(), 1);
    let mass = world.get::<ComputedMass>(shard).unwrap().value();
    let (energy, momentum) = motion(&mut app);
    update(&mut app, 30);
    let world = app.world();
    assert!(world.get::<Broken>(shard).is_some(), "{:?}", log.lines());
    let again: Vec<Entity> = world.get::<Fragments>(shard).unwrap().iter().collect();
    let sum: f32 = (again.iter())
        .map(|&f| world.get::<ComputedMass>(f).unwrap().value())
        .sum();
    assert!((sum / mass - 1.0).abs() < 1e-3, "{sum} kg of {mass} kg");
    assert!(
        world.get::<Children>(shard).is_none_or(|c| c.is_empty()),
        "its faces are gone"
    );
    let (after, then) = motion(&mut app);
    assert!(after <= energy * (1.0 + 1e-3), "{energy} J, then {after} J");
    assert!(
        (then - momentum).length() < 0.02 * momentum.length(),
        "{momentum} {then}"
    );
    // All of them go with the pane.
    app.world_mut().despawn(pane);
    assert!(again.iter().all(|&f| app.world().get_entity(f).is_err()));
}

#[test]
fn without_a_model_a_shard_is_a_plain_body() {
    let (mut app, _, _, shard) = twice(BreakAgain::default());
    update(&mut app, 30);
    assert!(app.world().get::<BreakableBody>(shard).is_none());
    assert!(app.world().get::<Broken>(shard).is_none());
}

#[test]
fn generations_have_an_end() {
    let once = BreakAgain {
        generations: 1,
        ..pieces()
    };
    let (mut app, _, _, shard) = twice(once);
    update(&mut app, 30);
    let mut bodies = app.world_mut().query::<&BreakableBody>();
    let most = bodies.iter(app.world()).map(|b| b.0.generation()).max();
    assert!(app.world().get::<Broken>(shard).is_some());
    assert!(most.is_none_or(|most| most <= 1));
}

#[test]
fn two_runs_give_the_same_bits() {
    let run = || {
        let (mut app, log, ..) = twice(pieces());
        update(&mut app, 60);
        let mut bodies = app.world_mut().query::<(&Position, &ComputedMass)>();
        let mut bits: Vec<[u32; 4]> = (bodies.iter(app.world()))
            .map(|(p, m)| [p.x, p.y, p.z, m.value()].map(f32::to_bits))
            .collect();
        bits.sort_unstable();
        (bits, log.lines())
    };
    let (first, second) = (run(), run());
    assert!(first.1.len() > 1, "{:?}", first.1);
    assert_eq!(first, second);
}

#[test]
fn siblings_that_overlap_creep_apart() {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO));
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    let ball = ball(&mut app, Vec3::new(0.01, 0.005, 0.03), Vec3::NEG_Z * 12.0);
    while app.world().get::<Broken>(pane).is_none() {
        app.update();
    }
    // Stopped at their birth, they are moved only by the push-out of overlaps.
    app.world_mut().despawn(ball);
    let mut pieces = app
        .world_mut()
        .query_filtered::<(&mut LinearVelocity, &mut AngularVelocity), With<FragmentOf>>();
    for (mut linear, mut angular) in pieces.iter_mut(app.world_mut()) {
        (linear.0, angular.0) = (Vec3::ZERO, Vec3::ZERO);
    }
    update(&mut app, 60);
    let speeds = pieces.iter(app.world()).map(|(v, _)| v.0.length());
    let fastest = speeds.fold(0.0, f32::max);
    println!("{:?}: {fastest} m/s", log.lines());
    assert!(fastest < 0.05, "{fastest} m/s");
}

#[test]
fn no_more_pieces_than_the_budget_and_dust_goes() {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO))
        .insert_resource(DebrisBudget {
            pieces: 5,
            dust_mass: 2e-3,
            ..DebrisBudget::default()
        });
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    ball(&mut app, Vec3::new(0.01, 0.005, 0.1), Vec3::NEG_Z * 25.0);
    update(&mut app, 60);
    let alive = |app: &App, wanted: &dyn Fn(Entity) -> bool| {
        let pieces = app.world().get::<Fragments>(pane).unwrap();
        pieces.iter().filter(|&f| wanted(f)).count()
    };
    let mass = |app: &App, f: Entity| app.world().get::<ComputedMass>(f).unwrap().value();
    let solid = |app: &App, f: Entity| app.world().get::<Collider>(f).is_some();
    let large = alive(&app, &|f| solid(&app, f));
    let dust = alive(&app, &|f| !solid(&app, f));
    println!("{:?}: {large} pieces, {dust} of dust", log.lines());
    assert!(large == 5 && dust > 0);
    assert_eq!(
        alive(&app, &|f| solid(&app, f) != (mass(&app, f) >= 2e-3)),
        0
    );
    update(&mut app, 240);
    assert_eq!(alive(&app, &|_| true), 5);
}
