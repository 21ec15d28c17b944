//! Energy lost in a run, and the part of it radiated as sound.

use std::f64::consts::PI;

use frangible::glam::Vec3;
use frangible_sound::glam::DVec3;
use frangible_sound::{AIR_DENSITY, Listener, SPEED_OF_SOUND, SoundError, SynthConfig};

use super::{Sources, sound_of};
use crate::result::Run;
use crate::scene::Scene;

/// Microphones around a scene, and their distance from the camera's target, m: far beyond the size of the bodies.
const MICROPHONES: u32 = 32;
const AWAY: f64 = 5.0;

/// Gravity, m/s².
const GRAVITY: f64 = 9.81;

/// Returns the sound energy radiated by the selected sources, J, integrated over a sphere around the scene. The floor is omitted: there is no
/// sound from forces on it and no reflection.
///
/// # Errors
/// A value of the recording is invalid.
pub fn energy_radiated(run: &Run, scene: &Scene, sources: Sources) -> Result<f64, SoundError> {
    let centre = run.recording.camera.target.as_dvec3();
    let mut flow = 0.0;
    for i in 0..MICROPHONES {
        // Fibonacci's sphere: points that each have as much of it around them.
        let (n, turn) = (f64::from(i), PI * (3.0 - 5.0_f64.sqrt()));
        let z = 1.0 - 2.0 * (n + 0.5) / f64::from(MICROPHONES);
        let (sin, cos) = (turn * n).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        let place = centre + AWAY * DVec3::new(radius * cos, z, radius * sin);
        let listener = Listener {
            channels: 1,
            ..Listener::at(place, centre)
        };
        let config = SynthConfig::new(listener);
        let heard = sound_of(run, scene, &config, sources)?;
        let squares: f64 = heard.samples.iter().map(|&s| f64::from(s).powi(2)).sum();
        flow += squares / config.rate;
    }
    let area = 4.0 * PI * AWAY * AWAY;
    Ok(flow / f64::from(MICROPHONES) * area / (AIR_DENSITY * SPEED_OF_SOUND))
}

/// Returns the loss of translational kinetic energy and potential energy from the first to the last frame of a run, J.
#[must_use]
pub fn energy_lost(run: &Run) -> f64 {
    energy(run, 0) - energy(run, run.recording.frame_count.saturating_sub(1))
}

/// Energy of the visible things in a frame, J.
fn energy(run: &Run, frame: usize) -> f64 {
    let recording = &run.recording;
    let mut sum = 0.0;
    for (i, node) in recording.nodes.iter().enumerate() {
        if !node.visible.contains(&frame) {
            continue;
        }
        let at = |frame: usize| recording.pose(i, frame).translation;
        let moved: Vec3 = if node.visible.contains(&(frame + 1)) {
            at(frame + 1) - at(frame)
        } else if frame > node.visible.start {
            at(frame) - at(frame - 1)
        } else {
            Vec3::ZERO
        };
        let speed = f64::from(moved.length() * recording.frame_rate);
        let height = f64::from(at(frame).y);
        sum += run.soundings[i].mass() * (0.5 * speed * speed + GRAVITY * height);
    }
    sum
}
