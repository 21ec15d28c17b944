//! The potters' test: a cracked cup sounds cracked.

use std::error::Error;
use std::f64::consts::TAU;
use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::Portion;
use frangible::{Body, Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::pieces::reanalysis;
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_sound::{AssetSound, AudibleDamping, Hold};

use super::RATE;
use super::objects::{decay, struck};
use crate::plot::Spectrum;

/// Elements and modes of the cup, intact and cracked.
const ELEMENTS: usize = 3000;
const MODES: usize = 80;

/// The blow that cracks the cup: a steel ball of 60 g, harder and harder in steps of this, m/s, until the cup parts.
const STEP: f64 = 1.0 / 30.0;
const STEPS: u32 = 100;

/// A cup, struck before and after it cracked.
#[derive(Clone, Debug)]
pub struct Cup {
    /// Speed of the ball that cracked it, m/s.
    pub speed: f64,
    /// Its lowest four modes, Hz, intact and cracked.
    pub modes: [Vec<f64>; 2],
    /// The strongest tone below 6 kHz, Hz, and the time in which it falls by 60 dB, s.
    pub strongest: [[f64; 2]; 2],
    /// Struck opposite the handle and half a quarter away, the intact cup's lowest tone, Hz.
    pub two_tones: [f64; 2],
    /// The sounds, Pa.
    pub samples: [Vec<f32>; 2],
}

impl Cup {
    /// Bakes, cracks and strikes it.
    pub(super) fn compute() -> Result<Self, Box<dyn Error>> {
        let shape = Shape::ready("coffee_cup").ok_or("no such shape")?;
        let spec = BakeSpec {
            modes: MODES,
            ..BakeSpec::new("cup", shape, Material::preset("porcelain")?)
        };
        let (asset, _) = bake(&spec, &mut |_| {})?;
        let intact = Breakable::new(Arc::new(asset))?.body(1);
        let (speed, cracked) = crack(&intact)?;
        let mut two_tones = [0.0; 2];
        for (tone, angle) in two_tones.iter_mut().zip([0.25 * TAU, 0.125 * TAU]) {
            let (samples, modes) = heard(&intact, angle)?;
            let highest = 1.2 * modes[1];
            let peak = Spectrum::of(&samples, RATE).peak(0.8 * modes[0], highest);
            *tone = peak.map_or(0.0, |(f, _)| f);
        }
        let (first, whole) = heard(&intact, 0.2 * TAU)?;
        let (second, split) = heard(&cracked, 0.2 * TAU)?;
        let strongest = [&first, &second].map(|samples| {
            let peak = Spectrum::of(samples, RATE).peak(300.0, 6000.0);
            let tone = peak.map_or(0.0, |(f, _)| f);
            [tone, decay(samples, tone)]
        });
        Ok(Self {
            speed,
            modes: [whole, split],
            strongest,
            two_tones,
            samples: [first, second],
        })
    }
}

/// The cup struck on its wall near the rim at an angle about z; the handle is at −y. Its sound and its lowest four modes.
fn heard(cup: &Body, angle: f64) -> Result<(Vec<f32>, Vec<f64>), Box<dyn Error>> {
    let damping = AudibleDamping::of(&cup.asset().material);
    let (shape, body) = AssetSound::new(cup, &damping, Hold::Free)?;
    let outward = Vec3::new(angle.cos() as f32, angle.sin() as f32, 0.0);
    let push = shape.push(0.06 * outward + Vec3::new(0.0, 0.0, 0.045), -outward);
    let modes = body
        .modes
        .iter()
        .take(4)
        .map(|mode| mode.frequency)
        .collect();
    Ok((struck(&body, push, 1.0)?, modes))
}

/// The cup with the cracks that a blow leaves, and modes of its own; and the speed of the blow, m/s.
fn crack(intact: &Body) -> Result<(f64, Body), Box<dyn Error>> {
    let config = FractureConfig::default();
    let striker = Striker::ball(&Material::preset("steel")?, 0.06, 0.0122);
    let point = Vec3::new(0.2, 0.0, 0.02);
    let mut hardest = None;
    for i in 0..STEPS {
        let speed = 1.0 + STEP * f64::from(i);
        let hit = Contact::collision(intact.asset(), point, Vec3::NEG_X, speed, striker.clone());
        match impact(intact, &[hit], &config)? {
            Outcome::Broke(_) => break,
            Outcome::Held {
                state: Some(state), ..
            } => hardest = Some((speed, state)),
            _ => {}
        }
    }
    let (speed, state) = hardest.ok_or("no blow leaves the cup cracked and whole")?;
    let mut cracked = intact.clone();
    cracked.set_state(*state)?;
    let portion = Arc::new(Portion::of_cracked(&cracked, &config)?);
    let piece = cracked.piece(&portion, reanalysis(&portion, ELEMENTS, MODES)?)?;
    Ok((speed, piece))
}
