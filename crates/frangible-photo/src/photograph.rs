//! A picture that rays of light are added to.

use frangible_recording::glam::Vec3A;
use frangible_recording::{Recording, View};
use rayon::prelude::*;

use crate::Picture;
use crate::exposure::{develop, tone};
use crate::path::{Seen, Traced};
use crate::random::Random;
use crate::set::Set;
use crate::smooth::smoothed;
use crate::stage::StageUnits;

/// Paths per pixel that every pixel gets, and the most that a noisy one gets.
const FIRST_PATHS: u32 = 3;
const MOST_PATHS: u32 = 9;

/// Paths between two looks at a pixel's noise.
const ROUND: u32 = 3;

/// A pixel whose brightness is known to this is done, of the white of the picture.
const QUIET: f32 = 0.020;

/// Sums of the paths through one pixel.
#[derive(Clone, Copy, Default)]
struct Pixel {
    /// Sums over all paths.
    seen: Seen,
    /// Sum of squares of the brightness on the picture.
    squares: f32,
    tones: f32,
    paths: u32,
}

/// A picture that paths are added to.
pub(crate) struct Photograph {
    set: Set,
    camera: Camera,
    pixels: Vec<Pixel>,
    width: u32,
    height: u32,
}

impl Photograph {
    /// A picture of the recording's first frame without any path yet.
    pub(crate) fn new(recording: &Recording, view: &View, width: u32, height: u32) -> Self {
        let units = StageUnits::of(view);
        Self {
            set: Set::new(recording, view, units),
            camera: Camera::new(&units.view(view), width, height),
            pixels: vec![Pixel::default(); width as usize * height as usize],
            width,
            height,
        }
    }

    /// Adds the paths of a quick picture.
    pub(crate) fn expose(&mut self) {
        self.add(FIRST_PATHS, false);
        for _ in (FIRST_PATHS..MOST_PATHS).step_by(ROUND as usize) {
            self.add(ROUND, true);
        }
    }

    /// Adds paths to each pixel, or to those alone that are noisy.
    pub(crate) fn add(&mut self, paths: u32, noisy_alone: bool) {
        let wanted = noisy_alone.then(|| self.noisy());
        let (set, camera, width) = (&self.set, &self.camera, self.width);
        let rows = self.pixels.par_chunks_mut(width as usize).enumerate();
        rows.for_each(|(row, pixels)| {
            for (column, pixel) in pixels.iter_mut().enumerate() {
                let at = row * width as usize + column;
                if wanted.as_ref().is_some_and(|wanted| !wanted[at]) {
                    continue;
                }
                for _ in 0..paths {
                    let mut random = Random::new(at as u32, pixel.paths);
                    let ray = camera.ray(column as u32, row as u32, &mut random);
                    pixel.take(Traced { set }.seen(ray, &mut random));
                }
            }
        });
    }

    /// Pixels that are noisy, or have such a neighbour: an edge may have been missed there.
    fn noisy(&self) -> Vec<bool> {
        let own: Vec<bool> = self.pixels.iter().map(Pixel::is_noisy).collect();
        let (width, height) = (self.width as usize, self.height as usize);
        let around = |at: usize| {
            let (x, y) = (at % width, at / width);
            own[at]
                || (x > 0 && own[at - 1])
                || (x + 1 < width && own[at + 1])
                || (y > 0 && own[at - width])
                || (y + 1 < height && own[at + width])
        };
        (0..own.len()).map(around).collect()
    }

    /// The picture as it is.
    pub(crate) fn picture(&self) -> Picture {
        let means: Vec<Seen> = self.pixels.iter().map(Pixel::mean).collect();
        let light = smoothed(&means, self.width as usize);
        develop(&light, self.width, self.height)
    }
}

impl Pixel {
    fn take(&mut self, seen: Seen) {
        let tone = tone(seen.light + seen.lit);
        self.seen.add(&seen);
        self.tones += tone;
        self.squares += tone * tone;
        self.paths += 1;
    }

    fn mean(&self) -> Seen {
        self.seen.scaled((self.paths.max(1) as f32).recip())
    }

    /// Returns true if the mean brightness is not yet known well enough. Evenly lit parts are smoothed later, so they may be three times as noisy.
    fn is_noisy(&self) -> bool {
        let count = self.paths.max(1) as f32;
        let mean = self.tones / count;
        let variance = (self.squares / count - mean * mean).max(0.0);
        let smoothable = self.seen.matt / count;
        (variance / count).sqrt() > QUIET * (1.0 + 2.0 * smoothable)
    }
}

/// Origin and directions of the rays through pixels.
struct Camera {
    eye: Vec3A,
    forward: Vec3A,
    right: Vec3A,
    down: Vec3A,
    size: [f32; 2],
}

impl Camera {
    /// `view` in stage units.
    fn new(view: &View, width: u32, height: u32) -> Self {
        let forward = (view.target - view.eye).normalize();
        let right = forward.cross(view.up).normalize();
        let half_height = (0.5 * view.vertical_fov).tan();
        let half_width = half_height * width as f32 / height as f32;
        Self {
            eye: view.eye.into(),
            forward: forward.into(),
            right: (right * half_width).into(),
            down: (forward.cross(right) * half_height).into(),
            size: [width as f32, height as f32],
        }
    }

    fn ray(&self, column: u32, row: u32, random: &mut Random) -> (Vec3A, Vec3A) {
        // A tent over the neighbouring pixels: edges come out smoother than over the pixel's own square.
        let jitter = |u: f32| {
            if u < 0.5 {
                (2.0 * u).sqrt() - 1.0
            } else {
                1.0 - (2.0 - 2.0 * u).sqrt()
            }
        };
        let [u, v] = random.pair();
        let x = 2.0 * (column as f32 + 0.5 + 0.8 * jitter(u)) / self.size[0] - 1.0;
        let y = 2.0 * (row as f32 + 0.5 + 0.8 * jitter(v)) / self.size[1] - 1.0;
        let along = (self.forward + x * self.right + y * self.down).normalize();
        (self.eye, along)
    }
}
