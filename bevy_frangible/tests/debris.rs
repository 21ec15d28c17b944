//! Pieces that rest, fade, or take too long.
#![cfg(feature = "avian")]

mod common;

use std::time::Duration;

use avian3d::prelude::*;
use bevy::prelude::*;
use bevy_frangible::Broken;
use bevy_frangible::prelude::*;
use common::{app, ball, body, ready};

/// A pane that falls flat from half a metre on a floor, and its pieces.
fn fallen(budget: DebrisBudget) -> (App, Entity) {
    let (mut app, log) = app();
    app.insert_resource(DebrisBudget {
        dust_mass: 0.0,
        ..budget
    });
    let floor = (RigidBody::Static, Collider::half_space(Vec3::Y));
    app.world_mut().spawn(floor);
    let flat = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    let place = Transform::from_xyz(0.0, 0.5, 0.0).with_rotation(flat);
    let pane = body(&mut app, "pane", place);
    ready(&mut app, pane);
    steps(&mut app, 120);
    assert!(
        app.world().get::<Broken>(pane).is_some(),
        "{:?}",
        log.lines()
    );
    (app, pane)
}

fn steps(app: &mut App, count: usize) {
    for _ in 0..count {
        app.update();
    }
}

fn pieces(app: &App, pane: Entity) -> Vec<Entity> {
    let fragments = app.world().get::<Fragments>(pane);
    fragments.map_or_else(Vec::new, |all| all.iter().collect())
}

fn frozen(app: &App, pieces: &[Entity]) -> usize {
    let kind = |&piece: &Entity| app.world().get::<RigidBody>(piece).copied();
    pieces
        .iter()
        .filter(|p| kind(p) == Some(RigidBody::Static))
        .count()
}

#[test]
fn what_rests_becomes_static_and_is_not_moved_any_more() {
    let (mut app, pane) = fallen(DebrisBudget {
        at_rest: AtRest::Freeze,
        rest_time: Duration::from_millis(200),
        ..DebrisBudget::default()
    });
    let all = pieces(&app, pane);
    assert_eq!(frozen(&app, &all), 0, "they move still");
    steps(&mut app, 8 * 240);
    let still: Vec<Entity> = all
        .iter()
        .copied()
        .filter(|&piece| frozen(&app, &[piece]) == 1)
        .collect();
    println!("{} of {} are static", still.len(), all.len());
    // Avian lets one of them creep on.
    assert!(still.len() + 1 >= all.len());
    let places = |app: &App| -> Vec<Vec3> {
        let at = |&piece: &Entity| app.world().get::<Position>(piece).unwrap().0;
        still.iter().map(at).collect()
    };
    let before = places(&app);
    ball(&mut app, before[0] + Vec3::Y * 0.1, Vec3::NEG_Y * 5.0);
    steps(&mut app, 60);
    assert_eq!(places(&app), before);
}

#[test]
fn what_rests_shrinks_and_goes() {
    let (mut app, pane) = fallen(DebrisBudget {
        at_rest: AtRest::Go,
        rest_time: Duration::from_millis(200),
        fade_time: Duration::from_millis(250),
        ..DebrisBudget::default()
    });
    let all = pieces(&app, pane);
    let mut smallest = 1.0_f32;
    for _ in 0..8 * 240 {
        app.update();
        for &piece in &all {
            let Some(place) = app.world().get::<Transform>(piece) else {
                continue;
            };
            smallest = smallest.min(place.scale.x);
            let solid = app.world().get::<Collider>(piece).is_some();
            assert!(!solid || place.scale.x == 1.0, "what shrinks is no body");
        }
    }
    assert!(smallest < 0.1, "{smallest}");
    // Avian lets one of them creep on.
    assert!(all.len() > 3 && pieces(&app, pane).len() <= 1);
}

#[test]
fn steps_that_take_too_long_cost_pieces() {
    for (step_time, all_go) in [(Some(Duration::ZERO), true), (Some(Duration::MAX), false)] {
        let (mut app, pane) = fallen(DebrisBudget {
            step_time,
            ..DebrisBudget::default()
        });
        let before = pieces(&app, pane).len();
        steps(&mut app, 240);
        let after = pieces(&app, pane).len();
        println!("{before} pieces, then {after}");
        assert_eq!(after == 0, all_go);
        assert!(all_go || after > 3);
    }
}
