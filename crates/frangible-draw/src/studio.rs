//! One frame of a recording as a picture.

use frangible_export::{Recording, View};
use image::RgbImage;

use crate::DrawError;
use crate::adapter::texture_limit;
use crate::floor_shadow::Fineness;
use crate::renderer::{Label, SUPERSAMPLING, Shot, Subject, draw};
use crate::traced::{GoOn, Tracing};

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
    /// [`DrawError::BadSize`] if the adapter cannot hold such a picture.
    pub fn new(width: u32, height: u32) -> Result<Self, DrawError> {
        let limit = texture_limit()? / SUPERSAMPLING;
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

    /// Draws one frame; a label, if not empty, stands in the upper left corner.
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
        draw(Shot {
            subject: Subject::Recording(still, Fineness::STILL),
            view: *view,
            labels: vec![Label {
                at: [0.55 * LABEL_HEIGHT; 2],
                height: LABEL_HEIGHT,
                text: label.into(),
            }],
            width: self.width,
            height: self.height,
        })
    }

    /// Draws one frame of a film: without a label, and the shadow as of things on the move, in a twentieth of the time.
    ///
    /// # Errors
    ///
    /// As [`Studio::frame`].
    pub fn film_frame(
        &self,
        recording: &Recording,
        frame: usize,
        view: &View,
    ) -> Result<RgbImage, DrawError> {
        let still = self.checked(recording, frame, view)?;
        self.shoot(Subject::Recording(still, Fineness::MOVING), view)
    }

    /// [`Studio::film_frame`] between two frames, where things are on their way from the one to the other: for slow motion.
    ///
    /// # Errors
    ///
    /// As [`Studio::frame`].
    pub fn film_frame_between(
        &self,
        recording: &Recording,
        frame: f64,
        view: &View,
    ) -> Result<RgbImage, DrawError> {
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
        self.shoot(Subject::Recording(shot, Fineness::MOVING), view)
    }

    /// Path-traces one frame: light goes its own ways, through glass and around corners. `go_on` gets the samples per pixel so
    /// far and says whether to go on; a software driver takes three seconds for a sample of 640 × 400 pixels.
    ///
    /// # Errors
    ///
    /// As [`Studio::frame`]; [`DrawError::Cancelled`] if `go_on` said no.
    pub fn traced(
        &self,
        recording: &Recording,
        frame: usize,
        view: &View,
        samples: u32,
        go_on: GoOn,
    ) -> Result<RgbImage, DrawError> {
        let still = self.checked(recording, frame, view)?;
        self.shoot(Subject::Traced(still, Tracing { samples, go_on }), view)
    }

    fn shoot(&self, subject: Subject, view: &View) -> Result<RgbImage, DrawError> {
        draw(Shot {
            subject,
            view: *view,
            labels: Vec::new(),
            width: self.width,
            height: self.height,
        })
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
/// As [`Studio::new`] and [`Studio::frame`].
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
