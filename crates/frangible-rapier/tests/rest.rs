//! Rolling bodies come to rest, and so do those that were pressed into the floor.

use crate::common::{at, world};
use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use frangible_rapier::rapier3d::geometry::{ColliderBuilder, SharedShape};
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig};

#[test]
fn a_rolling_ball_comes_to_rest() {
    let mut world = world(true);
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    let ball = Ball {
        mass: 0.1,
        radius: 0.015,
    };
    let start = at(0.0, 0.015, 0.0);
    world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            start,
            Vector::new(0.2, 0.0, 0.0),
        )
        .unwrap();
    let mut energy = world.kinetic_energy();
    for _ in 0..720 {
        world.step().unwrap();
        let now = world.kinetic_energy();
        assert!(now <= energy + 1e-6, "energy rose from {energy} to {now} J");
        energy = now;
    }
    assert!(world.at_rest(), "still {energy} J after 3 s");
}

#[test]
fn what_was_pressed_into_the_floor_comes_out_and_lies_still() {
    let mut world = BreakableWorld::new(WorldConfig::for_games()).unwrap();
    let stone = SurfaceProperties::STONE;
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, stone)
        .unwrap();
    // Chips of stone, 3 mm thick, all of them 2 cm under the floor.
    let shape = SharedShape::cuboid(0.012, 0.0015, 0.009);
    let chips: Vec<_> = (0..8)
        .map(|k| {
            let turn = 0.4 * k as f32;
            let place = Vector::new(0.05 * k as f32, -0.02, 0.0);
            let rotation = Rotation::from_scaled_axis(Vector::new(turn, 0.3, 0.5 * turn));
            let chip = RigidBodyBuilder::dynamic().pose(Pose::from_parts(place, rotation));
            let collider = ColliderBuilder::new(shape.clone()).density(2500.0);
            world.physics.insert(chip, collider).0
        })
        .collect();
    for _ in 0..120 {
        world.step().unwrap();
    }
    for chip in chips {
        let body = &world.physics.bodies[chip];
        let (height, spin) = (body.translation().y, body.angvel().length());
        assert!(height > 0.001, "{height} m");
        assert!(spin < 0.5, "{spin} rad/s at {height} m");
    }
}

/// A shard of glass: the hull of eight points, of which `number` says which.
fn shard(number: u32) -> SharedShape {
    let share =
        |k: u32| (number * 24 + k).wrapping_mul(2_654_435_769) as f32 / u32::MAX as f32 - 0.5;
    let corner = |k: u32| {
        Vector::new(
            0.03 * share(3 * k),
            0.006 * share(3 * k + 1),
            0.02 * share(3 * k + 2),
        )
    };
    let corners: Vec<Vector> = (0..8).map(corner).collect();
    SharedShape::convex_hull(&corners).expect("eight points that lie in no plane")
}

#[test]
fn a_heap_of_shards_falls_asleep_as_a_whole() {
    let mut world = BreakableWorld::new(WorldConfig::for_games()).unwrap();
    let stone = SurfaceProperties::STONE;
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, stone)
        .unwrap();
    // They fall on one place.
    for number in 0..150 {
        let turn = number as f32;
        let aside = 0.02 * Vector::new(turn.cos(), 0.0, turn.sin());
        let place = aside + Vector::Y * (0.02 + 0.008 * turn);
        let rotation = Rotation::from_scaled_axis(Vector::new(turn, 0.5, 0.3 * turn));
        let body = RigidBodyBuilder::dynamic().pose(Pose::from_parts(place, rotation));
        let collider = ColliderBuilder::new(shard(number))
            .density(2500.0)
            .friction(0.5);
        world.physics.insert(body, collider);
    }
    let mut slept = None;
    for step in 0..20 * 60 {
        world.step().unwrap();
        let awake = |world: &BreakableWorld| {
            let bodies = world.physics.bodies.iter();
            bodies
                .filter(|(_, b)| b.is_dynamic() && !b.is_sleeping())
                .count()
        };
        if awake(&world) == 0 {
            slept.get_or_insert(step);
        }
        if step % 120 == 119 {
            println!("{} s: {} awake", (step + 1) / 60, awake(&world));
        }
    }
    assert!(world.at_rest(), "slept since {slept:?}");
}

#[test]
fn a_body_that_nothing_carries_any_longer_falls() {
    let mut world = BreakableWorld::new(WorldConfig::for_games()).unwrap();
    let stone = SurfaceProperties::STONE;
    let board = world
        .insert_fixed_box(Vector::new(0.1, 0.01, 0.1), at(0.0, 0.5, 0.0), stone)
        .unwrap();
    let body = RigidBodyBuilder::dynamic().pose(at(0.0, 0.515, 0.0));
    let collider = ColliderBuilder::new(shard(1)).density(2500.0);
    let shard = world.physics.insert(body, collider).0;
    for _ in 0..240 {
        world.step().unwrap();
    }
    assert!(world.physics.bodies[shard].is_sleeping());
    world.physics.remove_body(board);
    for _ in 0..30 {
        world.step().unwrap();
    }
    let height = world.physics.bodies[shard].translation().y;
    assert!(height < 0.0, "{height} m");
}
