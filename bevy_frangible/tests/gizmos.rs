//! Tests of the gizmos drawn over bodies.

use crate::common::{app_with, ball, bodies, body, ready};
use avian3d::prelude::*;
use bevy::gizmos::{GizmoAsset, GizmoPlugin};
use bevy::prelude::*;
use bevy_frangible::{BreakableBody, FrangibleGizmos, FrangibleGizmosPlugin, LastBlow};

/// Ends of all lines that are drawn.
fn drawn(app: &App) -> Vec<Vec3> {
    let assets = app.world().resource::<Assets<GizmoAsset>>();
    let lines = assets.iter().map(|(_, asset)| asset.buffer());
    lines
        .flat_map(|lines| lines.list_positions.clone())
        .collect()
}

#[test]
fn weak_points_and_the_last_blow_are_drawn_where_they_are() {
    let (mut app, log) = app_with(bodies(), |app| {
        app.add_plugins((GizmoPlugin, FrangibleGizmosPlugin));
    });
    app.insert_resource(Gravity(Vec3::ZERO));
    let up = 3.0;
    let pane = body(&mut app, "pane", Transform::from_xyz(0.0, up, 0.0));
    ready(&mut app, pane);
    app.update();
    let points = app
        .world()
        .get::<BreakableBody>(pane)
        .unwrap()
        .0
        .weak_tets()
        .len();
    let lines = drawn(&app);
    // A cross is three lines.
    assert_eq!(lines.len(), 6 * points);
    let size = FrangibleGizmos::default().size;
    let half = Vec3::new(0.1, 0.1, 0.002) + size + 1e-4;
    assert!(
        lines
            .iter()
            .all(|p| (*p - Vec3::Y * up).abs().cmple(half).all())
    );
    ball(
        &mut app,
        Vec3::new(0.01, up + 0.005, 0.03),
        Vec3::NEG_Z * 0.7,
    );
    for _ in 0..20 {
        app.update();
    }
    assert_eq!(log.lines(), ["held"]);
    let blow = app.world().get::<LastBlow>(pane).unwrap();
    println!("{blow:?}");
    let [(at, impulse)] = blow.contacts[..] else {
        panic!("one contact");
    };
    assert!(at.distance(Vec3::new(0.01, 0.005, 0.002)) < 1e-3);
    assert!(impulse.normalize().dot(Vec3::NEG_Z) > 0.99);
    assert!(drawn(&app).len() > lines.len());
}
