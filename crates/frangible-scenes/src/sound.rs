//! Sound of a run: from its recording to samples.
//!
//! Each node is a body of the synthesiser. The recording has the causes of its sound: the force of each blow as the fracture found it, the cracks
//! with their times and energy, and the touches of pieces, of which the impulse is known and the duration is Hertz'.

mod energy;
mod live;
mod played;

use frangible::Material;
use frangible_recording::View;
use frangible_sound::{Hearing, Listener, SoundError, SoundFloor, SynthConfig, SynthReport, wav};

use crate::result::Run;
use crate::scene::Scene;

pub use energy::{energy_lost, energy_radiated};

pub use live::LiveSound;

use played::Played;

/// Longest time for which the last tone may ring on, s.
const RINGS_ON: f64 = 6.0;

/// Sound of a run.
#[derive(Clone, Debug)]
pub struct Sounded {
    /// Pressures, Pa, left and right in turn.
    pub samples: Vec<f32>,
    /// Settings of the synthesis.
    pub config: SynthConfig,
    /// Report of the synthesiser.
    pub report: SynthReport,
    /// Wall-clock time of making bodies ready to sound, and of the samples, s.
    pub seconds: [f64; 2],
}

impl Sounded {
    /// The bytes of a WAV file, as loud as fits: its full scale is the loudest of the samples, [`Sounded::loudest`].
    ///
    /// # Errors
    /// The errors of [`wav`].
    pub fn wav(&self) -> Result<Vec<u8>, SoundError> {
        wav(
            &self.samples,
            self.config.listener.channels,
            self.config.rate,
            self.loudest(),
        )
    }

    /// The loudest of the samples, Pa.
    #[must_use]
    pub fn loudest(&self) -> f64 {
        let loudest = self
            .samples
            .iter()
            .fold(0.0_f32, |most, s| most.max(s.abs()));
        f64::from(loudest)
    }

    /// Its duration, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.samples.len() as f64 / (self.config.rate * self.config.listener.channels as f64)
    }

    /// Level of the loudest of the samples, dB over 20 µPa.
    #[must_use]
    pub fn peak_level(&self) -> f64 {
        20.0 * (self.loudest() / 2e-5).max(1e-9).log10()
    }
}

/// Settings for listening to a run: with the ears where the camera of its recording is, above the floor of its scene.
#[must_use]
pub fn sound_config(run: &Run, scene: &Scene) -> SynthConfig {
    config_at(&run.recording.camera, scene)
}

/// Settings for listening to a scene from where a camera is.
fn config_at(camera: &View, scene: &Scene) -> SynthConfig {
    let [eye, target] = [camera.eye, camera.target].map(|p| p.as_dvec3());
    let floor = scene.floor.as_ref().map(|_| {
        let material = floor_material(scene);
        material.map_or_else(
            || SoundFloor::stone(0.0),
            |material| SoundFloor::of(&material, 0.0),
        )
    });
    SynthConfig {
        floor,
        ..SynthConfig::new(Listener::at(eye, target))
    }
}

/// Material of the floor of a scene.
fn floor_material(scene: &Scene) -> Option<Material> {
    scene
        .floor
        .as_ref()
        .and_then(|name| Material::preset(name).ok())
}

/// Sources of sound in a run that are heard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sources {
    /// The forces of blows, on struck bodies and strikers.
    pub blows: bool,
    /// Cracks.
    pub cracks: bool,
    /// Touches of pieces.
    pub touches: bool,
    /// Slides.
    pub slides: bool,
}

impl Sources {
    /// All of it.
    pub const ALL: Self = Self {
        blows: true,
        cracks: true,
        touches: true,
        slides: true,
    };
}

/// Computes the sound of a run with these settings.
///
/// # Errors
/// A number of the configuration, or of the recording, that cannot be used.
pub fn sound(run: &Run, scene: &Scene, config: &SynthConfig) -> Result<Sounded, SoundError> {
    sound_of(run, scene, config, Sources::ALL)
}

/// Computes the sound of these sources of a run.
///
/// # Errors
/// A number of the configuration, or of the recording, that cannot be used.
pub fn sound_of(
    run: &Run,
    scene: &Scene,
    config: &SynthConfig,
    sources: Sources,
) -> Result<Sounded, SoundError> {
    let clock = web_time::Instant::now();
    let mut hearing = Hearing::new(*config, floor_material(scene))?;
    let cast = Played(run);
    let recording = &run.recording;
    recording.blows.iter().for_each(|blow| hearing.note(blow));
    for blow in &recording.blows {
        if sources.blows {
            hearing.blow(&cast, blow)?;
        }
        if sources.cracks {
            hearing.cracks(&cast, blow)?;
        }
    }
    if sources.touches {
        for touch in &recording.touches {
            hearing.touch(&cast, touch)?;
        }
    }
    if sources.slides {
        for slide in &recording.slides {
            hearing.slide(&cast, slide)?;
        }
    }
    let ready = clock.elapsed().as_secs_f64();
    let frames = recording.frame_count as f64 / f64::from(recording.frame_rate.max(1.0));
    let samples = hearing.until_silence(frames + RINGS_ON)?;
    Ok(Sounded {
        samples,
        config: *config,
        report: hearing.synth().report(),
        seconds: [ready, clock.elapsed().as_secs_f64() - ready],
    })
}
