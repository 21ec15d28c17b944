//! An infinite wall: the speed of its bending waves, and its bending under a force.

use crate::asset::SurfaceWall;
use crate::config::PlateTheory;
use crate::material::Material;

/// Mindlin's shear coefficient, π²/12: with it short waves run at the Rayleigh speed, nearly.
const SHEAR: f64 = std::f64::consts::PI * std::f64::consts::PI / 12.0;

/// An infinite wall of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WallMaterial {
    /// Thickness h, m.
    pub(crate) thickness: f64,
    /// Bending stiffness D = E h³ / 12(1−ν²), N·m.
    pub(crate) bending_stiffness: f64,
    /// Mass per area μ = ρ h, kg/m².
    pub(crate) mass_per_area: f64,
    /// Stiffness E h s by which curvature holds the wall where it is, Pa/m.
    pub(crate) curvature_stiffness: f64,
    /// Shear stiffness κ G h, N/m.
    shear_stiffness: f64,
    /// Rotary inertia ρ h³ / 12, kg.
    rotary_inertia: f64,
    /// E, Pa.
    youngs_modulus: f64,
    /// ν.
    poisson_ratio: f64,
    theory: PlateTheory,
}

impl WallMaterial {
    /// A wall of this thickness (m) and stiffening by curvature (1/m²).
    #[must_use]
    pub(crate) fn new(material: &Material, wall: &SurfaceWall, theory: PlateTheory) -> Self {
        let (e, nu, h) = (
            material.youngs_modulus,
            material.poisson_ratio,
            wall.thickness,
        );
        Self {
            thickness: h,
            bending_stiffness: e * h.powi(3) / (12.0 * (1.0 - nu * nu)),
            mass_per_area: material.density * h,
            curvature_stiffness: e * h * wall.stiffening,
            shear_stiffness: SHEAR * material.shear_modulus() * h,
            rotary_inertia: material.density * h.powi(3) / 12.0,
            youngs_modulus: e,
            poisson_ratio: nu,
            theory,
        }
    }

    /// All numbers, and the theory, as a contact's bytes keep them of a wall.
    pub(crate) fn numbers(&self) -> ([f64; 8], PlateTheory) {
        let numbers = [
            self.thickness,
            self.bending_stiffness,
            self.mass_per_area,
            self.curvature_stiffness,
            self.shear_stiffness,
            self.rotary_inertia,
            self.youngs_modulus,
            self.poisson_ratio,
        ];
        (numbers, self.theory)
    }

    /// The wall that [`Self::numbers`] describes.
    pub(crate) fn of_numbers(numbers: [f64; 8], theory: PlateTheory) -> Self {
        let [
            thickness,
            bending_stiffness,
            mass_per_area,
            curvature_stiffness,
            ..,
        ] = numbers;
        let [
            ..,
            shear_stiffness,
            rotary_inertia,
            youngs_modulus,
            poisson_ratio,
        ] = numbers;
        Self {
            thickness,
            bending_stiffness,
            mass_per_area,
            curvature_stiffness,
            shear_stiffness,
            rotary_inertia,
            youngs_modulus,
            poisson_ratio,
            theory,
        }
    }

    /// Returns true if every number can be one of a wall's.
    pub(crate) fn is_sound(&self) -> bool {
        let [
            thickness,
            bending,
            mass,
            held,
            shear,
            inertia,
            youngs_modulus,
            poisson_ratio,
        ] = self.numbers().0;
        let positive = [thickness, bending, mass, shear, inertia, youngs_modulus];
        positive.iter().all(|x| x.is_finite() && *x > 0.0)
            && held.is_finite()
            && held >= 0.0
            && (-1.0..0.5).contains(&poisson_ratio)
    }

    /// Zener's dashpot of the infinite plate, 8 √(D μ), N·s/m.
    #[must_use]
    pub(crate) fn dashpot(&self) -> f64 {
        8.0 * (self.bending_stiffness * self.mass_per_area).sqrt()
    }

    /// D k⁴ + E h s, Pa/m: stiffness of a thin wall against a wave of wave number k, 1/m.
    fn stiffness(&self, k: f64) -> f64 {
        self.bending_stiffness * k.powi(4) + self.curvature_stiffness
    }

    /// ω² of the wave number k, 1/s².
    #[must_use]
    pub(crate) fn eigenvalue(&self, k: f64) -> f64 {
        if self.theory == PlateTheory::Kirchhoff {
            return self.stiffness(k) / self.mass_per_area;
        }
        // (S k² + E h s − μ ω²)(D k² + S − I ω²) = S² k², Mindlin's plate on an elastic foundation: the smaller root.
        let (s, i, mu) = (
            self.shear_stiffness,
            self.rotary_inertia,
            self.mass_per_area,
        );
        let held = self.curvature_stiffness;
        let bending = self.bending_stiffness * k * k + s;
        let a = mu * i;
        let b = mu * bending + i * (s * k * k + held);
        let c = s * self.bending_stiffness * k.powi(4) + held * bending;
        2.0 * c / (b + (b * b - 4.0 * a * c).max(0.0).sqrt())
    }

    /// The wave number of an angular frequency, rad/s, 1/m; 0 below the frequency where waves begin.
    #[must_use]
    pub(crate) fn wave_number(&self, frequency: f64) -> f64 {
        let squared = frequency * frequency;
        let (d, s) = (self.bending_stiffness, self.shear_stiffness);
        let free = self.mass_per_area * squared - self.curvature_stiffness;
        if free <= 0.0 {
            return 0.0;
        }
        if self.theory == PlateTheory::Kirchhoff {
            return (free / d).sqrt().sqrt();
        }
        // The equation of `eigenvalue`, in k²: S D k⁴ − (S I ω² + D free) k² − free (S − I ω²) = 0, the larger root. The terms under the
        // root that are added below are its (S I ω² + D free)² + 4 S D free (S − I ω²).
        let turned = s * self.rotary_inertia * squared;
        let bent = d * free;
        let root = ((turned - bent).powi(2) + 4.0 * s * s * bent).sqrt();
        ((turned + bent + root) / (2.0 * s * d)).sqrt()
    }

    /// The wave number from which on bending rules, D k⁴ ≥ 3 E h s, 1/m: longer waves are held by the wall's curvature.
    #[must_use]
    pub(crate) fn bending_rules_from(&self) -> f64 {
        (3.0 * self.curvature_stiffness / self.bending_stiffness)
            .sqrt()
            .sqrt()
    }

    /// Compliance of the contact in waves of wave number k, m per Pa at the crest, beyond that of Hertz's half-space.
    pub(super) fn compliance(&self, k: f64) -> f64 {
        let factor = match self.theory {
            PlateTheory::Kirchhoff => 1.0,
            PlateTheory::Layer => layer_compliance(k * self.thickness),
        };
        factor / self.stiffness(k)
    }

    /// Largest wave number that matters, 1/m: beyond it neither a contact of radius a, m, nor the far face shows anything.
    pub(super) fn last_wave_number(&self, contact_radius: f64) -> f64 {
        match self.theory {
            PlateTheory::Kirchhoff => 8.0 / contact_radius,
            PlateTheory::Layer => (8.0 / contact_radius).min(12.0 / self.thickness),
        }
    }

    /// Curvature κ_r + κ_θ of the wall per steady pressure of wave number k that is 1 Pa at its crest, 1/(Pa·m): k² C/(D k⁴ + E h s).
    pub(super) fn curvature(&self, k: f64) -> f64 {
        let factor = match self.theory {
            PlateTheory::Kirchhoff => 1.0,
            PlateTheory::Layer => layer_factor(k * self.thickness),
        };
        k * k * factor / self.stiffness(k)
    }

    /// Upper bound of the principal stress per newton of a steady near field of waves from wave number `first`, 1/m, on, Pa/N.
    pub(crate) fn most_stress(&self, first: f64) -> f64 {
        // ½ (|σ_r + σ_θ| + |σ_θ − σ_r|) with |J₀| ≤ 1, |J₂| ≤ 0.49, p̂ ≤ 1, C ≤ 1.07.
        let waves = libm::log(12.0 / (self.thickness * first)).max(0.0);
        let sum = 1.07 * self.stress_of_sum() * waves / (2.0 * std::f64::consts::PI);
        let difference = 0.49 * sum * self.stress_of_difference() / self.stress_of_sum();
        0.5 * (sum + difference) / self.bending_stiffness
    }

    /// σ_r + σ_θ at the far face per κ_r + κ_θ, Pa·m.
    pub(super) fn stress_of_sum(&self) -> f64 {
        0.5 * self.thickness * self.youngs_modulus / (1.0 - self.poisson_ratio)
    }

    /// σ_θ − σ_r at the far face per κ_θ − κ_r, Pa·m.
    pub(super) fn stress_of_difference(&self) -> f64 {
        0.5 * self.thickness * self.youngs_modulus / (1.0 + self.poisson_ratio)
    }
}

/// Tension of the far face of an elastic layer under a pressure of wave number k, over that of Kirchhoff's plate; `x` = kh.
fn layer_factor(x: f64) -> f64 {
    if x < 0.1 {
        // x³ sinh x / 3(sinh²x − x²) = 1 + x²/30 + …: the quotient loses digits.
        return 1.0 + x * x / 30.0;
    }
    let x = x.min(60.0);
    let sinh = libm::sinh(x);
    x.powi(3) * sinh / (3.0 * (sinh * sinh - x * x))
}

/// Compliance of an elastic layer under a pressure of wave number k, beyond that of a half-space, over that of Kirchhoff's plate;
/// `x` = kh. The layer bends and is squeezed: (f_a + f_s) against 2, with f_a = (cosh x + 1)/(sinh x − x),
/// f_s = (cosh x − 1)/(sinh x + x). The difference falls to nothing where kh > 4: Hertz's spring has the rest.
fn layer_compliance(x: f64) -> f64 {
    if x < 0.1 {
        // 1 + x²/5 + …, less x³/6 of the half-space: the differences lose digits.
        return 1.0 + 0.2 * x * x - x.powi(3) / 6.0;
    }
    let x = x.min(40.0);
    let (sinh, cosh) = (libm::sinh(x), libm::cosh(x));
    let bends = (cosh + 1.0) / (sinh - x);
    let squeezed = (cosh - 1.0) / (sinh + x);
    x.powi(3) / 12.0 * (bends + squeezed - 2.0)
}

/// Transform of Hertz's pressure on a disc, of unit force; `x` = ka.
pub(super) fn hertz_disc(x: f64) -> f64 {
    if x < 1e-2 {
        1.0 - x * x / 10.0
    } else {
        3.0 * (libm::sin(x) - x * libm::cos(x)) / x.powi(3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pmma(theory: PlateTheory) -> WallMaterial {
        let mut material = Material::preset("glass").unwrap();
        (material.youngs_modulus, material.poisson_ratio) = (3.3e9, 0.37);
        material.density = 1180.0;
        let wall = SurfaceWall {
            thickness: 1e-3,
            stiffening: 0.0,
            margin: f64::INFINITY,
        };
        WallMaterial::new(&material, &wall, theory)
    }

    #[test]
    fn the_layers_factor_has_the_values_of_the_closed_form() {
        // Published with the derivation: 1.03 at 1, 1.06 at 2, 0.80 at 4, 0.11 at 8.
        for (x, expected) in [(1.0, 1.03), (2.0, 1.06), (4.0, 0.80), (8.0, 0.11)] {
            assert!((layer_factor(x) - expected).abs() < 0.01, "{x}");
        }
        assert!((layer_factor(0.1) - layer_factor(0.0999)).abs() < 1e-5);
        assert!((layer_compliance(0.1) - layer_compliance(0.0999)).abs() < 1e-5);
        assert!((0.0..1e-6).contains(&layer_compliance(30.0)));
    }

    #[test]
    fn mindlins_frequency_lies_below_kirchhoffs_by_a_seventh_at_kh_of_one() {
        let (thin, thick) = (pmma(PlateTheory::Kirchhoff), pmma(PlateTheory::Layer));
        let ratio = (thin.eigenvalue(1e3) / thick.eigenvalue(1e3)).sqrt();
        assert!((1.12..1.20).contains(&ratio), "{ratio}");
        let long = (thin.eigenvalue(10.0) / thick.eigenvalue(10.0)).sqrt();
        assert!((long - 1.0).abs() < 1e-4);
    }

    #[test]
    fn a_wave_number_is_that_of_its_frequency() {
        for theory in [PlateTheory::Kirchhoff, PlateTheory::Layer] {
            let mut wall = pmma(theory);
            wall.curvature_stiffness = 2e9;
            for k in [150.0, 1e3, 9e3] {
                let back = wall.wave_number(wall.eigenvalue(k).sqrt());
                assert!((back / k - 1.0).abs() < 1e-9, "{k} {back}");
            }
            assert_eq!(wall.wave_number(1.0), 0.0);
        }
    }
}
