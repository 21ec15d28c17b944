//! A ball flies on through the body that it broke ([`frangible::internals::rigid::fly_through`]).
//!
//! The core finds what it meets of the pieces on its way, so the engine leaves its contacts with the loose ones out for [`APART`] (`siblings.rs`). Where
//! the ball or a piece touches anything else, the engine's contacts count: there a chain of bodies pushes. The ball reaches the body within the step: it
//! begins the step so far ahead that it is at the point of contact when it would have been.

use frangible::glam::{DMat3, DVec3, Vec3};
use frangible::internals::rigid::{self, APART, nearest_first};
use rapier3d::dynamics::{RigidBody, RigidBodyHandle};

use crate::impulses::blows::Touch;
use crate::impulses::plain::Plain;
use crate::impulses::settle::Broken;
use crate::world::BreakableWorld;

/// A ball before the blow by which it breaks a body.
pub(crate) struct Thrown {
    ball: RigidBodyHandle,
    touch: Touch,
    /// Its centre at the touch, in the frame of the body at the start of the step, m.
    centre: DVec3,
    /// Time from the start of the step to the touch, s.
    wait: f64,
    velocity: Vec3,
}

impl BreakableWorld {
    /// The ball that alone breaks a body; none where it is anything else.
    pub(crate) fn thrown_at(&self, broken: &Broken) -> Option<Thrown> {
        let [meeting] = &broken.blow[..] else {
            return None;
        };
        let ball = (meeting.partner).filter(|_| broken.alone && meeting.share == 1.0)?;
        let [touch] = &meeting.touches[..] else {
            return None;
        };
        let body = self.physics.bodies.get(ball)?;
        let [collider] = body.colliders() else {
            return None;
        };
        let shape = self.physics.colliders.get(*collider)?.shape().as_ball()?;
        let centre = touch.point - touch.normal * f64::from(shape.radius);
        let way = (centre - body.center_of_mass().as_dvec3()).dot(touch.normal);
        Some(Thrown {
            ball,
            touch: touch.clone(),
            centre,
            wait: (way / touch.approach).max(0.0),
            velocity: body.linvel(),
        })
    }

    /// Lets the ball fly through the fragments, with the blow's impulses on them.
    pub(crate) fn fly_through(&mut self, broken: &Broken, thrown: &Thrown) {
        let (fracture, fragments) = (&*broken.fracture, &broken.fragments);
        let set = &mut self.physics.bodies;
        let Some(first) = fragments.first().copied() else {
            return;
        };
        let turn = set
            .get(first)
            .map_or(Default::default(), |b: &RigidBody| *b.rotation());
        let axes = DMat3::from_quat(turn.as_dquat());
        let at = thrown.touch.point - axes * thrown.touch.local.as_dvec3();
        let order = nearest_first(fracture, &[thrown.touch.local]);
        let nearest: Vec<RigidBodyHandle> = order.iter().map(|&i| fragments[i]).collect();
        let (mut pieces, mut ball) = (Plain::of(set, &nearest), Plain::of(set, &[thrown.ball]));
        let Some(now) = ball.bodies.first_mut() else {
            return;
        };
        now.centre = thrown.centre;
        rigid::fly_through(
            fracture,
            (&order, axes, at),
            &mut pieces.bodies,
            &mut ball.bodies,
        );
        pieces.put_back(set);
        ball.put_back(set);
        if let Some(body) = set.get_mut(thrown.ball) {
            let ahead = (thrown.velocity - body.linvel()) * thrown.wait as f32;
            let goes_on = body.linvel().as_dvec3().dot(thrown.touch.normal) > 0.0;
            if goes_on {
                body.set_translation(body.translation() + ahead, true);
            }
        }
        let dt = f64::from(self.physics.integration_parameters.dt);
        let steps = ((thrown.wait + APART) / dt).ceil() as u64;
        self.siblings.pass(thrown.ball, first, steps);
    }
}
