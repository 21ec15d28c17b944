//! Questions about blows that have not happened.

use frangible::{Body, Contact, Outcome, Striker};
use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::math::Vector;

use crate::error::{WorldError, finite, not_negative};
use crate::stepping::judge::breakable;
use crate::world::BreakableWorld;

impl BreakableWorld {
    /// A breakable body of the world as a striker of another one, for [`Self::would_break`]: it touches at `point`, m, and flies `toward` a
    /// direction of any length, both in world coordinates. It strikes with its mass and vibrates under the blow.
    ///
    /// # Errors
    /// No breakable body of this handle, a number that is not finite, a direction of no length.
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
        let mut on_it = Contact::new(
            to_body * (point - rigid.translation()),
            to_body * -toward.normalize_or_zero(),
            0.0,
            0.0,
            Striker::rigid(),
        );
        on_it.striker.restitution = body.asset().material.restitution as f32;
        Ok(Striker::flexible(body, &on_it, &self.config.fracture)?)
    }

    /// A breakable body, and how it moves.
    fn body_and_rigid(&self, handle: RigidBodyHandle) -> Result<(&Body, &RigidBody), WorldError> {
        let (index, generation) = handle.into_raw_parts();
        let rigid = self.physics.bodies.get(handle);
        let rigid = rigid.ok_or(WorldError::NoBody { index, generation })?;
        Ok((breakable(&self.state.breakables, handle)?, rigid))
    }

    /// Returns true if a blow would break a body into pieces, all in world coordinates: the striker flies `toward` a direction of any length at
    /// `speed`, m/s, against the body's `point`, m. Nothing in the world changes. A game asks it before an arrow is drawn, or to show
    /// where a wall would give way; a blow that is far too weak costs microseconds, one that breaks as much as the break.
    ///
    /// # Errors
    /// No breakable body of this handle, a number that is not finite, a direction of no length, a negative speed.
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
