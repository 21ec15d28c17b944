//! Rigid motions: three translations and three rotations, and those that the supports permit.

use frangible::glam::DVec3;

use crate::eigen::basis::Block;
use crate::eigen::constraints::Constraints;
use crate::eigen::metric::{Basis, Metric};
use crate::eigen::reduce::Reduction;
use crate::error::BakeError;
use crate::fem::System;

/// Returns the displacements of the six rigid motions, 3 × nodes numbers each: unit translations, then
/// rotations by one radian about axes through the centre of mass.
#[must_use]
pub fn rigid_motions(system: &System) -> Vec<Vec<f64>> {
    let centre = centre_of_mass(system);
    let motion = |f: &dyn Fn(DVec3) -> DVec3| {
        system
            .positions
            .iter()
            .flat_map(|&x| f(x).to_array())
            .collect()
    };
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let mut motions: Vec<Vec<f64>> = axes.iter().map(|&a| motion(&|_| a)).collect();
    motions.extend(
        axes.iter()
            .map(|&a| -> Vec<f64> { motion(&|x| a.cross(x - centre)) }),
    );
    motions
}

fn centre_of_mass(system: &System) -> DVec3 {
    let shares = system.mass.row_sums();
    let mass: f64 = shares.iter().sum();
    let places = system.positions.iter().zip(&shares);
    places.map(|(x, m)| *x * *m).sum::<DVec3>() / mass
}

/// Returns the displacements of the rigid motions that the constraints permit, 3 × nodes numbers each:
/// those of [`rigid_motions`] for a free body, none for a clamped one.
#[must_use]
pub fn remaining_motions(system: &System, constraints: &Constraints) -> Vec<Vec<f64>> {
    let all = rigid_motions(system);
    let centre = centre_of_mass(system);
    let reach = system.positions.iter().map(|x| x.distance(centre));
    let reach = reach.fold(0.0, f64::max);
    let Some(free) = constraints.free_motions(centre, reach) else {
        return all;
    };
    let combined = |coefficients: [f64; 6]| -> Vec<f64> {
        (0..system.unknowns())
            .map(|i| (0..6).map(|k| coefficients[k] * all[k][i]).sum())
            .collect()
    };
    free.into_iter().map(combined).collect()
}

/// B-orthonormal basis of D⁻¹ × rigid motions over the unknowns that are left, D = diag(M)^-½.
pub(crate) fn deflation_basis(
    system: &System,
    remaining: &[Vec<f64>],
    reduction: Option<&Reduction>,
    metric: &Metric,
) -> Result<Basis, BakeError> {
    let diagonal = system.mass.diagonal();
    let mut motions = Block::zeros(system.unknowns(), remaining.len());
    for (j, motion) in remaining.iter().enumerate() {
        for (i, (to, from)) in motions.column_mut(j).iter_mut().zip(motion).enumerate() {
            *to = from * diagonal[i / 3].sqrt();
        }
    }
    if let Some(reduction) = reduction {
        motions = reduction.columns(&motions);
    }
    match metric.orthonormalise(motions) {
        Some((basis, _)) => Ok(basis),
        None => Err(BakeError::Factorization {
            reason: "the body is as thin as a line, so its rotations are not independent".into(),
        }),
    }
}
