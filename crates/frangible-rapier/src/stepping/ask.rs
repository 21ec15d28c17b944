//! Tests of hypothetical blows.

use frangible::{Body, Contact, Outcome, Striker};
use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::math::Vector;

use crate::error::{WorldError, finite, not_negative};
use crate::stepping::judge::breakable;
use crate::world::BreakableWorld;

impl BreakableWorld {
    /// Describes a breakable body of the world as a striker for [`Self::would_break`]: it touches at `point`, m, and moves `toward` a direction
    /// of any length, both in world coordinates. It strikes with its own mass and vibration.
    ///
    /// # Errors
    /// A handle without a breakable body, a number that is not finite, a direction of length zero.
    pub fn striker(
        &self,
        handle: RigidBodyHandle,
        point: Vector,
        toward: Vector,
    ) -> Result<Striker, WorldError> {
        let (body, rigid) = self.body_and_rigid(handle)?;
        finite("point", point)?;
        finite("direction", toward)?;
        let to_body = rigid.rotation().inverse();
        let mut on_it = Contact::strike(
            to_body * (point - rigid.translation()),
            to_body * -toward.normalize_or_zero(),
            0.0,
            Striker::rigid(),
        );
        on_it.striker.restitution = body.asset().material().restitution as f32;
        Ok(Striker::flexible(body, &on_it, &self.config.fracture)?)
    }

    /// A breakable body, and how it moves.
    fn body_and_rigid(&self, handle: RigidBodyHandle) -> Result<(&Body, &RigidBody), WorldError> {
        let (index, generation) = handle.into_raw_parts();
        let rigid = self.physics.bodies.get(handle);
        let rigid = rigid.ok_or(WorldError::NoBody { index, generation })?;
        Ok((breakable(&self.state.breakables, handle)?, rigid))
    }

    /// Returns true if a blow would break a body into pieces, without changing the world. The striker moves `toward` a direction of any length
    /// at `speed`, m/s, and hits the body at `point`, m, in world coordinates. A far too weak blow costs microseconds, a breaking blow as much
    /// as the break itself. Useful for example to show where a wall would fail.
    ///
    /// # Errors
    /// A handle without a breakable body, a number that is not finite, a direction of length zero, a negative speed.
    pub fn would_break(
        &self,
        handle: RigidBodyHandle,
        point: Vector,
        toward: Vector,
        speed: f32,
        striker: Striker,
    ) -> Result<bool, WorldError> {
        let (body, rigid) = self.body_and_rigid(handle)?;
        finite("point", point)?;
        finite("direction", toward)?;
        not_negative("speed (m/s)", speed)?;
        let to_body = rigid.rotation().inverse();
        let contact = Contact::collision(
            body.asset(),
            to_body * (point - rigid.translation()),
            to_body * toward,
            f64::from(speed),
            striker,
        );
        let config = &self.config.fracture;
        if self.clears_quickly {
            return Ok(frangible::would_break(body, &[contact], config)?);
        }
        // Another judge was set, and is asked.
        let outcome = (self.break_function)(body, &[contact], config)?;
        Ok(matches!(outcome, Outcome::Broke(fracture) if fracture.fragments.len() > 1))
    }
}
