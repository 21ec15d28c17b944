//! The off-screen surface with its backdrop, ready for one frame after another.

use frangible_export::glam::Vec2;
use frangible_export::{Recording, View};
use image::{DynamicImage, Rgb32FImage, RgbImage};
use kiss3d::color::Color;
use kiss3d::light::Fog;
use kiss3d::text::Font;
use kiss3d::window::OffscreenSurface;

use crate::adapter::texture_limit;
use crate::camera::StillCamera;
use crate::scale::halve;
use crate::stage::{SHADOW_LAYERS, StageUnits, stage};
use crate::DrawError;

/// The backdrop, linear; the floor fades into it.
const BACKDROP: [f32; 3] = [0.60, 0.62, 0.65];

/// Pixels drawn per pixel of the picture, each way.
const SUPERSAMPLING: u32 = 2;

/// Height of a label's letters, pixels of the picture.
const LABEL_HEIGHT: f32 = 24.0;

/// Draws frames of one size, one after another; making a studio costs about as
/// much as a frame, so keep it.
pub struct Studio {
    surface: OffscreenSurface,
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
            return Err(DrawError::BadSize { width, height, limit });
        }
        let drawn = (SUPERSAMPLING * width, SUPERSAMPLING * height);
        let mut surface = pollster::block_on(OffscreenSurface::new(drawn.0, drawn.1));
        furnish(&mut surface);
        Ok(Self { surface, width, height })
    }

    /// Draws one frame; a label, if not empty, stands in the upper left corner.
    ///
    /// # Errors
    ///
    /// [`DrawError::Recording`] if the recording or the view is not sound,
    /// [`DrawError::NoSuchFrame`] beyond its end.
    pub fn frame(
        &mut self,
        recording: &Recording,
        frame: usize,
        view: &View,
        label: &str,
    ) -> Result<RgbImage, DrawError> {
        recording.validate()?;
        view.validate()?;
        if frame >= recording.frame_count {
            return Err(DrawError::NoSuchFrame { frame, count: recording.frame_count });
        }
        let units = StageUnits::of(view);
        let aspect = self.width as f32 / self.height as f32;
        let mut camera = StillCamera::new(&units.view(view), aspect);
        let pixels = SUPERSAMPLING as f32;
        self.surface.window_mut().draw_text(
            label,
            Vec2::splat(0.55 * LABEL_HEIGHT * pixels),
            LABEL_HEIGHT * pixels,
            &Font::default(),
            Color::new(0.06, 0.07, 0.08, 1.0),
        );
        // Dropped at the end of this call, before the surface can be: the other
        // way round the renderer panics.
        let mut scene = stage(recording, frame, view);
        let drawn = self.surface.render_image_3d(&mut scene, &mut camera);
        Ok(halve(&pollster::block_on(drawn)))
    }
}

/// Draws one frame of a recording, seen from `view`, `width` × `height` pixels.
/// For several frames of one size, [`Studio::frame`] saves the setting up.
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

fn furnish(surface: &mut OffscreenSurface) {
    let [red, green, blue] = BACKDROP;
    let backdrop = Color::new(red, green, blue, 1.0);
    surface.set_background_color(backdrop);
    surface.set_shadow_resolution(1024);
    surface.set_shadow_atlas_layers(SHADOW_LAYERS);
    surface.set_shadow_softness(2.5);
    let window = surface.window_mut();
    window.set_skybox_image(&surroundings());
    window.set_fog(Fog::linear(backdrop, 9.0, 24.0));
    // Shards behind shards: each step shows one more layer of glass.
    window.transmission_settings_mut().steps = 3;
    window.set_ssao_enabled(true);
    let occlusion = window.ssao_settings_mut();
    occlusion.radius = 0.25;
    occlusion.bias = 0.01;
}

/// What shines and mirrors around the stage, as an equirectangular picture: the
/// backdrop at the horizon, a pale ceiling with a soft box, a dim ground.
fn surroundings() -> DynamicImage {
    const WIDTH: u32 = 128;
    const HEIGHT: u32 = 64;
    DynamicImage::ImageRgb32F(Rgb32FImage::from_fn(WIDTH, HEIGHT, |x, y| {
        let up = 1.0 - 2.0 * (y as f32 + 0.5) / HEIGHT as f32;
        let around = (x as f32 + 0.5) / WIDTH as f32;
        let soft_box = (0.35..0.8).contains(&up) && (around * 4.0).fract() < 0.4;
        let light = if soft_box {
            2.6
        } else if up > 0.0 {
            1.0 + 0.35 * up
        } else {
            1.0 + 0.6 * up
        };
        image::Rgb(BACKDROP.map(|part| part * light))
    }))
}
