//! Green–Lagrange strain and Hooke's law.

use glam::{Mat3, Vec3};

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
        let (a, b, c) = (gradient.x_axis, gradient.y_axis, gradient.z_axis);
        let e = [
            a.x + 0.5 * a.dot(a),
            b.y + 0.5 * b.dot(b),
            c.z + 0.5 * c.dot(c),
        ];
        let s = [
            0.5 * (b.x + a.y + a.dot(b)),
            0.5 * (c.y + b.z + b.dot(c)),
            0.5 * (a.z + c.x + c.dot(a)),
        ];
        let trace = self.lambda * (e[0] + e[1] + e[2]);
        let diagonal = e.map(|x| trace + 2.0 * self.mu * x);
        let off = s.map(|x| 2.0 * self.mu * x);
        let energy: f32 = (0..3)
            .map(|i| 0.5 * diagonal[i] * e[i] + off[i] * s[i])
            .sum();
        StressState {
            stress: Symmetric3 { diagonal, off },
            energy_density: energy,
        }
    }
}
