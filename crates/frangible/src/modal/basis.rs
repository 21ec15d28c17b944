//! The vibration modes of a body: frequencies, shapes, stress bounds.

use crate::material::Material;

/// Mass-normalised vibration modes (Φᵀ M Φ = I) of a free body, without its six rigid motions.
///
/// Struct of arrays, one entry per mode in each; modes sorted by rising frequency.
#[derive(Clone, Debug, Default)]
pub struct ModalBasis {
    /// Eigenvalues λ_i = ω_i², 1/s².
    pub eigenvalues: Vec<f64>,
    /// Mode shapes φ, 1/√kg: row-major, row `3 * analysis node + axis`, one column per mode.
    pub shapes: Vec<f32>,
    /// Largest spectral norm of each mode's linear stress over the fracture tetrahedra, Pa per unit amplitude (m·√kg).
    pub peak_stress: Vec<f32>,
    /// Number of modes, the highest, that a blow does not follow through time: they answer its force statically, together, as the
    /// [residual vector](crate::FractureConfig::residual). 0: all are followed.
    pub residual_modes: usize,
}

impl ModalBasis {
    /// Number of modes m.
    #[must_use]
    pub fn count(&self) -> usize {
        self.eigenvalues.len()
    }

    /// Number of modes that a blow follows through time, the lowest.
    #[must_use]
    pub fn followed(&self) -> usize {
        self.count().saturating_sub(self.residual_modes)
    }

    /// Natural frequency of mode `i` without damping, Hz.
    #[must_use]
    pub fn frequency(&self, i: usize) -> f64 {
        self.eigenvalues[i].sqrt() / std::f64::consts::TAU
    }

    /// Row of the shapes at degree of freedom `3 * node + axis`: one number per mode.
    #[must_use]
    pub fn row(&self, dof: usize) -> &[f32] {
        let m = self.count();
        &self.shapes[dof * m..(dof + 1) * m]
    }

    /// Rows of the shapes along x, y and z at an analysis node.
    #[inline]
    #[must_use]
    pub fn rows(&self, node: usize) -> [&[f32]; 3] {
        [0, 1, 2].map(|axis| self.row(3 * node + axis))
    }

    /// Rayleigh damping d_i = α λ_i + β of mode `i`, 1/s.
    #[must_use]
    pub fn damping(&self, i: usize, material: &Material) -> f64 {
        material.stiffness_damping * self.eigenvalues[i] + material.mass_damping
    }
}
