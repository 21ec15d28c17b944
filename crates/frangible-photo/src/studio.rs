//! One frame of a recording as a picture.

use frangible_recording::{RecordedNode, Recording, View};

use crate::caption::write;
use crate::photograph::Photograph;
use crate::{PhotoError, Picture};

/// The longest side of a picture, pixels: each pixel takes a quarter of a kilobyte while light is followed.
const LARGEST: u32 = 4096;

/// Height of a label's line, and the colour of its letters.
const LABEL_HEIGHT: f32 = 24.0;
const INK: [u8; 3] = [240; 3];

/// Renderer for frames of one size.
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
    /// [`PhotoError::BadSize`] if a side has less than 16 or more than 4096 pixels.
    pub fn new(width: u32, height: u32) -> Result<Self, PhotoError> {
        if !(16..=LARGEST).contains(&width) || !(16..=LARGEST).contains(&height) {
            return Err(PhotoError::BadSize {
                width,
                height,
                limit: LARGEST,
            });
        }
        Ok(Self { width, height })
    }

    /// Path-traces one frame, which takes seconds. A non-empty label is drawn in the upper left corner.
    ///
    /// # Errors
    ///
    /// [`PhotoError::Recording`] if the recording or the view is invalid,
    /// [`PhotoError::NoSuchFrame`] beyond its end.
    pub fn frame(
        &self,
        recording: &Recording,
        frame: usize,
        view: &View,
        label: &str,
    ) -> Result<Picture, PhotoError> {
        let mut picture = self.frame_between(recording, frame as f64, view)?;
        let corner = [0.55 * LABEL_HEIGHT; 2];
        write(&mut picture, label, corner, LABEL_HEIGHT, INK);
        Ok(picture)
    }

    /// Like [`Studio::frame`], for a time between two frames, for path-traced films: half a minute of CPU time per second of film at 480 × 270 pixels.
    ///
    /// # Errors
    ///
    /// The same as [`Studio::frame`].
    pub fn frame_between(
        &self,
        recording: &Recording,
        frame: f64,
        view: &View,
    ) -> Result<Picture, PhotoError> {
        let shot = moment_between(recording, frame, view)?;
        let mut photograph = Photograph::new(&shot, view, self.width, self.height);
        photograph.expose();
        Ok(photograph.picture())
    }

    /// Like [`Studio::frame`], with `samples` paths per pixel. Calls `go_on` with the number of completed paths and stops if it returns false. One
    /// path per pixel at 1280 × 800 takes one to three seconds of CPU time.
    ///
    /// # Errors
    ///
    /// The same as [`Studio::frame`]; [`PhotoError::Cancelled`] if `go_on` returned false.
    pub fn traced(
        &self,
        recording: &Recording,
        frame: usize,
        view: &View,
        samples: u32,
        mut go_on: impl FnMut(u32) -> bool,
    ) -> Result<Picture, PhotoError> {
        let still = moment_between(recording, frame as f64, view)?;
        let mut photograph = Photograph::new(&still, view, self.width, self.height);
        for path in 1..=samples.max(1) {
            photograph.add(1, false);
            if !go_on(path) {
                return Err(PhotoError::Cancelled);
            }
        }
        Ok(photograph.picture())
    }
}

/// Draws one frame of a recording, seen from `view`, `width` × `height` pixels.
///
/// # Errors
///
/// The same as [`Studio::new`] and [`Studio::frame`].
pub fn render_frame(
    recording: &Recording,
    frame: usize,
    view: &View,
    width: u32,
    height: u32,
) -> Result<Picture, PhotoError> {
    Studio::new(width, height)?.frame(recording, frame, view, "")
}

/// Makes a recording of one moment with only the visible objects, interpolated between two frames.
///
/// # Errors
///
/// The same as [`Studio::frame`].
pub fn moment_between(
    recording: &Recording,
    frame: f64,
    view: &View,
) -> Result<Recording, PhotoError> {
    recording.validate()?;
    view.validate()?;
    let (frame, count) = (frame.max(0.0), recording.frame_count);
    let first = frame as usize;
    if first >= count {
        return Err(PhotoError::NoSuchFrame {
            frame: first,
            count,
        });
    }
    let share = (frame - first as f64).clamp(0.0, 1.0) as f32;
    let mut moment = Recording {
        frame_rate: recording.frame_rate,
        frame_count: 1,
        surfaces: recording.surfaces.clone(),
        images: recording.images.clone(),
        floor: recording.floor,
        camera: recording.camera,
        ..Recording::default()
    };
    for (index, node) in recording.nodes.iter().enumerate() {
        if !node.visible.contains(&first) {
            continue;
        }
        let mut pose = recording.pose(index, first);
        if share > 0.0 && node.visible.contains(&(first + 1)) {
            let next = recording.pose(index, first + 1);
            pose.translation = pose.translation.lerp(next.translation, share);
            pose.rotation = pose.rotation.slerp(next.rotation, share);
        }
        moment.nodes.push(RecordedNode {
            mesh: moment.meshes.len(),
            visible: 0..1,
            poses: vec![pose],
            ..RecordedNode::default()
        });
        moment.meshes.push(recording.meshes[node.mesh].clone());
    }
    Ok(moment)
}
