//! Unbreakable strikers of any shape.

use rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use rapier3d::geometry::SharedShape;
use rapier3d::math::{Pose, Vector};

use crate::bodies::insert::check_pose;
use crate::contact::surface::SurfaceProperties;
use crate::error::{WorldError, finite, positive};
use crate::world::BreakableWorld;

impl BreakableWorld {
    /// Inserts a rigid solid of uniform density with its frame at `pose`, with continuous collision detection so that it does not tunnel;
    /// `mass` in kg, `linvel` in m/s. The radius of curvature of `surface` is that of the striking part.
    ///
    /// # Errors
    /// A mass not above zero, a shape without volume, a pose or velocity that is not finite, a full world.
    pub fn insert_rigid(
        &mut self,
        shape: SharedShape,
        mass: f32,
        surface: SurfaceProperties,
        pose: Pose,
        linvel: Vector,
    ) -> Result<RigidBodyHandle, WorldError> {
        self.check_room()?;
        check_pose(pose)?;
        finite("velocity", linvel)?;
        positive("mass of the body (kg)", mass)?;
        surface.validate()?;
        let mut properties = shape.mass_properties(1.0);
        positive("volume of the shape (m³)", properties.mass())?;
        properties.set_mass(mass, true);
        let builder = RigidBodyBuilder::dynamic()
            .pose(pose)
            .linvel(linvel)
            .ccd_enabled(true)
            .allow_fast_rotation(true)
            .additional_mass_properties(properties);
        Ok(self.insert_plain(builder, shape, surface))
    }
}
