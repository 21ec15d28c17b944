//! Bodies that break in Avian, without a window.

use crate::common::{app, ball, body, motion, ready};
use avian3d::prelude::*;
use bevy::prelude::*;
use bevy_frangible::prelude::*;
use bevy_frangible::{BreakableBody, Broken, CrackFaces, OuterFaces};

#[test]
fn a_ball_goes_on_through_the_pane_that_it_breaks() {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO));
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    let ball = ball(&mut app, Vec3::new(0.01, 0.005, 0.1), Vec3::NEG_Z * 12.0);
    app.update();
    let (energy, momentum) = motion(&mut app);
    for _ in 0..60 {
        app.update();
    }
    let lines = log.lines();
    assert!(
        lines.iter().any(|line| line.ends_with("pieces")),
        "{lines:?}"
    );
    let world = app.world();
    assert!(world.get::<Broken>(pane).is_some());
    assert!(world.get::<Collider>(pane).is_none() && world.get::<Mesh3d>(pane).is_none());
    let fragments: Vec<Entity> = world.get::<Fragments>(pane).unwrap().iter().collect();
    assert!(fragments.len() > 3);
    let mut mass = 0.0;
    let (mut outer, mut crack) = (0, 0);
    for &fragment in &fragments {
        assert!(world.get::<Collider>(fragment).is_some());
        mass += world.get::<ComputedMass>(fragment).unwrap().value();
        for &child in world.get::<Children>(fragment).unwrap() {
            outer += usize::from(world.get::<OuterFaces>(child).is_some());
            crack += usize::from(world.get::<CrackFaces>(child).is_some());
        }
    }
    assert!(
        (mass / (0.2 * 0.2 * 0.004 * 2500.0) - 1.0).abs() < 1e-3,
        "{mass} kg"
    );
    assert!(outer >= fragments.len() - 1 && crack == fragments.len());
    let speed = -world.get::<LinearVelocity>(ball).unwrap().z;
    println!(
        "{} pieces, the ball goes on at {speed} m/s",
        fragments.len()
    );
    assert!(speed.abs() < 12.0, "{speed} m/s");
    let (after, then) = motion(&mut app);
    assert!(after <= energy * (1.0 + 1e-3), "{energy} J, then {after} J");
    assert!(
        (then - momentum).length() < 0.02 * momentum.length(),
        "{momentum} {then}"
    );
    // The broken body goes, and its pieces with it.
    app.world_mut().despawn(pane);
    assert!(
        fragments
            .iter()
            .all(|&f| app.world().get_entity(f).is_err())
    );
}

#[test]
fn a_fast_ball_is_at_the_pane_when_it_breaks_it() {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO));
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    // Avian's sweep stops it in front of the pane, so that its place at the end of the step says nothing.
    let ball = ball(&mut app, Vec3::Z * 0.1, Vec3::NEG_Z * 40.0);
    app.update();
    assert!(log.lines()[0].ends_with("pieces"), "{:?}", log.lines());
    let at = app.world().get::<Position>(ball).unwrap().0;
    let touches = 0.0158 + 0.002;
    assert!((at.z - touches).abs() < 1e-4, "{at}");
}

#[test]
fn a_slow_ball_bounces_off_and_is_heard_of() {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO));
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    ball(&mut app, Vec3::new(0.01, 0.005, 0.03), Vec3::NEG_Z * 0.7);
    for _ in 0..60 {
        app.update();
    }
    assert_eq!(log.lines(), ["held"]);
    assert!(app.world().get::<BreakableBody>(pane).is_some());
}

#[test]
fn what_is_held_stays_where_it_is_held() {
    let (mut app, log) = app();
    let shelf = body(&mut app, "shelf", Transform::default());
    ready(&mut app, shelf);
    assert_eq!(
        app.world().get::<RigidBody>(shelf),
        Some(&RigidBody::Static)
    );
    ball(&mut app, Vec3::new(0.1, 0.0, 0.1), Vec3::NEG_Z * 6.0);
    for _ in 0..60 {
        app.update();
    }
    assert!(
        log.lines().iter().any(|line| line.ends_with("pieces")),
        "{:?}",
        log.lines()
    );
    let world = app.world();
    let kinds: Vec<RigidBody> = (world.get::<Fragments>(shelf).unwrap().iter())
        .map(|f| *world.get::<RigidBody>(f).unwrap())
        .collect();
    assert!(kinds.contains(&RigidBody::Static) && kinds.contains(&RigidBody::Dynamic));
}

#[test]
fn a_script_breaks_a_body_by_one_event() {
    let (mut app, log) = app();
    let pane = body(&mut app, "pane", Transform::from_xyz(0.0, 3.0, 0.0));
    ready(&mut app, pane);
    app.world_mut().trigger(Blow {
        entity: pane,
        at: Vec3::new(0.0, 3.0, 0.0),
        impulse: Vec3::NEG_Z * 2.0,
    });
    app.update();
    assert!(log.lines()[0].ends_with("pieces"), "{:?}", log.lines());
}

#[test]
fn two_that_break_each_other_keep_their_momentum() {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO));
    let still = body(&mut app, "pane", Transform::default());
    // It comes with its edge first.
    let turned = Quat::from_rotation_y(std::f32::consts::FRAC_PI_2);
    let place = Transform::from_xyz(0.01, 0.02, 0.15).with_rotation(turned);
    let flies = body(&mut app, "pane", place);
    for pane in [still, flies] {
        ready(&mut app, pane);
    }
    app.update();
    app.world_mut()
        .entity_mut(flies)
        .insert(LinearVelocity(Vec3::NEG_Z * 80.0));
    let (energy, momentum) = motion(&mut app);
    while app.world().get::<Broken>(still).is_none() {
        app.update();
    }
    app.update();
    let both = app.world().get::<Broken>(flies).is_some();
    assert!(both, "{:?}", log.lines());
    let (after, then) = motion(&mut app);
    println!("{momentum} {then}, {energy} J {after} J");
    assert!((then - momentum).length() < 0.02 * momentum.length());
    assert!(after <= energy * (1.0 + 1e-3));
}

#[test]
fn a_collider_of_the_game_s_own_breaks_as_well() {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO));
    let handle = app.world().resource::<AssetServer>().load("pane.frangible");
    let own = (RigidBody::Dynamic, Collider::cuboid(0.2, 0.2, 0.004));
    let pane = app.world_mut().spawn((Breakable(handle), own)).id();
    ready(&mut app, pane);
    ball(&mut app, Vec3::new(0.01, 0.005, 0.1), Vec3::NEG_Z * 12.0);
    for _ in 0..30 {
        app.update();
    }
    assert!(
        app.world().get::<Broken>(pane).is_some(),
        "{:?}",
        log.lines()
    );
    let lines = log.lines();
    assert!(!lines.iter().any(|l| l.contains("removed")), "{lines:?}");
}

/// A pane at each of these places along x, and a ball that flies at it.
fn panes(app: &mut App, places: &[f32]) -> Vec<(Entity, Entity)> {
    let panes: Vec<Entity> = (places.iter())
        .map(|&x| body(app, "pane", Transform::from_xyz(x, 0.0, 0.0)))
        .collect();
    for &pane in &panes {
        ready(app, pane);
    }
    let thrown = panes.into_iter().zip(places);
    let throw = |(pane, &x)| {
        let at = Vec3::new(x + 0.01, 0.005, 0.1);
        (pane, ball(app, at, Vec3::NEG_Z * 12.0))
    };
    thrown.map(throw).collect()
}

/// Step in which each pane broke, and the bits of all positions at that time.
fn late(budget: usize, delay: u32) -> (Vec<u32>, Vec<[u32; 3]>) {
    let (mut app, _) = app();
    app.insert_resource(Gravity(Vec3::ZERO))
        .insert_resource(Breaking::AfterStep { budget, delay });
    let panes = panes(&mut app, &[0.0, 0.5, 1.0]);
    let mut steps = vec![0; panes.len()];
    let (energy, momentum) = motion(&mut app);
    for _ in 0..60 {
        for (step, &(pane, _)) in steps.iter_mut().zip(&panes) {
            *step += u32::from(app.world().get::<Broken>(pane).is_none());
        }
        app.update();
    }
    let (after, then) = motion(&mut app);
    assert!((then - momentum).length() < 0.02 * momentum.length());
    assert!(after < energy, "{energy} J, then {after} J");
    let mut places = app.world_mut().query::<&Position>();
    let bits = places
        .iter(app.world())
        .map(|p| p.to_array().map(f32::to_bits));
    let mut bits: Vec<[u32; 3]> = bits.collect();
    bits.sort_unstable();
    (steps, bits)
}

#[test]
fn a_budget_spreads_breaks_over_steps() {
    let (all, _) = late(usize::MAX, 3);
    let (mut one, _) = late(1, 3);
    one.sort_unstable();
    println!("{all:?} {one:?}");
    assert!(all.iter().all(|&step| step == all[0]) && all[0] < 60);
    assert_eq!(one, [all[0], all[0] + 1, all[0] + 2]);
    let (at_once, _) = late(usize::MAX, 0);
    assert_eq!(at_once[0] + 3, all[0]);
}

#[test]
fn breaks_after_the_step_are_the_same_bits_in_every_run() {
    assert_eq!(late(1, 3), late(1, 3));
}
