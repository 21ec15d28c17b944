//! Bodies that are struck once.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::{Breakable, Material};
use frangible_bake::{BakeSpec, Shape, Station, bake};
use frangible_sound::glam::{DQuat, DVec3};
use frangible_sound::{
    AssetSound, AudibleDamping, Hold, Listener, SoundBody, SoundPulse, Strike, Synth, SynthConfig,
};
use serde::Serialize;

use super::RATE;
use super::spectrum::Spectrum;
use crate::Result;

/// Time for which a struck body is listened to, s.
const LONG: f64 = 2.0;

/// A tone of a body.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Partial {
    /// Frequency of the mode of the bake, Hz.
    #[serde(rename = "mode_hz")]
    pub mode: f64,
    /// Frequency that was found in the sound, Hz.
    #[serde(rename = "heard_hz")]
    pub heard: f64,
    /// Published or in closed form, as a multiple of the first.
    pub known: f64,
    /// Heard, as a multiple of the first.
    pub ratio: f64,
}

/// A body with its tones.
#[derive(Clone, Debug, Serialize)]
pub struct Object {
    /// Name of the object.
    pub name: &'static str,
    /// Source of the known tones.
    pub source: &'static str,
    /// The tones.
    pub partials: Vec<Partial>,
    /// Time in which the first tone falls by 60 dB, s: by the damping alone, and measured in the sound.
    pub decay: [f64; 2],
    /// The sound, Pa.
    #[serde(skip)]
    pub samples: Vec<f32>,
}

/// Plan of an object: the body, the blow, and the tones that are compared.
struct Plan {
    name: &'static str,
    source: &'static str,
    shape: Shape,
    material: Material,
    point: Vec3,
    direction: Vec3,
    /// Known tones as multiples of the first.
    known: &'static [f64],
}

/// All of them.
pub(super) fn all() -> Result<Vec<Object>> {
    let glass = Material::preset("glass")?;
    let mut tile = Material::preset("porcelain")?;
    // The series' own.
    tile.poisson_ratio = 0.3;
    let plans = [
        Plan {
            name: "glass rod, 300 × 12 × 8 mm, flat",
            source: "thin bar, Euler and Bernoulli",
            shape: Shape::block([0.3, 0.012, 0.008]),
            material: glass.clone(),
            point: Vec3::new(0.15, 0.0, 0.004),
            direction: Vec3::NEG_Z,
            known: &[1.0, 2.7565, 5.4039],
        },
        Plan {
            name: "square tile, 150 × 150 × 3 mm",
            source: "thin plate, ν 0.3: Leissa, J. Sound Vib. 31, 1973",
            shape: Shape::plate(0.15, 0.15, 0.003),
            material: tile,
            point: Vec3::new(0.068, 0.05, 0.0015),
            direction: Vec3::NEG_Z,
            known: &[1.0, 19.789 / 13.489, 24.432 / 13.489],
        },
        Plan {
            name: "wine glass",
            source: "529.3 and 1368.0 Hz: Harvard Natural Sciences Lecture Demonstrations, Wineglass Normal Modes",
            shape: Shape::Revolution {
                profile: wine_glass(),
            },
            material: glass.clone(),
            point: Vec3::new(0.04, 0.0, 0.05),
            direction: Vec3::NEG_X,
            known: &[1.0, 1368.0 / 529.3],
        },
        Plan {
            name: "beer bottle",
            source: "3200, 4448 and 5632 Hz: Russell, Vibrational Behavior of an Empty Beer Bottle, 2004",
            shape: Shape::bottle(),
            material: glass,
            point: Vec3::new(0.031, 0.0, 0.0),
            direction: Vec3::NEG_X,
            known: &[1.0, 4448.0 / 3200.0, 5632.0 / 3200.0],
        },
    ];
    plans.into_iter().map(Plan::heard).collect()
}

/// The bowl of a wine glass, 100 mm high, 66 mm across at the rim and 77 mm at the belly; its wall thins from 1.7 to 1.1 mm. The stem
/// and the foot are left out: the wall's tones hardly feel them.
fn wine_glass() -> Vec<Station> {
    let wall = |r: f64, z: f64, h: f64| Station::smooth([r, z], [r - h, z]);
    vec![
        Station::smooth([0.0, 0.0], [0.0, 0.006]),
        Station::smooth([0.009, 0.0005], [0.008, 0.0065]),
        Station::smooth([0.018, 0.004], [0.0168, 0.0085]),
        Station::smooth([0.0300, 0.0150], [0.0283, 0.0165]),
        wall(0.0370, 0.0330, 0.0017),
        wall(0.0385, 0.0500, 0.0015),
        wall(0.0365, 0.0750, 0.0013),
        wall(0.0330, 0.1000, 0.0011),
    ]
}

impl Plan {
    fn heard(self) -> Result<Object> {
        let damping = AudibleDamping::of(&self.material);
        let spec = BakeSpec {
            modes: 40,
            followed: Some(40),
            ..BakeSpec::new(self.name, self.shape, self.material)
        };
        let asset = bake(&spec)?;
        let kind = Breakable::uniform(Arc::new(asset))?;
        let (shape, body) = AssetSound::new(&kind.body(1), &damping, Hold::Free)?;
        let push = shape.push(self.point, self.direction);
        let samples = struck(&body, vec![blow(push)], LONG)?;
        let spectrum = Spectrum::of(&samples, RATE);
        let mut partials: Vec<Partial> = Vec::new();
        for &known in self.known {
            let mode = match partials.first() {
                None => body.modes[0].frequency,
                Some(first) => nearest(&body, known * first.mode),
            };
            let (heard, _) = spectrum.peak(0.985 * mode, 1.015 * mode).ok_or("no peak")?;
            let ratio = heard / partials.first().map_or(heard, |first| first.heard);
            partials.push(Partial {
                mode,
                heard,
                known,
                ratio,
            });
        }
        let decay = [
            body.modes[0].reverberation(),
            decay(&samples, partials[0].heard),
        ];
        Ok(Object {
            name: self.name,
            source: self.source,
            partials,
            decay,
            samples,
        })
    }
}

/// The mode whose frequency is nearest to one, Hz.
fn nearest(body: &SoundBody, frequency: f64) -> f64 {
    let away = |f: f64| (f / frequency).ln().abs();
    let modes = body.modes.iter().map(|mode| mode.frequency);
    modes
        .min_by(|a, b| away(*a).total_cmp(&away(*b)))
        .unwrap_or(0.0)
}

/// A blow of 0.01 N·s and 0.1 ms.
pub(super) fn blow(push: Vec<f32>) -> Strike {
    Strike {
        pulse: Arc::new(SoundPulse::half_sine(0.01, 1e-4)),
        push,
        direction: Vec3::ZERO,
    }
}

/// The sound of strikes that begin together, at 1 m, Pa, for a time, s.
pub(super) fn struck(body: &SoundBody, strikes: Vec<Strike>, long: f64) -> Result<Vec<f32>> {
    let place = DVec3::new(0.7, 0.3, 0.65);
    let listener = Listener {
        channels: 1,
        ..Listener::at(place, DVec3::ZERO)
    };
    let mut synth = Synth::new(SynthConfig::new(listener))?;
    let id = synth.add(Arc::new(body.clone()), DVec3::ZERO, DQuat::IDENTITY)?;
    for strike in strikes {
        synth.strike(0.0, id, strike)?;
    }
    let mut samples = vec![0.0; (long * RATE) as usize];
    synth.render(&mut samples);
    Ok(samples)
}

/// Time in which a tone falls by 60 dB, s, by its amplitudes in two windows of the sound.
fn decay(samples: &[f32], frequency: f64) -> f64 {
    let window = samples.len() / 4;
    let level = |from: usize| {
        let part = &samples[from..from + window];
        let peak = Spectrum::of(part, RATE).peak(0.97 * frequency, 1.03 * frequency);
        peak.map_or(f64::NEG_INFINITY, |(_, amplitude)| 20.0 * amplitude.log10())
    };
    let (early, late) = (window / 4, window * 5 / 4);
    60.0 * (late - early) as f64 / RATE / (level(early) - level(late))
}
