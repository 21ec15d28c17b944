//! Hertz' spring between two bodies that touch at a point.

use crate::asset::Asset;
use crate::contact::{Contact, contact_radius_of_curvature};

/// F = K δ^1.5 for a dent δ, K = 4/3 E* √R (Hertz 1882).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spring {
    /// K, N/m^1.5.
    pub(crate) stiffness: f64,
    /// Radius R of the two curvatures together, m.
    pub(crate) radius: f64,
}

impl Spring {
    /// Between two bodies with together this modulus E*, Pa, and radius, m.
    #[must_use]
    pub(crate) fn new(modulus: f64, radius: f64) -> Self {
        Self {
            stiffness: 4.0 / 3.0 * modulus * radius.sqrt(),
            radius,
        }
    }

    /// At a contact of this asset, whose surface has this radius of curvature there, m.
    pub(crate) fn at(asset: &Asset, contact: &Contact, curvature_radius: f64) -> Self {
        let striker = f64::from(contact.striker.contact_modulus);
        let modulus = 1.0 / (1.0 / asset.material.contact_modulus() + 1.0 / striker);
        let radius = contact_radius_of_curvature(asset, contact, curvature_radius);
        Self::new(modulus, radius)
    }

    /// Dent δ under a force, N, m.
    #[must_use]
    pub(crate) fn dent(&self, force: f64) -> f64 {
        (force.max(0.0) / self.stiffness).cbrt().powi(2)
    }

    /// Radius of the disc that touches under a force, N, m: √(R δ).
    #[must_use]
    pub(crate) fn contact_radius(&self, force: f64) -> f64 {
        (self.radius * self.dent(force)).sqrt()
    }

    /// Force at which the spring holds this much energy, J, N: 2/5 F δ = energy.
    #[must_use]
    pub(crate) fn force_of_energy(&self, energy: f64) -> f64 {
        (2.5 * energy * self.stiffness.powf(2.0 / 3.0)).powf(0.6)
    }

    /// The force F ≥ 0 at which `dent(F) + compliance F = gap`, N: gap, m; compliance, m/N. Zero where the gap is open. `root`: the square
    /// root of the dent, m^½, where the search begins, and then what was found; zero where nothing is known.
    #[must_use]
    pub(crate) fn force(&self, gap: f64, compliance: f64, root: &mut f64) -> f64 {
        if gap <= 0.0 {
            return 0.0;
        }
        // With z = δ^½: compliance K z³ + z² = gap, convex and rising for z ≥ 0: Newton's second step and all after it fall onto the root.
        let cubic = compliance * self.stiffness;
        let most = gap.sqrt();
        let mut z = if *root > 0.0 { *root } else { most };
        for _ in 0..60 {
            let excess = (cubic * z + 1.0) * z * z - gap;
            let step = excess / ((3.0 * cubic * z + 2.0) * z);
            z = (z - step).min(most);
            // The next step would be about the square of this one.
            if step.abs() <= 1e-9 * z {
                break;
            }
        }
        *root = z;
        self.stiffness * z * z * z
    }

    /// The blow of a mass on this spring behind a dashpot (Zener 1941), kg, m/s, N·s/m: its peak force, N. An infinite
    /// dashpot is a rigid wall.
    #[must_use]
    pub(crate) fn peak_force(&self, mass: f64, speed: f64, dashpot: f64) -> f64 {
        let rigid = self.force_of_energy(0.5 * mass * speed * speed);
        if !dashpot.is_finite() {
            return rigid;
        }
        // A two-hundredth of the time to the deepest dent on a rigid wall is fine for a per cent.
        let step = self.dent(rigid) / speed / 200.0;
        let (mut dent, mut moving, mut peak) = (0.0_f64, speed, 0.0_f64);
        for _ in 0..4000 {
            let force = self.stiffness * dent.max(0.0).powf(1.5);
            if force < peak {
                break;
            }
            peak = force;
            dent += (moving - force / dashpot) * step;
            moving -= force / mass * step;
        }
        peak
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_closes_the_gap() {
        let spring = Spring::new(7e10, 0.01);
        for gap in [1e-12, 1e-7, 1e-5, 3e-4] {
            for compliance in [0.0, 1e-12, 1e-8, 1e-3] {
                for mut root in [0.0, 1e-9, 1e-4, 0.3] {
                    let force = spring.force(gap, compliance, &mut root);
                    let closed = spring.dent(force) + compliance * force;
                    assert!((closed / gap - 1.0).abs() < 1e-12, "{gap} {compliance}");
                    assert!((root * root / spring.dent(force) - 1.0).abs() < 1e-12);
                }
            }
        }
        assert_eq!(spring.force(0.0, 1.0, &mut 0.1), 0.0);
        assert_eq!(spring.force(-1.0, 0.0, &mut 0.1), 0.0);
    }

    #[test]
    fn a_rigid_wall_stops_the_mass_where_the_spring_holds_its_energy() {
        let spring = Spring::new(3e9, 2e-3);
        let (mass, speed) = (2.6e-4, 20.0);
        let stiff = spring.peak_force(mass, speed, 1e9);
        let rigid = spring.peak_force(mass, speed, f64::INFINITY);
        assert!((stiff / rigid - 1.0).abs() < 0.01);
        assert!(
            (0.4 * rigid * spring.dent(rigid) / (0.5 * mass * speed * speed) - 1.0).abs() < 1e-12
        );
    }
}
