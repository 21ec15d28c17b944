//! Pieces that rest, fade, or take too long.

use std::time::Duration;

use crate::common::{app, ball, body, ready};
use avian3d::dynamics::solver::islands::WakeBody;
use avian3d::prelude::*;
use bevy::prelude::*;
use bevy_frangible::prelude::*;
use bevy_frangible::{Broken, CrackFaces, Rubble};

/// A pane that falls flat from a metre on a floor, and its pieces.
fn fallen(budget: DebrisBudget) -> (App, Entity) {
    let (mut app, log) = app();
    app.insert_resource(DebrisBudget {
        dust_mass: 0.0,
        ..budget
    });
    let floor = (RigidBody::Static, Collider::half_space(Vec3::Y));
    app.world_mut().spawn(floor);
    let flat = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    let place = Transform::from_xyz(0.0, 1.0, 0.0).with_rotation(flat);
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

/// Runs until all pieces were dealt with; they lie on one another here, and have ten seconds.
fn settle(app: &mut App, pane: Entity, mut before_step: impl FnMut(&mut App)) {
    for _ in 0..10 * 240 {
        let kind = |&piece: &Entity| app.world().get::<RigidBody>(piece);
        let mut pieces = pieces(app, pane);
        pieces.retain(|piece| kind(piece) == Some(&RigidBody::Dynamic));
        if pieces.is_empty() {
            return;
        }
        before_step(app);
        app.update();
    }
    panic!("a piece never sleeps");
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
    settle(&mut app, pane, |_| {});
    assert_eq!(frozen(&app, &all), all.len());
    let places = |app: &App| -> Vec<Vec3> {
        let at = |&piece: &Entity| app.world().get::<Position>(piece).unwrap().0;
        all.iter().map(at).collect()
    };
    let before = places(&app);
    ball(&mut app, before[0] + Vec3::Y * 0.1, Vec3::NEG_Y * 5.0);
    steps(&mut app, 60);
    assert_eq!(places(&app), before);
}

/// Corners of all faces of a piece, in the world, m: outer faces and crack faces.
fn corners(app: &mut App, of: &[Entity]) -> [Vec<Vec3>; 2] {
    let world = app.world_mut();
    let mut faces = world.query::<(&ChildOf, &Mesh3d, Has<CrackFaces>)>();
    let meshes = world.resource::<Assets<Mesh>>();
    let mut corners = [Vec::new(), Vec::new()];
    for (piece, mesh, crack) in faces.iter(world) {
        let place = world
            .get::<Transform>(piece.0)
            .filter(|_| of.contains(&piece.0));
        let (Some(place), Some(mesh)) = (place, meshes.get(&mesh.0)) else {
            continue;
        };
        let positions = mesh.attribute(Mesh::ATTRIBUTE_POSITION);
        let positions = positions.and_then(|p| p.as_float3()).unwrap_or(&[]);
        let placed = positions.iter().map(|&p| place.transform_point(p.into()));
        corners[usize::from(crack)].extend(placed);
    }
    corners
}

#[test]
fn what_rests_is_merged_into_one_static_body_that_looks_and_collides_alike() {
    let (mut app, pane) = fallen(DebrisBudget {
        at_rest: AtRest::Merge,
        rest_time: Duration::from_millis(200),
        ..DebrisBudget::default()
    });
    let all = pieces(&app, pane);
    let mut last: Vec<[Vec<Vec3>; 2]> = vec![default(); all.len()];
    settle(&mut app, pane, |app| {
        for (piece, last) in all.iter().zip(&mut last) {
            if app.world().get_entity(*piece).is_ok() {
                *last = corners(app, &[*piece]);
            }
        }
    });
    let after = pieces(&app, pane);
    assert_eq!(after.len(), 1);
    let rubble = *after
        .iter()
        .find(|&&piece| app.world().get::<Rubble>(piece).is_some())
        .expect("what rests is merged");
    assert_eq!(frozen(&app, &[rubble]), 1);
    // Each face is where it was, in the order in which its piece was merged.
    let lies = corners(&mut app, &[rubble]);
    for (kind, lies) in lies.iter().enumerate() {
        let gone = all.iter().zip(&last).filter(|(p, _)| !after.contains(p));
        let gone: Vec<&[Vec3]> = gone.map(|(_, last)| &last[kind][..]).collect();
        assert_eq!(gone.iter().map(|g| g.len()).sum::<usize>(), lies.len());
        for was in gone.into_iter().filter(|was| !was.is_empty()) {
            let near = |(a, b): (&Vec3, &Vec3)| a.distance(*b) < 1e-4;
            let mut windows = lies.windows(was.len());
            assert!(windows.any(|now| now.iter().zip(was).all(near)));
        }
    }
    let faces = app.world().get::<Children>(rubble).expect("its faces");
    assert_eq!(faces.iter().count(), 2);
    // A ball that falls on it stays above the floor by the height of a pane.
    let middle: Vec3 = lies[0].iter().sum::<Vec3>() / lies[0].len() as f32;
    let nearest = lies[0].iter().copied().filter(|p| p.y > 0.0015);
    let nearest = nearest.min_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
    let on = nearest.expect("a top face");
    let at = Vec3::new(on.x, 0.1, on.z);
    let ball = ball(&mut app, at, Vec3::ZERO);
    let mut lowest = f32::INFINITY;
    for _ in 0..120 {
        app.update();
        lowest = lowest.min(app.world().get::<Position>(ball).unwrap().y);
    }
    println!("the ball of 15.8 mm came down to {lowest}");
    assert!(lowest > 0.0158 + 0.5 * on.y, "{lowest} over {on}");
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
    settle(&mut app, pane, |app| {
        for &piece in &all {
            let Some(place) = app.world().get::<Transform>(piece) else {
                continue;
            };
            smallest = smallest.min(place.scale.x);
            let solid = app.world().get::<Collider>(piece).is_some();
            assert!(!solid || place.scale.x == 1.0, "what shrinks is no body");
        }
    });
    assert!(smallest < 0.1, "{smallest}");
    // Pieces that had begun to shrink are gone too.
    steps(&mut app, 61);
    assert!(pieces(&app, pane).is_empty());
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

#[test]
fn a_heap_of_pieces_falls_asleep_and_falls_when_nothing_carries_it() {
    let (mut app, _) = app();
    let board = (RigidBody::Static, Collider::cuboid(40.0, 0.1, 40.0));
    let board = app
        .world_mut()
        .spawn((board, Transform::from_xyz(0.0, -0.05, 0.0)))
        .id();
    let flat = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    let panes: Vec<Entity> = (0..4)
        .map(|k| {
            let place = Transform::from_xyz(0.02 * k as f32, 1.0 + 0.3 * k as f32, 0.0);
            body(&mut app, "pane", place.with_rotation(flat))
        })
        .collect();
    for &pane in &panes {
        ready(&mut app, pane);
    }
    steps(&mut app, 12 * 240);
    let all: Vec<Entity> = panes.iter().flat_map(|&pane| pieces(&app, pane)).collect();
    let awake = |app: &App| {
        let asleep = |&&piece: &&Entity| app.world().get::<Sleeping>(piece).is_some();
        all.len() - all.iter().filter(asleep).count()
    };
    println!("{} of {} are awake", awake(&app), all.len());
    assert!(all.len() > 15 && awake(&app) == 0);
    // Avian itself wakes nothing when what is static goes.
    app.world_mut().despawn(board);
    for &piece in &all {
        app.world_mut().commands().queue(WakeBody(piece));
    }
    steps(&mut app, 120);
    let falls = |&piece: &Entity| app.world().get::<Position>(piece).unwrap().y < -0.5;
    assert!(all.iter().all(falls));
}
