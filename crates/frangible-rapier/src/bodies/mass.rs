//! Exact mass properties in Rapier's form.

use frangible::internals::MassProperties as Exact;
use frangible::internals::mesh::symmetric_eigen;
use rapier3d::dynamics::MassProperties;
use rapier3d::math::{Matrix, Rotation, Vector};

use crate::error::{WorldError, positive};

/// Rapier's mass properties of a body whose frame has its origin at the centre of mass.
pub(crate) fn rapier_mass(exact: &Exact) -> Result<MassProperties, WorldError> {
    positive("mass of the body (kg)", exact.mass as f32)?;
    let (principal, axes) = symmetric_eigen(exact.inertia);
    for moment in principal.to_array() {
        positive("principal moment of inertia (kg·m²)", moment as f32)?;
    }
    let rotation = Rotation::from_mat3(&Matrix::from_cols(
        axes.x_axis.as_vec3(),
        axes.y_axis.as_vec3(),
        axes.z_axis.as_vec3(),
    ));
    let moments = principal.as_vec3();
    Ok(MassProperties::with_principal_inertia_frame(
        Vector::ZERO,
        exact.mass as f32,
        moments,
        rotation.normalize(),
    ))
}

/// Mass properties of a solid ball: mass in kg, radius in m.
pub(crate) fn ball_mass(mass: f32, radius: f32) -> MassProperties {
    MassProperties::new(
        Vector::ZERO,
        mass,
        Vector::splat(0.4 * mass * radius * radius),
    )
}
