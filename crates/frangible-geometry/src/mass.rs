//! Exact mass properties of polyhedra and tetrahedra.

use glam::{DMat3, DVec3, Vec3Swizzles as _};

/// Mass, centre of mass and inertia of a rigid piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Mass, kg.
    pub mass: f64,
    /// Volume, m³.
    pub volume: f64,
    /// Centre of mass, m, in the frame of the input.
    pub centre: DVec3,
    /// Inertia tensor about the centre of mass, axes of the same frame, kg·m².
    pub inertia: DMat3,
}

impl MassProperties {
    /// Computes the mass properties of signed tetrahedra (a, b, c, d) of one density, kg/m³, whose volumes may be negative. A closed
    /// surface is the sum of the tetrahedra of its triangles with any fourth point.
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

    /// Computes the mass properties of the solid inside a closed surface, of one density, kg/m³, from the corners of its triangles.
    pub fn of_surface(density: f64, triangles: impl Iterator<Item = [DVec3; 3]>) -> Self {
        let (mut volume, mut first) = (0.0, DVec3::ZERO);
        // xx, yy, zz and yz, zx, xy of the second moments.
        let (mut squares, mut products) = (DVec3::ZERO, DVec3::ZERO);
        let square = |p: DVec3| p * p;
        let product = |p: DVec3| p.zxy() * p.yzx();
        for [a, b, c] in triangles {
            let v = a.cross(b).dot(c) / 6.0;
            let sum = a + b + c;
            volume += v;
            first += v / 4.0 * sum;
            let share = v / 20.0;
            squares += (square(a) + square(b) + square(c) + square(sum)) * share;
            products += (product(a) + product(b) + product(c) + product(sum)) * share;
        }
        let centre = first / volume;
        let squares = squares - square(centre) * volume;
        let products = products - product(centre) * volume;
        let second = DMat3::from_cols(
            DVec3::new(squares.x, products.z, products.y),
            DVec3::new(products.z, squares.y, products.x),
            DVec3::new(products.y, products.x, squares.z),
        );
        let trace = squares.x + squares.y + squares.z;
        Self {
            mass: density * volume,
            volume,
            centre,
            inertia: (DMat3::from_diagonal(DVec3::splat(trace)) - second) * density,
        }
    }

    /// Returns n_aᵀ K n_b, 1/kg: the change of velocity at one point along a unit direction due to a unit impulse at another, including
    /// rotation. Both (point, direction) pairs are in the frame of the piece.
    #[must_use]
    pub fn inverse_mass_between(&self, a: (DVec3, DVec3), b: (DVec3, DVec3)) -> f64 {
        let arm = |(point, n): (DVec3, DVec3)| (point - self.centre).cross(n);
        a.1.dot(b.1) / self.mass + arm(a).dot(self.inertia.inverse() * arm(b))
    }

    /// Returns nᵀ K n, 1/kg: the inverse effective mass for an impulse along the unit vector `n` at `point`, including rotation. Both
    /// are in the frame of the piece.
    #[must_use]
    pub fn inverse_effective_mass(&self, point: DVec3, n: DVec3) -> f64 {
        self.inverse_mass_between((point, n), (point, n))
    }
}
