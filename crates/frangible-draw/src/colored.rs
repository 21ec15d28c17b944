//! A surface coloured by a quantity, with a colour bar.

use frangible_photo::{PhotoError, Picture};
use frangible_recording::View;
use frangible_recording::glam::Vec3;
use image::Rgb;

use crate::color_map::color_of;
use crate::field::{Field, SurfaceLine};
use crate::mode_sheet::check_values;
use crate::renderer::{Label, Shot, Subject, draw};
use crate::{DrawError, Raster};

/// A surface to draw, coloured by a quantity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ColoredSurface {
    /// Vertices, m.
    pub positions: Vec<Vec3>,
    /// Vertices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Value of each vertex for its colour, clamped to 0..=1.
    pub values: Vec<f32>,
    /// Dark lines on it.
    pub lines: Vec<SurfaceLine>,
    /// Lines of text in the upper left corner.
    pub captions: Vec<String>,
    /// Labels of the two ends of the colour scale, and of its quantity.
    pub legend: [String; 3],
}

/// Height of a line of text, of the picture.
const TEXT: f32 = 0.045;

/// Left edge, width and height of the colour bar, as shares of the picture's height.
const BAR: [f32; 3] = [0.045, 0.5, 0.03];

impl Raster {
    /// Draws a coloured surface on white.
    ///
    /// # Errors
    /// [`DrawError::BadField`] if its lists do not match or contain NaN; otherwise the errors of [`Raster::frame`].
    pub fn colored_frame(
        &self,
        surface: &ColoredSurface,
        view: &View,
    ) -> Result<Picture, DrawError> {
        view.validate().map_err(PhotoError::from)?;
        check_values(0, &surface.positions, &surface.triangles, &surface.values)?;
        let (width, height) = self.size();
        let high = height as f32;
        let row = TEXT * high;
        let text = |at: [f32; 2], text: &str| Label {
            at,
            height: row,
            text: text.into(),
        };
        let captions = (0_u8..).zip(&surface.captions);
        let mut labels: Vec<Label> = captions
            .map(|(line, caption)| text([0.5 * row, (0.4 + 1.2 * f32::from(line)) * row], caption))
            .collect();
        let [left, long, thick] = BAR.map(|share| share * high);
        let top = high - left - thick;
        let [least, most, what] = &surface.legend;
        labels.push(text([left, top - 1.25 * row], what));
        labels.push(text([left + long + 0.4 * row, top - 0.1 * row], most));
        labels.push(text([0.2 * left, top - 0.1 * row], least));
        let mut drawn = draw(Shot {
            subject: Subject::Field(Field {
                positions: surface.positions.clone(),
                triangles: surface.triangles.clone(),
                values: surface.values.clone(),
                lines: surface.lines.clone(),
            }),
            view: *view,
            labels,
            width,
            height,
        })?;
        for column in 0..long as u32 {
            let color = Rgb(color_of(column as f32 / (long - 1.0)));
            for line in 0..thick as u32 {
                let (x, y) = (left as u32 + column, top as u32 + line);
                if x < width && y < height {
                    drawn.put_pixel(x, y, color);
                }
            }
        }
        Ok(drawn.into())
    }
}
