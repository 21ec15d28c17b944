//! Flat or curved panes with rounded corners, such as the cover glass of a phone or a windscreen.
//!
//! The mesh of a pane is the mesh of a box with displaced nodes.

use std::f64::consts::PI;

use frangible::glam::DVec3;

use crate::error::{BakeError, positive};
use crate::shapes::block;

/// Deepest bow, over the width: half a circle.
const DEEPEST: f64 = 0.5;

/// Shares of the width in which the volume of a bent pane is summed.
const SLICES: usize = 1000;

/// A pane: a rectangle with rounded corners, curved in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaneShape {
    /// Width, depth and thickness, m; one corner is at the origin, as for a box.
    pub size: [f64; 3],
    /// Radius of the corners, m; 0 for sharp corners.
    pub corner: f64,
    /// Height of the middle above the left and right edges, m, along a parabola; 0 for a flat pane.
    pub bow: f64,
}

impl PaneShape {
    /// Refuses a pane that cannot be built.
    pub(crate) fn validate(&self) -> Result<(), BakeError> {
        block::validate(self.size)?;
        let [width, depth, _] = self.size;
        within(
            "the radius of the pane's corners, in m,",
            self.corner,
            0.5 * width.min(depth),
        )?;
        within("the bow of the pane, in m,", self.bow, DEEPEST * width)
    }

    /// Volume, m³.
    pub(crate) fn volume(&self) -> Result<f64, BakeError> {
        self.validate()?;
        let [width, depth, thickness] = self.size;
        let missing = (4.0 - PI) * self.corner * self.corner;
        // The bow stretches the pane between the corners as well.
        let stretch = |i: usize| {
            let x = (i as f64 + 0.5) / SLICES as f64 * width;
            self.slope(x).hypot(1.0)
        };
        let stretch = (0..SLICES).map(stretch).sum::<f64>() / SLICES as f64;
        Ok((width * depth - missing) * thickness * stretch)
    }

    /// Rise of the middle surface per metre along x.
    fn slope(&self, x: f64) -> f64 {
        let width = self.size[0];
        4.0 * self.bow * (width - 2.0 * x) / (width * width)
    }

    /// Maps a place of the box to its place in the pane, m.
    pub(crate) fn place(&self, p: DVec3) -> DVec3 {
        let [width, _, thickness] = self.size;
        let [x, y] = self.rounded([p.x, p.y]);
        let u = 2.0 * x / width - 1.0;
        let middle = 0.5 * thickness;
        let normal = DVec3::new(-self.slope(x), 0.0, 1.0).normalize();
        DVec3::new(x, y, middle + self.bow * (1.0 - u * u)) + (p.z - middle) * normal
    }

    /// A place of the rectangle in the outline with round corners: the squares at the corners become quarters of a disc.
    fn rounded(&self, at: [f64; 2]) -> [f64; 2] {
        let radius = self.corner;
        if radius <= 0.0 {
            return at;
        }
        // Distance of the place beyond the middle of its corner's circle, along each side.
        let beyond = [0, 1].map(|k| {
            let middle = 0.5 * self.size[k];
            let from = at[k] - middle;
            ((from.abs() - (middle - radius)).max(0.0), from.signum())
        });
        let [(a, left), (b, low)] = beyond;
        let distance = a.hypot(b);
        if a.min(b) <= 0.0 {
            return at;
        }
        let shrink = a.max(b) / distance;
        let moved = |k: usize, far: f64, sign: f64| {
            0.5 * self.size[k] + sign * (0.5 * self.size[k] - radius + far * shrink)
        };
        [moved(0, a, left), moved(1, b, low)]
    }
}

/// A length from 0 to this.
fn within(what: &'static str, value: f64, most: f64) -> Result<(), BakeError> {
    if value == 0.0 {
        return Ok(());
    }
    positive(what, value)?;
    if value > most {
        return Err(BakeError::TooLarge { what, value, most });
    }
    Ok(())
}
