//! Bodies that something holds.

use std::sync::Arc;

use crate::common::{app, ball, ready};
use avian3d::prelude::*;
use bevy::prelude::*;
use bevy_frangible::prelude::*;
use frangible_bake::pieces::Pieces;
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};

/// A pane of glass of half a metre that is held at all its edges.
fn window() -> FrangibleAsset {
    let glass = bevy_frangible::frangible::Material::preset("glass").unwrap();
    let shape = Shape::plate(0.5, 0.5, 0.004);
    let mut spec = BakeSpec::for_games("window", shape.clone(), glass).unwrap();
    spec.fracture = Some(shape.size_for(6000.0).unwrap());
    let edges = [
        Region::below(0, 0.01),
        Region::above(0, 0.49),
        Region::below(1, 0.01),
        Region::above(1, 0.49),
    ];
    spec.supports = edges.map(Support::clamped).to_vec();
    FrangibleAsset::new(bake(&spec).unwrap()).unwrap()
}

/// Shoots two balls through a held pane, one after the other; shares of their speed along their way that they keep.
fn two_balls_through(window: &FrangibleAsset, seed: u64) -> [f32; 2] {
    let (mut app, log) = app();
    app.insert_resource(Gravity(Vec3::ZERO));
    // The rest of the pane breaks on where the ball meets it.
    app.insert_resource(BreakAgain {
        model: Some(Arc::new(Pieces::default())),
        at_once: 16,
        ..BreakAgain::default()
    });
    let asset = app
        .world_mut()
        .resource_mut::<Assets<FrangibleAsset>>()
        .add(window.clone());
    let pane = app.world_mut().spawn((Breakable(asset), Seed(seed))).id();
    ready(&mut app, pane);
    let speed = 40.0;
    let first = ball(&mut app, Vec3::Z * 0.1, Vec3::NEG_Z * speed);
    for _ in 0..120 {
        app.update();
    }
    assert!(log.lines()[0].ends_with("pieces"), "{:?}", log.lines());
    let kinds = app.world_mut().query::<(&FragmentOf, &RigidBody)>();
    let held = { kinds }
        .iter(app.world())
        .filter(|(_, kind)| kind.is_static())
        .count();
    assert!(held > 0, "the frame holds nothing");
    let second = ball(&mut app, Vec3::Z * 0.1, Vec3::NEG_Z * speed);
    for _ in 0..60 {
        app.update();
    }
    [first, second].map(|ball| {
        let at = app.world().get::<Position>(ball).unwrap().0;
        let velocity = app.world().get::<LinearVelocity>(ball).unwrap().0;
        println!("seed {seed}: {at}, {velocity} m/s");
        if at.z < 0.0 { -velocity.z / speed } else { 0.0 }
    })
}

#[test]
fn what_flies_through_a_held_pane_leaves_a_hole_that_others_fly_through() {
    let window = window();
    let kept: Vec<[f32; 2]> = (1..=8)
        .map(|seed| two_balls_through(&window, seed))
        .collect();
    // Measured: 7 of 8, with 0.78 of their speed in the mean. The other one is thrown back by its blow, under which the pane stays held. The goal is
    // 8 of 8.
    for (ball, least) in [(0, 7), (1, 7)] {
        let through = kept.iter().filter(|kept| kept[ball] > 0.0).count();
        let mean = kept.iter().map(|kept| kept[ball]).sum::<f32>() / kept.len() as f32;
        println!("ball {ball}: {through} of 8 fly through, all keep {mean} of their speed");
        assert!(through >= least && mean > 0.3, "{through} of 8, {mean}");
    }
}
