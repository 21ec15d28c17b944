//! Bodies that are held: fixed until they break, then their supported pieces stay.

use std::sync::Arc;

use crate::common::{Judge, at, body, box_asset, sliced, step_to_break, unbreakable, world};
use frangible::glam::Vec3;
use frangible::internals::asset::AssetParts;
use frangible::{Asset, Outcome};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties};

/// A shelf in a wall at −x: y is up.
const SHELF: Vec3 = Vec3::new(0.10, 0.01, 0.06);
/// A pane across x.
const PANE: Vec3 = Vec3::new(0.003, 0.15, 0.15);

/// The box, held at the nodes for which `held` is true.
fn held_box(half: Vec3, cells: [usize; 3], held: impl Fn(Vec3) -> bool) -> Arc<Asset> {
    let asset = box_asset(half, cells);
    let positions = asset.fracture().positions.iter().zip(0_u32..);
    let supported: Vec<u32> = positions.filter(|(p, _)| held(**p)).map(|p| p.1).collect();
    assert!(!supported.is_empty());
    Arc::new(Asset::from_parts(AssetParts {
        supported,
        ..(*asset).clone().into_parts()
    }))
}

/// Every impact slices the box; pieces whose centre of mass `held` accepts are supported.
fn holding_slicer(
    half: Vec3,
    slices: [usize; 3],
    energy: f64,
    held: impl Fn(Vec3) -> bool + Send + Sync + 'static,
) -> Judge {
    Box::new(move |_, _, _| {
        let mut fracture = sliced(half, slices, 0.0, energy);
        for fragment in &mut fracture.fragments {
            fragment.supported = held(fragment.mass.centre.as_vec3());
        }
        Ok(Outcome::Broke(Box::new(fracture)))
    })
}

fn shelf(energy: f64) -> (BreakableWorld, RigidBodyHandle) {
    let mut world = world(true);
    let asset = held_box(SHELF, [4, 1, 3], |p| p.x < -0.099);
    let handle = world
        .insert(body(&asset), RigidBodyBuilder::dynamic())
        .unwrap();
    world.set_break_function(holding_slicer(SHELF, [2, 1, 1], energy, |c| c.x < -0.02));
    (world, handle)
}

fn pane(energy: f64) -> (BreakableWorld, RigidBodyHandle) {
    let mut world = world(true);
    let asset = held_box(PANE, [1, 4, 4], |p| p.y.abs() > 0.149 || p.z.abs() > 0.149);
    let handle = world
        .insert(body(&asset), RigidBodyBuilder::dynamic())
        .unwrap();
    // Five by five: the outer ring is held, nine pieces are not.
    world.set_break_function(holding_slicer(PANE, [1, 5, 5], energy, |c| {
        let ring = |x: f32| !(-0.105..0.105).contains(&x);
        ring(c.y) || ring(c.z)
    }));
    (world, handle)
}

fn throw(world: &mut BreakableWorld, mass: f32, from: Pose, velocity: Vector) -> RigidBodyHandle {
    let ball = Ball {
        mass,
        radius: 0.015,
    };
    world
        .insert_ball(ball, SurfaceProperties::STEEL, from, velocity)
        .unwrap()
}

/// Kinetic and potential energy, J; a fixed body counts with its height, as its pieces will.
fn energy(world: &BreakableWorld) -> f64 {
    let bodies = world.physics.bodies.iter().map(|(_, b)| b);
    let height = |b: &frangible_rapier::rapier3d::dynamics::RigidBody| {
        f64::from(b.mass() * 9.81 * b.center_of_mass().y)
    };
    world.kinetic_energy() + bodies.map(height).sum::<f64>()
}

#[test]
fn a_supported_body_is_fixed_whatever_velocity_it_is_given() {
    let mut world = world(true);
    let asset = held_box(SHELF, [4, 1, 3], |p| p.x < -0.099);
    let handle = world
        .insert(
            body(&asset),
            RigidBodyBuilder::dynamic()
                .pose(at(1.0, 2.0, 3.0))
                .linvel(Vector::X)
                .angvel(Vector::Y),
        )
        .unwrap();
    for _ in 0..100 {
        world.step().unwrap();
    }
    let body = &world.physics.bodies[handle];
    assert!(body.is_fixed());
    assert_eq!(*body.position(), at(1.0, 2.0, 3.0));
    assert_eq!((body.linvel(), body.angvel()), (Vector::ZERO, Vector::ZERO));
    assert_eq!(world.kinetic_energy(), 0.0);
}

#[test]
fn a_light_ball_bounces_off_and_the_contact_is_that_with_an_immovable_body() {
    let (mut world, shelf) = shelf(0.0);
    world.set_break_function(unbreakable());
    let (mass, speed) = (0.05, 4.0);
    let start = at(0.05, 0.01 + 0.015 + 0.03, 0.0);
    let ball = throw(&mut world, mass, start, Vector::new(0.0, -speed, 0.0));
    let mut seen = Vec::new();
    for _ in 0..60 {
        world.step().unwrap();
        seen.extend(world.held().iter().cloned());
    }
    assert_eq!(seen.len(), 1, "one impact");
    assert_eq!(seen[0].body, shelf);
    let contacts = &seen[0].contacts;
    let impulse: f32 = contacts.iter().map(|c| c.impulse).sum();
    let contact = &contacts[0];
    assert!(
        (contact.approach_speed / speed - 1.0).abs() < 0.03,
        "{contact:?}"
    );
    let blow = (1.0 + contact.striker.restitution) * mass * contact.approach_speed;
    assert!(
        (impulse / blow - 1.0).abs() < 0.05,
        "{impulse} of {blow} N·s"
    );
    assert!((contact.striker.inverse_effective_mass * mass - 1.0).abs() < 1e-3);
    assert!((contact.normal - Vec3::NEG_Y).length() < 1e-3);
    assert_eq!(*world.physics.bodies[shelf].position(), Pose::IDENTITY);
    assert!(world.physics.bodies[ball].translation().y > 0.0);
}

#[test]
fn a_dynamic_body_that_hits_a_held_one_meets_an_immovable_striker() {
    let (mut world, _) = shelf(0.0);
    world.set_break_function(unbreakable());
    let brick = box_asset(Vec3::splat(0.02), [1, 1, 1]);
    let start = at(0.05, 0.05, 0.0);
    let brick = world
        .insert(
            body(&brick),
            RigidBodyBuilder::dynamic()
                .pose(start)
                .linvel(Vector::new(0.0, -3.0, 0.0)),
        )
        .unwrap();
    let mut seen = Vec::new();
    for _ in 0..30 {
        world.step().unwrap();
        seen.extend(world.held().iter().filter(|h| h.body == brick).cloned());
    }
    let contact = &seen.first().expect("the brick lands").contacts[0];
    assert_eq!(contact.striker.inverse_effective_mass, 0.0);
    assert!(
        contact.striker.contact_modulus.is_finite(),
        "glass, not rigid"
    );
}

#[test]
fn the_end_of_a_shelf_falls_and_the_piece_in_the_wall_stays() {
    let (mut world, _) = shelf(0.5);
    let start = at(0.06, 0.05, 0.0);
    throw(&mut world, 0.5, start, Vector::new(0.0, -12.0, 0.0));
    let mut total = energy(&world);
    let event = step_to_break(&mut world, 60).expect("the ball hits the shelf");
    assert!(
        (event.energy_paid - 0.5).abs() < 1e-6,
        "{}",
        event.energy_paid
    );
    assert!(energy(&world) < total - 0.49);
    total = energy(&world);
    let [stays, falls] = [true, false].map(|supported| {
        let index = event.fracture.fragments.iter();
        let index = index
            .zip(&event.fragments)
            .find(|(f, _)| f.supported == supported);
        *index.expect("one of each").1
    });
    assert!(world.physics.bodies[stays].is_fixed() && world.physics.bodies[falls].is_dynamic());
    let place = *world.physics.bodies[stays].position();
    for _ in 0..240 {
        world.step().unwrap();
        let now = energy(&world);
        assert!(
            now <= total + 1e-3 * total.abs().max(1.0),
            "{total} to {now} J"
        );
        total = now;
    }
    assert_eq!(*world.physics.bodies[stays].position(), place);
    let centre = event
        .fracture
        .fragments
        .iter()
        .find(|f| f.supported)
        .unwrap()
        .mass
        .centre;
    assert!((place.translation - centre.as_vec3()).length() < 1e-6);
    assert!(world.physics.bodies[falls].translation().y < -1.0);
}

#[test]
fn a_pane_hit_in_the_middle_leaves_its_border_in_the_frame() {
    for (toll, speed) in [(0.0, 15.0), (0.3, 15.0), (0.3, 60.0)] {
        let (mut world, _) = pane(toll);
        // At the middle of the middle piece.
        let start = at(-0.1, -0.02, -0.02);
        let ball = throw(&mut world, 0.1, start, Vector::new(speed, 0.0, 0.0));
        let mut total = energy(&world);
        let mut broke = None;
        for _ in 0..200 {
            let event = world.step().unwrap().first().cloned();
            let now = energy(&world);
            // The break adds nothing; later steps are Rapier's, with pieces wedged into each other.
            let rounding = if event.is_some() { 1e-5 } else { 2e-3 };
            assert!(
                now <= total + rounding * total.abs().max(1.0),
                "{total} to {now} J at {speed} m/s, toll {toll}"
            );
            total = now;
            broke = broke.or(event);
        }
        let event = broke.expect("the ball hits the pane");
        let (mut stayed, mut loose) = (0, 0);
        for (fragment, &handle) in event.fracture.fragments.iter().zip(&event.fragments) {
            let body = &world.physics.bodies[handle];
            let centre = fragment.mass.centre.as_vec3();
            if fragment.supported {
                assert!(body.is_fixed());
                assert!((body.translation() - centre).length() < 1e-6);
                stayed += 1;
            } else {
                assert!(body.is_dynamic());
                // The others may stand on the border below them.
                if centre.y.abs().max(centre.z.abs()) < 0.03 {
                    assert!(
                        body.translation().distance(centre) > 0.1,
                        "the struck piece is still at {}",
                        body.translation()
                    );
                }
                loose += 1;
            }
        }
        assert_eq!((stayed, loose), (16, 9));
        let ball = &world.physics.bodies[ball];
        assert!(
            ball.translation().x > PANE.x,
            "the ball goes on through the pane, not back to {} at {}",
            ball.translation(),
            ball.linvel()
        );
        assert!(ball.linvel().x < speed);
    }
}

#[test]
fn what_was_held_begins_its_fall_from_rest() {
    let (mut world, _) = pane(0.0);
    // Gravity pulls the pieces out of the frame; downwards they would stand on it.
    world.physics.gravity = Vector::new(-9.81, 0.0, 0.0);
    // A feather breaks the pane and hardly moves it.
    throw(
        &mut world,
        1e-7,
        at(-0.03, 0.0, 0.0),
        Vector::new(5.0, 0.0, 0.0),
    );
    let event = step_to_break(&mut world, 30).unwrap();
    let dt = world.physics.integration_parameters.dt;
    let falling: Vec<_> = event
        .fragments
        .iter()
        .map(|&h| &world.physics.bodies[h])
        .collect();
    for body in falling.iter().filter(|body| body.is_dynamic()) {
        let fallen = body.linvel() / (9.81 * dt);
        println!("{fallen}");
        assert!((fallen - Vector::NEG_X).length() < 0.1, "{fallen}");
    }
}
