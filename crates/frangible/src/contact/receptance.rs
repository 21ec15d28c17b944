//! Receptance of a body at a contact point, as a sum over modes.
//!
//! A force `F` along the normal `n` moves the contact point by `Σ (φ_i · n) q_i`, where `q̈_i + d_i q̇_i + λ_i q_i = (φ_i · n) F`. Modes that
//! are not integrated through time respond statically, `q_i = (φ_i · n) F/λ_i`, and on a wall the wall oscillators extend the spectrum above
//! the modes (Zener 1941). Struck body and striker are described alike, so that both get the same force F(t).

use crate::error::InputError;
use crate::near_field::{PlateTheory, WallMaterial};

/// Receptance of a vibrating body at a contact, in addition to its rigid motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Receptance {
    /// λ of every mode, 1/s².
    pub(crate) eigenvalues: Vec<f64>,
    /// Number of modes that are integrated through time; the others respond statically.
    pub(crate) followed: usize,
    /// Rayleigh's damping `d = stiffness_damping λ + mass_damping`, s and 1/s.
    pub(crate) stiffness_damping: f64,
    pub(crate) mass_damping: f64,
    /// φ · n of every mode, 1/√kg: its contribution to the gap and to the modal force of the contact.
    pub(crate) shape: Vec<f64>,
    /// Receptance of the wall beyond the modes.
    pub(crate) wall: Option<WallReceptance>,
    /// Radius of the ball of the body's volume, with which flat on flat is taken to touch, m.
    pub(crate) ball_radius: f64,
}

/// Receptance of the wall behind a contact due to waves that the modes omit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WallReceptance {
    pub(crate) material: WallMaterial,
    /// Largest width of a contact, m.
    pub(crate) widest: f64,
    /// Lowest angular frequency, rad/s.
    pub(crate) lowest: f64,
    /// Share of the wall's motion across itself that is along the contact's normal, and of its normal force that acts across the wall.
    pub(crate) along_normal: f64,
}

impl Receptance {
    /// ω, rad/s, and d, 1/s, of the modes that are followed.
    pub(crate) fn oscillators(&self) -> impl Iterator<Item = (f64, f64)> {
        let followed = self.eigenvalues[..self.followed].iter();
        followed.map(|&lambda| (lambda.sqrt(), self.damping(lambda)))
    }

    /// d of this eigenvalue, 1/s.
    pub(crate) fn damping(&self, eigenvalue: f64) -> f64 {
        self.stiffness_damping * eigenvalue + self.mass_damping
    }

    /// Residual compliance, m/N: of the modes that follow the force, with shapes `felt` at one contact and `pushed` at another of the body.
    pub(crate) fn compliance(&self, felt: &[f64], pushed: &[f64]) -> f64 {
        let rest = self.followed..;
        let terms = (felt[rest.clone()].iter())
            .zip(&pushed[rest.clone()])
            .zip(&self.eigenvalues[rest]);
        terms.map(|((a, b), lambda)| a * b / lambda).sum()
    }

    /// Returns true if two contacts may be of one body, which then swings under both.
    pub(crate) fn swings_with(&self, other: &Self) -> bool {
        self.followed == other.followed && self.eigenvalues == other.eigenvalues
    }

    /// Length of [`Self::to_numbers`] of a body with so many modes.
    pub(crate) fn numbers_of(modes: usize) -> usize {
        modes.saturating_mul(2).saturating_add(16)
    }

    /// All of it as numbers: the body's, its wall's, and those of its modes.
    pub(crate) fn to_numbers(&self) -> Vec<f64> {
        let mut numbers = vec![
            self.followed as f64,
            self.stiffness_damping,
            self.mass_damping,
            self.ball_radius,
        ];
        let wall = self.wall.map(|wall| {
            let (material, theory) = wall.material.numbers();
            // Kind of the wall: 0 is none.
            let kind = match theory {
                PlateTheory::Kirchhoff => 1.0,
                PlateTheory::Layer => 2.0,
            };
            let place = [wall.widest, wall.lowest, wall.along_normal];
            (kind, material, place)
        });
        let (kind, material, place) = wall.unwrap_or_default();
        numbers.push(kind);
        numbers.extend(material.into_iter().chain(place));
        for list in [&self.eigenvalues, &self.shape] {
            numbers.extend_from_slice(list);
        }
        numbers
    }

    /// Reads the output of [`Self::to_numbers`]; call [`Self::validate`] afterwards.
    pub(crate) fn of_numbers(numbers: &[f64], modes: usize) -> Result<Self, InputError> {
        let torn =
            InputError::Receptance("the number of its values does not match its number of modes");
        let Some((&head, lists)) = numbers.split_first_chunk::<16>() else {
            return Err(torn);
        };
        if lists.len() != 2 * modes {
            return Err(torn);
        }
        let [
            followed,
            stiffness_damping,
            mass_damping,
            ball_radius,
            kind,
            ..,
        ] = head;
        let [.., widest, lowest, along_normal] = head;
        let material: [f64; 8] = std::array::from_fn(|i| head[5 + i]);
        let theory = match kind {
            0.0 => None,
            1.0 => Some(PlateTheory::Kirchhoff),
            2.0 => Some(PlateTheory::Layer),
            _ => {
                return Err(InputError::Receptance(
                    "the plate theory of its wall is unknown",
                ));
            }
        };
        let whole = followed as usize;
        // Bit for bit: what would not be written again is refused.
        if (whole as f64).to_bits() != followed.to_bits() {
            return Err(InputError::Receptance(
                "its number of modes is not a whole number",
            ));
        }
        if theory.is_none() && head[4..].iter().any(|x| x.to_bits() != 0) {
            return Err(InputError::Receptance(
                "it has values for a wall, but no wall",
            ));
        }
        Ok(Self {
            eigenvalues: lists[..modes].to_vec(),
            followed: whole,
            stiffness_damping,
            mass_damping,
            shape: lists[modes..].to_vec(),
            wall: theory.map(|theory| WallReceptance {
                material: WallMaterial::of_numbers(material, theory),
                widest,
                lowest,
                along_normal,
            }),
            ball_radius,
        })
    }

    /// Checks that every number can be used.
    pub(crate) fn validate(&self) -> Result<(), InputError> {
        let count = self.eigenvalues.len();
        if self.followed > count || self.shape.len() != count {
            return Err(InputError::Receptance(
                "its eigenvalues and mode shapes differ in number",
            ));
        }
        // Modes come of numbers of four bytes.
        let finite = |x: &f64| x.abs() <= f64::from(f32::MAX);
        let positive = |x: &f64| finite(x) && *x > 0.0;
        let not_negative = |x: &f64| finite(x) && *x >= 0.0;
        if !self.eigenvalues.iter().all(positive) {
            return Err(InputError::Receptance(
                "an eigenvalue is not a finite number above zero",
            ));
        }
        if !self.shape.iter().all(finite) {
            return Err(InputError::Receptance(
                "a mode's shape is not a finite number",
            ));
        }
        if ![self.stiffness_damping, self.mass_damping]
            .iter()
            .all(not_negative)
        {
            return Err(InputError::Receptance(
                "a damping is not a finite number, zero or above",
            ));
        }
        if !positive(&self.ball_radius) {
            return Err(InputError::Receptance(
                "its radius is not a finite number above zero",
            ));
        }
        let Some(wall) = &self.wall else {
            return Ok(());
        };
        let sound = wall.material.is_sound()
            && wall.widest >= wall.material.thickness
            && positive(&wall.lowest)
            && finite(&wall.along_normal);
        match sound {
            true => Ok(()),
            false => Err(InputError::Receptance(
                "a value of its wall is not a finite number above zero",
            )),
        }
    }
}
