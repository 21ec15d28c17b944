//! Draws computed things.

mod compose;
mod model;
mod pieces;
mod slice;
mod view;

pub(crate) use compose::{below, beside, chart};
pub(crate) use model::{Colour, Model};
pub(crate) use pieces::{PieceColours, add_held, add_pieces};
pub(crate) use slice::{crossing, surface_trace};
pub(crate) use view::Look;

/// Colours told apart by the colour-blind too (Okabe and Ito 2008), linear, without black and yellow: labels.
pub(crate) const LABELS: [Colour; 7] = [
    [0.0, 0.168, 0.445, 1.0],
    [0.665, 0.112, 0.0, 1.0],
    [0.0, 0.342, 0.171, 1.0],
    [0.791, 0.347, 0.0, 1.0],
    [0.604, 0.191, 0.386, 1.0],
    [0.093, 0.456, 0.815, 1.0],
    [0.45, 0.45, 0.45, 1.0],
];

/// Edges of meshes and highlighted cracks.
pub(crate) const INK: Colour = [0.012, 0.012, 0.016, 1.0];
