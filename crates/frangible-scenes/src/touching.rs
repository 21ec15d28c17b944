//! Touches, slides and rolling in a world of Rapier.

use std::collections::BTreeMap;

use frangible::glam::Vec3;
use frangible_rapier::BreakableWorld;
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::rapier3d::geometry::{Collider, ContactPair};
use frangible_recording::{RecordedSlide, RecordedTouch};
use frangible_sound::{EngineMotion, EngineStep, Push, Touching};

/// Finds touches, slides and rolling, step by step.
#[derive(Default)]
pub(crate) struct WorldTouching(Touching);

impl WorldTouching {
    /// Finds the touches, slides and rolling of the step that ended `time` s after the first frame: `node` numbers the bodies that are
    /// followed.
    pub(crate) fn step(
        &mut self,
        world: &BreakableWorld,
        node: &dyn Fn(RigidBodyHandle) -> Option<usize>,
        time: f64,
    ) -> (Vec<RecordedTouch>, Vec<RecordedSlide>) {
        let physics = &world.physics;
        let step = EngineStep {
            time,
            length: physics.integration_parameters.dt,
            gravity: physics.gravity.length(),
            rolling_arm: world.config().rolling_arm,
        };
        let contacts = physics.narrow_phase.contact_pairs();
        let pushes: Vec<Push> = contacts
            .filter_map(|contact| push(world, contact, node))
            .collect();
        self.0.step(&step, &pushes, motions(world))
    }
}

/// The name of a body or a collider.
fn name((index, generation): (u32, u32)) -> u64 {
    u64::from(generation) << 32 | u64::from(index)
}

/// The push at a contact of two bodies; `None` if there is no impulse, or neither of them is followed.
fn push(
    world: &BreakableWorld,
    contact: &ContactPair,
    node: &dyn Fn(RigidBodyHandle) -> Option<usize>,
) -> Option<Push> {
    // A sum of vectors: equal pushes from both sides cancel.
    let push = Vec3::from(contact.total_impulse().to_array());
    if push == Vec3::ZERO {
        return None;
    }
    let physics = &world.physics;
    let colliders = [contact.collider1, contact.collider2];
    let bodies = colliders.map(|c| physics.colliders.get(c).and_then(Collider::parent));
    let followed = |body: Option<RigidBodyHandle>| {
        let body = body?;
        Some((node(body)?, physics.bodies.get(body)?.mass()))
    };
    let (nodes, lightest, flip) = match bodies.map(followed) {
        [Some(a), Some(b)] => ((a.0, Some(b.0)), a.1.min(b.1), false),
        [Some(a), None] => ((a.0, None), a.1, false),
        [None, Some(b)] => ((b.0, None), b.1, true),
        [None, None] => return None,
    };
    let (manifold, deepest) = contact.find_deepest_contact()?;
    let at = physics.colliders.get(contact.collider1)?;
    let at = at.position().transform_point(deepest.local_p1);
    let impulse = push.length();
    let mut bodies = bodies.map(|body| body.map(|body| name(body.into_raw_parts())));
    let mut places = [deepest.local_p1, deepest.local_p2].map(|p| Vec3::from(p.to_array()));
    if flip {
        bodies.reverse();
        places.reverse();
    }
    Some(Push {
        colliders: colliders.map(|collider| name(collider.into_raw_parts())),
        nodes,
        bodies,
        lightest,
        point: Vec3::from(at.to_array()),
        // Rapier's normals point from the first collider to the second.
        normal: push / impulse * if flip { 1.0 } else { -1.0 },
        places,
        impulse,
        friction: manifold.data.friction,
    })
}

/// Motion of each dynamic body.
fn motions(world: &BreakableWorld) -> BTreeMap<u64, EngineMotion> {
    let bodies = world.physics.bodies.iter().filter(|(_, b)| b.is_dynamic());
    let motion = bodies.map(|(handle, body)| {
        let motion = [body.linvel(), body.angvel(), body.center_of_mass()];
        let motion = motion.map(|v| Vec3::from(v.to_array()));
        (name(handle.into_raw_parts()), motion)
    });
    motion.collect()
}

#[cfg(test)]
mod tests {
    use frangible_rapier::rapier3d::math::{Pose, Vector};
    use frangible_rapier::{Ball, SurfaceProperties, WorldConfig};

    use super::*;

    const RADIUS: f32 = 0.02;
    const MASS: f32 = 0.5;

    /// Slides and rolling of a steel ball that is thrown along a stone floor at 1 m/s, turning so fast, rad/s.
    fn thrown(spin: f32) -> Vec<RecordedSlide> {
        let mut world = BreakableWorld::new(WorldConfig::default()).expect("a world");
        world
            .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
            .expect("a floor");
        let ball = Ball {
            mass: MASS,
            radius: RADIUS,
        };
        let at = Pose::from_translation(Vector::new(0.0, RADIUS, 0.0));
        let ball = world.insert_ball(ball, SurfaceProperties::STEEL, at, Vector::X);
        let ball = ball.expect("a ball");
        let body = &mut world.physics.bodies[ball];
        body.set_angvel(Vector::new(0.0, 0.0, -spin), true);
        let node = |handle| (handle == ball).then_some(0);
        let mut touching = WorldTouching::default();
        let mut heard = Vec::new();
        for _ in 0..60 {
            world.step().expect("a step");
            heard.extend(touching.step(&world, &node, world.time()).1);
        }
        heard
    }

    #[test]
    fn a_ball_that_rolls_is_recorded_with_what_its_rolling_takes() {
        let rolls = thrown(1.0 / RADIUS);
        assert!(rolls.len() > 10, "{}", rolls.len());
        let arm = WorldConfig::default().rolling_arm;
        let mut taken = 0.0;
        for roll in &rolls {
            assert!((0.9..1.05).contains(&roll.speed), "{roll:?}");
            taken += roll.power * roll.duration;
        }
        // A quarter of a second at 1 m/s. The engine pushes now and then, and on the whole with the ball's weight.
        let turned = 0.25 / f64::from(RADIUS);
        let expected = f64::from(MASS * 9.81 * arm) * turned;
        assert!(
            (0.8..1.1).contains(&(taken / expected)),
            "{taken} J of {expected} J"
        );
        // Without spin it slides first, and friction takes far more.
        let slides = thrown(0.0);
        assert!(slides[0].power > 5.0 * rolls[0].power, "{:?}", slides[0]);
    }
}
