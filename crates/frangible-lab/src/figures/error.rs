//! Errors of the figures.

use thiserror::Error;

/// Error that keeps a figure from being made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FigureError {
    /// A name that no figure has.
    #[error("there is no figure `{name}`{hint}; figures: {known}")]
    UnknownFigure {
        /// The requested name.
        name: String,
        /// The one that was probably meant, or nothing.
        hint: String,
        /// All names.
        known: String,
    },
    /// The material of a body.
    #[error(transparent)]
    Material(#[from] frangible::internals::UnknownMaterial),
    /// The bake refused a body.
    #[error("a body could not be baked: {0}")]
    Bake(#[from] frangible_bake::BakeError),
    /// The pipeline refused an impact.
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
    /// Nothing broke where the figure needs pieces.
    #[error("nothing to show: {0}")]
    Nothing(&'static str),
}
