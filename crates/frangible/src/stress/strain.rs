//! Green–Lagrange strain and Hooke's law.

use glam::{Mat3, Vec3};

use super::displacement::{BATCH, Lanes};
use super::principal::largest_eigenvalue_bound;
use crate::material::Material;

/// Symmetric 3 × 3 tensor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Symmetric3 {
    /// xx, yy, zz.
    pub diagonal: [f32; 3],
    /// xy, yz, zx.
    pub off: [f32; 3],
}

impl Symmetric3 {
    /// As a full matrix.
    #[must_use]
    pub fn to_mat3(self) -> Mat3 {
        let ([xx, yy, zz], [xy, yz, zx]) = (self.diagonal, self.off);
        Mat3::from_cols(
            Vec3::new(xx, xy, zx),
            Vec3::new(xy, yy, yz),
            Vec3::new(zx, yz, zz),
        )
    }

    /// The symmetric part of a matrix.
    #[must_use]
    pub fn from_mat3(m: Mat3) -> Self {
        Self {
            diagonal: [m.x_axis.x, m.y_axis.y, m.z_axis.z],
            off: [
                0.5 * (m.x_axis.y + m.y_axis.x),
                0.5 * (m.y_axis.z + m.z_axis.y),
                0.5 * (m.z_axis.x + m.x_axis.z),
            ],
        }
    }

    /// Von Mises' equivalent of a stress, √(3 J₂): what a bar under this much tension would feel of change of shape.
    #[must_use]
    pub fn von_mises(self) -> f32 {
        let ([xx, yy, zz], [xy, yz, zx]) = (self.diagonal, self.off);
        let differences = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
        (0.5 * differences + 3.0 * (xy * xy + yz * yz + zx * zx)).sqrt()
    }

    /// What is left of a stress beside a free surface of unit normal `n`: P σ P, P = I − n nᵀ.
    #[must_use]
    pub fn released(self, n: Vec3) -> Self {
        let p = Mat3::IDENTITY - Mat3::from_cols(n * n.x, n * n.y, n * n.z);
        Self::from_mat3(p * self.to_mat3() * p)
    }
}

/// Lamé's parameters at run-time precision.
#[derive(Clone, Copy, Debug)]
pub struct Elasticity {
    lambda: f32,
    mu: f32,
}

/// Stress and strain energy at a point.
#[derive(Clone, Copy, Debug)]
pub struct StressState {
    /// σ, Pa.
    pub stress: Symmetric3,
    /// η = ½ σ : E, J/m³.
    pub energy_density: f32,
}

impl Elasticity {
    /// Of a material.
    #[must_use]
    pub fn new(material: &Material) -> Self {
        Self {
            lambda: material.lame_lambda() as f32,
            mu: material.shear_modulus() as f32,
        }
    }

    /// E = ½(∇u + ∇uᵀ + ∇uᵀ∇u), σ = λ tr(E) I + 2 μ E `[G12 §4.4]`.
    #[must_use]
    pub fn state(&self, gradient: Mat3) -> StressState {
        let columns = gradient.to_cols_array_2d();
        let (stress, energy_density) = self.evaluate(&columns);
        let [xx, yy, zz, xy, yz, zx] = stress;
        StressState {
            stress: Symmetric3 {
                diagonal: [xx, yy, zz],
                off: [xy, yz, zx],
            },
            energy_density,
        }
    }

    /// The same for the steps of a batch side by side; `[column j][row i]` = ∂u_i/∂x_j.
    #[inline(always)]
    pub(crate) fn lanes(&self, gradient: &[[Lanes; 3]; 3]) -> StressLanes {
        let mut out = StressLanes::default();
        for k in 0..BATCH {
            let columns = gradient.map(|column| column.map(|row| row[k]));
            let (stress, energy_density) = self.evaluate(&columns);
            for (lanes, s) in out.components.iter_mut().zip(stress) {
                lanes[k] = s;
            }
            out.energy_density[k] = energy_density;
        }
        out
    }

    /// σ as xx, yy, zz, xy, yz, zx, and η, of a gradient `[column j][row i]`.
    #[inline(always)]
    fn evaluate(&self, [a, b, c]: &[[f32; 3]; 3]) -> ([f32; 6], f32) {
        let dot = |u: &[f32; 3], v: &[f32; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let e = [
            a[0] + 0.5 * dot(a, a),
            b[1] + 0.5 * dot(b, b),
            c[2] + 0.5 * dot(c, c),
        ];
        let s = [
            0.5 * (b[0] + a[1] + dot(a, b)),
            0.5 * (c[1] + b[2] + dot(b, c)),
            0.5 * (a[2] + c[0] + dot(c, a)),
        ];
        let trace = self.lambda * (e[0] + e[1] + e[2]);
        let diagonal = e.map(|x| trace + 2.0 * self.mu * x);
        let off = s.map(|x| 2.0 * self.mu * x);
        let mut energy = 0.0;
        for i in 0..3 {
            energy += 0.5 * diagonal[i] * e[i] + off[i] * s[i];
        }
        (
            [
                diagonal[0],
                diagonal[1],
                diagonal[2],
                off[0],
                off[1],
                off[2],
            ],
            energy,
        )
    }
}

/// Stress and strain energy at a point at the steps of a batch.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StressLanes {
    /// σ, Pa: xx, yy, zz, xy, yz, zx.
    components: [Lanes; 6],
    /// η, J/m³.
    pub(crate) energy_density: Lanes,
}

impl StressLanes {
    /// σ at step k of the batch, Pa.
    #[inline(always)]
    pub(crate) fn stress(&self, k: usize) -> Symmetric3 {
        let [xx, yy, zz, xy, yz, zx] = self.components.map(|lanes| lanes[k]);
        Symmetric3 {
            diagonal: [xx, yy, zz],
            off: [xy, yz, zx],
        }
    }

    /// Qᵀ σ Q, without the energy.
    #[inline(always)]
    pub(crate) fn projected(&self, q: &Mat3) -> Self {
        let [xx, yy, zz, xy, yz, zx] = &self.components;
        let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        let columns = q.to_cols_array_2d();
        let mut out = Self::default();
        for (component, [i, j]) in [[0, 0], [1, 1], [2, 2], [0, 1], [1, 2], [2, 0]]
            .into_iter()
            .enumerate()
        {
            for (row, left) in rows.iter().zip(columns[i]) {
                for (lanes, right) in row.iter().zip(columns[j]) {
                    for k in 0..BATCH {
                        out.components[component][k] += left * right * lanes[k];
                    }
                }
            }
        }
        out
    }

    /// Upper bounds of the largest principal tension, Pa.
    #[inline(always)]
    pub(crate) fn tension_bounds(&self) -> Lanes {
        let mut bounds = [0.0; BATCH];
        for (k, bound) in bounds.iter_mut().enumerate() {
            *bound = largest_eigenvalue_bound(&self.stress(k));
        }
        bounds
    }
}
