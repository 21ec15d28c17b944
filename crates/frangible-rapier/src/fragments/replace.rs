//! A broken body gives way to its fragments.

use frangible::{Fracture, Fragment};
use rapier3d::dynamics::{
    ImpulseJointHandle, MassProperties, RigidBody, RigidBodyBuilder, RigidBodyHandle, RigidBodyType,
};
use rapier3d::geometry::{Aabb, Collider, ColliderBuilder, SharedShape};
use rapier3d::math::{Pose, Vector};
use rapier3d::parry::bounding_volume::BoundingVolume;
use rapier3d::pipeline::ActiveHooks;

use crate::bodies::collider::collision_shape;
use crate::bodies::mass::rapier_mass;
use crate::config::WorldConfig;
use crate::error::WorldError;
use crate::fragments::joints::hand_over_joints;
use crate::world::BreakableWorld;

/// Shapes and masses of a fracture's fragments: built once, though a step may be undone more than once.
pub(crate) struct Parts {
    parts: Vec<Part>,
}

struct Part {
    /// Collider; dust has none.
    shape: Option<SharedShape>,
    mass: MassProperties,
    /// Centre of mass, in the parent's frame, m.
    centre: Vector,
    supported: bool,
}

impl Parts {
    /// # Errors
    /// A fragment whose mass or moment of inertia is no positive number.
    pub(crate) fn new(fracture: &Fracture, config: &WorldConfig) -> Result<Self, WorldError> {
        let part = |fragment: &Fragment| -> Result<Part, WorldError> {
            let mass = rapier_mass(&fragment.mass)?;
            let shape = (!is_dust(fragment, config)).then(|| collision_shape(fragment, config));
            Ok(Part {
                shape,
                mass,
                centre: fragment.mass.centre.as_vec3(),
                // On a film nothing else holds a piece in its frame.
                supported: fragment.supported && fracture.film().is_empty(),
            })
        };
        Ok(Self {
            parts: fracture
                .fragments
                .iter()
                .map(part)
                .collect::<Result<_, _>>()?,
        })
    }
}

pub(crate) fn is_dust(fragment: &Fragment, config: &WorldConfig) -> bool {
    fragment.mass.mass < f64::from(config.dust_mass) && !fragment.supported
}

pub(crate) fn is_debris(fragment: &Fragment, config: &WorldConfig) -> bool {
    fragment.mass.mass < f64::from(config.debris_mass.max(config.dust_mass))
}

/// Fragments that have taken the place of a body that broke.
pub(crate) struct Replacement {
    pub(crate) fragments: Vec<RigidBodyHandle>,
    /// Joints of the body that no fragment holds; they are no longer in the world.
    pub(crate) released: Vec<ImpulseJointHandle>,
}

impl BreakableWorld {
    /// Puts fragments in the place of `parent`, each moving as the piece of the rigid body it was:
    /// v + ω × r, same ω. Neither momentum nor angular momentum nor kinetic energy changes. Of a fixed parent the
    /// supported fragments are fixed, the others start from rest.
    pub(crate) fn replace(&mut self, parent: RigidBodyHandle, parts: &Parts) -> Replacement {
        let Some(body) = self.physics.bodies.get(parent).cloned() else {
            return Replacement {
                fragments: Vec::new(),
                released: Vec::new(),
            };
        };
        let skin = body
            .colliders()
            .first()
            .and_then(|&c| self.physics.colliders.get(c))
            .cloned();
        let bounds = self.bounds(&body);
        let mut fragments = Vec::with_capacity(parts.parts.len());
        for part in &parts.parts {
            let builder = fragment_body(&body, part).additional_mass_properties(part.mass);
            let handle = self.physics.bodies.insert(builder);
            if let Some(shape) = &part.shape {
                let collider = fragment_collider(shape.clone(), skin.as_ref());
                self.physics.insert_collider(collider, Some(handle));
            }
            if let Some(fragment) = self.physics.bodies.get_mut(handle) {
                fragment.recompute_mass_properties_from_colliders(&self.physics.colliders);
            }
            fragments.push((handle, part.centre));
        }
        let released = hand_over_joints(
            &mut self.physics,
            parent,
            &fragments,
            self.config.joint_reach,
        );
        self.physics.remove_body(parent);
        self.wake_around(bounds);
        let handles: Vec<RigidBodyHandle> =
            fragments.into_iter().map(|(handle, _)| handle).collect();
        self.siblings.born(parent, &handles);
        Replacement {
            fragments: handles,
            released,
        }
    }

    /// Bounds of a body's colliders where it is.
    pub(super) fn bounds(&self, body: &RigidBody) -> Option<Aabb> {
        let colliders = body
            .colliders()
            .iter()
            .filter_map(|&c| self.physics.colliders.get(c));
        colliders
            .map(Collider::compute_aabb)
            .reduce(|a, b| a.merged(&b))
    }

    /// Wakes bodies that may have leaned on, or hung from, the body that is gone.
    fn wake_around(&mut self, bounds: Option<Aabb>) {
        let Some(bounds) = bounds else { return };
        let bounds =
            bounds.loosened(4.0 * self.physics.integration_parameters.prediction_distance());
        let near = self
            .physics
            .colliders
            .iter()
            .filter(|(_, c)| c.compute_aabb().intersects(&bounds));
        let handles: Vec<RigidBodyHandle> = near.filter_map(|(_, c)| c.parent()).collect();
        for handle in handles {
            self.physics.wake_up(handle, true);
        }
    }
}

fn fragment_body(parent: &RigidBody, part: &Part) -> RigidBodyBuilder {
    let pose = *parent.position();
    let position = pose * part.centre;
    let kind = if part.supported && parent.is_fixed() {
        RigidBodyType::Fixed
    } else {
        RigidBodyType::Dynamic
    };
    let mut builder = RigidBodyBuilder::new(kind)
        .pose(Pose::from_parts(position, pose.rotation))
        .linvel(parent.velocity_at_point(position))
        .angvel(parent.angvel())
        .gravity_scale(parent.gravity_scale())
        .linear_damping(parent.linear_damping())
        .angular_damping(parent.angular_damping())
        .dominance_group(parent.dominance_group())
        .user_data(parent.user_data);
    if !parent.is_dynamic() {
        builder = builder.linvel(Vector::ZERO).angvel(Vector::ZERO);
    }
    builder
}

fn fragment_collider(shape: SharedShape, parent: Option<&Collider>) -> ColliderBuilder {
    let builder = ColliderBuilder::new(shape)
        .mass_properties(MassProperties::default())
        .active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS);
    let Some(parent) = parent else { return builder };
    builder
        .active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS | parent.active_hooks())
        .friction(parent.friction())
        .friction_combine_rule(parent.friction_combine_rule())
        .restitution(parent.restitution())
        .restitution_combine_rule(parent.restitution_combine_rule())
        .collision_groups(parent.collision_groups())
        .solver_groups(parent.solver_groups())
        .active_events(parent.active_events())
        .active_collision_types(parent.active_collision_types())
        .contact_skin(parent.contact_skin())
        .contact_force_event_threshold(parent.contact_force_event_threshold())
        .user_data(parent.user_data)
}
