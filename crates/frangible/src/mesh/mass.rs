//! Exact mass properties of polyhedra and tetrahedra.

use glam::{DMat3, DVec3};

/// Mass, centre of mass and inertia of a rigid piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Mass, kg.
    pub mass: f64,
    /// Volume, m³.
    pub volume: f64,
    /// Centre of mass, m, in the frame the piece was given in.
    pub centre: DVec3,
    /// Inertia tensor about the centre of mass, axes of the same frame, kg·m².
    pub inertia: DMat3,
}

impl MassProperties {
    /// Of signed tetrahedra of one density, kg/m³: the apexes (a, b, c, d) with positive or negative
    /// volume. A closed surface is the sum of the tetrahedra of its triangles with any fourth point.
    #[must_use]
    pub fn of_tetrahedra(density: f64, tetrahedra: impl Iterator<Item = [DVec3; 4]>) -> Self {
        let (mut volume, mut first) = (0.0, DVec3::ZERO);
        let mut second = DMat3::ZERO;
        for [a, b, c, d] in tetrahedra {
            let v = (b - a).cross(c - a).dot(d - a) / 6.0;
            let sum = a + b + c + d;
            volume += v;
            first += v / 4.0 * sum;
            // ∫ x xᵀ over a tetrahedron = V/20 (Σ_i x_i x_iᵀ + (Σ x_i)(Σ x_i)ᵀ).
            let outer = |p: DVec3, q: DVec3| DMat3::from_cols(p * q.x, p * q.y, p * q.z);
            second += (outer(a, a) + outer(b, b) + outer(c, c) + outer(d, d) + outer(sum, sum))
                * (v / 20.0);
        }
        let centre = first / volume;
        let about_centre = second
            - DMat3::from_cols(centre * centre.x, centre * centre.y, centre * centre.z) * volume;
        let trace = about_centre.x_axis.x + about_centre.y_axis.y + about_centre.z_axis.z;
        let inertia = (DMat3::from_diagonal(DVec3::splat(trace)) - about_centre) * density;
        Self {
            mass: density * volume,
            volume,
            centre,
            inertia,
        }
    }

    /// nᵀ K n, 1/kg: the inverse effective mass felt by an impulse along unit `n` at `point`
    /// (both in the frame of the piece), rotation included.
    #[must_use]
    pub fn inverse_effective_mass(&self, point: DVec3, n: DVec3) -> f64 {
        let arm = (point - self.centre).cross(n);
        1.0 / self.mass + arm.dot(self.inertia.inverse() * arm)
    }
}
