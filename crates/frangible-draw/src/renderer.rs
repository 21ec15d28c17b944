//! The drawing thread.
//!
//! kiss3d keeps its graphics context in thread-local storage and destroys it with the last surface. Some of its caches outlive the context and
//! then dangle: a second surface on the same thread panics, and so does dropping a surface that never drew. So a single thread owns a
//! single surface, resizes it as needed, and lives as long as the process. If the renderer panics nevertheless, callers get an error.

use std::sync::OnceLock;
use std::sync::mpsc::{Sender, channel};
use std::thread;

use frangible_photo::internals::StageUnits;
use frangible_recording::glam::Vec2;
use frangible_recording::{Recording, View};
use image::RgbImage;
use kiss3d::color::Color;
use kiss3d::text::Font;
use kiss3d::window::{NumSamples, OffscreenSurface};

use crate::DrawError;
use crate::backdrop::{furnish, surround};
use crate::camera::StillCamera;
use crate::field::{Field, field_scene};
use crate::scale::halve;
use crate::stage::{has_glass, refracts, stage};

/// Pixels drawn per pixel of the picture, each way, where there is glass.
///
/// Multisampling smooths edges at a third of the cost, but the renderer draws
/// glass with a single sample, and its shards would look frayed.
pub(crate) const SUPERSAMPLING: u32 = 2;

/// A picture to draw, checked beforehand.
pub(crate) struct Shot {
    pub(crate) subject: Subject,
    pub(crate) view: View,
    pub(crate) labels: Vec<Label>,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// Subject of a shot.
pub(crate) enum Subject {
    /// A recording of one frame, as of a film.
    Recording(Box<Recording>),
    /// A surface coloured by numbers.
    Field(Field),
}

/// A line of text, pixels of the picture.
pub(crate) struct Label {
    /// Its upper left corner, from that of the picture.
    pub(crate) at: [f32; 2],
    pub(crate) height: f32,
    pub(crate) text: String,
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

/// Smoothing of the edges of a shot: supersampling factor and number of samples.
fn sampling(shot: &Shot) -> (u32, NumSamples) {
    let scene = match &shot.subject {
        Subject::Recording(scene) => scene,
        Subject::Field(_) => return (1, NumSamples::Four),
    };
    let surfaces = &scene.surfaces;
    let mut parts = scene.meshes.iter().flat_map(|mesh| &mesh.parts);
    if parts.any(|part| refracts(&surfaces[part.surface])) {
        (SUPERSAMPLING, NumSamples::One)
    } else {
        (1, NumSamples::Four)
    }
}

fn open(shot: &Shot) -> OffscreenSurface {
    let mut surface = pollster::block_on(OffscreenSurface::new(shot.width, shot.height));
    furnish(surface.window_mut());
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
    // The floor brings its own shadow. On things, a shadow map gives glass the shadow of clay, and costs most of the time. Colours that stand for
    // numbers need no shadow.
    let shadows = match &shot.subject {
        Subject::Recording(scene) => !has_glass(scene),
        Subject::Field(_) => false,
    };
    surface.set_shadows_enabled(shadows);
    let view = StageUnits::of(&shot.view).view(&shot.view);
    let mut camera = StillCamera::new(&view, width as f32 / height as f32);
    let ink = Color::new(0.06, 0.07, 0.08, 1.0);
    let window = surface.window_mut();
    surround(window, !matches!(shot.subject, Subject::Field(_)));
    for label in &shot.labels {
        let [at, line] =
            [Vec2::from(label.at), Vec2::splat(label.height)].map(|v| factor as f32 * v);
        window.draw_text(&label.text, at, line.y, &Font::default(), ink);
    }
    let mut scene = match &shot.subject {
        Subject::Recording(scene) => stage(scene, &shot.view),
        Subject::Field(field) => field_scene(field, &shot.view),
    };
    let drawn = pollster::block_on(surface.render_image_3d(&mut scene, &mut camera));
    if factor == 1 { drawn } else { halve(&drawn) }
}
