//! Errors of the run time: each names what is wrong and how to mend it.

use frangible_material::OutOfRange;
use thiserror::Error;

pub use frangible_material::{not_negative, positive};

/// A number or an array given by the caller that cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum InputError {
    /// A number that is out of its range.
    #[error(transparent)]
    Number(#[from] OutOfRange),
    /// A vector with a NaN or an infinity in it.
    #[error("{what} is ({x}, {y}, {z}); every component must be a finite number")]
    NotFinite {
        /// The vector.
        what: &'static str,
        /// Components.
        x: f32,
        /// Components.
        y: f32,
        /// Components.
        z: f32,
    },
    /// The state of a body that cannot be its own.
    #[error(
        "the state of a body cannot be used: {0}; replay its impacts, or begin with an intact one"
    )]
    State(&'static str),
    /// Bytes of a contact that are too few or too many.
    #[error("a contact has at least {least} bytes, and more of a striker that vibrates, and these {0} are none; give what Contact::to_bytes wrote", least = crate::Contact::BYTES)]
    ContactBytes(usize),
    /// A striker's receptance that cannot be used.
    #[error(
        "a striker's receptance cannot be used: {0}; make the striker anew by Striker::flexible"
    )]
    Receptance(&'static str),
    /// Fields of strength, toughness or weak points that cannot be used.
    #[error("fields of a body cannot be used: {0}")]
    Field(String),
    /// A motion that is not one of the body's modes.
    #[error("a motion cannot be followed: {0}")]
    Motion(&'static str),
    /// Arrays of an asset that do not fit together.
    #[error("asset `{asset}`: {problem}; bake it again")]
    Asset {
        /// The asset's name.
        asset: String,
        /// Problem with its arrays.
        problem: String,
    },
}

/// Checks that a vector has neither a NaN nor an infinity in it.
///
/// # Errors
/// A vector that has.
pub fn finite(what: &'static str, v: glam::Vec3) -> Result<(), InputError> {
    if v.is_finite() {
        Ok(())
    } else {
        Err(InputError::NotFinite {
            what,
            x: v.x,
            y: v.y,
            z: v.z,
        })
    }
}
