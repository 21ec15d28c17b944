//! Smooth strokes on a picture.

use image::{Rgb, RgbImage};

use super::chart::Marker;
use super::font;

pub(super) type Colour = [u8; 3];

/// A picture to draw on, pixels from the upper left corner.
pub(super) struct Canvas(pub(super) RgbImage);

impl Canvas {
    pub(super) fn new(width: u32, height: u32) -> Self {
        Self(RgbImage::from_pixel(width, height, Rgb([255; 3])))
    }

    /// Covers the pixels within `reach` of the box between two points, each as far as `inside` says: the distance within
    /// the shape, pixels, so that its edge is a pixel wide.
    fn cover(
        &mut self,
        [a, b]: [[f64; 2]; 2],
        reach: f64,
        colour: Colour,
        inside: impl Fn([f64; 2]) -> f64,
    ) {
        let range = |low: f64, high: f64, end: u32| {
            let first = (low - reach).floor().max(0.0) as u32;
            let past = (high + reach).ceil().clamp(0.0, f64::from(end)) as u32;
            first..past
        };
        let rows = range(a[1].min(b[1]), a[1].max(b[1]), self.0.height());
        let columns = range(a[0].min(b[0]), a[0].max(b[0]), self.0.width());
        for y in rows {
            for x in columns.clone() {
                let share =
                    (inside([f64::from(x) + 0.5, f64::from(y) + 0.5]) + 0.5).clamp(0.0, 1.0);
                let pixel = self.0.get_pixel_mut(x, y);
                for (old, new) in pixel.0.iter_mut().zip(colour) {
                    let mixed = f64::from(*old) + share * (f64::from(new) - f64::from(*old));
                    *old = mixed.round() as u8;
                }
            }
        }
    }

    /// A straight stroke with round ends.
    pub(super) fn line(&mut self, a: [f64; 2], b: [f64; 2], width: f64, colour: Colour) {
        let along = [b[0] - a[0], b[1] - a[1]];
        let square = (along[0] * along[0] + along[1] * along[1]).max(f64::MIN_POSITIVE);
        self.cover([a, b], 0.5 * width + 1.0, colour, |p| {
            let from = [p[0] - a[0], p[1] - a[1]];
            let t = ((from[0] * along[0] + from[1] * along[1]) / square).clamp(0.0, 1.0);
            0.5 * width - (from[0] - t * along[0]).hypot(from[1] - t * along[1])
        });
    }

    /// A filled rectangle between two corners.
    pub(super) fn rectangle(&mut self, a: [f64; 2], b: [f64; 2], colour: Colour) {
        self.cover([a, b], 1.0, colour, |p| {
            let inside = |i: usize| (p[i] - a[i].min(b[i])).min(a[i].max(b[i]) - p[i]);
            inside(0).min(inside(1))
        });
    }

    pub(super) fn marker(&mut self, at: [f64; 2], marker: Marker, radius: f64, colour: Colour) {
        self.cover([at, at], radius + 2.0, colour, |p| {
            let (x, y) = ((p[0] - at[0]).abs(), p[1] - at[1]);
            match marker {
                Marker::Disc => radius - x.hypot(y),
                Marker::Square => 0.85 * radius - x.max(y.abs()),
                Marker::Diamond => 0.5_f64.sqrt() * (1.15 * radius - x - y.abs()),
                // The point up; edges at 0.55 radii from the middle.
                Marker::Triangle => 0.55 * radius - y.max(0.75_f64.sqrt() * x - 0.5 * y),
                Marker::Nothing => -1.0,
            }
        });
    }

    /// Text from its left end on the base line; `up` turns it a quarter to run upwards.
    pub(super) fn text(&mut self, at: [f64; 2], text: &str, height: f64, up: bool, colour: Colour) {
        let place = |x: f64, y: f64| {
            if up {
                [at[0] - y, at[1] - x]
            } else {
                [at[0] + x, at[1] - y]
            }
        };
        let width = 0.13 * height;
        let mut pen = 0.0;
        for letter in text.chars() {
            for stroke in font::strokes(letter) {
                let points: Vec<[f64; 2]> = stroke
                    .iter()
                    .map(|[x, y]| place(pen + x * height, y * height))
                    .collect();
                for ends in points.windows(2) {
                    self.line(ends[0], ends[1], width, colour);
                }
            }
            pen += font::advance(letter) * height;
        }
    }
}

/// Width of a text, pixels.
pub(super) fn text_width(text: &str, height: f64) -> f64 {
    text.chars().map(font::advance).sum::<f64>() * height
}
