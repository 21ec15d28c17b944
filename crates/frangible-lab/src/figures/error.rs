//! Errors of the figures.

use thiserror::Error;

/// Error of computing a figure.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FigureError {
    /// An unknown figure.
    #[error("there is no figure `{name}`{hint}; figures: {known}")]
    UnknownFigure {
        /// The requested name.
        name: String,
        /// Hint with the most similar name, or empty.
        hint: String,
        /// All names.
        known: String,
    },
    /// An unknown material of a body.
    #[error(transparent)]
    Material(#[from] frangible::internals::UnknownMaterial),
    /// A body could not be baked.
    #[error("a body could not be baked: {0}")]
    Bake(#[from] frangible_bake::BakeError),
    /// The fracture model rejected an impact.
    #[error(transparent)]
    Input(#[from] frangible::InputError),
    /// A scene could not be played.
    #[error(transparent)]
    Scene(#[from] frangible_scenes::SceneError),
    /// A picture could not be drawn.
    #[error(transparent)]
    Draw(#[from] frangible_draw::DrawError),
    /// A still that could not be drawn.
    #[error(transparent)]
    Photo(#[from] frangible_photo::PhotoError),
    /// Nothing broke in a figure that shows pieces.
    #[error("nothing to show: {0}")]
    Nothing(&'static str),
}
