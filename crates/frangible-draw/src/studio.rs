//! One frame of a recording as a picture.

use std::sync::Arc;

use frangible_export::{Recording, View};
use image::RgbImage;

use crate::DrawError;
use crate::adapter::texture_limit;
use crate::field::Field;
use crate::photo::Photograph;
use crate::renderer::{Label, SUPERSAMPLING, Shot, Subject, draw};

/// Told after each path of light how many there are per pixel; says whether to go on.
pub type GoOn = Arc<dyn Fn(u32) -> bool + Send + Sync>;

/// The longest side of a picture, pixels: each pixel takes a quarter of a kilobyte while light is followed.
const LARGEST: u32 = 4096;

/// Height of a label's line, pixels of the picture.
const LABEL_HEIGHT: f32 = 24.0;

/// Draws frames of one size.
///
/// All studios of a process share one renderer, which starts with the first
/// frame; that one takes about a second longer than the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Studio {
    width: u32,
    height: u32,
}

impl Studio {
    /// A studio for pictures of `width` × `height` pixels.
    ///
    /// # Errors
    ///
    /// [`DrawError::NoAdapter`] without a graphics driver,
    /// [`DrawError::BadSize`] if a side has less than 16 or more than 4096 pixels, or more than the adapter can hold.
    pub fn new(width: u32, height: u32) -> Result<Self, DrawError> {
        let limit = (texture_limit()? / SUPERSAMPLING).min(LARGEST);
        if !(16..=limit).contains(&width) || !(16..=limit).contains(&height) {
            return Err(DrawError::BadSize {
                width,
                height,
                limit,
            });
        }
        Ok(Self { width, height })
    }

    /// Width and height of its pictures, pixels.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// Draws one frame by following light, within seconds; a label, if not empty, stands in the upper left corner.
    ///
    /// # Errors
    ///
    /// [`DrawError::Recording`] if the recording or the view is not sound,
    /// [`DrawError::NoSuchFrame`] beyond its end, [`DrawError::Renderer`] if
    /// the renderer failed.
    pub fn frame(
        &self,
        recording: &Recording,
        frame: usize,
        view: &View,
        label: &str,
    ) -> Result<RgbImage, DrawError> {
        let still = self.checked(recording, frame, view)?;
        let mut photograph = Photograph::new(&still, view, self.width, self.height);
        photograph.expose();
        let mut picture = photograph.picture();
        if !label.is_empty() {
            self.write(&mut picture, label)?;
        }
        Ok(picture)
    }

    /// Draws one frame of a film: without a label, and the shadow as of things on the move, in a twentieth of the time.
    ///
    /// # Errors
    ///
    /// Those of [`Studio::frame`].
    pub fn film_frame(
        &self,
        recording: &Recording,
        frame: usize,
        view: &View,
    ) -> Result<RgbImage, DrawError> {
        self.film_frame_between(recording, frame as f64, view)
    }

    /// [`Studio::film_frame`] between two frames, where things are on their way from the one to the other: for slow motion.
    ///
    /// # Errors
    ///
    /// Those of [`Studio::frame`].
    pub fn film_frame_between(
        &self,
        recording: &Recording,
        frame: f64,
        view: &View,
    ) -> Result<RgbImage, DrawError> {
        let shot = self.between(recording, frame, view)?;
        draw(Shot {
            subject: Subject::Recording(Box::new(shot)),
            view: *view,
            labels: Vec::new(),
            width: self.width,
            height: self.height,
        })
    }

    /// [`Studio::frame`] between two frames, for films that follow light: half a minute of processor time for a second of 480 × 270 pixels.
    ///
    /// # Errors
    ///
    /// Those of [`Studio::frame`].
    pub fn frame_between(
        &self,
        recording: &Recording,
        frame: f64,
        view: &View,
    ) -> Result<RgbImage, DrawError> {
        let shot = self.between(recording, frame, view)?;
        let mut photograph = Photograph::new(&shot, view, self.width, self.height);
        photograph.expose();
        Ok(photograph.picture())
    }

    /// A recording of one moment between two frames.
    fn between(
        &self,
        recording: &Recording,
        frame: f64,
        view: &View,
    ) -> Result<Recording, DrawError> {
        let first = frame.max(0.0) as usize;
        let mut shot = self.checked(recording, first, view)?;
        let share = (frame - first as f64).clamp(0.0, 1.0) as f32;
        let seen = (0..recording.nodes.len())
            .filter(|&node| recording.nodes[node].visible.contains(&first));
        for (node, still) in seen.zip(&mut shot.nodes) {
            if recording.nodes[node].visible.contains(&(first + 1)) {
                let (from, to) = (still.poses[0], recording.pose(node, first + 1));
                still.poses[0].translation = from.translation.lerp(to.translation, share);
                still.poses[0].rotation = from.rotation.slerp(to.rotation, share);
            }
        }
        Ok(shot)
    }

    /// Draws one frame as [`Studio::frame`] does, with so many paths of light per pixel. `go_on` gets their number so far and says
    /// whether to go on; a path per pixel of 1280 × 800 takes one to three seconds of processor time.
    ///
    /// # Errors
    ///
    /// Those of [`Studio::frame`]; [`DrawError::Cancelled`] if `go_on` said no.
    pub fn traced(
        &self,
        recording: &Recording,
        frame: usize,
        view: &View,
        samples: u32,
        go_on: GoOn,
    ) -> Result<RgbImage, DrawError> {
        let still = self.checked(recording, frame, view)?;
        let mut photograph = Photograph::new(&still, view, self.width, self.height);
        for path in 1..=samples.max(1) {
            photograph.add(1, false);
            if !go_on(path) {
                return Err(DrawError::Cancelled);
            }
        }
        Ok(photograph.picture())
    }

    /// Writes a line into the upper left corner.
    fn write(&self, picture: &mut RgbImage, text: &str) -> Result<(), DrawError> {
        let height = (2.2 * LABEL_HEIGHT) as u32;
        let drawn = draw(Shot {
            subject: Subject::Field(Field::default()),
            view: View::default(),
            labels: vec![Label {
                at: [0.55 * LABEL_HEIGHT; 2],
                height: LABEL_HEIGHT,
                text: text.into(),
            }],
            width: self.width,
            height,
        })?;
        let paper = f32::from(drawn.get_pixel(self.width - 1, height - 1).0[0]);
        for (x, y, pixel) in drawn.enumerate_pixels() {
            let inked = (1.0 - f32::from(pixel.0[0]) / paper.max(1.0)).clamp(0.0, 1.0);
            if inked > 0.0 && y < self.height {
                for code in &mut picture.get_pixel_mut(x, y).0 {
                    *code = (f32::from(*code) * (1.0 - inked) + 240.0 * inked) as u8;
                }
            }
        }
        Ok(())
    }

    fn checked(
        &self,
        recording: &Recording,
        frame: usize,
        view: &View,
    ) -> Result<Recording, DrawError> {
        recording.validate()?;
        view.validate()?;
        let count = recording.frame_count;
        if frame >= count {
            return Err(DrawError::NoSuchFrame { frame, count });
        }
        Ok(still(recording, frame))
    }
}

/// Draws one frame of a recording, seen from `view`, `width` × `height` pixels.
///
/// # Errors
///
/// What [`Studio::new`] and [`Studio::frame`] refuse.
pub fn render_frame(
    recording: &Recording,
    frame: usize,
    view: &View,
    width: u32,
    height: u32,
) -> Result<RgbImage, DrawError> {
    Studio::new(width, height)?.frame(recording, frame, view, "")
}

/// A recording of this one frame, with nothing but what can be seen in it.
fn still(recording: &Recording, frame: usize) -> Recording {
    let mut still = Recording {
        frame_rate: recording.frame_rate,
        frame_count: 1,
        surfaces: recording.surfaces.clone(),
        floor: recording.floor,
        camera: recording.camera,
        ..Recording::default()
    };
    for (index, node) in recording.nodes.iter().enumerate() {
        if !node.visible.contains(&frame) {
            continue;
        }
        let mut seen = frangible_export::RecordedNode {
            mesh: still.meshes.len(),
            visible: 0..1,
            ..Default::default()
        };
        seen.poses.push(recording.pose(index, frame));
        still.nodes.push(seen);
        still.meshes.push(recording.meshes[node.mesh].clone());
    }
    still
}
