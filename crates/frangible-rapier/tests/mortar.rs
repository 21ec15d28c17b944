//! Weak bonds between bodies.

use crate::common::at;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{Ball, BreakableWorld, Mortar, SurfaceProperties, WorldConfig, WorldError};

/// Drops a ball of 1 kg bonded over 1 cm² to a block that does not move, above it (`side` 1) or below (−1). Returns the number of bonds left after
/// half a second, and the fall of the ball, m. `swap`: the ball is the first of the two.
fn bonded(side: f32, strength: f32, swap: bool) -> (usize, f32) {
    let mut world = BreakableWorld::new(WorldConfig::default()).unwrap();
    let block = world
        .insert_fixed_box(
            Vector::new(0.1, 0.05, 0.1),
            at(0.0, 1.0, 0.0),
            SurfaceProperties::STONE,
        )
        .unwrap();
    let ball = Ball {
        mass: 1.0,
        radius: 0.03,
    };
    let start = 1.0 + side * 0.08;
    let ball = world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            at(0.0, start, 0.0),
            Vector::ZERO,
        )
        .unwrap();
    let (one, two, across) = if swap {
        (ball, block, -side)
    } else {
        (block, ball, side)
    };
    let mortar = Mortar {
        centre: Vector::new(0.0, 1.0 + side * 0.05, 0.0),
        normal: Vector::new(0.0, across, 0.0),
        area: 1e-4,
        strength,
    };
    world.insert_mortar(one, two, mortar).unwrap();
    for _ in 0..120 {
        world.step().unwrap();
    }
    let y = world.physics.bodies.get(ball).unwrap().translation().y;
    (world.mortar(), start - y)
}

#[test]
fn it_holds_what_it_bears_and_gives_way_to_more() {
    for swap in [false, true] {
        // 9.81 N over 1 cm² are 98 kPa.
        let (bonds, fall) = bonded(-1.0, 2e5, swap);
        assert_eq!(bonds, 1);
        assert!(fall.abs() < 1e-3, "{fall}");
        let (bonds, fall) = bonded(-1.0, 4e4, swap);
        assert_eq!(bonds, 0);
        assert!(fall > 0.5, "{fall}");
    }
}

#[test]
fn what_presses_does_not_part_it() {
    for swap in [false, true] {
        let (bonds, fall) = bonded(1.0, 4e4, swap);
        assert_eq!(bonds, 1);
        assert!(fall.abs() < 1e-3, "{fall}");
    }
}

#[test]
fn numbers_that_mean_nothing_are_refused() {
    let mut world = BreakableWorld::new(WorldConfig::default()).unwrap();
    let block = world
        .insert_fixed_box(Vector::ONE, at(0.0, 0.0, 0.0), SurfaceProperties::STONE)
        .unwrap();
    let good = Mortar {
        centre: Vector::ZERO,
        normal: Vector::Y,
        area: 1e-4,
        strength: 1e5,
    };
    let normal = Vector::ZERO;
    let refused = world.insert_mortar(block, block, Mortar { normal, ..good });
    assert!(matches!(refused, Err(WorldError::NoNormal(_))));
    let area = 0.0;
    assert!(
        world
            .insert_mortar(block, block, Mortar { area, ..good })
            .is_err()
    );
    let strength = f32::NAN;
    assert!(
        world
            .insert_mortar(block, block, Mortar { strength, ..good })
            .is_err()
    );
}
