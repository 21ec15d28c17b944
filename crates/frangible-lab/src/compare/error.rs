//! Errors of a comparison.

use frangible::InputError;
use thiserror::Error;

/// Error that keeps an impact from being compared.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CompareError {
    /// The fracture model refused the body or its contacts.
    #[error(transparent)]
    Input(#[from] InputError),
    /// No contact with an impulse.
    #[error("none of the body's contacts has an impulse; give at least one an impulse above 0 N·s")]
    NoImpulse,
    /// A piece of a broken body.
    #[error("`{0}` is a piece of a broken body; methods are compared on whole bodies only")]
    Piece(String),
    /// Labels by which a body cannot be divided.
    #[error("a body cannot be divided: {0}")]
    Labels(String),
    /// An option that cannot be used.
    #[error("{what} is {value}; it must be {wanted}")]
    Option {
        /// The option.
        what: &'static str,
        /// The given value.
        value: String,
        /// Permitted values.
        wanted: &'static str,
    },
}
