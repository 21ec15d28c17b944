//! Views of the figures.

use frangible::glam::{Quat, Vec3};
use frangible_photo::{PhotoError, Studio};
use frangible_recording::View;
use image::RgbImage;

use super::Model;

/// A direction to look from, and the size of the picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    /// Direction from the subject towards the camera.
    pub(crate) from: Vec3,
    pub(crate) up: Vec3,
    /// Pixels.
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// Vertical field of view, rad: long enough a lens that parallels look parallel.
const FIELD: f32 = 0.35;

/// Free margin around the subject, as a share of its size.
const MARGIN: f32 = 1.05;

/// Height of the strip that a label takes, pixels.
const HEADING: f32 = 40.0;

impl Look {
    /// Draws the model so that it fills the picture, below a label.
    pub(crate) fn at(&self, model: &Model, label: &str) -> Result<RgbImage, PhotoError> {
        let points: Vec<Vec3> = model.points().collect();
        self.at_points(model, &points, label)
    }

    /// Draws the model so that these points fill the picture.
    pub(crate) fn at_points(
        &self,
        model: &Model,
        points: &[Vec3],
        label: &str,
    ) -> Result<RgbImage, PhotoError> {
        // Lamps and surroundings are set up for y upwards.
        let turn = Quat::from_rotation_arc(self.up.normalize_or(Vec3::Y), Vec3::Y);
        let turned: Vec<Vec3> = points.iter().map(|&p| turn * p).collect();
        let heading = if label.is_empty() { 0.0 } else { HEADING };
        let view = self.fit(&turned, turn * self.from, heading);
        let studio = Studio::new(self.width, self.height)?;
        Ok(studio
            .frame(&model.recording(turn), 0, &view, label)?
            .into())
    }

    /// The view from `from`, y upwards, in which the points fill the space that the heading leaves.
    fn fit(&self, points: &[Vec3], from: Vec3, heading: f32) -> View {
        let back = from.normalize_or(Vec3::Z);
        let right = Vec3::Y.cross(back).normalize_or(Vec3::X);
        let up = back.cross(right);
        let axes = [right, up, back];
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for p in points {
            let p = Vec3::from_array(axes.map(|axis| axis.dot(*p)));
            (low, high) = (low.min(p), high.max(p));
        }
        let middle = 0.5 * (low + high);
        let target = right * middle.x + up * middle.y + back * middle.z;
        let tangent = (0.5 * FIELD).tan();
        let (width, height) = (self.width as f32, self.height as f32);
        let free = (height - heading) / height;
        let distance = points
            .iter()
            .map(|&p| {
                let d = p - target;
                let across = (d.dot(right).abs() * height / width).max(d.dot(up).abs() / free);
                MARGIN * across / tangent + d.dot(back)
            })
            .fold(1e-3, f32::max);
        let target = target + up * (distance * tangent * heading / height);
        View {
            eye: target + back * distance,
            target,
            up: Vec3::Y,
            vertical_fov: FIELD,
        }
    }
}
