//! A striker that hits a pane goes on through it.

use crate::common::{at, body, box_asset, slicer, unbreakable, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{Ball, SurfaceProperties};

const PANE: Vec3 = Vec3::new(0.15, 0.15, 0.002);

/// Speed of a ball along z after 0.1 s, having met a pane of 0.45 kg; where it is then.
fn after_the_pane(mass: f32, speed: f32, breaks: bool) -> (f32, f32) {
    let mut world = world(false);
    let pane = box_asset(PANE, [4, 4, 1]);
    world
        .insert_breakable(body(&pane), at(0.0, 0.0, 0.0), Vector::ZERO, Vector::ZERO)
        .unwrap();
    let ball = Ball { mass, radius: 0.01 };
    let start = at(0.013, 0.021, -0.3);
    let ball = world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            start,
            Vector::new(0.0, 0.0, speed),
        )
        .unwrap();
    world.set_break_function(if breaks {
        slicer(PANE, [12, 12, 1], 0.0, 0.2)
    } else {
        unbreakable()
    });
    let steps = (2.0 * 0.3 / speed / world.config().dt) as usize + 12;
    for _ in 0..steps {
        world.step().unwrap();
    }
    let ball = &world.physics.bodies[ball];
    (ball.linvel().z, ball.translation().z)
}

#[test]
fn a_ball_goes_on_through_the_pane_it_breaks() {
    for (mass, speed) in [(0.1, 8.0), (0.1, 30.0), (0.3, 60.0)] {
        let (through, z) = after_the_pane(mass, speed, true);
        let (bounced, _) = after_the_pane(mass, speed, false);
        println!(
            "{mass} kg at {speed} m/s: through the broken pane {through:.2} m/s, off the whole one {bounced:.2} m/s"
        );
        assert!(z > 0.02, "the ball is at z = {z}");
        assert!(through > 0.6 * speed, "{speed} m/s fell to {through} m/s");
        assert!(bounced < 0.5 * through);
    }
}
