//! Frames of films, drawn with the graphics driver.

use frangible_photo::internals::moment_between;
use frangible_photo::{PhotoError, Picture};
use frangible_recording::{Recording, View};

use crate::DrawError;
use crate::adapter::texture_limit;
use crate::renderer::{SUPERSAMPLING, Shot, Subject, draw};

/// The longest side of a picture, pixels.
const LARGEST: u32 = 4096;

/// Renderer for frames of one size with the graphics driver, twenty times as fast as path tracing.
///
/// All rasters of a process share one renderer, which starts with the first frame; that frame takes about a second longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Raster {
    width: u32,
    height: u32,
}

impl Raster {
    /// Makes a raster for pictures of `width` × `height` pixels.
    ///
    /// # Errors
    ///
    /// [`DrawError::NoAdapter`] without a graphics driver,
    /// [`PhotoError::BadSize`] if a side has less than 16 or more than 4096 pixels, or more than the adapter can hold.
    pub fn new(width: u32, height: u32) -> Result<Self, DrawError> {
        let limit = (texture_limit()? / SUPERSAMPLING).min(LARGEST);
        if !(16..=limit).contains(&width) || !(16..=limit).contains(&height) {
            return Err(PhotoError::BadSize {
                width,
                height,
                limit,
            }
            .into());
        }
        Ok(Self { width, height })
    }

    /// Width and height of its pictures, pixels.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// Draws a recording at a frame, or interpolated between two frames.
    ///
    /// # Errors
    ///
    /// [`PhotoError::Recording`] if the recording or the view is invalid, [`PhotoError::NoSuchFrame`] beyond its end,
    /// [`DrawError::Renderer`] if the renderer failed.
    pub fn frame(
        &self,
        recording: &Recording,
        frame: f64,
        view: &View,
    ) -> Result<Picture, DrawError> {
        let moment = moment_between(recording, frame, view)?;
        let drawn = draw(Shot {
            subject: Subject::Recording(Box::new(moment)),
            view: *view,
            labels: Vec::new(),
            width: self.width,
            height: self.height,
        })?;
        Ok(drawn.into())
    }
}
