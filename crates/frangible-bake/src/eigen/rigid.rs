//! The six motions that deform nothing: three translations, three rotations.

use frangible::glam::DVec3;

use crate::eigen::basis::Block;
use crate::eigen::metric::{Basis, Metric};
use crate::error::BakeError;
use crate::fem::System;

/// Displacements of the six rigid motions, one after another, 3 × nodes numbers each: unit
/// translations, then rotations by one radian about axes through the centre of mass.
#[must_use]
pub fn rigid_motions(system: &System) -> Vec<Vec<f64>> {
    let shares = system.mass.row_sums();
    let mass: f64 = shares.iter().sum();
    let centre = system
        .positions
        .iter()
        .zip(&shares)
        .map(|(x, m)| *x * *m)
        .sum::<DVec3>()
        / mass;
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

/// B-orthonormal basis of D⁻¹ × rigid motions, D = diag(M)^-½.
pub(crate) fn deflation_basis(system: &System, metric: &Metric) -> Result<Basis, BakeError> {
    let diagonal = system.mass.diagonal();
    let mut motions = Block::zeros(system.unknowns(), 6);
    for (j, motion) in rigid_motions(system).iter().enumerate() {
        for (i, (to, from)) in motions.column_mut(j).iter_mut().zip(motion).enumerate() {
            *to = from * diagonal[i / 3].sqrt();
        }
    }
    match metric.orthonormalise(motions) {
        Some((basis, _)) => Ok(basis),
        None => Err(BakeError::Factorization {
            reason: "the body is as thin as a line, so that its rotations are not independent"
                .into(),
        }),
    }
}
