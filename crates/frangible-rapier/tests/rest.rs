//! What rolls comes to rest.

mod common;

use common::{at, world};
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{Ball, SurfaceProperties};

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
