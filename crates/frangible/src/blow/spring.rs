//! The spring between two bodies that touch at a point: Hertz's until the weaker body is crushed.
//!
//! Hertz's pressure is largest in the middle of the disc that touches. Once it reaches the pressure p that the weaker body can bear there, that body
//! is crushed, or flows, and no place is pressed harder: the force grows by `π p R` per dent, as the disc does (C. Thornton, J. Appl. Mech. 64 (1997)
//! 383). A crushed place does not come back. When the force falls, the bodies part along Hertz's spring of the dent that was made, which is flatter
//! than what made it and holds less energy. Crushing has taken the difference.

use std::f64::consts::PI;

use crate::asset::Asset;
use crate::contact::{Contact, contact_radius_of_curvature};

/// F = K δ^1.5 for a dent δ, K = 4/3 E* √R (Hertz 1882), up to the force at which one of the bodies is crushed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spring {
    /// K, N/m^1.5.
    pub(crate) stiffness: f64,
    /// Radius R of the two curvatures together, m.
    pub(crate) radius: f64,
    /// Largest pressure p that both bodies bear, Pa; infinite where none is ever crushed.
    pub(crate) crushing_pressure: f64,
    /// Force at which crushing begins, N.
    crushing_force: f64,
    /// Growth of the force with the dent from there on, π p R, N/m.
    crushing_stiffness: f64,
}

impl Spring {
    /// Spring between two bodies of joint modulus E*, Pa, and joint radius, m, one of which is crushed at this pressure, Pa; it may be infinite.
    #[must_use]
    pub(crate) fn crushed_at(pressure: f64, modulus: f64, radius: f64) -> Self {
        // The pressure in the middle is 2 E* √(δ/R) / π.
        let root = 0.5 * PI * pressure / modulus;
        Self {
            stiffness: 4.0 / 3.0 * modulus * radius.sqrt(),
            radius,
            crushing_pressure: pressure,
            crushing_force: 4.0 / 3.0 * modulus * radius * radius * root * root * root,
            crushing_stiffness: PI * pressure * radius,
        }
    }

    /// Spring at a contact of this asset, whose surface has this radius of curvature there, m.
    pub(crate) fn at(asset: &Asset, contact: &Contact, curvature_radius: f64) -> Self {
        let striker = f64::from(contact.striker.contact_modulus);
        let modulus = 1.0 / (1.0 / asset.material.contact_modulus() + 1.0 / striker);
        let radius = contact_radius_of_curvature(asset, contact, curvature_radius);
        let pressure = f64::from(contact.striker.crushing_pressure);
        Self::crushed_at(
            pressure.min(asset.material.crushing_pressure),
            modulus,
            radius,
        )
    }

    /// Dent δ of Hertz's spring, m, under a force, N.
    fn elastic_dent(&self, force: f64) -> f64 {
        libm::cbrt(force.max(0.0) / self.stiffness).powi(2)
    }

    /// Dent δ, m, when a force, N, is reached for the first time.
    #[must_use]
    pub(crate) fn dent(&self, force: f64) -> f64 {
        if force <= self.crushing_force {
            return self.elastic_dent(force);
        }
        self.elastic_dent(self.crushing_force)
            + (force - self.crushing_force) / self.crushing_stiffness
    }

    /// Force, N, that makes a dent δ, m, for the first time.
    fn force_of_dent(&self, dent: f64) -> f64 {
        let elastic = self.stiffness * dent.max(0.0) * dent.max(0.0).sqrt();
        if elastic <= self.crushing_force {
            return elastic;
        }
        let more = dent - self.elastic_dent(self.crushing_force);
        self.crushing_force + self.crushing_stiffness * more
    }

    /// Radius of the disc that touches, m, when a force, N, is reached for the first time: √(R δ).
    #[must_use]
    pub(crate) fn contact_radius(&self, force: f64) -> f64 {
        (self.radius * self.dent(force)).sqrt()
    }

    /// Energy, J, that pressing to a force, N, for the first time takes: ∫ F dδ.
    fn energy(&self, force: f64) -> f64 {
        if force <= self.crushing_force {
            return 0.4 * force * self.elastic_dent(force);
        }
        0.4 * self.crushing_force * self.elastic_dent(self.crushing_force)
            + 0.5 * (force.powi(2) - self.crushing_force.powi(2)) / self.crushing_stiffness
    }

    /// Force, N, up to which this energy, J, presses for the first time.
    #[must_use]
    pub(crate) fn force_of_energy(&self, energy: f64) -> f64 {
        let elastic = libm::pow(2.5 * energy * libm::cbrt(self.stiffness).powi(2), 0.6);
        if elastic <= self.crushing_force {
            return elastic;
        }
        let more = energy - self.energy(self.crushing_force);
        (self.crushing_force.powi(2) + 2.0 * self.crushing_stiffness * more.max(0.0)).sqrt()
    }

    /// Energy lost to crushing, J, once the largest force, N, is over.
    #[must_use]
    pub(crate) fn crushing_energy(&self, largest: f64) -> f64 {
        if largest <= self.crushing_force {
            return 0.0;
        }
        let (left, _) = self.of_dented(largest);
        (self.energy(largest) - 0.4 * largest * (self.dent(largest) - left)).max(0.0)
    }

    /// Dent that is left, m, and K of Hertz's spring in it, N/m^1.5, after the largest force, N, has crushed a body. This spring bears the largest
    /// force on the same disc.
    fn of_dented(&self, largest: f64) -> (f64, f64) {
        let dent = self.dent(largest);
        let disc = self.radius * dent;
        let modulus = 0.75 * self.stiffness / self.radius.sqrt();
        let radius = 4.0 / 3.0 * modulus * disc * disc.sqrt() / largest;
        (dent - disc / radius, 4.0 / 3.0 * modulus * radius.sqrt())
    }

    /// Force F ≥ 0, N, at which the dent and `compliance F` fill the gap; zero if the gap is open. `gap`: m; `compliance`: m/N; `largest`: the
    /// largest force so far, N; `root`: the square root of the dent, m^½, from which the search begins, zero if unknown; then the one found.
    #[must_use]
    pub(crate) fn force(&self, gap: f64, compliance: f64, largest: f64, root: &mut f64) -> f64 {
        let was_crushed = largest > self.crushing_force;
        let (left, stiffness, most) = if was_crushed {
            let (left, stiffness) = self.of_dented(largest);
            (left, stiffness, largest)
        } else {
            (0.0, self.stiffness, self.crushing_force)
        };
        let force = hertz_force(stiffness, gap - left, compliance, root);
        if force <= most {
            return force;
        }
        let more = gap - self.elastic_dent(self.crushing_force);
        let along = more + self.crushing_force / self.crushing_stiffness;
        along / (1.0 / self.crushing_stiffness + compliance)
    }

    /// Factor by which crushing lengthens the blow of a mass, kg, at a speed, m/s, on a rigid wall: ratio of the times to the deepest dent with
    /// crushing and with Hertz's spring alone. Crushed bodies part faster than they met, so it is an upper bound; 1 if nothing is crushed.
    #[must_use]
    pub(crate) fn stretch(&self, mass: f64, speed: f64) -> f64 {
        let energy = 0.5 * mass * speed * speed;
        if self.force_of_energy(energy) <= self.crushing_force {
            return 1.0;
        }
        let elastic = Self {
            crushing_force: f64::INFINITY,
            ..*self
        };
        let time = |spring: &Self| spring.loading(mass, speed, f64::INFINITY).time;
        time(self) / time(&elastic)
    }

    /// Peak force, N, of the blow of a mass, kg, at a speed, m/s, on this spring behind a dashpot, N·s/m (Zener 1941). An infinite dashpot is a rigid
    /// wall.
    #[must_use]
    pub(crate) fn peak_force(&self, mass: f64, speed: f64, dashpot: f64) -> f64 {
        if !dashpot.is_finite() {
            return self.force_of_energy(0.5 * mass * speed * speed);
        }
        self.loading(mass, speed, dashpot).peak
    }

    /// Integrates the first half of such a blow, until its force is largest.
    fn loading(&self, mass: f64, speed: f64, dashpot: f64) -> Loading {
        let rigid = self.force_of_energy(0.5 * mass * speed * speed);
        // A two-hundredth of the time to the deepest dent on a rigid wall is fine for a per cent.
        let step = self.dent(rigid) / speed / 200.0;
        let (mut dent, mut moving) = (0.0_f64, speed);
        let mut loading = Loading {
            peak: 0.0,
            time: 0.0,
        };
        for _ in 0..4000 {
            let force = self.force_of_dent(dent);
            if force < loading.peak {
                break;
            }
            loading.peak = force;
            loading.time += step;
            dent += (moving - force / dashpot) * step;
            moving -= force / mass * step;
        }
        loading
    }
}

/// First half of a blow, until its force is largest.
#[derive(Clone, Copy, Debug)]
struct Loading {
    /// Largest force, N.
    peak: f64,
    /// Time until then, s.
    time: f64,
}

/// The force F ≥ 0 of Hertz's spring at which `(F/K)^(2/3) + compliance F = gap`, N; see [`Spring::force`].
fn hertz_force(stiffness: f64, gap: f64, compliance: f64, root: &mut f64) -> f64 {
    if gap <= 0.0 {
        return 0.0;
    }
    // With z = δ^½: compliance K z³ + z² = gap, convex and rising for z ≥ 0: Newton's second step and all after it fall onto the root.
    let cubic = compliance * stiffness;
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
    stiffness * z * z * z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_closes_the_gap() {
        let spring = Spring::crushed_at(f64::INFINITY, 7e10, 0.01);
        for gap in [1e-12, 1e-7, 1e-5, 3e-4] {
            for compliance in [0.0, 1e-12, 1e-8, 1e-3] {
                for mut root in [0.0, 1e-9, 1e-4, 0.3] {
                    let force = spring.force(gap, compliance, 0.0, &mut root);
                    let closed = spring.dent(force) + compliance * force;
                    assert!((closed / gap - 1.0).abs() < 1e-12, "{gap} {compliance}");
                    assert!((root * root / spring.dent(force) - 1.0).abs() < 1e-12);
                }
            }
        }
        assert_eq!(spring.force(0.0, 1.0, 0.0, &mut 0.1), 0.0);
        assert_eq!(spring.force(-1.0, 0.0, 0.0, &mut 0.1), 0.0);
    }

    #[test]
    fn a_rigid_wall_stops_the_mass_where_the_spring_holds_its_energy() {
        let spring = Spring::crushed_at(f64::INFINITY, 3e9, 2e-3);
        let (mass, speed) = (2.6e-4, 20.0);
        let stiff = spring.peak_force(mass, speed, 1e9);
        let rigid = spring.peak_force(mass, speed, f64::INFINITY);
        assert!((stiff / rigid - 1.0).abs() < 0.01);
        assert!(
            (0.4 * rigid * spring.dent(rigid) / (0.5 * mass * speed * speed) - 1.0).abs() < 1e-12
        );
    }

    #[test]
    fn a_spring_that_is_crushed_closes_the_gap_pressing_and_parting() {
        let spring = Spring::crushed_at(3e8, 1e10, 0.01);
        let crushed = spring.crushing_force;
        assert!(crushed > 1.0 && crushed.is_finite());
        for compliance in [0.0, 1e-12, 1e-8] {
            let mut root = 0.0;
            for share in [0.2, 0.9, 1.1, 3.0, 40.0] {
                let largest = share * crushed;
                let gap = spring.dent(largest) + compliance * largest;
                // For the first time, or after anything less.
                for before in [0.0, 0.5 * largest, 0.999 * largest] {
                    let force = spring.force(gap, compliance, before, &mut root);
                    assert!((force / largest - 1.0).abs() < 1e-9, "{share} {before}");
                }
                let again = spring.force(gap, compliance, largest, &mut root);
                assert!((again / largest - 1.0).abs() < 1e-9, "{share}");
                // Afterwards it lets go sooner than it was pressed, where it was crushed.
                let half = spring.force(0.5 * gap, compliance, largest, &mut root);
                let first = spring.force(0.5 * gap, compliance, 0.0, &mut root);
                assert_eq!(half < first * (1.0 - 1e-9), share > 1.0, "{share}");
            }
        }
    }

    #[test]
    fn crushing_makes_a_blow_longer() {
        let (mass, speed, pressure, radius) = (0.2, 8.0, 3.3e6, 0.0183);
        let spring = |pressure| Spring::crushed_at(pressure, 9e9, radius);
        assert_eq!(spring(f64::INFINITY).stretch(mass, speed), 1.0);
        assert_eq!(spring(1e12).stretch(mass, speed), 1.0);
        // Where nearly all is crushed the spring is linear, and Hertz's takes 1.47 δ / v to its deepest dent.
        let linear = 0.5 * PI * (mass / (PI * pressure * radius)).sqrt();
        let hertz = spring(f64::INFINITY);
        let deepest = hertz.dent(hertz.force_of_energy(0.5 * mass * speed * speed));
        let stretch = spring(pressure).stretch(mass, speed);
        let closed = linear / (1.472 * deepest / speed);
        assert!(
            stretch > 3.0 && (stretch / closed - 1.0).abs() < 0.03,
            "{stretch} {closed}"
        );
    }

    #[test]
    fn crushing_takes_what_parting_does_not_give_back() {
        let spring = Spring::crushed_at(3e8, 1e10, 0.01);
        assert_eq!(spring.crushing_energy(0.99 * spring.crushing_force), 0.0);
        let largest = 30.0 * spring.crushing_force;
        // ∫ F dδ there and back.
        let (steps, mut taken, mut root) = (100_000, 0.0, 0.0);
        let dent = spring.dent(largest);
        for k in 0..steps {
            let middle = (f64::from(k) + 0.5) / f64::from(steps) * dent;
            let there = spring.force_of_dent(middle);
            let back = spring.force(middle, 0.0, largest, &mut root);
            taken += (there - back) * dent / f64::from(steps);
        }
        let expected = spring.crushing_energy(largest);
        assert!((taken / expected - 1.0).abs() < 1e-4, "{taken} {expected}");
        let brought = spring.energy(largest);
        assert!(expected > 0.5 * brought && expected < brought);
        let force = spring.force_of_energy(brought);
        assert!((force / largest - 1.0).abs() < 1e-12);
    }

    #[test]
    fn far_beyond_the_limit_the_mean_pressure_is_the_limit() {
        let spring = Spring::crushed_at(3e8, 1e10, 0.01);
        let force = 1e4 * spring.crushing_force;
        let disc = PI * spring.contact_radius(force).powi(2);
        assert!((force / disc / 3e8 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn a_mass_comes_back_as_slowly_as_thornton_says() {
        let spring = Spring::crushed_at(3e8, 1e10, 0.01);
        let first = spring.energy(spring.crushing_force);
        for faster in [1.0, 1.5, 4.0, 30.0_f64] {
            let energy = first * faster.powi(2);
            let largest = spring.force_of_energy(energy);
            let restitution = (1.0 - spring.crushing_energy(largest) / energy).sqrt();
            // Thornton (1997), of the ratio y of the speed that just crushes to the speed.
            let y = 1.0 / faster;
            let root = (y / (y + 2.0 * (1.2 - 0.2 * y * y).sqrt())).powf(0.25);
            let expected = (1.2 * 3.0_f64.sqrt()).sqrt() * (1.0 - y * y / 6.0).sqrt() * root;
            assert!((restitution / expected - 1.0).abs() < 1e-9, "{faster}");
        }
    }
}
