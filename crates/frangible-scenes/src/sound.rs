//! Computes the sound of a run from its recording.
//!
//! Each node of the recording is a body of the synthesiser. The recording supplies the sources of sound: the contact force of each
//! blow as computed by the fracture model, the cracks with their times and energies, and the contacts of pieces with their impulses;
//! the duration of these contacts follows from Hertz's theory.

mod energy;
mod live;
mod played;

use frangible::Material;
use frangible_recording::View;
use frangible_sound::{
    Hearing, Levelled, Listener, SoundError, SoundFloor, SynthConfig, SynthReport, by_loudness, wav,
};

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
    /// Sound pressure, Pa, left and right interleaved.
    pub samples: Vec<f32>,
    /// Settings of the synthesis.
    pub config: SynthConfig,
    /// Report of the synthesiser.
    pub report: SynthReport,
    /// Dice of tempered glass that were heard: when they came loose, and when they met something.
    pub dice: [u64; 2],
    /// Wall-clock times of preparing the bodies and of computing the samples, s.
    pub seconds: [f64; 2],
}

impl Sounded {
    /// Encodes the sound as a WAV file true to scale, normalized so that full scale is the peak pressure, [`Sounded::loudest`].
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

    /// Levels the sound to an integrated loudness, LUFS, so that soft parts are heard beside loud ones.
    ///
    /// # Errors
    /// The errors of [`by_loudness`].
    pub fn levelled(&self, target: f64) -> Result<Levelled, SoundError> {
        let channels = self.config.listener.channels;
        by_loudness(&self.samples, channels, self.config.rate, target)
    }

    /// Returns the peak pressure, Pa.
    #[must_use]
    pub fn loudest(&self) -> f64 {
        let loudest = self
            .samples
            .iter()
            .fold(0.0_f32, |most, s| most.max(s.abs()));
        f64::from(loudest)
    }

    /// Returns the duration of the sound, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.samples.len() as f64 / (self.config.rate * self.config.listener.channels as f64)
    }

    /// Returns the peak sound pressure level, dB re 20 µPa.
    #[must_use]
    pub fn peak_level(&self) -> f64 {
        20.0 * (self.loudest() / 2e-5).max(1e-9).log10()
    }
}

/// Returns settings for a listener at the recording's camera, above the floor of the scene.
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

/// Selection of the sound sources of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sources {
    /// Contact forces of blows, on struck bodies and strikers.
    pub blows: bool,
    /// Cracks.
    pub cracks: bool,
    /// Contacts of pieces.
    pub touches: bool,
    /// Sliding friction.
    pub slides: bool,
}

impl Sources {
    /// All sources.
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
/// A value of the configuration or of the recording is out of range.
pub fn sound(run: &Run, scene: &Scene, config: &SynthConfig) -> Result<Sounded, SoundError> {
    sound_of(run, scene, config, Sources::ALL)
}

/// Computes the sound of selected sources of a run.
///
/// # Errors
/// A value of the configuration or of the recording is out of range.
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
        dice: hearing.dice(),
        seconds: [ready, clock.elapsed().as_secs_f64() - ready],
    })
}
