//! Why a scene gave no result.

use thiserror::Error;

/// Why a scene gave no result.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// No built-in scene of that name.
    #[error("there is no scene `{name}`{hint}; scenes: {known}")]
    UnknownScene {
        /// What was asked for.
        name: String,
        /// “, did you mean …”, or nothing.
        hint: String,
        /// The names there are.
        known: String,
    },
    /// A quantity of the scene that cannot be used.
    #[error("{what} is {value}; it must be {must}")]
    Quantity {
        /// The quantity.
        what: &'static str,
        /// What was given.
        value: String,
        /// What it must be, with its unit.
        must: &'static str,
    },
    /// A ball that would start inside the floor or the body.
    #[error(
        "the ball would start {depth_mm:.1} mm below the floor; aim higher with --at, or turn --toward downwards"
    )]
    BallBelowFloor {
        /// Depth, mm.
        depth_mm: f32,
    },
    /// The body could not be baked.
    #[error("baking failed: {0}")]
    Bake(#[from] frangible_bake::BakeError),
    /// The rigid-body world refused something.
    #[error("simulating failed: {0}")]
    World(#[from] frangible_rapier::WorldError),
    /// The fracture model refused something.
    #[error(transparent)]
    Input(#[from] frangible::InputError),
    /// No such material.
    #[error(transparent)]
    Material(#[from] frangible::UnknownMaterial),
}
