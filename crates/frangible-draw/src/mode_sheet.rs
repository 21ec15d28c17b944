//! Vibration mode shapes on one picture, coloured by a quantity.

use frangible_photo::{PhotoError, Picture};
use frangible_recording::View;
use frangible_recording::glam::Vec3;
use image::{Rgb, RgbImage, imageops};

use crate::DrawError;
use crate::color_map::color_of;
use crate::field::Field;
use crate::raster::Raster;
use crate::renderer::{Label, Shot, Subject, draw};

/// A mode shape to draw.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModeCell {
    /// Displaced vertices, m.
    pub positions: Vec<Vec3>,
    /// Vertices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Value of each vertex for its colour, 0..=1.
    pub values: Vec<f32>,
    /// Number and frequency of the mode, large, above the shape.
    pub caption: String,
    /// Small line below the caption.
    pub note: String,
}

/// Layout of a sheet of modes.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeSheetOptions {
    /// Width of a cell, pixels. Default 340.
    pub cell_width: u32,
    /// Height of a cell, pixels. Default 280.
    pub cell_height: u32,
    /// Cells side by side. Default 4.
    pub columns: u32,
    /// Direction from the subject towards the camera, any length.
    pub look_from: Vec3,
    /// Up direction in the picture.
    pub up: Vec3,
    /// Lines beside the colour bar: its quantity, and the exaggeration of the shapes.
    pub legend: Vec<String>,
}

impl Default for ModeSheetOptions {
    fn default() -> Self {
        Self {
            cell_width: 340,
            cell_height: 280,
            columns: 4,
            look_from: Vec3::new(0.55, 0.5, 1.0),
            up: Vec3::Y,
            legend: Vec::new(),
        }
    }
}

/// White lines between the cells, pixels.
const GAP: u32 = 4;
/// Heights of the lines of text, pixels.
const CAPTION: f32 = 24.0;
const NOTE: f32 = 18.0;
/// Height of the text in a cell, pixels.
const HEADING: f32 = CAPTION + NOTE + 16.0;
/// Free margin around the body, pixels.
const MARGIN: f32 = 14.0;
/// Left, top, width and height of the colour bar in the legend, pixels.
const BAR: [u32; 4] = [34, 18, 260, 20];
/// Width from which the lines of the legend stand beside the bar, and not below it, pixels.
const BESIDE: u32 = 980;

/// Draws the shapes row by row, with the same view and scale, and a colour bar from 0 to 1 below them.
///
/// # Errors
///
/// [`PhotoError::EmptySheet`] without a cell or a column, [`DrawError::BadField`] for a cell whose lists do not match or contain NaN; otherwise the
/// errors of [`Raster::new`].
pub fn mode_sheet(cells: &[ModeCell], options: &ModeSheetOptions) -> Result<Picture, DrawError> {
    let (width, height) = (options.cell_width, options.cell_height);
    let count = u32::try_from(cells.len()).unwrap_or(u32::MAX);
    let columns = options.columns.min(count);
    if columns == 0 {
        return Err(PhotoError::EmptySheet.into());
    }
    for (number, cell) in cells.iter().enumerate() {
        check(number, cell)?;
    }
    Raster::new(width, height)?;
    let rows = count.div_ceil(columns);
    let (sheet_width, body) = (columns * (width + GAP) - GAP, rows * (height + GAP));
    let legend = legend(sheet_width, &options.legend)?;
    let size = (sheet_width, body + legend.height());
    let mut sheet = RgbImage::from_pixel(size.0, size.1, Rgb([255; 3]));
    let view = fit(cells, options);
    view.validate().map_err(PhotoError::from)?;
    for (index, cell) in (0..).zip(cells) {
        let at = |y, height, text: &str| Label {
            at: [0.55 * CAPTION, y],
            height,
            text: text.into(),
        };
        let drawn = draw(Shot {
            subject: Subject::Field(Field {
                positions: cell.positions.clone(),
                triangles: cell.triangles.clone(),
                values: cell.values.clone(),
                lines: Vec::new(),
            }),
            view,
            labels: vec![
                at(0.4 * CAPTION, CAPTION, &cell.caption),
                at(0.4 * CAPTION + CAPTION, NOTE, &cell.note),
            ],
            width,
            height,
        })?;
        let x = index % columns * (width + GAP);
        let y = index / columns * (height + GAP);
        imageops::replace(&mut sheet, &drawn, x.into(), y.into());
    }
    imageops::replace(&mut sheet, &legend, 0, body.into());
    Ok(sheet.into())
}

fn check(number: usize, cell: &ModeCell) -> Result<(), DrawError> {
    check_values(number, &cell.positions, &cell.triangles, &cell.values)
}

/// Refuses lists that do not fit together, of the shape with this number, from 0.
pub(crate) fn check_values(
    number: usize,
    positions: &[Vec3],
    triangles: &[[u32; 3]],
    values: &[f32],
) -> Result<(), DrawError> {
    let wrong = |problem: &'static str| DrawError::BadField {
        number: number + 1,
        problem,
    };
    let vertices = positions.len();
    if triangles.is_empty() {
        return Err(wrong("it has no triangle"));
    }
    if values.len() != vertices {
        return Err(wrong("it must have one value per vertex"));
    }
    let mut corners = triangles.iter().flatten();
    if corners.any(|&vertex| vertex as usize >= vertices) {
        return Err(wrong("a triangle refers to a vertex that does not exist"));
    }
    if !positions.iter().all(|p| p.is_finite()) {
        return Err(wrong("a position is not a finite number"));
    }
    if !values.iter().all(|v| v.is_finite()) {
        return Err(wrong("a value is not a finite number"));
    }
    Ok(())
}

/// View in which all shapes fill the part of a cell that the text leaves free.
fn fit(cells: &[ModeCell], options: &ModeSheetOptions) -> View {
    let backward = options.look_from.normalize_or(Vec3::Z);
    let right = options.up.cross(backward).normalize_or(Vec3::X);
    let up = backward.cross(right);
    let axes = [right, up, backward];
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for p in cells.iter().flat_map(|cell| &cell.positions) {
        let p = Vec3::from_array(axes.map(|axis| axis.dot(*p)));
        (low, high) = (low.min(p), high.max(p));
    }
    let (width, height) = (options.cell_width as f32, options.cell_height as f32);
    let free = [
        (width - 2.0 * MARGIN).max(1.0),
        (height - HEADING - MARGIN).max(1.0),
    ];
    let half = 0.5 * (high - low);
    // m per pixel.
    let scale = (2.0 * half.x / free[0])
        .max(2.0 * half.y / free[1])
        .max(f32::MIN_POSITIVE);
    let vertical_fov = 0.4_f32;
    let half_height = 0.5 * height * scale;
    let middle = 0.5 * (low + high) + Vec3::Y * (0.5 * (HEADING - MARGIN) * scale);
    // The scale holds in the plane half way to the nearest point: closer parts look larger.
    let distance = half_height / (0.5 * vertical_fov).tan() + 0.5 * half.z;
    let target = right * middle.x + up * middle.y + backward * middle.z;
    View {
        eye: target + backward * distance,
        target,
        up: options.up,
        vertical_fov,
    }
}

/// The bar of colours with its ends and lines of text.
fn legend(width: u32, lines: &[String]) -> Result<RgbImage, DrawError> {
    let [x, y, long, high] = BAR;
    let beside = width >= BESIDE;
    let row = NOTE + 6.0;
    let text_rows = row * lines.len() as f32;
    let (left, top) = if beside {
        (
            (x + long + 60) as f32,
            (y as f32 + 0.5 * (high as f32 - text_rows)).max(8.0),
        )
    } else {
        (x as f32, (y + high) as f32 + 10.0)
    };
    let below = top + text_rows + 6.0;
    let height = (below.ceil() as u32).max(y + high + 18);
    let mut labels = Vec::new();
    for (end, text) in [(x - 18, "0"), (x + long + 8, "1")] {
        labels.push(Label {
            at: [end as f32, y as f32],
            height: NOTE + 2.0,
            text: text.into(),
        });
    }
    for (number, line) in lines.iter().enumerate() {
        labels.push(Label {
            at: [left, top + row * number as f32],
            height: NOTE + 2.0,
            text: line.clone(),
        });
    }
    let mut drawn = draw(Shot {
        subject: Subject::Field(Field::default()),
        view: View::default(),
        labels,
        width,
        height,
    })?;
    for column in 0..long.min(width.saturating_sub(x)) {
        let color = Rgb(color_of(column as f32 / (long - 1) as f32));
        for line in 0..high {
            drawn.put_pixel(x + column, y + line, color);
        }
    }
    Ok(drawn)
}
