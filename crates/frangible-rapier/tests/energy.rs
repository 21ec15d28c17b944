//! The energy budget of real breaks, and two breakable bodies that meet.

use std::sync::Arc;

use crate::common::baked::{block, pane};
use crate::common::{self, at, body, world};
use frangible::glam::{DVec3, Vec3};
use frangible::internals::DurationModel;
use frangible::internals::blow::Blow;
use frangible::internals::contact::answer_duration;
use frangible::{Asset, FractureConfig};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{Ball, BreakEvent, BreakableWorld, SurfaceProperties};

/// Kinetic energy of some bodies, from Rapier's own velocities, J.
fn kinetic(world: &BreakableWorld, handles: &[RigidBodyHandle]) -> f64 {
    let bodies = handles.iter().map(|&h| &world.physics.bodies[h]);
    bodies.map(|b| f64::from(b.kinetic_energy())).sum()
}

fn check(world: &BreakableWorld, event: &BreakEvent) {
    let report = &event.fracture.report;
    println!(
        "T {:.3} + {:.3} → {:.3} J; strain {:.4}, cracks {:.4}, paid {:.4} J; {} pieces",
        event.kinetic_before,
        event.work,
        event.kinetic_after,
        report.peak_strain_energy,
        report.fracture_energy,
        event.energy_paid,
        event.fragments.len()
    );
    let rounding = 1e-5 * event.kinetic_before;
    assert!(event.kinetic_after <= event.kinetic_before + event.work + rounding);
    assert!(report.fracture_energy <= report.peak_strain_energy * (1.0 + 1e-6));
    assert!(report.fracture_energy > 0.0);
    let group: Vec<RigidBodyHandle> = event
        .fragments
        .iter()
        .chain(&event.strikers)
        .copied()
        .collect();
    // Rapier sums in f32.
    let own = kinetic(world, &group);
    assert!((own / event.kinetic_after - 1.0).abs() < 1e-3, "{own} J");
}

#[test]
fn a_break_creates_no_energy_when_a_pane_falls() {
    for (height, turn) in [(1.0, 0.3), (2.0, 1.2), (3.0, 0.7)] {
        let mut world = world(true);
        world
            .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
            .unwrap();
        let pose = Pose::new(Vector::new(0.0, 0.25, 0.0), Vector::new(turn, 0.0, 0.2));
        let speed = (2.0 * 9.81 * height as f32).sqrt();
        world
            .insert(
                body(pane()),
                RigidBodyBuilder::dynamic()
                    .pose(pose)
                    .linvel(Vector::new(0.0, -speed, 0.0)),
            )
            .unwrap();
        let event = common::step_to_break(&mut world, 60).expect("it breaks");
        check(&world, &event);
    }
}

#[test]
fn a_break_creates_no_energy_when_a_ball_is_thrown_at_a_pane() {
    for speed in [8.0, 20.0, 60.0] {
        let mut world = world(true);
        world
            .insert(body(pane()), RigidBodyBuilder::dynamic())
            .unwrap();
        let ball = Ball {
            mass: 0.1,
            radius: 0.014,
        };
        let start = at(0.02, 0.01, -0.05);
        let velocity = Vector::new(0.0, 0.0, speed);
        world
            .insert_ball(ball, SurfaceProperties::STEEL, start, velocity)
            .unwrap();
        let event = common::step_to_break(&mut world, 60).expect("it breaks");
        assert_eq!(event.strikers.len(), 1);
        let before = 0.5 * 0.1 * f64::from(speed * speed);
        assert!(event.kinetic_before < 1.01 * before);
        check(&world, &event);
    }
}

#[test]
fn two_panes_that_meet_both_break_and_momentum_stays() {
    for model in [
        DurationModel::Integrated,
        DurationModel::Hertz,
        DurationModel::ModalHertz,
    ] {
        let mut world = world(false);
        world.fracture_config_mut().duration = model;
        let bodies = [(-1.0_f32, 0.0), (1.0, 1.2)].map(|(side, turn)| {
            // One flat, the other edge on and 1 mm above it: they come nearer by a quarter of a metre in a step.
            let turned = Pose::new(Vector::new(0.02, 0.01, 0.0), Vector::new(turn, 0.0, 0.1));
            let up = (turned.rotation.inverse() * Vector::Z).abs();
            let z = up.dot(Vector::new(0.15, 0.15, 0.002)) + 0.003;
            let pose = turned.append_translation(if turn > 0.0 {
                at(0.0, 0.0, z).translation
            } else {
                Vector::ZERO
            });
            let velocity = Vector::new(0.0, 0.0, -30.0 * side);
            world
                .insert(
                    body(pane()),
                    RigidBodyBuilder::dynamic().pose(pose).linvel(velocity),
                )
                .unwrap()
        });
        let (momentum, energy) = (world.momentum(), world.kinetic_energy());
        let mut events = Vec::new();
        for _ in 0..30 {
            events = world.step().unwrap().to_vec();
            if !events.is_empty() {
                break;
            }
        }
        assert_eq!(events.len(), 2, "both in one step with {model:?}");
        assert!(events.iter().all(|e| bodies.contains(&e.parent)));
        let mass = pane().mass().mass;
        let change = (world.momentum() - momentum).length() / (mass * 30.0);
        assert!(change < 1e-4, "momentum changed by {change:e}");
        assert!(world.kinetic_energy() <= energy * (1.0 + 1e-6));
        for event in &events {
            println!(
                "{model:?}: {} pieces, {:.2} → {:.2} J",
                event.fragments.len(),
                event.kinetic_before,
                event.kinetic_after
            );
            assert!(event.kinetic_after <= event.kinetic_before * (1.0 + 1e-6));
            assert!((event.kinetic_before / energy - 1.0).abs() < 1e-3);
            for contact in &event.contacts {
                let answered = contact.striker.modal_duration > 0.0;
                assert_eq!(answered, model == DurationModel::ModalHertz);
                let vibrates = contact.striker.receptance.is_some();
                assert_eq!(vibrates, model == DurationModel::Integrated);
            }
        }
    }
}

#[test]
fn each_of_two_bodies_knows_how_long_the_other_answers() {
    let mut world = world(false);
    world.fracture_config_mut().duration = DurationModel::ModalHertz;
    world.set_break_function(common::unbreakable());
    let lower = at(0.0, 0.0, 0.0);
    let upper = at(0.03, 0.02, 0.002 + 0.025 + 0.002);
    let pane_handle = world
        .insert(body(pane()), RigidBodyBuilder::dynamic().pose(lower))
        .unwrap();
    let block_handle = world
        .insert(
            body(block()),
            RigidBodyBuilder::dynamic()
                .pose(upper)
                .linvel(Vector::new(0.0, 0.0, -2.0)),
        )
        .unwrap();
    let held = (0..20)
        .find_map(|_| {
            world.step().unwrap();
            Some(world.held().to_vec()).filter(|h| h.len() == 2)
        })
        .expect("they meet");
    let of = |handle| held.iter().find(|h| h.body == handle).unwrap();
    let (pane_event, block_event) = (of(pane_handle), of(block_handle));
    let pane_body = body(pane());
    for contact in &block_event.contacts {
        // The same contact as the pane reports it, found by its place.
        let place = contact.point + Vec3::new(0.03, 0.02, 0.0);
        let gap = |c: &&frangible::Contact| (c.point - place).truncate().length();
        let mirror = pane_event
            .contacts
            .iter()
            .min_by(|a, b| gap(a).total_cmp(&gap(b)))
            .unwrap();
        let expected = answer_duration(&pane_body, mirror, DurationModel::ModalHertz) as f32;
        let found = contact.striker.modal_duration;
        assert!(
            (found / expected - 1.0).abs() < 0.02,
            "{found} s, not {expected} s"
        );
    }
    assert!(
        world
            .momentum()
            .distance(DVec3::Z * -2.0 * block().mass().mass)
            < 1e-4
    );
}

#[test]
fn both_of_two_bodies_find_one_force() {
    let mut world = world(false);
    world.set_break_function(common::unbreakable());
    // Steps so short that the engine's contacts lie on both surfaces.
    world.physics.integration_parameters.dt = 2.5e-4;
    let (lower, still) = (at(0.0, 0.0, 0.0), Vector::ZERO);
    let upper = at(0.03, 0.02, 0.002 + 0.025 + 0.002);
    let falls = Vector::new(0.0, 0.0, -2.0);
    let bodies =
        [(pane(), lower, still), (block(), upper, falls)].map(|(asset, pose, velocity)| {
            let handle = world.insert(
                body(asset),
                RigidBodyBuilder::dynamic().pose(pose).linvel(velocity),
            );
            (asset, handle.unwrap())
        });
    let held = (0..20).find_map(|_| {
        world.step().unwrap();
        Some(world.held().to_vec()).filter(|h| h.len() == 2)
    });
    let held = held.expect("they meet");
    let config = FractureConfig::default();
    let force = |(asset, handle): (&Arc<Asset>, _), vibrates: bool| -> f64 {
        let event = held.iter().find(|h| h.body == handle).unwrap();
        let mut contacts = event.contacts.clone();
        assert!(contacts.iter().all(|c| c.striker.receptance.is_some()));
        if !vibrates {
            contacts
                .iter_mut()
                .for_each(|c| c.striker.receptance = None);
        }
        let blow = Blow::new(&body(asset), &contacts, &config).unwrap();
        let reports = blow.unwrap().reports();
        reports.iter().map(|r| r.peak_force).fold(0.0, f64::max)
    };
    let apart = |vibrates: bool| {
        let [pane, block] = bodies.map(|body| force(body, vibrates));
        println!("{pane} N on the pane, {block} N on the block");
        (pane / block - 1.0).abs()
    };
    let (both, alone) = (apart(true), apart(false));
    // The engine's contact is at two places, one on each surface, and its friction is not quite the same on both.
    assert!(both < 0.05, "{both}");
    assert!(alone > 0.5, "{alone} without the other's vibration");
}
