//! The potters' test: a cracked cup sounds cracked.

use std::f64::consts::TAU;
use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::Portion;
use frangible::{Body, Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::pieces::reanalysis;
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_sound::{AssetSound, AudibleDamping, Hold, Strike};
use serde::Serialize;

use super::RATE;
use super::faces::{Faces, Tone};
use super::objects::{blow, struck};
use super::spectrum::Spectrum;
use crate::Result;

/// Elements and modes of the cup, intact and cracked.
const ELEMENTS: usize = 3000;
const MODES: usize = 80;

/// The blow that cracks the cup: a steel ball of 60 g, harder and harder in steps of this, m/s, until the cup parts.
const STEP: f64 = 1.0 / 30.0;
const STEPS: u32 = 100;

/// Cups that are tried, which differ in their weak points, until a blow leaves one cracked and whole.
const SEEDS: u64 = 16;

/// Coefficients of friction of the faces: none, and two between which most pairs of hard ceramics without grease lie.
pub const FRICTIONS: [f32; 3] = [0.0, 0.35, 0.65];

/// Settings for following the faces: time step, s, duration, s, and number of steps that are noted as one.
const STEP_TIME: f64 = 1e-6;
const LONG: f64 = 0.4;
const EVERY: usize = 4;

/// A cup, struck before and after it cracked.
#[derive(Clone, Debug, Serialize)]
pub struct Cup {
    /// Speed of the ball that cracked it, m/s.
    pub speed: f64,
    /// Struck opposite the handle and half a quarter away, the intact cup's lowest tone, Hz.
    pub two_tones: [f64; 2],
    /// The intact cup.
    pub whole: Knocked,
    /// The cracked cup as if its faces could run through each other.
    pub open: Knocked,
    /// The cracked cup whose faces beat and rub, for each of [`FRICTIONS`].
    pub rattling: Vec<Knocked>,
    /// Places on its faces.
    pub places: usize,
}

/// A cup that was knocked at.
#[derive(Clone, Debug, Serialize)]
pub struct Knocked {
    /// Its lowest four modes, Hz.
    #[serde(rename = "modes_hz")]
    pub modes: Vec<f64>,
    /// The strongest tone below 6 kHz, Hz.
    #[serde(rename = "tone_hz")]
    pub tone: f64,
    /// The times after which 10, 20 and 30 dB less of the sound's energy is still to come, s.
    #[serde(rename = "falls_s")]
    pub falls: [f64; 3],
    /// Share of the blow's energy that friction has taken.
    pub rubbed: f64,
    /// The sound, Pa.
    #[serde(skip)]
    pub samples: Vec<f32>,
}

impl Knocked {
    fn new(samples: Vec<f32>, body: &frangible_sound::SoundBody, rubbed: f64) -> Self {
        let modes = body.modes.iter().take(4).map(|mode| mode.frequency);
        let peak = Spectrum::of(&samples, RATE).peak(300.0, 6000.0);
        let falls = [0.1, 0.01, 0.001].map(|share| {
            let square = |&s: &f32| f64::from(s).powi(2);
            let rest = share * samples.iter().map(square).sum::<f64>();
            let mut later = 0.0;
            let after = samples.iter().rev().map(square).take_while(|e| {
                later += e;
                later < rest
            });
            (samples.len() - after.count()) as f64 / RATE
        });
        Self {
            modes: modes.collect(),
            tone: peak.map_or(0.0, |(f, _)| f),
            falls,
            rubbed,
            samples,
        }
    }
}

impl Cup {
    /// Bakes, cracks and strikes it.
    ///
    /// # Errors
    /// An error of the bake or of the synthesiser.
    pub fn compute() -> Result<Self> {
        let shape = Shape::ready("coffee_cup").ok_or("no such shape")?;
        let material = Material::preset("porcelain")?;
        let spec = BakeSpec {
            modes: MODES,
            ..BakeSpec::new("cup", shape, material.clone())
        };
        let asset = bake(&spec)?;
        let kind = Breakable::uniform(Arc::new(asset))?;
        let intact = kind.body(1);
        let mut two_tones = [0.0; 2];
        for (tone, angle) in two_tones.iter_mut().zip([0.25 * TAU, 0.125 * TAU]) {
            let (body, push) = at_rim(&intact, angle)?;
            let samples = struck(&body, vec![blow(push)], 1.0)?;
            let [first, second] = [0, 1].map(|i| body.modes[i].frequency);
            let peak = Spectrum::of(&samples, RATE).peak(0.8 * first, 1.2 * second);
            *tone = peak.map_or(0.0, |(f, _)| f);
        }
        let (body, push) = at_rim(&intact, 0.2 * TAU)?;
        let whole = Knocked::new(struck(&body, vec![blow(push)], 1.0)?, &body, 0.0);

        let (speed, cracked) = crack(&kind)?;
        let state = cracked.state();
        let portion = Arc::new(Portion::of_cracked(&cracked, &FractureConfig::default())?);
        let elastic = reanalysis(&portion, ELEMENTS, MODES)?;
        let (body, push) = at_rim(&cracked.piece(&portion, elastic.clone())?, 0.2 * TAU)?;
        let open = Knocked::new(struck(&body, vec![blow(push.clone())], 1.0)?, &body, 0.0);
        let tones: Vec<Tone> = body.modes.iter().map(Tone::of).collect();
        let (mut rattling, mut places) = (Vec::new(), 0);
        for friction in FRICTIONS {
            let faces = Faces::new(state, &portion, &elastic, &material, friction);
            places = faces.count();
            let hit = blow(push.clone());
            let course = faces.follow(&tones, &hit.push, &hit.pulse, [STEP_TIME, LONG], EVERY);
            let pulses = course
                .pulses
                .into_iter()
                .enumerate()
                .map(|(i, pulse)| Strike {
                    pulse: Arc::new(pulse),
                    push: (0..tones.len()).map(|k| f32::from(k == i)).collect(),
                    direction: Vec3::ZERO,
                });
            let samples = struck(&body, pulses.chain([hit]).collect(), LONG)?;
            rattling.push(Knocked::new(samples, &body, course.rubbed / course.energy));
        }
        Ok(Self {
            speed,
            two_tones,
            whole,
            open,
            rattling,
            places,
        })
    }
}

/// The cup as it sounds, and the modal forces of a newton on its wall near the rim at an angle about z; the handle is at −y.
fn at_rim(cup: &Body, angle: f64) -> Result<(frangible_sound::SoundBody, Vec<f32>)> {
    let damping = AudibleDamping::of(cup.asset().material());
    let (shape, body) = AssetSound::new(cup, &damping, Hold::Free)?;
    let outward = Vec3::new(angle.cos() as f32, angle.sin() as f32, 0.0);
    let push = shape.push(0.06 * outward + Vec3::new(0.0, 0.0, 0.045), -outward);
    Ok((body, push))
}

/// The hardest blow in steps that leaves a cup whole and cracked: its speed, m/s, and the cup. The first cup of several that one does.
fn crack(kind: &Breakable) -> Result<(f64, Body)> {
    let config = FractureConfig::default();
    let striker = Striker::ball(&Material::preset("steel")?, 0.06, 0.0122);
    let point = Vec3::new(0.2, 0.0, 0.02);
    for seed in 1..=SEEDS {
        let mut cup = kind.body(seed);
        let mut hardest = None;
        for i in 0..STEPS {
            let speed = 1.0 + STEP * f64::from(i);
            let hit = Contact::collision(cup.asset(), point, Vec3::NEG_X, speed, striker.clone());
            match impact(&cup, &[hit], &config)? {
                Outcome::Broke(_) => break,
                Outcome::Held {
                    state: Some(state), ..
                } => hardest = Some((speed, *state)),
                _ => {}
            }
        }
        if let Some((speed, state)) = hardest {
            cup.set_state(state)?;
            return Ok((speed, cup));
        }
    }
    Err("no blow leaves a cup cracked and whole".into())
}
