//! Errors of the run time: each names what is wrong and how to mend it.

use thiserror::Error;

/// A number or an array given by the caller that cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum InputError {
    /// A quantity that must be finite and above zero is not.
    #[error("{what} is {value}{}{unit}; it must be a finite number above zero", if unit.is_empty() { "" } else { " " })]
    NotPositive {
        /// The quantity.
        what: &'static str,
        /// What was given.
        value: f64,
        /// Its unit; empty where it has none.
        unit: &'static str,
    },
    /// A quantity that must be finite and not negative is not.
    #[error("{what} is {value}; it must be a finite number, zero or above")]
    Negative {
        /// The quantity.
        what: &'static str,
        /// What was given.
        value: f64,
    },
    /// A number of a [`FractureConfig`](crate::FractureConfig) that is out of its range.
    #[error("`{field}` of the fracture configuration is {value}; it must be {must}")]
    Configuration {
        /// The field.
        field: &'static str,
        /// What was given.
        value: f64,
        /// Its range.
        must: &'static str,
    },
    /// Poisson's ratio out of (−1, 0.5).
    #[error(
        "Poisson's ratio is {0}; it must lie between -1 and 0.5 (glass 0.23, rubber just under 0.5)"
    )]
    PoissonRatio(f64),
    /// Restitution out of 0..=1.
    #[error("restitution is {0}; it must lie between 0 (no bounce) and 1 (full bounce)")]
    Restitution(f64),
    /// The number of a body that strikes at several points, too large.
    #[error("the number of a striker's body is {0}; it must be below {most}", most = crate::internals::contact::SharedMass::MOST_BODIES)]
    StrikerNumber(u32),
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
        /// What does not fit.
        problem: String,
    },
}

pub(crate) fn positive(
    what: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<(), InputError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(InputError::NotPositive { what, value, unit })
    }
}

pub(crate) fn finite(what: &'static str, v: glam::Vec3) -> Result<(), InputError> {
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
