//! Errors of the core crate. Each message says what is wrong and how to fix it.

use frangible_material::OutOfRange;
use thiserror::Error;

pub use frangible_material::{not_negative, positive};

/// An invalid number or array given by the caller.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum InputError {
    /// A number that is out of range.
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
    /// A state that does not belong to the body.
    #[error(
        "the state of a body is invalid: {0}; replay its impacts, or start with an intact body"
    )]
    State(&'static str),
    /// A byte string of a contact with a wrong length.
    #[error("{0} bytes are not a contact, which has at least {least} bytes, and more with a vibrating striker; give the bytes that Contact::to_bytes wrote", least = crate::Contact::BYTES)]
    ContactBytes(usize),
    /// A striker's receptance that is invalid.
    #[error(
        "a striker's receptance is invalid: {0}; make the striker again with Striker::flexible"
    )]
    Receptance(&'static str),
    /// Fields of strength, toughness or weak points that are invalid.
    #[error("the fields of a body are invalid: {0}")]
    Field(String),
    /// A motion that does not match the body's modes.
    #[error("the motion is invalid: {0}")]
    Motion(&'static str),
    /// A tempered body that is not one wall.
    #[error(
        "`{asset}` is of `{material}`, which has a residual stress through its wall, but it is not one wall of even thickness: {problem}; give it the shape of a pane, flat or curved, or a material without residual stress"
    )]
    NoWall {
        /// The asset's name.
        asset: String,
        /// The material's name.
        material: String,
        /// Why the body is no wall.
        problem: String,
    },
    /// A laminated body that is not one wall, or whose plies do not fit in it.
    #[error("{0}")]
    Laminate(String),
    /// Arrays of an asset that do not fit together.
    #[error("asset `{asset}`: {problem}; bake it again")]
    Asset {
        /// The asset's name.
        asset: String,
        /// Problem with its arrays.
        problem: String,
    },
}

impl InputError {
    /// An error about a laminated asset: its name, that of its material, and a clause that says what does not fit and how to mend it.
    #[doc(hidden)]
    #[must_use]
    pub fn laminate(asset: &str, material: &str, problem: &str) -> Self {
        Self::Laminate(format!(
            "`{asset}` is of `{material}`, which is laminated, but {problem}"
        ))
    }
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
