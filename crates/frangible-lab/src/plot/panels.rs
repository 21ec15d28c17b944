//! Line drawings side by side.

use image::RgbImage;

use super::canvas::{Canvas, Colour, text_width};

/// Square drawings of the same kind in rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Panels {
    /// Heading.
    pub title: String,
    /// Drawings in a row.
    pub columns: usize,
    /// Row after row.
    pub panels: Vec<Panel>,
}

/// One drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Text below the drawing.
    pub label: String,
    /// Half its side, in the unit of the lines; the origin is in the middle.
    pub half: f64,
    /// Ends of straight strokes.
    pub lines: Vec<[[f64; 2]; 2]>,
    /// Radii of thin circles about the middle.
    pub circles: Vec<f64>,
}

const INK: Colour = [40, 40, 40];
const THIN: Colour = [140, 185, 225];
/// Around each drawing, below it, and above all of them, pixels.
const GAP: u32 = 16;
const LABEL: u32 = 26;
const TITLE: u32 = 48;
/// Corners of a circle.
const CORNERS: usize = 90;

impl Panels {
    /// Draws them, each `side` pixels wide, at least 60.
    #[must_use]
    pub fn draw(&self, side: u32) -> RgbImage {
        let side = side.max(60);
        let columns = self.columns.max(1) as u32;
        let rows = (self.panels.len() as u32).div_ceil(columns).max(1);
        let (wide, high) = (side + GAP, side + GAP + LABEL);
        let width = GAP + columns * wide;
        let mut canvas = Canvas::new(width, TITLE + rows * high);
        let start = 0.5 * (f64::from(width) - text_width(&self.title, 14.0));
        canvas.text([start, 32.0], &self.title, 14.0, false, INK);
        for (panel, i) in self.panels.iter().zip(0..) {
            let corner = [GAP + i % columns * wide, TITLE + i / columns * high];
            panel.draw(&mut canvas, corner.map(f64::from), f64::from(side));
        }
        canvas.0
    }
}

impl Panel {
    fn draw(&self, canvas: &mut Canvas, corner: [f64; 2], side: f64) {
        let place = |[x, y]: [f64; 2]| {
            let scale = 0.5 * side / self.half;
            [
                corner[0] + 0.5 * side + scale * x,
                corner[1] + 0.5 * side - scale * y,
            ]
        };
        for &radius in &self.circles {
            let at = |k: usize| {
                let angle = std::f64::consts::TAU * k as f64 / CORNERS as f64;
                place([radius * angle.cos(), radius * angle.sin()])
            };
            (0..CORNERS).for_each(|k| canvas.line(at(k), at(k + 1), 1.0, THIN));
        }
        for &[a, b] in &self.lines {
            canvas.line(place(a), place(b), 1.6, INK);
        }
        let h = self.half;
        let corners = [[-h, -h], [h, -h], [h, h], [-h, h], [-h, -h]].map(place);
        for ends in corners.windows(2) {
            canvas.line(ends[0], ends[1], 1.2, INK);
        }
        let start = corner[0] + 0.5 * (side - text_width(&self.label, 10.0));
        canvas.text(
            [start, corner[1] + side + 19.0],
            &self.label,
            10.0,
            false,
            INK,
        );
    }
}
