//! Stiffness of a tetrahedron in isotropic linear elasticity.

use frangible::Material;
use frangible::glam::DVec3;

use crate::fem::quadratic::shape_gradients;
use crate::mesh::{barycentric_gradients, tet_volume};

/// Material constants that determine the modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elasticity {
    /// Young's modulus E, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio ν, in (−1, 0.5).
    pub poisson_ratio: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
}

impl From<&Material> for Elasticity {
    fn from(m: &Material) -> Self {
        Self {
            youngs_modulus: m.youngs_modulus,
            poisson_ratio: m.poisson_ratio,
            density: m.density,
        }
    }
}

impl Elasticity {
    /// Returns the Lamé constants λ and μ, Pa.
    #[must_use]
    pub fn lame(&self) -> (f64, f64) {
        let (e, nu) = (self.youngs_modulus, self.poisson_ratio);
        (
            e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
            e / (2.0 * (1.0 + nu)),
        )
    }
}

/// Coordinates of the four-point Gauss rule, exact to second order: (5 ± 3√5)/20 and (5 − √5)/20.
const NEAR: f64 = 0.585_410_196_624_968_5;
const FAR: f64 = 0.138_196_601_125_010_5;

/// Adds `weight` · (λ g_a g_bᵀ + μ g_b g_aᵀ + μ (g_a·g_b) I) to the 3 × 3 block of every node pair.
pub(crate) fn add_point<const N: usize>(
    k: &mut [[[[f64; 3]; 3]; N]; N],
    g: &[DVec3; N],
    weight: f64,
    (lambda, mu): (f64, f64),
) {
    for a in 0..N {
        for b in 0..=a {
            let dot = mu * g[a].dot(g[b]);
            for i in 0..3 {
                for j in 0..3 {
                    let diagonal = if i == j { dot } else { 0.0 };
                    k[a][b][i][j] +=
                        weight * (lambda * g[a][i] * g[b][j] + mu * g[b][i] * g[a][j] + diagonal);
                }
            }
        }
    }
}

/// Returns the stiffness of a quadratic tetrahedron, N/m: 3 × 3 blocks of the node pairs (a, b) with b ≤ a.
#[must_use]
pub fn stiffness_t10(corners: [DVec3; 4], material: &Elasticity) -> [[[[f64; 3]; 3]; 10]; 10] {
    let gradients = barycentric_gradients(corners);
    let weight = tet_volume(corners) / 4.0;
    let mut k = [[[[0.0; 3]; 3]; 10]; 10];
    for point in 0..4 {
        let mut l = [FAR; 4];
        l[point] = NEAR;
        add_point(
            &mut k,
            &shape_gradients(l, &gradients),
            weight,
            material.lame(),
        );
    }
    k
}

/// Returns the stiffness of a linear tetrahedron, N/m: 3 × 3 blocks of the node pairs (a, b) with b ≤ a.
#[must_use]
pub fn stiffness_t4(corners: [DVec3; 4], material: &Elasticity) -> [[[[f64; 3]; 3]; 4]; 4] {
    let mut k = [[[[0.0; 3]; 3]; 4]; 4];
    add_point(
        &mut k,
        &barycentric_gradients(corners),
        tet_volume(corners),
        material.lame(),
    );
    k
}
