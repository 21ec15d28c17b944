//! Green–Lagrange strain and Hooke's law.

use glam::{Mat3, Vec3};

use super::lanes::StressLanes;
use super::tensor::{
    Real, Symmetric3, half_dot, half_product, products, stretch, tangential, uniaxial,
};
use super::wide::{Wide, narrow, wide};
use crate::material::Material;

/// Lamé's parameters at run-time precision.
#[derive(Clone, Copy, Debug)]
pub struct Elasticity {
    pub(super) lambda: f32,
    pub(super) mu: f32,
    /// True if strain has its quadratic terms.
    quadratic: bool,
    /// λ* = 2 λ μ / (λ + 2 μ): λ where nothing holds the third direction.
    pub(super) plane_lambda: f32,
    /// E = μ (3 λ + 2 μ) / (λ + μ).
    pub(super) youngs_modulus: f32,
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
    /// The elasticity of a material, with Green and Lagrange's strain.
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

    /// Sets the strain: Green and Lagrange's, as [`Elasticity::new`] has it, or else the linear one, ½(∇u + ∇uᵀ).
    #[must_use]
    pub fn with_green_lagrange(self, quadratic: bool) -> Self {
        Self { quadratic, ..self }
    }

    /// E, or its linear part, of ∇u, `[column j][row i]` = ∂u_i/∂x_j.
    #[inline(always)]
    fn strain<T: Real>(&self, [a, b, c]: &[[T; 3]; 3]) -> [T; 6] {
        let e = [
            a[0],
            b[1],
            c[2],
            (b[0] + a[1]) * 0.5,
            (c[1] + b[2]) * 0.5,
            (a[2] + c[0]) * 0.5,
        ];
        if !self.quadratic {
            return e;
        }
        [
            e[0] + half_dot(a, a),
            e[1] + half_dot(b, b),
            e[2] + half_dot(c, c),
            e[3] + half_dot(a, b),
            e[4] + half_dot(b, c),
            e[5] + half_dot(c, a),
        ]
    }

    /// Stress by a law, and energy density, of ∇u.
    #[inline(always)]
    fn evaluate<T: Real>(&self, gradient: &[[T; 3]; 3], law: Law) -> ([T; 6], T) {
        let strain = self.strain(gradient);
        match law {
            Law::Solid => {
                let stress = self.hooke_of(&strain);
                (stress, half_product(&stress, &strain))
            }
            Law::Free(n) => {
                let in_surface = tangential(&strain, n);
                let stress = self.plane_stress(&in_surface, n);
                (stress, half_product(&stress, &in_surface))
            }
            Law::Edge(t) => {
                let along = stretch(&strain, t);
                let tension = along * self.youngs_modulus;
                (uniaxial(tension, t), tension * along * 0.5)
            }
        }
    }

    /// Stress and energy of ∇u by one of the laws.
    #[must_use]
    #[inline(always)]
    pub fn state_by(&self, gradient: Mat3, law: Law) -> StressState {
        let (stress, energy_density) = self.evaluate(&gradient.to_cols_array_2d(), law);
        StressState {
            stress: Symmetric3::from_components(stress),
            energy_density,
        }
    }

    /// E = ½(∇u + ∇uᵀ + ∇uᵀ∇u), σ = λ tr(E) I + 2 μ E `[G12 §4.4]`.
    #[must_use]
    pub fn state(&self, gradient: Mat3) -> StressState {
        self.state_by(gradient, Law::Solid)
    }

    /// Stress and energy of ∇u beside a free surface of unit normal `n`, where the traction σ·n is zero. The strain in the surface is
    /// kept, and Hooke's law says the rest (plane stress). With P = I − n nᵀ and E_t = P E P:
    /// σ = λ* tr(E_t) P + 2 μ E_t, λ* = 2 λ μ / (λ + 2 μ), η = ½ σ : E_t.
    #[must_use]
    pub fn free_state(&self, gradient: Mat3, n: Vec3) -> StressState {
        self.state_by(gradient, Law::Free(n))
    }

    /// Stress and energy by one of the laws at all steps of a batch, side by side; `[column j][row i]` = ∂u_i/∂x_j.
    #[inline(always)]
    pub(crate) fn lanes(&self, gradient: &[[Wide; 3]; 3], law: Law) -> StressLanes {
        let (components, energy_density) = self.evaluate(gradient, law);
        StressLanes {
            components: narrow(components),
            energy_density: energy_density.0,
        }
    }

    /// Strain energy density of a stress, J/m³: ((1 + ν) σ : σ − ν tr(σ)²) / 2E.
    #[inline(always)]
    fn energy_of<T: Real>(&self, s: &[T; 6]) -> T {
        let nu = self.lambda / (2.0 * (self.lambda + self.mu));
        let trace = s[0] + s[1] + s[2];
        let squares = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
        let shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
        ((squares + shear * 2.0) * (1.0 + nu) - trace * trace * nu) * (0.5 / self.youngs_modulus)
    }

    /// Gives a stress of a wall the energy density that it has.
    pub(crate) fn with_energy(&self, stress: Symmetric3) -> StressState {
        StressState {
            stress,
            energy_density: self.energy_of(&stress.components()),
        }
    }

    /// Gives stresses at the steps of a batch the energy densities that they have.
    #[inline(always)]
    pub(crate) fn set_energy(&self, lanes: &mut StressLanes) {
        lanes.energy_density = self.energy_of(&wide(&lanes.components)).0;
    }

    /// Stress of a strain by one of the laws, linear in it.
    #[inline(always)]
    pub(crate) fn linear<T: Real>(&self, strain: &[T; 6], law: Law) -> [T; 6] {
        match law {
            Law::Solid => self.hooke_of(strain),
            Law::Free(n) => self.plane_stress(&tangential(strain, n), n),
            Law::Edge(t) => uniaxial(stretch(strain, t) * self.youngs_modulus, t),
        }
    }

    /// σ = λ tr(E) I + 2 μ E.
    #[inline(always)]
    fn hooke_of<T: Real>(&self, strain: &[T; 6]) -> [T; 6] {
        let trace = (strain[0] + strain[1] + strain[2]) * self.lambda;
        let mut stress = *strain;
        for s in &mut stress {
            *s = *s * (2.0 * self.mu);
        }
        for s in &mut stress[..3] {
            *s = *s + trace;
        }
        stress
    }

    #[inline(always)]
    fn plane_stress<T: Real>(&self, in_surface: &[T; 6], n: Vec3) -> [T; 6] {
        let trace = (in_surface[0] + in_surface[1] + in_surface[2]) * self.plane_lambda;
        let across = products(n, n);
        let mut stress = *in_surface;
        for (i, s) in stress.iter_mut().enumerate() {
            let part = if i < 3 { 1.0 - across[i] } else { -across[i] };
            *s = *s * (2.0 * self.mu) + trace * part;
        }
        stress
    }
}

/// Law by which strain at a place becomes stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Hooke's, inside a body.
    Solid,
    /// Beside a free surface of this unit normal: [`Elasticity::free_state`].
    Free(Vec3),
    /// At the edge between two free surfaces that runs along this unit vector: all that is left is the tension along it.
    Edge(Vec3),
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
                let strain = Symmetric3::from_components(law.strain(&g.to_cols_array_2d()));
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
                let edge = law.state_by(g, Law::Edge(n));
                let along = n.dot(strain.times(n));
                assert!((n.dot(edge.stress.times(n)) - e * along).abs() < 1e-5 * size);
                assert!(edge.stress.times(a).length() < 1e-5 * size);
                assert!((edge.energy_density - 0.5 * e * along * along).abs() < 1e-5 * size * 1e-4);
            }
        }
    }

    /// A wall interpolates stress and has no strain: its energy follows from the stress alone.
    #[test]
    fn the_energy_of_a_stress_is_that_of_the_strain_behind_it() {
        let law = Elasticity::new(&glass());
        for g in gradients() {
            let mut states = vec![law.state(g)];
            states.extend(directions().map(|n| law.free_state(g, n)));
            for state in states {
                let energy = law.with_energy(state.stress).energy_density;
                let off = (energy / state.energy_density - 1.0).abs();
                assert!(off < 1e-4, "{energy}, not {}", state.energy_density);
            }
        }
    }

    #[test]
    fn what_acts_across_a_free_surface_does_not_show_beside_it() {
        let law = Elasticity::new(&glass());
        let beside = |g: Mat3, n: Vec3| {
            let strain = Symmetric3::from_mat3(g).components();
            Symmetric3::from_components(law.linear(&strain, Law::Free(n)))
        };
        for g in gradients() {
            for n in directions() {
                let noise = Mat3::from_cols(n * n.x, n * n.y, n * n.z) * 3e-5;
                let (a, b) = (beside(g, n), beside(g + noise, n));
                assert!((0..3).all(|i| (a.diagonal[i] - b.diagonal[i]).abs() < 50.0));
                assert!((0..3).all(|i| (a.off[i] - b.off[i]).abs() < 50.0));
            }
        }
    }
}
