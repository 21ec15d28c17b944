//! Laminated walls: plies of one brittle material on films of plastic between them.
//!
//! **Bending.** Plies have one deflection, `w = sin kx`, and each may shift along itself: `u_i cos kx`. A film of thickness t and shear modulus G between
//! two plies whose middles are s apart is sheared by `(u_{i+1} − u_i + s k w)/t`. Least energy gives the shifts, and with them the bending stiffness
//! of the whole at this wave number. It lies between that of plies that slide freely and that of one plate. For two plies it is Wölfel and
//! Bennison's formula, `η = 1/(1 + k² E I_s t / (G s²))`: for the deflection of a beam of span a under a uniform load that has k² = 9.6/a² (E. Wölfel 1987; ASTM
//! E1300, appendix on laminated glass), and for a wave it is exact with k = π over half the wave's length (Newmark's beam; N. Newmark, C. Siess, I. Viest 1951).
//!
//! **Stress.** A ply is stretched in its middle by its shift and bent by the common curvature.
//!
//! **The film** holds what the plies lose when they crack: it carries `strength` times its section while it is drawn out, and tears when the two sides of
//! a crack have moved apart by `stretch`.

use crate::error::{OutOfRange, not_negative, positive};
use crate::material::Material;

/// Plies and films of a laminated wall. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laminate {
    /// Number of plies, 2 or more, all of one thickness.
    pub plies: u32,
    /// Thickness of each ply, m; 0: what the films leave of the wall.
    pub ply: f64,
    /// Thickness of each film between two plies, m.
    pub interlayer: f64,
    /// Shear modulus of the film under a blow, Pa.
    pub shear_modulus: f64,
    /// Tension that the film carries while it is drawn out across a crack, Pa.
    pub strength: f64,
    /// Opening of a crack at which the film across it tears, m.
    pub stretch: f64,
}

/// A laminated wall of this thickness as one plate, at one wave number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bending {
    /// Effective thickness for the deflection, m: that of a plate of the plies' material which bends as little.
    pub deflection: f64,
    /// Effective thickness for the stress of the outer faces, m: that of a plate with their stress under the same moment.
    pub stress: f64,
    /// Tension of the outer faces over that of a plate as thick as the wall which has the same curvature.
    pub face: f64,
}

/// Difference of the plies' and films' thickness from the wall's, as a share of it, at most.
const GAP: f64 = 0.05;
/// Most plies.
const MOST: u32 = 12;

impl Laminate {
    /// Names of the numbers, in the order of [`Laminate::numbers`].
    pub const KEYS: [&'static str; 6] = [
        "plies",
        "ply",
        "interlayer",
        "shear_modulus",
        "strength",
        "stretch",
    ];

    /// Two plies on one film of PVB, 0.76 mm thick.
    pub const PVB: Self = Self {
        plies: 2,
        ply: 0.0,
        interlayer: 0.76e-3,
        shear_modulus: 150e6,
        strength: 20e6,
        stretch: 0.01,
    };

    /// Its numbers.
    #[must_use]
    pub fn numbers(&self) -> [f64; 6] {
        [
            f64::from(self.plies),
            self.ply,
            self.interlayer,
            self.shear_modulus,
            self.strength,
            self.stretch,
        ]
    }

    /// The laminate of these numbers.
    #[must_use]
    pub fn of_numbers(
        [plies, ply, interlayer, shear_modulus, strength, stretch]: [f64; 6],
    ) -> Self {
        Self {
            // What is no number of plies is refused as too few of them.
            plies: if plies.fract() == 0.0 {
                plies as u32
            } else {
                0
            },
            ply,
            interlayer,
            shear_modulus,
            strength,
            stretch,
        }
    }

    /// Checks every number.
    pub(crate) fn validate(&self) -> Result<(), OutOfRange> {
        let (must, plies) = ("a whole number from 2 to 12", f64::from(self.plies));
        OutOfRange::unless(
            (2..=MOST).contains(&self.plies),
            "number of plies of the laminate",
            plies,
            must,
        )?;
        not_negative("thickness of a ply of the laminate", self.ply)?;
        positive(
            "thickness of the laminate's interlayer",
            self.interlayer,
            "m",
        )?;
        positive(
            "shear modulus of the laminate's interlayer",
            self.shear_modulus,
            "Pa",
        )?;
        positive("strength of the laminate's interlayer", self.strength, "Pa")?;
        positive("stretch of the laminate's interlayer", self.stretch, "m")
    }

    /// Distance from a crack within which the film loads a ply of this plane-strain modulus, Pa, and thickness, m, again: `√(E' h t / 2G)`, m.
    #[must_use]
    pub fn shear_lag(&self, modulus: f64, ply: f64) -> f64 {
        (modulus * ply * self.interlayer / (2.0 * self.shear_modulus)).sqrt()
    }

    /// Thickness of each ply of a wall of this thickness, m.
    ///
    /// # Errors
    /// A clause that says why they do not fit in the wall, and what to do.
    pub fn ply_in(&self, wall: f64) -> Result<f64, String> {
        let films = f64::from(self.plies - 1) * self.interlayer;
        let mm = |x: f64| format!("{:.3} mm", 1e3 * x);
        if films >= wall {
            return Err(format!(
                "its {} of {} {} thicker than its wall of {}; give a thinner `interlayer`, or a thicker wall",
                if self.plies == 2 {
                    "interlayer".into()
                } else {
                    format!("{} interlayers", self.plies - 1)
                },
                mm(self.interlayer),
                if self.plies == 2 { "is" } else { "are" },
                mm(wall)
            ));
        }
        let left = (wall - films) / f64::from(self.plies);
        if self.ply > 0.0 && (self.ply - left).abs() * f64::from(self.plies) > GAP * wall {
            let relation = if self.ply < left {
                "do not touch"
            } else {
                "overlap"
            };
            return Err(format!(
                "its {} plies of {} {relation}: with interlayers of {} a wall of {} needs plies of {}; set `ply` to that, or leave it out",
                self.plies,
                mm(self.ply),
                mm(self.interlayer),
                mm(wall),
                mm(left)
            ));
        }
        Ok(left)
    }
}

impl Material {
    /// Bending of its laminate with plies of this thickness, m, at wave number k, 1/m. `is_plate`: plies cannot shrink across the bend, as in a plate;
    /// else they are those of a narrow beam. A single plate of this thickness where the material has no laminate.
    #[doc(hidden)]
    #[must_use]
    pub fn laminate_bending(&self, ply: f64, k: f64, is_plate: bool) -> Bending {
        let Some(laminate) = &self.laminate else {
            return Bending {
                deflection: ply,
                stress: ply,
                face: 1.0,
            };
        };
        let count = laminate.plies as usize;
        let modulus = match is_plate {
            true => self.contact_modulus(),
            false => self.youngs_modulus,
        };
        let spacing = ply + laminate.interlayer;
        // Stretching and shearing per area for unit shifts.
        let stretch = modulus * ply * k * k;
        let shear = laminate.shear_modulus / laminate.interlayer;
        let shifts = shifts(count, stretch, shear, spacing * k);
        // Each part of the energy per area, twice: of k² w = 1/k² its stiffness.
        let stretched: f64 = shifts.iter().map(|u| stretch * u * u).sum();
        let sheared: f64 = shifts
            .windows(2)
            .map(|u| shear * (u[1] - u[0] + spacing * k).powi(2))
            .sum();
        let bent = count as f64 * modulus * ply.powi(3) / 12.0;
        let stiffness = bent + (stretched + sheared) / k.powi(4);
        let deflection = (12.0 * stiffness / modulus).cbrt();
        // Strain of an outer face per curvature, m: the shift of its ply, and half of its thickness.
        let outer = 0.5 * ply + shifts.last().map_or(0.0, |u| u.abs() / k);
        let wall =
            f64::from(laminate.plies) * ply + f64::from(laminate.plies - 1) * laminate.interlayer;
        Bending {
            deflection,
            stress: (stiffness * 6.0 / (modulus * outer)).sqrt(),
            face: outer / (0.5 * wall),
        }
    }
}

/// Shifts of so many plies along themselves, m, at which the energy is least. `slip`: by how much each film would be sheared without them.
///
/// Each ply's balance: `a u_i + b (2 u_i − u_{i−1} − u_{i+1}) = b (slip to its next − slip to the one before)`, which is zero but for the outer plies.
fn shifts(count: usize, stretch: f64, shear: f64, slip: f64) -> Vec<f64> {
    let last = count - 1;
    let (mut diagonal, mut right) = (vec![0.0; count], vec![0.0; count]);
    for i in 0..count {
        let films = f64::from(u8::from(i > 0) + u8::from(i < last));
        diagonal[i] = stretch + films * shear;
        right[i] = shear * slip * (f64::from(u8::from(i < last)) - f64::from(u8::from(i > 0)));
    }
    for i in 1..count {
        let factor = -shear / diagonal[i - 1];
        diagonal[i] -= factor * -shear;
        right[i] -= factor * right[i - 1];
    }
    let mut shifts = vec![0.0; count];
    for i in (0..count).rev() {
        let next = if i < last { shifts[i + 1] } else { 0.0 };
        shifts[i] = (right[i] + shear * next) / diagonal[i];
    }
    shifts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glass(modulus: f64, laminate: Laminate) -> Material {
        Material {
            youngs_modulus: modulus,
            laminate: Some(laminate),
            ..Material::preset("glass").unwrap()
        }
    }

    /// A beam of two plies, in mm, MPa: span, ply, film, G, E.
    fn beam([span, ply, interlayer, shear, modulus]: [f64; 5]) -> Bending {
        let laminate = Laminate {
            interlayer: 1e-3 * interlayer,
            shear_modulus: 1e6 * shear,
            ..Laminate::PVB
        };
        let k = 9.6_f64.sqrt() / (1e-3 * span);
        glass(1e6 * modulus, laminate).laminate_bending(1e-3 * ply, k, false)
    }

    #[test]
    fn two_plies_are_wolfels_and_bennisons() {
        for (span, shear) in [(0.3, 1e6), (1.0, 0.4e6), (0.05, 150e6)] {
            let (ply, film, modulus) = (6e-3, 1.52e-3, 70e9);
            let b = beam([1e3 * span, 6.0, 1.52, 1e-6 * shear, 70e3]);
            let s: f64 = ply + film;
            let inertia = 2.0 * ply * (0.5 * s).powi(2);
            let eta = 1.0 / (1.0 + 9.6 * modulus * inertia * film / (shear * s * s * span * span));
            let deflection = (2.0 * ply.powi(3) + 12.0 * eta * inertia).cbrt();
            let stress = (deflection.powi(3) / (ply + eta * s)).sqrt();
            assert!((b.deflection / deflection - 1.0).abs() < 1e-12);
            assert!((b.stress / stress - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_stiff_film_makes_one_plate_and_a_soft_one_leaves_a_stack() {
        for plies in [2, 3, 5] {
            let of = |shear_modulus| {
                let laminate = Laminate {
                    plies,
                    shear_modulus,
                    interlayer: 1e-9,
                    ..Laminate::PVB
                };
                glass(70e9, laminate).laminate_bending(4e-3, 3.0, true)
            };
            let n = f64::from(plies);
            let (one, stack) = (of(1e12), of(1e-6));
            assert!(
                (one.deflection / (4e-3 * n) - 1.0).abs() < 1e-3 && (one.face - 1.0).abs() < 1e-3
            );
            assert!((stack.deflection / (4e-3 * n.cbrt()) - 1.0).abs() < 1e-3);
            assert!((stack.face * n - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn plies_that_do_not_fit_are_refused_with_the_mend() {
        let wall = |laminate: Laminate, wall: f64| laminate.ply_in(wall).unwrap_err();
        let thick = Laminate {
            interlayer: 6e-3,
            ..Laminate::PVB
        };
        assert!(
            wall(thick, 5e-3)
                .contains("interlayer of 6.000 mm is thicker than its wall of 5.000 mm")
        );
        let apart = Laminate {
            ply: 2e-3,
            ..Laminate::PVB
        };
        let said = wall(apart, 6.76e-3);
        assert!(
            said.contains("do not touch") && said.contains("needs plies of 3.000 mm"),
            "{said}"
        );
        assert!(
            wall(
                Laminate {
                    ply: 4e-3,
                    ..Laminate::PVB
                },
                6.76e-3
            )
            .contains("overlap")
        );
        assert!((apart.ply_in(4.76e-3).unwrap() - 2e-3).abs() < 1e-12);
        let one = Laminate {
            plies: 1,
            ..Laminate::PVB
        };
        let said = glass(70e9, one).validate().unwrap_err().to_string();
        assert!(
            said.contains("number of plies of the laminate is 1; it must be a whole number from 2"),
            "{said}"
        );
        assert!(
            glass(70e9, Laminate::of_numbers([2.5, 0.0, 1e-3, 1e8, 1e7, 0.01]))
                .validate()
                .is_err()
        );
        for (k, key) in Laminate::KEYS.iter().enumerate().skip(2) {
            let mut numbers = Laminate::PVB.numbers();
            numbers[k] = -1.0;
            assert!(
                glass(70e9, Laminate::of_numbers(numbers))
                    .validate()
                    .is_err(),
                "{key}"
            );
        }
    }

    /// Published worked examples, simply supported under a uniform load: deflection and stress thickness, mm.
    #[test]
    fn published_beams_have_the_published_thickness() {
        let near = |ours: f64, published: f64| {
            assert!(
                (1e3 * ours / published - 1.0).abs() < 0.05,
                "{ours} {published}"
            );
        };
        let b = beam([1500.0, 5.56, 1.52, 7.1, 71_700.0]);
        near(b.deflection, 12.070);
        near(b.stress, 12.339);
        let b = beam([1950.0, 15.0, 1.52, 26.4, 70_000.0]);
        near(b.deflection, 30.92);
        near(b.stress, 31.21);
    }

    /// Newmark's beam of two plies that slide on an elastic joint, simply supported under a uniform load, has a closed form.
    #[test]
    fn a_beam_of_any_film_bends_as_the_closed_form_says() {
        let (span, ply, film, modulus): (f64, f64, f64, f64) = (1.0, 9.02e-3, 1.52e-3, 71.7e9);
        for shear in [0.05e6, 0.44e6, 5e6, 150e6] {
            let s = ply + film;
            let own = 2.0 * modulus * ply.powi(3) / 12.0;
            let whole = own + modulus * 0.5 * ply * s * s;
            let a2 = shear / film * (2.0 / (modulus * ply) + s * s / own);
            let end = 1.0 - 1.0 / (a2.sqrt() * span / 2.0).cosh();
            let exact = 5.0 * span.powi(4) / (384.0 * whole)
                + (whole / own - 1.0) / (a2 * whole) * (span * span / 8.0 - end / a2);
            let b = beam([1e3, 9.02, 1.52, 1e-6 * shear, 71_700.0]);
            let ours = 5.0 * span.powi(4) / (384.0 * modulus * b.deflection.powi(3) / 12.0);
            assert!((ours / exact - 1.0).abs() < 0.05, "{shear} {ours} {exact}");
        }
    }
}
