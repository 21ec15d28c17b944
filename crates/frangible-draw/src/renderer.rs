//! The one thread that draws.
//!
//! kiss3d keeps its graphics context in thread-local storage and tears it down
//! with the last surface. Some of its caches outlive that and then point at
//! nothing: a second surface on the same thread panics, and so does dropping
//! one that never drew. So a single thread owns a single surface, resizes it as
//! needed, and lives as long as the process. Should the renderer panic all the
//! same, callers get an error.

use std::sync::OnceLock;
use std::sync::mpsc::{Sender, channel};
use std::thread;

use frangible_export::glam::Vec2;
use frangible_export::{Recording, View};
use image::RgbImage;
use kiss3d::color::Color;
use kiss3d::text::Font;
use kiss3d::window::{NumSamples, OffscreenSurface};

use crate::DrawError;
use crate::backdrop::furnish;
use crate::camera::StillCamera;
use crate::scale::halve;
use crate::stage::{StageUnits, has_glass, stage};

/// Pixels drawn per pixel of the picture, each way, where there is glass.
///
/// Multisampling smooths edges at a third of the cost, but the renderer draws
/// glass with a single sample, and its shards would look frayed.
pub(crate) const SUPERSAMPLING: u32 = 2;

/// Height of a label's line, pixels of the picture.
const LABEL_HEIGHT: f32 = 24.0;

/// A picture to draw, checked beforehand.
pub(crate) struct Shot {
    /// A recording of one frame.
    pub(crate) scene: Recording,
    pub(crate) view: View,
    pub(crate) label: String,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

type Job = (Shot, Sender<RgbImage>);

/// Has a picture drawn and waits for it.
pub(crate) fn draw(shot: Shot) -> Result<RgbImage, DrawError> {
    static QUEUE: OnceLock<Sender<Job>> = OnceLock::new();
    let queue = QUEUE.get_or_init(|| {
        let (queue, jobs) = channel::<Job>();
        thread::spawn(move || {
            let mut surface = None;
            for (shot, reply) in jobs {
                let surface = surface.get_or_insert_with(|| open(&shot));
                // Nobody waits for a picture whose asker has gone.
                let _ = reply.send(photograph(surface, &shot));
            }
        });
        queue
    });
    let (reply, picture) = channel();
    queue.send((shot, reply)).map_err(|_| DrawError::Renderer)?;
    picture.recv().map_err(|_| DrawError::Renderer)
}

/// How the edges of a shot are smoothed.
fn sampling(shot: &Shot) -> (u32, NumSamples) {
    let surfaces = &shot.scene.surfaces;
    let mut parts = shot.scene.meshes.iter().flat_map(|mesh| &mesh.parts);
    if parts.any(|part| surfaces[part.surface].transmission > 0.0) {
        (SUPERSAMPLING, NumSamples::One)
    } else {
        (1, NumSamples::Four)
    }
}

fn open(shot: &Shot) -> OffscreenSurface {
    let mut surface = pollster::block_on(OffscreenSurface::new(shot.width, shot.height));
    furnish(&mut surface);
    surface
}

fn photograph(surface: &mut OffscreenSurface, shot: &Shot) -> RgbImage {
    let (factor, samples) = sampling(shot);
    let (width, height) = (factor * shot.width, factor * shot.height);
    if surface.samples() != samples as u32 {
        surface.set_samples(samples);
    }
    if (surface.width(), surface.height()) != (width, height) {
        surface.resize(width, height);
    }
    // The floor has its shadow without. On things, a map gives glass the shadow
    // of clay, and costs most of the time.
    surface.set_shadows_enabled(!has_glass(&shot.scene));
    let view = StageUnits::of(&shot.view).view(&shot.view);
    let mut camera = StillCamera::new(&view, width as f32 / height as f32);
    let line = LABEL_HEIGHT * factor as f32;
    let ink = Color::new(0.06, 0.07, 0.08, 1.0);
    let window = surface.window_mut();
    window.draw_text(
        &shot.label,
        Vec2::splat(0.55 * line),
        line,
        &Font::default(),
        ink,
    );
    let mut scene = stage(&shot.scene, &shot.view);
    let drawn = pollster::block_on(surface.render_image_3d(&mut scene, &mut camera));
    if factor == 1 { drawn } else { halve(&drawn) }
}
