//! Charts as PNG: points and lines over linear or logarithmic axes, with a legend; line drawings side by side.
//!
//! Drawn by the project itself, strokes and letters alike, so that a report needs no font file, no system library and no
//! graphics driver, and is the same on every machine.

mod canvas;
mod chart;
mod font;
mod panels;
mod ticks;

pub use chart::{Axis, Chart, Marker, Scale, Series};
pub use panels::{Panel, Panels};
