//! Computing time of a resonator, beside that of the plainest one.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use frangible_sound::glam::{DQuat, DVec3, Vec3};
use frangible_sound::{
    AudibleDamping, Listener, Plate, PlateMaterial, SoundPulse, Strike, Synth, SynthConfig,
};
use serde::Serialize;

use crate::Result;

/// Samples that are rendered at once, and number of repetitions: the fastest time counts, which nothing else on the machine has held up.
const FRAMES: usize = 4800;
const ROUNDS: usize = 40;

/// Time per sample and resonator, ns: of plain two-pole filters one after the other, and of the synthesiser with all that it does.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Cost {
    /// Resonators that ring.
    pub resonators: usize,
    /// Plain filters.
    pub plain: f64,
    /// The synthesiser, stereo, with its selection and its ways to two ears.
    pub ours: f64,
}

impl Cost {
    /// Lets shards ring on and measures them, with filters as many.
    pub(super) fn measure() -> Result<Self> {
        let ringing = ringing()?;
        let resonators = ringing.resonators();
        let per_sample = |seconds: f64| 1e9 * seconds / (FRAMES * resonators) as f64;
        let mut out = vec![0.0; 2 * FRAMES];
        let ours = fastest(|| {
            let mut synth = ringing.clone();
            let clock = Instant::now();
            synth.render(black_box(&mut out));
            clock.elapsed().as_secs_f64()
        });
        let mut filters: Vec<[f32; 4]> = (0..resonators)
            .map(|i| {
                let angle = 0.01 + 2.0 * i as f32 / resonators as f32;
                [2.0 * 0.9999 * angle.cos(), -0.9999 * 0.9999, 1.0, 0.5]
            })
            .collect();
        let plain = fastest(|| {
            let clock = Instant::now();
            plain(black_box(&mut filters), black_box(&mut out[..FRAMES]));
            clock.elapsed().as_secs_f64()
        });
        Ok(Self {
            resonators,
            plain: per_sample(plain),
            ours: per_sample(ours),
        })
    }
}

fn fastest(mut once: impl FnMut() -> f64) -> f64 {
    (0..ROUNDS).map(|_| once()).fold(f64::INFINITY, f64::min)
}

/// Two-pole filters as anybody would write them first: y_n = a y_{n−1} + b y_{n−2}.
fn plain(filters: &mut [[f32; 4]], out: &mut [f32]) {
    out.fill(0.0);
    for [a, b, last, before] in filters {
        for out in &mut *out {
            let new = *a * *last + *b * *before;
            (*last, *before) = (new, *last);
            *out += new;
        }
        // Held up, lest they die away into denormal numbers.
        *last += 1e-3;
    }
}

/// Shards of glass that were struck hard a moment ago.
fn ringing() -> Result<Synth> {
    let listener = Listener::at(DVec3::new(0.0, 0.4, 1.5), DVec3::ZERO);
    let mut synth = Synth::new(SynthConfig::new(listener))?;
    let (damping, _) = AudibleDamping::published("glass").ok_or("glass has no damping")?;
    let glass = PlateMaterial {
        youngs_modulus: 71e9,
        poisson_ratio: 0.23,
        density: 2500.0,
        damping,
    };
    for i in 0..40 {
        let side = 0.06 + 0.0004 * f64::from(i);
        let sides = [side, 0.8 * side, 0.003];
        let (plate, body) = Plate::new("shard", sides, DQuat::IDENTITY, &glass)?;
        let place = DVec3::new(0.01 * f64::from(i % 10), 0.0, 0.01 * f64::from(i / 10));
        let id = synth.add(Arc::new(body), place, DQuat::IDENTITY)?;
        let strike = Strike {
            pulse: Arc::new(SoundPulse::half_sine(10.0, 1e-4)),
            push: plate.push(Vec3::new(0.3 * side as f32, 0.01, 0.0), Vec3::Z),
            direction: Vec3::Z,
        };
        synth.strike(0.0, id, strike)?;
    }
    synth.render(&mut vec![0.0; 2 * 2000]);
    Ok(synth)
}
