//! Avian's bodies as plain numbers, and back.

use avian3d::prelude::*;
use bevy::ecs::query::QueryData;
use bevy::prelude::*;
use frangible::MassProperties;
use frangible::glam::{self, DMat3, DVec3};
use frangible::internals::rigid::Rigid;

use super::Moving;
use crate::meshes::into;

/// A body as plain numbers.
pub(super) fn rigid(kind: &RigidBody, moving: <Moving as QueryData>::Item<'_, '_>) -> Rigid {
    let (position, rotation, linear, angular, mass, inertia, centre) = moving;
    let movable = kind.is_dynamic() && mass.inverse() > 0.0;
    let tensor = inertia.rotated(rotation.0).tensor().to_mat3();
    let columns = [tensor.x_axis, tensor.y_axis, tensor.z_axis].map(|c| double(into(c)));
    let motion = [position.0 + rotation.0 * centre.0, linear.0, angular.0];
    let motion = motion.map(|v| double(into(v)));
    if movable {
        let tensor = DMat3::from_cols(columns[0], columns[1], columns[2]);
        Rigid::free(f64::from(mass.value()), tensor, motion)
    } else {
        Rigid::immovable(motion)
    }
}

pub(super) fn double(v: glam::Vec3) -> DVec3 {
    v.as_dvec3()
}

/// A fragment as plain numbers, moving with its body.
pub(super) fn piece(
    mass: &MassProperties,
    supported: bool,
    body: &Rigid,
    rotation: Quat,
    at: Vec3,
) -> Rigid {
    let turn = DMat3::from_quat(glam::DQuat::from_array(rotation.to_array().map(f64::from)));
    let centre = double(into(at)) + turn * mass.centre;
    let (linear, angular) = if body.gives_way() {
        (body.velocity_at(centre), body.angular)
    } else {
        (DVec3::ZERO, DVec3::ZERO)
    };
    if supported {
        return Rigid::immovable([centre, DVec3::ZERO, DVec3::ZERO]);
    }
    let tensor = turn * mass.inertia * turn.transpose();
    Rigid::free(mass.mass, tensor, [centre, linear, angular])
}

pub(super) fn velocities(body: &Rigid) -> (LinearVelocity, AngularVelocity) {
    let single = |v: DVec3| Vec3::from_array(v.as_vec3().to_array());
    (
        LinearVelocity(single(body.linear)),
        AngularVelocity(single(body.angular)),
    )
}
