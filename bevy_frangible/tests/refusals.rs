//! A body that cannot break gives the reason, and nothing panics.

use std::time::Duration;

use crate::common::{Log, app, app_in, ball, bodies, body, ready};
use avian3d::prelude::*;
use bevy::prelude::*;
use bevy_frangible::prelude::*;
use bevy_frangible::{BreakableBody, Fracturing};
use frangible::Asset as Baked;
use frangible::Fields;

fn said(log: &Log, words: &str) -> bool {
    log.lines().iter().any(|line| line.contains(words))
}

/// Waits until a message with these words has come.
fn hear(app: &mut App, log: &Log, words: &str) {
    for _ in 0..2000 {
        app.update();
        if said(log, words) {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("nobody said `{words}`: {:?}", log.lines());
}

fn blow(entity: Entity, impulse: Vec3) -> Blow {
    let at = Vec3::ZERO;
    Blow {
        entity,
        at,
        impulse,
    }
}

#[test]
fn a_missing_file_is_named() {
    let (mut app, log) = app();
    let missing = body(&mut app, "nothing", Transform::default());
    app.world_mut().trigger(blow(missing, Vec3::X));
    hear(&mut app, &log, "not loaded yet");
    hear(&mut app, &log, "nothing.frangible");
    // Also to one that comes when the failure is old.
    let count = log.lines().len();
    body(&mut app, "nothing", Transform::default());
    let start = std::time::Instant::now();
    while log.lines().len() == count && start.elapsed().as_secs() < 60 {
        app.update();
    }
    assert!(log.lines().len() > count, "{:?}", log.lines());
}

#[test]
fn a_file_of_a_newer_version_says_so() {
    let folder = std::env::temp_dir().join(format!("bevy_frangible-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let mut bytes = std::fs::read(bodies().join("block.frangible")).unwrap();
    // The version stands behind the magic number and the checksum.
    bytes[16..20].copy_from_slice(&9999_u32.to_le_bytes());
    std::fs::write(folder.join("newer.frangible"), bytes).unwrap();
    let (mut app, log) = app_in(folder.clone());
    body(&mut app, "newer", Transform::default());
    hear(&mut app, &log, "its format version is 9999");
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn numbers_that_make_no_strength_are_named() {
    let baked = || Baked::load(bodies().join("pane.frangible")).unwrap();
    let mut soft = baked();
    soft.parts_mut().material.fracture_energy = 0.0;
    let refused = FrangibleAsset::new(soft).err().unwrap().to_string();
    assert!(refused.contains("fracture energy"), "{refused}");
    let kind = FrangibleAsset::new(baked()).unwrap().0;
    for (name, spoil) in [
        ("specimen", (|f| f.specimen = 0.0) as fn(&mut Fields)),
        ("specimen", |f| f.specimen = f64::INFINITY),
        ("Weibull modulus", |f| f.weibull_modulus = 0.5),
        ("fatigue exponent", |f| {
            f.fatigue.as_mut().unwrap().exponent = 0.0;
        }),
    ] {
        let mut fields = Fields::of_material(kind.asset().material());
        spoil(&mut fields);
        let refused = kind.clone().with_fields(fields).err().unwrap().to_string();
        assert!(refused.contains(name), "{refused}");
    }
    let (mut app, log) = app();
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    app.world_mut().resource_mut::<Fracturing>().0.load_duration = f64::NAN;
    app.world_mut().trigger(blow(pane, Vec3::Z * 3.0));
    hear(&mut app, &log, "`load_duration`");
}

#[test]
fn a_scale_that_is_not_uniform_is_refused() {
    let (mut app, log) = app();
    for (scale, said) in [
        (Vec3::new(1.0, 2.0, 1.0), "scaled by [1, 2, 1]"),
        (Vec3::new(1.0, 1.0, -1.0), "scaled by [-1, 1, 1]"),
        (Vec3::ZERO, "scaled by [0, 0, 0]"),
    ] {
        let scaled = body(&mut app, "block", Transform::from_scale(scale));
        hear(&mut app, &log, said);
        assert!(app.world().get::<BreakableBody>(scaled).is_none());
    }
}

#[test]
fn a_uniform_scale_is_a_body_of_that_size() {
    let (mut app, _) = app();
    app.insert_resource(Gravity(Vec3::ZERO));
    let one = body(&mut app, "pane", Transform::from_xyz(0.0, 9.0, 0.0));
    let twice = body(&mut app, "pane", Transform::from_scale(Vec3::splat(2.0)));
    ready(&mut app, one);
    ready(&mut app, twice);
    let world = app.world();
    let body = |e: Entity| &world.get::<BreakableBody>(e).unwrap().0;
    let (small, large) = (body(one).asset(), body(twice).asset());
    assert!((large.mass().mass / small.mass().mass - 8.0).abs() < 1e-4);
    // A frequency goes as one over the size.
    let ratio = small.modes().eigenvalues[0] / large.modes().eigenvalues[0];
    assert!((ratio - 4.0).abs() < 1e-9, "{ratio}");
    // The ball that would fly past the small one hits the large one, which is scaled once and not twice.
    ball(&mut app, Vec3::new(0.15, 0.005, 0.1), Vec3::NEG_Z * 20.0);
    let past = ball(&mut app, Vec3::new(0.25, 0.005, 0.02), Vec3::NEG_Z * 20.0);
    for _ in 0..30 {
        app.update();
    }
    let world = app.world();
    assert!(world.get::<Fragments>(twice).is_some());
    assert!(world.get::<Fragments>(one).is_none());
    let free = world.get::<LinearVelocity>(past).unwrap().0;
    assert_eq!(free, Vec3::NEG_Z * 20.0);
    let fragments: Vec<Entity> = world.get::<Fragments>(twice).unwrap().iter().collect();
    let sum: f32 = (fragments.iter())
        .map(|&f| world.get::<ComputedMass>(f).unwrap().value())
        .sum();
    assert!(
        (sum / (0.4 * 0.4 * 0.008 * 2500.0) - 1.0).abs() < 1e-3,
        "{sum} kg"
    );
    let scale = |e: &Entity| world.get::<Transform>(*e).unwrap().scale;
    assert!(fragments.iter().all(|f| scale(f) == Vec3::ONE));
}

#[test]
fn a_despawn_in_the_frame_of_its_break_leaves_no_pieces() {
    let (mut app, log) = app();
    let gone = body(&mut app, "pane", Transform::default());
    ready(&mut app, gone);
    app.world_mut().trigger(blow(gone, Vec3::splat(f32::NAN)));
    hear(&mut app, &log, "finite");
    app.world_mut()
        .commands()
        .trigger(blow(gone, Vec3::Z * 3.0));
    app.world_mut().commands().entity(gone).despawn();
    for _ in 0..60 {
        app.update();
    }
    assert!(said(&log, "pieces"), "{:?}", log.lines());
    let mut left = app.world_mut().query::<&FragmentOf>();
    assert_eq!(left.iter(app.world()).count(), 0);
}

#[test]
fn a_body_despawned_by_the_hearer_of_its_break_leaves_no_pieces() {
    let (mut app, log) = app();
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    app.world_mut()
        .entity_mut(pane)
        .observe(|broke: On<Broke>, mut commands: Commands| {
            commands.entity(broke.entity).despawn();
        });
    ball(&mut app, Vec3::new(0.01, 0.005, 0.1), Vec3::NEG_Z * 12.0);
    for _ in 0..60 {
        app.update();
    }
    assert!(said(&log, "pieces"), "{:?}", log.lines());
    let mut left = app.world_mut().query::<&FragmentOf>();
    assert_eq!(left.iter(app.world()).count(), 0);
}

#[test]
fn a_body_without_a_collider_or_a_rigid_body_is_told_of() {
    let (mut app, log) = app();
    let pane = body(&mut app, "pane", Transform::default());
    ready(&mut app, pane);
    app.world_mut().entity_mut(pane).remove::<Collider>();
    hear(&mut app, &log, "the collider of the body was removed");
    app.world_mut().entity_mut(pane).remove::<RigidBody>();
    app.world_mut().trigger(blow(pane, Vec3::Z * 3.0));
    hear(&mut app, &log, "has no rigid body");
    // A despawn is no such removal.
    let other = body(&mut app, "pane", Transform::from_xyz(9.0, 0.0, 0.0));
    ready(&mut app, other);
    let count = log.lines().len();
    app.world_mut().entity_mut(other).despawn();
    app.update();
    assert_eq!(log.lines().len(), count);
}
