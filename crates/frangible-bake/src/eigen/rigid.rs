//! The six motions that deform nothing: three translations, three rotations.

use frangible::glam::DVec3;

use crate::eigen::basis::{Block, orthonormalise};
use crate::fem::System;

/// Displacements of the six rigid motions, one after another, 3 × nodes numbers each: unit
/// translations, then rotations by one radian about axes through the centre of mass.
#[must_use]
pub fn rigid_motions(system: &System) -> Vec<Vec<f64>> {
    let mass: f64 = system.mass.iter().sum();
    let centre = system
        .positions
        .iter()
        .zip(&system.mass)
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

/// Orthonormal basis of M^½ × rigid motions. A mesh of positive volumes is not a line, so all six count.
pub(crate) fn deflation_basis(system: &System) -> Block {
    let n = 3 * system.mass.len();
    let mut basis = Block::zeros(n, 6);
    for (j, motion) in rigid_motions(system).iter().enumerate() {
        for (i, (to, from)) in basis.column_mut(j).iter_mut().zip(motion).enumerate() {
            *to = from * system.mass[i / 3].sqrt();
        }
    }
    let independent = orthonormalise(&mut basis).is_some();
    debug_assert!(independent, "six independent rigid motions");
    basis
}
