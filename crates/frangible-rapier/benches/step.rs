//! Cost of a step: plain, with the copy of the world, with a break into 100 fragments, of asking what bodies carry, and of a heap of pieces
//! that sleep, are fixed or are merged.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{AtRest, Ball, BreakableWorld, SurfaceProperties, WorldConfig};

#[allow(dead_code, reason = "shared with the tests")]
#[path = "../tests/common/mod.rs"]
mod common;

const PANE: Vec3 = Vec3::new(0.2, 0.2, 0.002);

/// A pane among `boxes` others on a floor, and a ball one step before it.
fn scene(boxes: usize, breaks: bool, near: bool) -> BreakableWorld {
    let mut world = common::world(true);
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    let pane = common::box_asset(PANE, [4, 4, 1]);
    world
        .insert(
            common::body(&pane),
            RigidBodyBuilder::dynamic().pose(common::at(0.0, 1.0, 0.0)),
        )
        .unwrap();
    let half = Vec3::splat(0.03);
    let cube = common::box_asset(half, [2, 2, 2]);
    for i in 0..boxes {
        let pose = common::at(0.08 * (i % 20) as f32, 0.0301, 1.0 + 0.08 * (i / 20) as f32);
        world
            .insert(common::body(&cube), RigidBodyBuilder::dynamic().pose(pose))
            .unwrap();
    }
    if breaks {
        world.set_break_function(common::slicer(PANE, [10, 10, 1], 0.001, 0.2));
    } else {
        world.set_break_function(common::unbreakable());
    }
    for _ in 0..20 {
        world.step().unwrap();
    }
    let height = 1.0 - 0.5 * 9.81 * world.time() as f32 * world.time() as f32;
    let z = if near { -0.05 } else { -0.5 };
    let ball = Ball {
        mass: 0.1,
        radius: 0.01,
    };
    let fast = Vector::new(0.0, 0.0, 15.0);
    world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            common::at(0.01, height, z),
            fast,
        )
        .unwrap();
    if near {
        // The sweep brings the ball to the pane; the next step is the one that breaks it.
        world.step().unwrap();
        assert!(world.breaks().is_empty());
    }
    world
}

fn steps(c: &mut Criterion) {
    let mut group = c.benchmark_group("step");
    group
        .sample_size(20)
        .measurement_time(Duration::from_secs(3))
        .warm_up_time(Duration::from_millis(500));
    for (name, boxes, breaks, near) in [
        ("plain, 300 boxes", 300, false, false),
        ("held impact, 300 boxes", 300, false, true),
        ("break in 100, alone", 0, true, true),
        ("break in 100, 300 boxes", 300, true, true),
    ] {
        let mut check = scene(boxes, breaks, near);
        check.step().unwrap();
        assert_eq!(
            (check.breaks().len(), check.held().len()),
            (usize::from(breaks), usize::from(near && !breaks)),
            "{name}"
        );
        group.bench_function(name, |b| {
            b.iter_batched_ref(
                || scene(boxes, breaks, near),
                |world| world.step().map(<[_]>::len),
                BatchSize::LargeInput,
            );
        });
    }
    let mut broken = scene(0, true, true);
    broken.step().unwrap();
    group.bench_function("after the break, 100 fragments flying", |b| {
        b.iter(|| broken.step().map(<[_]>::len));
    });
    let world = scene(300, false, false);
    group.bench_function("copy of bodies, colliders and contacts, 300 boxes", |b| {
        b.iter(|| {
            let p = &world.physics;
            let sets = (
                p.bodies.clone(),
                p.colliders.clone(),
                p.narrow_phase.clone(),
            );
            black_box((
                sets,
                p.islands.clone(),
                p.broad_phase.clone(),
                p.impulse_joints.clone(),
            ))
        });
    });
    group.finish();
}

/// Blocks in pairs, one on the other, that never sleep. `asked`: whether their resting loads are looked at.
fn pairs(count: usize, asked: bool) -> BreakableWorld {
    let mut config = WorldConfig::default();
    config.gravity = Vector::new(0.0, 0.0, -9.81);
    config.resting_loads = asked;
    let mut world = BreakableWorld::new(config).unwrap();
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Z, SurfaceProperties::STONE)
        .unwrap();
    for i in 0..count {
        let (column, layer) = (i / 2, i % 2);
        let pose = common::at(0.2 * column as f32, 0.0, 0.025 + 0.05 * layer as f32);
        let handle = world
            .insert(
                common::body(common::baked::block()),
                RigidBodyBuilder::dynamic().pose(pose),
            )
            .unwrap();
        let activation = world.physics.bodies[handle].activation_mut();
        activation.normalized_linear_threshold = -1.0;
    }
    for _ in 0..60 {
        world.step().unwrap();
    }
    world
}

fn resting(c: &mut Criterion) {
    let mut group = c.benchmark_group("resting");
    group
        .sample_size(20)
        .measurement_time(Duration::from_secs(3))
        .warm_up_time(Duration::from_millis(500));
    for (name, asked) in [("100 blocks", false), ("100 blocks, loads asked", true)] {
        let mut world = pairs(100, asked);
        group.bench_function(name, |b| b.iter(|| world.step().map(<[_]>::len)));
    }
    group.finish();
}

/// Twelve slabs that fell on each other and broke into 25 pieces each, at rest; beside them a block that holds.
fn heap(at_rest: AtRest) -> BreakableWorld {
    let mut config = WorldConfig::default();
    config.at_rest = at_rest;
    config.rest_time = 0.5;
    let mut world = BreakableWorld::new(config).unwrap();
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    world.set_break_function(common::slicer(SLAB, [5, 1, 5], 0.0, 0.0));
    let slab = common::box_asset(SLAB, [1, 1, 1]);
    for i in 0..12 {
        let (x, z) = (0.15 * (i % 2) as f32, 0.15 * (i / 2 % 2) as f32);
        let pose = common::at(x, 0.3 + 0.1 * (i / 4) as f32, z);
        let slab = common::body(&slab);
        world
            .insert(slab, RigidBodyBuilder::dynamic().pose(pose))
            .unwrap();
    }
    for _ in 0..8 * 240 {
        world.step().unwrap();
    }
    world.set_break_function(common::unbreakable());
    let block = common::box_asset(Vec3::splat(0.05), [2, 2, 2]);
    let aside = common::at(3.0, 0.05, 0.0);
    let block = common::body(&block);
    world
        .insert(block, RigidBodyBuilder::dynamic().pose(aside))
        .unwrap();
    for _ in 0..240 {
        world.step().unwrap();
    }
    world
}

/// Half sides of a slab, m.
const SLAB: Vec3 = Vec3::new(0.1, 0.005, 0.1);

/// A step of a heap: while nothing moves, while a ball goes through it, and while a ball hits the block beside it.
fn heaps(c: &mut Criterion) {
    let mut group = c.benchmark_group("heap of 300 pieces");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(2))
        .warm_up_time(Duration::from_millis(200));
    for at_rest in [AtRest::Sleep, AtRest::Freeze, AtRest::Merge] {
        let mut world = heap(at_rest);
        let moving = world.physics.bodies.iter();
        let moving = moving.filter(|(_, b)| b.is_dynamic()).count();
        println!(
            "{at_rest:?}: {moving} dynamic, {} merged",
            world.merged().count()
        );
        group.bench_function(format!("{at_rest:?}, at rest"), |b| {
            b.iter(|| world.step().map(<[_]>::len));
        });
        let ball = Ball {
            mass: 0.5,
            radius: 0.03,
        };
        let steel = SurfaceProperties::STEEL;
        for (what, from, steps) in [
            ("a ball goes through", common::at(-0.4, 0.031, 0.07), 30),
            ("a ball hits the block", common::at(2.918, 0.05, 0.0), 1),
        ] {
            let saved = world.save();
            let fast = Vector::new(5.0, 0.0, 0.0);
            world.insert_ball(ball, steel, from, fast).unwrap();
            let begun = world.save();
            let mut snapshots = 0;
            group.bench_function(format!("{at_rest:?}, {what}"), |b| {
                b.iter_custom(|times| {
                    let mut took = Duration::ZERO;
                    for _ in 0..times {
                        world.restore(&begun);
                        let start = Instant::now();
                        for _ in 0..steps {
                            world.step().unwrap();
                        }
                        took += start.elapsed() / steps;
                        snapshots = world.snapshots();
                    }
                    took
                });
            });
            world.restore(&saved);
            println!("{} copies of the world", snapshots - world.snapshots());
        }
    }
    group.finish();
}

criterion_group!(benches, steps, resting, heaps);
criterion_main!(benches);
