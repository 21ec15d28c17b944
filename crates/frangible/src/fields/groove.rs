//! Grooves: a groove in the surface is a flaw of its depth (an extension of the paper).
//!
//! A groove of depth d in a wall of thickness H cracks where the bending stress of the plain wall reaches `K_Ic / (F √(π d))`. F is the shape
//! factor of an edge crack in bending (Tada, Paris, Irwin, *The Stress Analysis of Cracks Handbook*). A crack along the groove separates only
//! the remaining `H − d`, so the fracture energy of the wall is `(1 − d/H) G_c` there. Both replace the factors of strength and toughness of
//! the region. The strength of a groove has no scatter.
//!
//! In a tempered wall the residual stress presses a groove of depth r H together with `σ_s (1 − 12/π r + 3 r²)`, the mean of its parabola over an edge
//! crack, as long as the groove ends in the compressed layer. Beneath that nothing bears any more: such a wall goes at the first touch.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{Factors, Fields};
use crate::material::Material;

/// Largest depth of a groove as a share of the thickness, so that the remaining wall has an area.
const DEEPEST: f64 = 0.95;

/// Strength of a groove that ends in the tension of a tempered wall, Pa: next to none, but a number that quotients can be formed with.
pub(super) const OPEN: f64 = 1e3;

/// Shape factor F of an edge crack in bending, for a share of the thickness from 0 to 1. Up to 0.6 it is within 2.5 % of Brown
/// and Srawley's series (ASTM STP 410, 1966).
fn bending_shape(share: f64) -> f64 {
    let half = FRAC_PI_2 * share.max(1e-6);
    let (sin, cos) = (libm::sin(half), libm::cos(half));
    let rest = 0.923 + 0.199 * libm::pow(1.0 - sin, 4.0);
    libm::sqrt(libm::tan(half) / half) * rest / cos
}

impl Fields {
    /// Replaces strength and toughness in grooves by those of a flaw of the groove's depth, in walls of these thicknesses, m.
    pub(crate) fn with_grooves(mut self, material: &Material, thickness: &[f32]) -> Self {
        let walls = self.of_tet.iter_mut().zip(thickness);
        for (factors, &thickness) in walls.filter(|(f, _)| f.groove > 0.0) {
            *factors = Factors {
                weak_points: factors.weak_points,
                ..grooved(factors.groove, thickness, material)
            };
        }
        self
    }
}

/// Factors of a groove of this depth, m, in a wall of this thickness, m.
fn grooved(depth: f32, thickness: f32, material: &Material) -> Factors {
    let share = (f64::from(depth) / f64::from(thickness)).min(DEEPEST);
    let deep = share * f64::from(thickness);
    let toughness = libm::sqrt(material.fracture_energy * material.contact_modulus());
    let mut strength = toughness / (bending_shape(share) * libm::sqrt(PI * deep));
    if material.residual_stress > 0.0 {
        let pressed = 1.0 - 12.0 / PI * share + 3.0 * share * share;
        strength = match share < Material::COMPRESSED_LAYER {
            true => strength + pressed * material.residual_stress,
            false => OPEN,
        };
    }
    Factors {
        strength: ((strength / material.strength) as f32).clamp(f32::MIN_POSITIVE, f32::MAX),
        toughness: (1.0 - share) as f32,
        ..Factors::of_groove(depth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Preset;

    #[test]
    fn shape_factors_are_those_of_a_series() {
        // W. F. Brown, J. E. Srawley, ASTM STP 410 (1966): pure bending, within 0.2 % up to 0.6.
        for share in [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6] {
            let series = [14.0, -13.08, 7.33, -1.40, 1.122];
            let exact = series.iter().fold(0.0, |sum, c| sum * share + c);
            let found = bending_shape(share);
            assert!((found / exact - 1.0).abs() < 0.025, "{share}: {found}");
        }
    }

    #[test]
    fn a_groove_is_a_flaw_of_its_depth() {
        let material = Preset::named("glass").unwrap().material();
        let factors = grooved(1e-4, 0.1, &material);
        let strength = f64::from(factors.strength) * material.strength;
        let depth = material.flaw_depth(material.fracture_energy, strength);
        assert!((depth / 1e-4 - 1.0).abs() < 5e-3, "{depth}");
        assert!(f64::from(factors.toughness) > 0.998);
        // Half through, less force and half the energy part it.
        let deep = grooved(2e-3, 4e-3, &material);
        assert!(deep.strength < 0.5 * factors.strength && deep.toughness == 0.5);
        // A groove deeper than the wall leaves something.
        let through = grooved(1.0, 4e-3, &material);
        assert!(through.strength > 0.0 && through.toughness > 0.04);
    }
}
