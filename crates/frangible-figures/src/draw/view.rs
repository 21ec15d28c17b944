//! Where to look from.

use frangible::glam::Vec3;
use frangible_draw::{DrawError, RgbImage, Studio};
use frangible_export::View;

use super::Model;

/// A direction to look from, and the size of the picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    /// From what is looked at towards the camera.
    pub(crate) from: Vec3,
    pub(crate) up: Vec3,
    /// Pixels.
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// Vertical field of view, rad: long enough a lens that parallels look parallel.
const FIELD: f32 = 0.35;

/// Free around what is shown, as a share of its size.
const MARGIN: f32 = 1.05;

impl Look {
    /// Draws the model so that it fills the picture, below a label.
    pub(crate) fn at(&self, model: &Model, label: &str) -> Result<RgbImage, DrawError> {
        let points: Vec<Vec3> = model.points().collect();
        self.draw(model, &self.fit(&points), label)
    }

    /// Draws the model so that these points fill the picture.
    pub(crate) fn at_points(
        &self,
        model: &Model,
        points: &[Vec3],
        label: &str,
    ) -> Result<RgbImage, DrawError> {
        self.draw(model, &self.fit(points), label)
    }

    fn draw(&self, model: &Model, view: &View, label: &str) -> Result<RgbImage, DrawError> {
        Studio::new(self.width, self.height)?.frame(&model.recording(), 0, view, label)
    }

    fn fit(&self, points: &[Vec3]) -> View {
        let back = self.from.normalize_or(Vec3::Z);
        let right = self.up.cross(back).normalize_or(Vec3::X);
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
        let aspect = self.width as f32 / self.height as f32;
        let distance = points
            .iter()
            .map(|&p| {
                let d = p - target;
                let across = (d.dot(right).abs() / aspect).max(d.dot(up).abs());
                MARGIN * across / tangent + d.dot(back)
            })
            .fold(1e-3, f32::max);
        View {
            eye: target + back * distance,
            target,
            up: self.up,
            vertical_fov: FIELD,
        }
    }
}
