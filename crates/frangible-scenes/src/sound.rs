//! What a run sounds like: from its recording to samples.
//!
//! Each node is a body of the synthesiser. What struck it is in the recording: the force of each blow as the fracture found it, the cracks with
//! their times and energy, and where pieces touched, of which the impulse is known and the duration is Hertz'.

mod blows;
mod nodes;
mod touches;

use frangible::Material;
use frangible_sound::glam::DVec3;
use frangible_sound::{Listener, SoundError, SoundFloor, Synth, SynthConfig, SynthReport, wav};

use crate::result::Run;
use crate::scene::Scene;

use blows::blows;
use nodes::Nodes;
use touches::touches;

/// How long the last tone may ring on, s.
const RINGS_ON: f64 = 6.0;

/// What a run sounds like.
#[derive(Clone, Debug)]
pub struct Sounded {
    /// Samples from −1 to 1, left and right in turn.
    pub samples: Vec<f32>,
    /// How they were made.
    pub config: SynthConfig,
    /// What the synthesiser did.
    pub report: SynthReport,
    /// Wall-clock time of making bodies ready to sound, and of the samples, s.
    pub seconds: [f64; 2],
}

impl Sounded {
    /// The bytes of a WAV file.
    ///
    /// # Errors
    /// What [`wav`] refuses.
    pub fn wav(&self) -> Result<Vec<u8>, SoundError> {
        wav(
            &self.samples,
            self.config.listener.channels,
            self.config.rate,
        )
    }

    /// How long it is, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.samples.len() as f64 / (self.config.rate * self.config.listener.channels as f64)
    }

    /// Level of the loudest pressure, dB over 20 µPa.
    #[must_use]
    pub fn peak_level(&self) -> f64 {
        20.0 * (self.report.limiter.peak / 2e-5).max(1e-9).log10()
    }
}

/// How a run is listened to: with the ears where the camera of its recording is, above the floor of its scene.
#[must_use]
pub fn sound_config(run: &Run, scene: &Scene) -> SynthConfig {
    let camera = &run.recording.camera;
    let [eye, target] = [camera.eye, camera.target].map(|p| p.as_dvec3());
    let floor = scene.floor.as_ref().map(|_| {
        let stone = SoundFloor::stone(0.0);
        let material = floor_material(scene);
        material.map_or(stone, |material| SoundFloor {
            shear_modulus: material.shear_modulus(),
            poisson_ratio: material.poisson_ratio,
            ..stone
        })
    });
    SynthConfig {
        floor,
        ..SynthConfig::new(Listener::at(eye, target))
    }
}

/// What the floor of a scene is made of.
fn floor_material(scene: &Scene) -> Option<Material> {
    scene
        .floor
        .as_ref()
        .and_then(|name| Material::preset(name).ok())
}

/// What a run sounds like, listened to like this.
///
/// # Errors
/// A number of the configuration, or of the recording, that cannot be used.
pub fn sound(run: &Run, scene: &Scene, config: &SynthConfig) -> Result<Sounded, SoundError> {
    let clock = web_time::Instant::now();
    let mut synth = Synth::new(*config)?;
    let mut nodes = Nodes::new(run);
    let recording = &run.recording;
    for blow in &recording.blows {
        blows(&mut synth, &mut nodes, run, blow)?;
    }
    let floor = floor_material(scene);
    for touch in &recording.touches {
        touches(&mut synth, &mut nodes, run, floor.as_ref(), touch)?;
    }
    let ready = clock.elapsed().as_secs_f64();
    let frames = recording.frame_count as f64 / f64::from(recording.frame_rate.max(1.0));
    let samples = synth.render_all(frames + RINGS_ON)?;
    Ok(Sounded {
        samples,
        config: *config,
        report: synth.report(),
        seconds: [ready, clock.elapsed().as_secs_f64() - ready],
    })
}

/// A point, m, in the precision of the synthesiser.
fn place(point: frangible::glam::Vec3) -> DVec3 {
    point.as_dvec3()
}
