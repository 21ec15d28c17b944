//! Insertion of bodies into the world.

use frangible::{Body, Striker};
use rapier3d::dynamics::{MassProperties, RigidBodyBuilder, RigidBodyHandle, RigidBodyType};
use rapier3d::geometry::{ColliderBuilder, HalfSpace, SharedShape};
use rapier3d::math::{Pose, Vector};
use std::sync::Arc;

use crate::bodies::collider::whole_shape;
use crate::bodies::mass::{ball_mass, rapier_mass};
use crate::contact::surface::SurfaceProperties;
use crate::error::{WorldError, finite, positive};
use crate::world::{BreakableWorld, key};

/// A solid ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Mass, kg.
    pub mass: f32,
    /// Radius, m.
    pub radius: f32,
}

impl BreakableWorld {
    /// Inserts a breakable body; `rigid` has the pose and velocity of its centre of mass, and its user data.
    ///
    /// The collider is a box where the body is one, else the compound of the asset's convex cells, with the friction and restitution of its material;
    /// mass and inertia are the asset's. A body whose asset [is supported](frangible::Asset::is_supported) becomes a fixed one: it does not move,
    /// whatever its velocities, until it breaks; then the fragments that are still supported stay where they are. Any other can be held by a fixed
    /// `rigid`, or by impulse joints, but all its fragments are dynamic.
    ///
    /// ```
    /// use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
    /// # use frangible_rapier::{BreakableWorld, WorldError, rapier3d::math::Vector};
    /// # fn of(world: &mut BreakableWorld, body: frangible::Body) -> Result<(), WorldError> {
    /// let falls = RigidBodyBuilder::dynamic().translation(Vector::Y).linvel(Vector::NEG_Y);
    /// let handle = world.insert(body, falls)?;
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// A pose or velocity that is not finite, an asset without a positive mass, a full world.
    pub fn insert(
        &mut self,
        body: Body,
        rigid: RigidBodyBuilder,
    ) -> Result<RigidBodyHandle, WorldError> {
        self.insert_with(body, rigid, |collider| collider)
    }

    /// Inserts a breakable body like [`insert`](Self::insert); `finish` receives the builder of its collider and may add groups, hooks and events.
    /// Fragments inherit all of these.
    ///
    /// # Errors
    /// The errors of [`insert`](Self::insert).
    pub fn insert_with(
        &mut self,
        body: Body,
        rigid: RigidBodyBuilder,
        finish: impl FnOnce(ColliderBuilder) -> ColliderBuilder,
    ) -> Result<RigidBodyHandle, WorldError> {
        self.check_room()?;
        check_pose(rigid.position)?;
        finite("velocity", rigid.linvel)?;
        finite("angular velocity", rigid.angvel)?;
        let mass = rapier_mass(&body.asset().mass())?;
        let shape = match self
            .shapes
            .iter()
            .find(|(asset, _)| Arc::ptr_eq(asset, body.asset()))
        {
            Some((_, shape)) => shape.clone(),
            None => {
                let shape = whole_shape(body.asset(), self.config.whole_collider);
                self.shapes.push((Arc::clone(body.asset()), shape.clone()));
                shape
            }
        };
        let surface = SurfaceProperties::of(body.asset().material(), Striker::EDGE_RADIUS);
        surface.validate()?;
        let mut rigid = rigid.additional_mass_properties(mass);
        if body.asset().is_supported() {
            rigid.body_type = RigidBodyType::Fixed;
            rigid = rigid.linvel(Vector::ZERO).angvel(Vector::ZERO);
        }
        let handle = self.insert_finished(rigid, shape, surface, finish);
        self.state.breakables.insert(key(handle), body);
        Ok(handle)
    }

    /// Inserts a solid ball, swept so that it never passes through anything however fast; `linvel` in m/s.
    /// The surface's radius of curvature becomes the ball's.
    ///
    /// # Errors
    /// Mass or radius not above zero, a pose or velocity that is not finite, a full world.
    pub fn insert_ball(
        &mut self,
        ball: Ball,
        surface: SurfaceProperties,
        pose: Pose,
        linvel: Vector,
    ) -> Result<RigidBodyHandle, WorldError> {
        self.check_room()?;
        check_pose(pose)?;
        finite("velocity", linvel)?;
        positive("mass of the ball (kg)", ball.mass)?;
        positive("radius of the ball (m)", ball.radius)?;
        let surface = SurfaceProperties {
            curvature_radius: ball.radius,
            ..surface
        };
        surface.validate()?;
        let builder = RigidBodyBuilder::dynamic()
            .pose(pose)
            .linvel(linvel)
            .ccd_enabled(true)
            .allow_fast_rotation(true);
        let builder = builder.additional_mass_properties(ball_mass(ball.mass, ball.radius));
        Ok(self.insert_plain(builder, SharedShape::ball(ball.radius), surface))
    }

    /// Inserts a box that never moves; half extents in m.
    ///
    /// # Errors
    /// A half extent not above zero, a pose that is not finite, a full world.
    pub fn insert_fixed_box(
        &mut self,
        half_extents: Vector,
        pose: Pose,
        surface: SurfaceProperties,
    ) -> Result<RigidBodyHandle, WorldError> {
        self.check_room()?;
        check_pose(pose)?;
        surface.validate()?;
        for extent in half_extents.to_array() {
            positive("half extent of the box (m)", extent)?;
        }
        let shape = SharedShape::cuboid(half_extents.x, half_extents.y, half_extents.z);
        Ok(self.insert_plain(RigidBodyBuilder::fixed().pose(pose), shape, surface))
    }

    /// Inserts an infinite fixed half-space, such as a floor: everything behind the plane through `point` (m) with outward `normal`.
    ///
    /// # Errors
    /// A point or normal that is not finite, a normal of length zero, a full world.
    pub fn insert_fixed_half_space(
        &mut self,
        point: Vector,
        normal: Vector,
        surface: SurfaceProperties,
    ) -> Result<RigidBodyHandle, WorldError> {
        self.check_room()?;
        finite("point of the half-space", point)?;
        finite("normal of the half-space", normal)?;
        surface.validate()?;
        let normal = normal.try_normalize().ok_or(WorldError::NoNormal(normal))?;
        let shape = SharedShape::new(HalfSpace::new(normal));
        Ok(self.insert_plain(RigidBodyBuilder::fixed().translation(point), shape, surface))
    }

    /// Sets the surface of all colliders of any body of [`BreakableWorld::physics`].
    ///
    /// # Errors
    /// An invalid number, or an unknown body.
    pub fn set_surface(
        &mut self,
        body: RigidBodyHandle,
        surface: SurfaceProperties,
    ) -> Result<(), WorldError> {
        surface.validate()?;
        let (index, generation) = body.into_raw_parts();
        let rigid = self
            .physics
            .bodies
            .get(body)
            .ok_or(WorldError::NoBody { index, generation })?;
        for &collider in rigid.colliders() {
            if let Some(collider) = self.physics.colliders.get_mut(collider) {
                collider.set_friction(surface.friction);
                collider.set_restitution(surface.restitution);
            }
        }
        self.state.surfaces.insert(key(body), surface);
        Ok(())
    }

    pub(crate) fn check_room(&self) -> Result<(), WorldError> {
        let limit = self.config.max_bodies;
        if self.body_count() < limit {
            Ok(())
        } else {
            Err(WorldError::Full(limit))
        }
    }

    pub(crate) fn insert_plain(
        &mut self,
        body: RigidBodyBuilder,
        shape: SharedShape,
        surface: SurfaceProperties,
    ) -> RigidBodyHandle {
        self.insert_finished(body, shape, surface, |collider| collider)
    }

    fn insert_finished(
        &mut self,
        body: RigidBodyBuilder,
        shape: SharedShape,
        surface: SurfaceProperties,
        finish: impl FnOnce(ColliderBuilder) -> ColliderBuilder,
    ) -> RigidBodyHandle {
        let handle = self.physics.bodies.insert(body);
        let collider = ColliderBuilder::new(shape)
            .friction(surface.friction)
            .restitution(surface.restitution);
        // The mass is the body's, and the collider's own is not used.
        let collider = finish(collider).mass_properties(MassProperties::default());
        self.physics.insert_collider(collider, Some(handle));
        if let Some(body) = self.physics.bodies.get_mut(handle) {
            // Rapier would do it at the next step; energy and momentum are asked for before.
            body.recompute_mass_properties_from_colliders(&self.physics.colliders);
        }
        self.state.surfaces.insert(key(handle), surface);
        handle
    }
}

pub(crate) fn check_pose(pose: Pose) -> Result<(), WorldError> {
    if !pose.is_finite() {
        return Err(WorldError::NotFinite { what: "pose" });
    }
    let length = pose.rotation.length();
    if (length - 1.0).abs() > 1e-3 {
        Err(WorldError::Rotation(length))
    } else {
        Ok(())
    }
}
