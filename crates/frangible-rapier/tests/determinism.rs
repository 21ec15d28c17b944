//! Two runs give the same bits.

use crate::common::{at, body, box_asset, slicer, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties};

const HALF: Vec3 = Vec3::new(0.1, 0.004, 0.1);

fn four_panes_and_a_ball() -> BreakableWorld {
    let mut world = world(true);
    world
        .insert_fixed_box(
            Vector::new(1.0, 0.01, 1.0),
            at(0.0, -0.01, 0.0),
            SurfaceProperties::STONE,
        )
        .unwrap();
    let asset = box_asset(HALF, [3, 1, 3]);
    for i in 0..4 {
        let pose = Pose::new(
            Vector::new(0.01 * i as f32, 0.1 + 0.08 * i as f32, 0.0),
            Vector::new(0.2, 0.1, 0.3),
        );
        world
            .insert(body(&asset), RigidBodyBuilder::dynamic().pose(pose))
            .unwrap();
    }
    let ball = Ball {
        mass: 0.2,
        radius: 0.02,
    };
    world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            at(0.0, 0.6, 0.0),
            Vector::new(0.0, -12.0, 0.0),
        )
        .unwrap();
    world.set_break_function(slicer(HALF, [4, 1, 4], 0.001, 0.02));
    world
}

/// Breaks in these steps, and every bit of what lies there then.
fn run(world: &mut BreakableWorld, steps: usize) -> (Vec<[u32; 13]>, usize) {
    let mut breaks = 0;
    for _ in 0..steps {
        breaks += world.step().unwrap().len();
    }
    let bits = world.physics.bodies.iter().map(|(_, b)| {
        let (p, v, w) = (b.position(), b.linvel(), b.angvel());
        let [px, py, pz] = p.translation.to_array();
        let [qx, qy, qz, qw] = p.rotation.to_array();
        let all = [px, py, pz, qx, qy, qz, qw, v.x, v.y, v.z, w.x, w.y, w.z];
        all.map(f32::to_bits)
    });
    (bits.collect(), breaks)
}

#[test]
fn two_runs_give_the_same_bits() {
    let (first, breaks) = run(&mut four_panes_and_a_ball(), 300);
    assert_eq!(breaks, 4, "all panes break");
    assert_eq!((first, breaks), run(&mut four_panes_and_a_ball(), 300));
}

#[test]
fn a_world_put_back_goes_on_as_it_did() {
    let mut world = four_panes_and_a_ball();
    let (mut saves, mut ends) = (Vec::new(), Vec::new());
    for _ in 0..5 {
        saves.push(world.save());
        ends.push(run(&mut world, 60));
    }
    assert_eq!(ends.iter().map(|(_, breaks)| breaks).sum::<usize>(), 4);
    // Backwards, so that each state is put back over a later one.
    for (saved, end) in saves.iter().zip(&ends).rev() {
        world.restore(saved);
        assert_eq!(run(&mut world, 60), *end);
    }
}

#[test]
fn the_fingerprint_tells_worlds_apart_that_differ_in_a_bit() {
    let [mut one, mut other] = [four_panes_and_a_ball(), four_panes_and_a_ball()];
    for world in [&mut one, &mut other] {
        run(world, 60);
    }
    assert_eq!(one.fingerprint(), other.fingerprint());
    let handle = one.physics.bodies.iter().last().unwrap().0;
    let body = one.physics.bodies.get_mut(handle).unwrap();
    let v = body.linvel();
    let next = f32::from_bits(v.x.to_bits() + 1);
    body.set_linvel(Vector::new(next, v.y, v.z), true);
    assert_ne!(one.fingerprint(), other.fingerprint());
}
