//! Contents and layout of a chart.

use image::RgbImage;

use super::canvas::{Canvas, Colour, text_width};
use super::ticks::{Ticks, label, linear, logarithmic};

/// Points and lines over two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Heading.
    pub title: String,
    /// Axis to the right.
    pub x: Axis,
    /// Axis upwards.
    pub y: Axis,
    /// Series to draw, named in the legend in this order.
    pub series: Vec<Series>,
}

/// An axis; its range is that of the points, to the next round numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// Even steps or even factors.
    pub scale: Scale,
    /// A number that the range is to include too, to leave room.
    pub including: Option<f64>,
}

impl Axis {
    /// Even steps.
    pub fn linear(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            scale: Scale::Linear,
            including: None,
        }
    }

    /// Even factors; points that are not above zero are left out.
    pub fn log(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            scale: Scale::Log,
            including: None,
        }
    }

    /// Extends the range so that it includes this number too.
    #[must_use]
    pub fn including(self, number: f64) -> Self {
        Self {
            including: Some(number),
            ..self
        }
    }
}

/// Scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Even steps.
    Linear,
    /// Even factors.
    Log,
}

/// Points of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// x and y; points with NaN or infinity are left out.
    pub points: Vec<(f64, f64)>,
    /// Mark at each point.
    pub marker: Marker,
    /// If true, a line joins the points in their order.
    pub line: bool,
}

/// Mark at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A filled circle.
    Disc,
    /// A square on its side.
    Square,
    /// A square on its corner.
    Diamond,
    /// A triangle, point up.
    Triangle,
    /// Nothing: a law through the points of the series before, in its colour.
    Nothing,
}

/// Okabe and Ito's colours (2008), told apart by the colour-blind too.
const COLOURS: [Colour; 6] = [
    [213, 94, 0],
    [230, 159, 0],
    [0, 114, 178],
    [0, 158, 115],
    [204, 121, 167],
    [86, 180, 233],
];
const INK: Colour = [40, 40, 40];
const GRID: Colour = [205, 205, 205];
const FAINT: Colour = [233, 233, 233];
const WHITE: Colour = [255; 3];

/// Space around the plot for title, labels and numbers, pixels: left, right, top, bottom.
const MARGINS: [f64; 4] = [84.0, 28.0, 52.0, 66.0];
/// Height of capitals, pixels: title, labels, numbers and legend.
const LETTERS: [f64; 3] = [15.0, 13.0, 11.0];
/// Smallest picture, pixels.
const SMALLEST: (u32, u32) = (320, 240);

impl Chart {
    /// Draws the chart, at least 320 × 240 pixels.
    #[must_use]
    pub fn draw(&self, width: u32, height: u32) -> RgbImage {
        let (width, height) = (width.max(SMALLEST.0), height.max(SMALLEST.1));
        let mut canvas = Canvas::new(width, height);
        let [left, right, top, bottom] = MARGINS;
        let (x_end, y_end) = (f64::from(width) - right, f64::from(height) - bottom);
        let points = || self.series.iter().flat_map(|s| self.finite(s));
        let across = points().map(|p| p.0).chain(self.x.including);
        let upwards = points().map(|p| p.1).chain(self.y.including);
        let x = Ruler::new(self.x.scale, across, [left, x_end]);
        let y = Ruler::new(self.y.scale, upwards, [y_end, top]);
        self.draw_axes(&mut canvas, &x, &y);
        let place = |(px, py): (f64, f64)| [x.pixel(px), y.pixel(py)];
        let mut pixels = Vec::new();
        for (series, colour) in self.series.iter().zip(self.colours()) {
            let points: Vec<[f64; 2]> = self.finite(series).map(place).collect();
            for ends in points.windows(2).filter(|_| series.line) {
                canvas.line(ends[0], ends[1], 2.0, colour);
            }
            for &point in &points {
                canvas.marker(point, series.marker, 6.0, colour);
            }
            pixels.extend(points);
        }
        self.draw_legend(&mut canvas, [left, x_end, top, y_end], &pixels);
        canvas.0
    }

    /// The colour of each series: the next one for each with a marker.
    fn colours(&self) -> Vec<Colour> {
        let mut next = 0;
        let colour = |series: &Series| {
            if series.marker != Marker::Nothing || next == 0 {
                next += 1;
            }
            COLOURS[(next - 1) % COLOURS.len()]
        };
        self.series.iter().map(colour).collect()
    }

    /// Points that have a place on the axes.
    fn finite<'a>(&'a self, series: &'a Series) -> impl Iterator<Item = (f64, f64)> + 'a {
        let fits = |scale: Scale, v: f64| v.is_finite() && (scale == Scale::Linear || v > 0.0);
        let points = series.points.iter().copied();
        points.filter(move |p| fits(self.x.scale, p.0) && fits(self.y.scale, p.1))
    }

    fn draw_axes(&self, canvas: &mut Canvas, x: &Ruler, y: &Ruler) {
        let ([left, right], [bottom, top]) = (x.pixels, y.pixels);
        for (ticks, colour) in [(&x.ticks.plain, FAINT), (&x.ticks.labelled, GRID)] {
            for &tick in ticks {
                let at = x.pixel(tick).round() + 0.5;
                canvas.line([at, bottom], [at, top], 1.0, colour);
            }
        }
        for (ticks, colour) in [(&y.ticks.plain, FAINT), (&y.ticks.labelled, GRID)] {
            for &tick in ticks {
                let at = y.pixel(tick).round() + 0.5;
                canvas.line([left, at], [right, at], 1.0, colour);
            }
        }
        let [title, letters, digits] = LETTERS;
        for &tick in &x.ticks.labelled {
            let (at, text) = (x.pixel(tick), label(tick));
            let start = at - 0.5 * text_width(&text, digits);
            canvas.line([at, bottom], [at, bottom + 5.0], 1.2, INK);
            canvas.text([start, bottom + 10.0 + digits], &text, digits, false, INK);
        }
        for &tick in &y.ticks.labelled {
            let (at, text) = (y.pixel(tick), label(tick));
            let start = left - 8.0 - text_width(&text, digits);
            canvas.line([left - 5.0, at], [left, at], 1.2, INK);
            canvas.text([start, at + 0.5 * digits], &text, digits, false, INK);
        }
        let corners = [
            [left, top],
            [right, top],
            [right, bottom],
            [left, bottom],
            [left, top],
        ];
        for side in corners.windows(2) {
            canvas.line(side[0], side[1], 1.2, INK);
        }
        let middle = 0.5 * (left + right);
        let start = |text: &str, height: f64| middle - 0.5 * text_width(text, height);
        let heading = [start(&self.title, title), top - 20.0];
        canvas.text(heading, &self.title, title, false, INK);
        let below = [start(&self.x.label, letters), bottom + 52.0];
        canvas.text(below, &self.x.label, letters, false, INK);
        let half = 0.5 * text_width(&self.y.label, letters);
        let beside = [letters + 12.0, 0.5 * (top + bottom) + half];
        canvas.text(beside, &self.y.label, letters, true, INK);
    }

    /// Draws the legend in the corner where it hides the fewest points.
    fn draw_legend(&self, canvas: &mut Canvas, inside: [f64; 4], points: &[[f64; 2]]) {
        const ROW: f64 = 22.0;
        const SAMPLE: f64 = 34.0;
        let letters = LETTERS[2];
        let widest = self.series.iter().map(|s| text_width(&s.name, letters));
        let width = SAMPLE + 18.0 + widest.fold(0.0, f64::max);
        let height = 10.0 + ROW * self.series.len() as f64;
        let [left, right, top, bottom] = inside;
        let mut corners = Vec::new();
        for y in [top + 10.0, bottom - 10.0 - height] {
            for x in [right - 10.0 - width, left + 10.0] {
                let near = |p: &&[f64; 2]| {
                    (x - 8.0..x + width + 8.0).contains(&p[0])
                        && (y - 8.0..y + height + 8.0).contains(&p[1])
                };
                corners.push((points.iter().filter(near).count(), [x, y]));
            }
        }
        let Some((_, [x, y])) = corners.into_iter().min_by_key(|c| c.0) else {
            return;
        };
        canvas.rectangle([x, y], [x + width, y + height], GRID);
        let (low, high) = ([x + 1.0, y + 1.0], [x + width - 1.0, y + height - 1.0]);
        canvas.rectangle(low, high, WHITE);
        for (row, (series, colour)) in self.series.iter().zip(self.colours()).enumerate() {
            let at = y + 5.0 + ROW * (row as f64 + 0.5);
            if series.line {
                canvas.line([x + 8.0, at], [x + SAMPLE, at], 2.0, colour);
            }
            let marker = [x + 0.5 * (8.0 + SAMPLE), at];
            canvas.marker(marker, series.marker, 6.0, colour);
            let start = [x + SAMPLE + 8.0, at + 0.5 * letters];
            canvas.text(start, &series.name, letters, false, INK);
        }
    }
}

/// Mapping from numbers to pixels along an axis.
struct Ruler {
    scale: Scale,
    range: [f64; 2],
    pixels: [f64; 2],
    ticks: Ticks,
}

impl Ruler {
    fn new(scale: Scale, numbers: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Self {
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = numbers.fold(none, |[low, high], x| [low.min(x), high.max(x)]);
        // Without a point there still are axes.
        let (low, high) = if low <= high {
            (low, high)
        } else {
            (1.0, 10.0)
        };
        let (range, ticks) = match scale {
            Scale::Linear => linear(low, high),
            Scale::Log => logarithmic(low, high),
        };
        Self {
            scale,
            range,
            pixels,
            ticks,
        }
    }

    fn pixel(&self, number: f64) -> f64 {
        let of = |x: f64| match self.scale {
            Scale::Linear => x,
            Scale::Log => x.ln(),
        };
        let [from, to] = self.range.map(of);
        let share = if to > from {
            (of(number) - from) / (to - from)
        } else {
            0.5
        };
        self.pixels[0] + share * (self.pixels[1] - self.pixels[0])
    }
}
