//! Tempered walls: the two faces of a body with a residual stress, as functions of a place in their mean plane.
//!
//! A thermal treatment presses the faces together and pulls the middle ([`Material`](crate::material::Material) has the stress). The weak points at
//! the faces bear that much more (`fields`), and a crack that gets below the compressed layer may end in dice (`dice`). Both need a body that is one
//! wall: a pane, flat or curved, whose faces are height fields over its mean plane.

mod grid;
mod outline;
mod wall;

pub(crate) use grid::Grid;
pub(crate) use wall::TemperedWall;
