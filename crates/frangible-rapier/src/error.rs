//! Errors of the world. Each message says how to fix the input.

use frangible::InputError;
use rapier3d::math::Vector;
use thiserror::Error;

/// A number given to the world, or a break, that cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum WorldError {
    /// A thread that computed a break panicked.
    #[error(
        "the thread that computed a break panicked; the body stays whole. Please report this as a bug"
    )]
    JudgeFailed,
    /// A quantity that must be finite and above zero is not.
    #[error("{what} is {value}; it must be a finite number above zero")]
    NotPositive {
        /// The quantity, with its unit.
        what: &'static str,
        /// The value given.
        value: f32,
    },
    /// A quantity that must be finite and not negative is not.
    #[error("{what} is {value}; it must be a finite number, zero or above")]
    Negative {
        /// The quantity, with its unit.
        what: &'static str,
        /// The value given.
        value: f32,
    },
    /// A crushing pressure below 10 kPa, at which contacts would outlast the simulated time of an impact, Pa.
    #[error("crushing pressure is {0} Pa; it must be 10 kPa or more, and may be infinite")]
    CrushingPressure(f32),
    /// Restitution out of 0..=1.
    #[error("restitution is {0}; it must lie between 0 (no bounce) and 1 (full bounce)")]
    Restitution(f32),
    /// A position, rotation or velocity with a NaN or an infinity in it.
    #[error(
        "{what} has a component that is not finite; give finite numbers in metres, radians and seconds"
    )]
    NotFinite {
        /// The quantity.
        what: &'static str,
    },
    /// A rotation that is not a unit quaternion.
    #[error("the pose's rotation has length {0}; normalise the quaternion")]
    Rotation(f32),
    /// A half-space whose normal has length zero.
    #[error("the half-space's normal is {0}; give a vector of non-zero length")]
    NoNormal(Vector),
    /// A handle of a body that is not in the world.
    #[error(
        "the world has no body {index} (generation {generation}); it was removed, or replaced by its fragments"
    )]
    NoBody {
        /// Index part of the handle.
        index: u32,
        /// Generation part of the handle.
        generation: u32,
    },
    /// The world is full.
    #[error("the world has reached its limit of {0} bodies; remove some, or raise `max_bodies`")]
    Full(usize),
    /// An asset, contact or configuration that the fracture model rejects. The body stays whole, and the step is complete.
    #[error(transparent)]
    Fracture(#[from] InputError),
}

pub(crate) fn positive(what: &'static str, value: f32) -> Result<(), WorldError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(WorldError::NotPositive { what, value })
    }
}

pub(crate) fn not_negative(what: &'static str, value: f32) -> Result<(), WorldError> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(WorldError::Negative { what, value })
    }
}

pub(crate) fn finite(what: &'static str, v: Vector) -> Result<(), WorldError> {
    if v.is_finite() {
        Ok(())
    } else {
        Err(WorldError::NotFinite { what })
    }
}
