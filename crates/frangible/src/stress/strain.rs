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

    /// The tensor times a vector.
    #[must_use]
    #[inline(always)]
    pub fn times(self, v: Vec3) -> Vec3 {
        let ([xx, yy, zz], [xy, yz, zx]) = (self.diagonal, self.off);
        Vec3::new(
            xx * v.x + xy * v.y + zx * v.z,
            xy * v.x + yy * v.y + yz * v.z,
            zx * v.x + yz * v.y + zz * v.z,
        )
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
    /// Whether strain has its quadratic terms.
    quadratic: bool,
    /// λ* = 2 λ μ / (λ + 2 μ): λ where nothing holds the third direction.
    plane_lambda: f32,
    /// E = μ (3 λ + 2 μ) / (λ + μ).
    youngs_modulus: f32,
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
        let (lambda, mu) = (material.lame_lambda(), material.shear_modulus());
        Self {
            lambda: lambda as f32,
            mu: mu as f32,
            quadratic: true,
            plane_lambda: (2.0 * lambda * mu / (lambda + 2.0 * mu)) as f32,
            youngs_modulus: material.youngs_modulus as f32,
        }
    }

    /// With Green and Lagrange's strain, as [`Elasticity::new`] has it, or else the linear one, ½(∇u + ∇uᵀ).
    #[must_use]
    pub fn with_green_lagrange(self, quadratic: bool) -> Self {
        Self { quadratic, ..self }
    }

    #[inline(always)]
    fn strain(&self, gradient: Mat3) -> Symmetric3 {
        if self.quadratic {
            green_lagrange(gradient)
        } else {
            Symmetric3::from_mat3(gradient)
        }
    }

    /// E = ½(∇u + ∇uᵀ + ∇uᵀ∇u), σ = λ tr(E) I + 2 μ E `[G12 §4.4]`.
    #[must_use]
    #[inline(always)]
    pub fn state(&self, gradient: Mat3) -> StressState {
        let strain = self.strain(gradient);
        let stress = self.hooke(&strain);
        let ([e, s], [t, u]) = ([strain.diagonal, strain.off], [stress.diagonal, stress.off]);
        StressState {
            stress,
            energy_density: (0..3).map(|i| 0.5 * t[i] * e[i] + u[i] * s[i]).sum(),
        }
    }

    /// By any of the laws.
    #[must_use]
    pub fn state_by(&self, law: Law, gradient: Mat3) -> StressState {
        match law {
            Law::Solid => self.state(gradient),
            Law::Free(n) => self.free_state(gradient, n),
            Law::Edge(t) => self.edge_state(gradient, t),
        }
    }

    /// The same for the steps of a batch side by side; `[column j][row i]` = ∂u_i/∂x_j.
    #[inline(always)]
    pub(crate) fn lanes(&self, gradient: &[[Lanes; 3]; 3], law: Law) -> StressLanes {
        match law {
            Law::Solid => each_lane(gradient, |g| self.state(g)),
            Law::Free(n) => each_lane(gradient, |g| self.free_state(g, n)),
            Law::Edge(t) => each_lane(gradient, |g| self.edge_state(g, t)),
        }
    }

    /// The same beside a free surface of unit normal `n`, where the traction σ·n is zero: the strain in the surface is
    /// kept, the rest is what Hooke's law makes of it (plane stress). With P = I − n nᵀ and E_t = P E P:
    /// σ = λ* tr(E_t) P + 2 μ E_t, λ* = 2 λ μ / (λ + 2 μ), η = ½ σ : E_t.
    #[must_use]
    #[inline(always)]
    pub fn free_state(&self, gradient: Mat3, n: Vec3) -> StressState {
        let strain = self.strain(gradient);
        let in_surface = tangential(&strain, n);
        let stress = self.plane_stress(&in_surface, n);
        let ([e, s], [t, u]) = (
            [in_surface.diagonal, in_surface.off],
            [stress.diagonal, stress.off],
        );
        let energy: f32 = (0..3).map(|i| 0.5 * t[i] * e[i] + u[i] * s[i]).sum();
        StressState {
            stress,
            energy_density: energy,
        }
    }

    /// The same at the edge between two free surfaces that runs along unit `t`: all that is left is the tension along it.
    #[must_use]
    #[inline(always)]
    pub fn edge_state(&self, gradient: Mat3, t: Vec3) -> StressState {
        let strain = self.strain(gradient);
        let stress = self.edge_hooke(&strain, t);
        let along = stress.diagonal.iter().sum::<f32>() / self.youngs_modulus;
        StressState {
            stress,
            energy_density: 0.5 * self.youngs_modulus * along * along,
        }
    }

    /// σ = λ tr(E) I + 2 μ E.
    #[inline(always)]
    pub(super) fn hooke(&self, strain: &Symmetric3) -> Symmetric3 {
        let trace = self.lambda * strain.diagonal.iter().sum::<f32>();
        Symmetric3 {
            diagonal: strain.diagonal.map(|x| trace + 2.0 * self.mu * x),
            off: strain.off.map(|x| 2.0 * self.mu * x),
        }
    }

    /// Stress beside a free surface of unit normal `n`, linear in the strain.
    pub(super) fn free_hooke(&self, strain: &Symmetric3, n: Vec3) -> Symmetric3 {
        self.plane_stress(&tangential(strain, n), n)
    }

    /// Stress at an edge along unit `t`, linear in the strain: E (t·E t) t tᵀ.
    #[inline(always)]
    pub(super) fn edge_hooke(&self, strain: &Symmetric3, t: Vec3) -> Symmetric3 {
        let tension = self.youngs_modulus * t.dot(strain.times(t));
        Symmetric3 {
            diagonal: [t.x * t.x, t.y * t.y, t.z * t.z].map(|x| tension * x),
            off: [t.x * t.y, t.y * t.z, t.z * t.x].map(|x| tension * x),
        }
    }

    #[inline(always)]
    fn plane_stress(&self, in_surface: &Symmetric3, n: Vec3) -> Symmetric3 {
        let trace = self.plane_lambda * in_surface.diagonal.iter().sum::<f32>();
        let along = [n.x, n.y, n.z];
        let across = [n.x * n.y, n.y * n.z, n.z * n.x];
        let two_mu = 2.0 * self.mu;
        Symmetric3 {
            diagonal: std::array::from_fn(|i| {
                two_mu * in_surface.diagonal[i] + trace * (1.0 - along[i] * along[i])
            }),
            off: std::array::from_fn(|i| two_mu * in_surface.off[i] - trace * across[i]),
        }
    }
}

/// E = ½(∇u + ∇uᵀ + ∇uᵀ∇u).
#[inline(always)]
fn green_lagrange(gradient: Mat3) -> Symmetric3 {
    let (a, b, c) = (gradient.x_axis, gradient.y_axis, gradient.z_axis);
    Symmetric3 {
        diagonal: [
            a.x + 0.5 * a.dot(a),
            b.y + 0.5 * b.dot(b),
            c.z + 0.5 * c.dot(c),
        ],
        off: [
            0.5 * (b.x + a.y + a.dot(b)),
            0.5 * (c.y + b.z + b.dot(c)),
            0.5 * (a.z + c.x + c.dot(a)),
        ],
    }
}

/// P E P, P = I − n nᵀ: E − n mᵀ − m nᵀ + (n·m) n nᵀ with m = E n.
#[inline(always)]
fn tangential(e: &Symmetric3, n: Vec3) -> Symmetric3 {
    let ([xx, yy, zz], [xy, yz, zx]) = (e.diagonal, e.off);
    let m = e.times(n);
    let nm = n.dot(m);
    Symmetric3 {
        diagonal: [
            xx - (2.0 * m.x - nm * n.x) * n.x,
            yy - (2.0 * m.y - nm * n.y) * n.y,
            zz - (2.0 * m.z - nm * n.z) * n.z,
        ],
        off: [
            xy - n.x * m.y - m.x * n.y + nm * n.x * n.y,
            yz - n.y * m.z - m.y * n.z + nm * n.y * n.z,
            zx - n.z * m.x - m.z * n.x + nm * n.z * n.x,
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glass() -> Material {
        Material::preset("glass").unwrap()
    }

    fn gradients() -> impl Iterator<Item = Mat3> {
        (0..20_u32).map(|k| {
            let at = |i: u32| f32::from(((k * 37 + i * 101) % 97) as u16) / 97.0 - 0.5;
            Mat3::from_cols_array(&std::array::from_fn(|i| 1e-4 * at(i as u32)))
        })
    }

    fn directions() -> [Vec3; 4] {
        [
            Vec3::Z,
            Vec3::X,
            Vec3::new(1.0, 2.0, -2.0) / 3.0,
            Vec3::new(-6.0, 2.0, 3.0) / 7.0,
        ]
    }

    #[test]
    fn a_free_surface_has_no_traction_and_keeps_its_strain() {
        let material = glass();
        let law = Elasticity::new(&material);
        let (e, nu) = (
            material.youngs_modulus as f32,
            material.poisson_ratio as f32,
        );
        for g in gradients() {
            for n in directions() {
                let free = law.free_state(g, n);
                let size = e * 1e-4;
                assert!(free.stress.times(n).length() < 1e-5 * size);
                // Hooke's law of plane stress, read backwards: ε = ((1 + ν) σ − ν tr(σ) I) / E in the surface.
                let strain = green_lagrange(g);
                let (a, b) = crate::stress::perpendicular_axes(n);
                let trace: f32 = free.stress.diagonal.iter().sum();
                let mut energy = 0.0;
                for (u, v) in [(a, a), (b, b), (a, b), (b, a)] {
                    let delta = u.dot(v);
                    let sigma = u.dot(free.stress.times(v));
                    let back = ((1.0 + nu) * sigma - nu * trace * delta) / e;
                    assert!((back - u.dot(strain.times(v))).abs() < 1e-5 * 1e-4);
                    energy += 0.5 * sigma * back;
                }
                assert!((free.energy_density - energy).abs() < 1e-5 * size * 1e-4);
                let edge = law.edge_state(g, n);
                let along = n.dot(strain.times(n));
                assert!((n.dot(edge.stress.times(n)) - e * along).abs() < 1e-5 * size);
                assert!(edge.stress.times(a).length() < 1e-5 * size);
                assert!((edge.energy_density - 0.5 * e * along * along).abs() < 1e-5 * size * 1e-4);
            }
        }
    }

    #[test]
    fn what_acts_across_a_free_surface_does_not_show_beside_it() {
        let law = Elasticity::new(&glass());
        for g in gradients() {
            for n in directions() {
                let noise = Mat3::from_cols(n * n.x, n * n.y, n * n.z) * 3e-5;
                let (a, b) = (
                    law.free_hooke(&Symmetric3::from_mat3(g), n),
                    law.free_hooke(&Symmetric3::from_mat3(g + noise), n),
                );
                assert!((0..3).all(|i| (a.diagonal[i] - b.diagonal[i]).abs() < 50.0));
                assert!((0..3).all(|i| (a.off[i] - b.off[i]).abs() < 50.0));
            }
        }
    }
}

/// Which law makes stress of strain at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Hooke's, inside a body.
    Solid,
    /// Beside a free surface of this unit normal: [`Elasticity::free_state`].
    Free(Vec3),
    /// At an edge along this unit vector: [`Elasticity::edge_state`].
    Edge(Vec3),
}

#[inline(always)]
fn each_lane(gradient: &[[Lanes; 3]; 3], state: impl Fn(Mat3) -> StressState) -> StressLanes {
    let mut out = StressLanes::default();
    for k in 0..BATCH {
        let [x, y, z] = gradient.map(|column| Vec3::from_array(column.map(|row| row[k])));
        let StressState {
            stress,
            energy_density,
        } = state(Mat3::from_cols(x, y, z));
        let ([xx, yy, zz], [xy, yz, zx]) = (stress.diagonal, stress.off);
        for (lanes, s) in out.components.iter_mut().zip([xx, yy, zz, xy, yz, zx]) {
            lanes[k] = s;
        }
        out.energy_density[k] = energy_density;
    }
    out
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
