//! Decay times of materials and shards, beside published loss factors.

use std::f64::consts::{LN_10, SQRT_2, TAU};

use frangible::Material;
use frangible_sound::glam::DQuat;
use frangible_sound::{AudibleDamping, Plate, PlateMaterial};
use serde::Serialize;

use super::landing::{RATIO, THICK};
use crate::Result;

/// Materials with their published loss factors and the sources of these.
const PUBLISHED: [(&str, Option<[f64; 2]>, &str); 8] = [
    ("glass", Some([6e-4, 2e-3]), CREMER),
    ("porcelain", None, "none found"),
    ("brick", Some([1e-2, 2e-2]), CREMER),
    ("concrete", Some([4e-3, 8e-3]), CREMER),
    ("wood", Some([8e-3, 1e-2]), CREMER),
    ("pmma", Some([2e-2, 4e-2]), CREMER),
    (
        "stone",
        Some([1.0 / 150.0, 1.0 / 150.0]),
        "granite, 140 to 4500 Hz: Birch and Bancroft 1938, by their abstract",
    ),
    (
        "steel",
        Some([2e-5, 3e-4]),
        "Irvine, Damping Properties of Materials, 2004, table 2",
    ),
];
const CREMER: &str = "Cremer and Heckl, Structure-Borne Sound, 1988, not re-checked";

/// Frequencies at which materials are compared, Hz.
const AT: [f64; 2] = [1e3, 1e4];

/// Masses of shards, kg, and middles of octaves, Hz.
const MASSES: [f64; 3] = [5e-3, 2e-2, 1e-1];
const OCTAVES: [f64; 4] = [2e3, 4e3, 8e3, 1.6e4];

/// Loss of a material.
#[derive(Clone, Debug, Serialize)]
pub struct MaterialLoss {
    /// Its name.
    pub material: &'static str,
    /// Loss factors at 1 and at 10 kHz.
    pub loss_factor: [f64; 2],
    /// Times in which a tone falls by 60 dB at 1 and at 10 kHz by the material alone, s.
    pub decay_s: [f64; 2],
    /// Published loss factors, least and greatest.
    pub published: [Option<f64>; 2],
    /// Their source.
    pub source: &'static str,
}

/// Tones of a shard of glass in an octave.
#[derive(Clone, Debug, Serialize)]
pub struct OctaveDecay {
    /// Mass of the shard, kg.
    pub mass_kg: f64,
    /// Middle of the octave, Hz.
    pub octave_hz: f64,
    /// Number of tones.
    pub tones: usize,
    /// Mean of the times in which they fall by 60 dB, s: in all, and by the material alone.
    pub decay_s: [Option<f64>; 2],
    /// Part of the loss that is radiated, in the mean.
    pub radiated: Option<f64>,
    /// The times by the greatest and by the least published loss factor, at the middle of the octave, s.
    pub published_s: [f64; 2],
}

/// Losses of materials.
pub(super) fn materials() -> Vec<MaterialLoss> {
    let row = |(name, published, source): (&'static str, Option<[f64; 2]>, _)| {
        let damping = AudibleDamping::published(name).unwrap_or_default().0;
        let loss = AT.map(|f| damping.loss(TAU * f));
        MaterialLoss {
            material: name,
            loss_factor: [0, 1].map(|k| loss[k] / (TAU * AT[k])),
            decay_s: loss.map(|loss| 6.0 * LN_10 / loss),
            published: [0, 1].map(|k| published.map(|range| range[k])),
            source,
        }
    };
    PUBLISHED.into_iter().map(row).collect()
}

/// Decay of shards of glass, 3 mm thick, by octaves.
pub(super) fn shards() -> Result<Vec<OctaveDecay>> {
    let glass = Material::preset("glass")?;
    let damping = AudibleDamping::of(&glass);
    let plate = PlateMaterial {
        youngs_modulus: glass.youngs_modulus,
        poisson_ratio: glass.poisson_ratio,
        density: glass.density,
        damping,
    };
    let mut rows = Vec::new();
    for mass in MASSES {
        let width = (mass / (glass.density * THICK * RATIO)).sqrt();
        let sides = [RATIO * width, width, THICK];
        let (_, body) = Plate::new("shard", sides, DQuat::IDENTITY, &plate)?;
        for octave in OCTAVES {
            let within = octave / SQRT_2..octave * SQRT_2;
            let modes = body.modes.iter().filter(|m| within.contains(&m.frequency));
            let modes: Vec<_> = modes.collect();
            let mean = |value: &dyn Fn(&frangible_sound::Mode) -> f64| {
                let sum: f64 = modes.iter().map(|mode| value(mode)).sum();
                (!modes.is_empty()).then(|| sum / modes.len() as f64)
            };
            let all = mean(&|mode| mode.reverberation());
            let alone = mean(&|mode| 6.0 * LN_10 / damping.loss(TAU * mode.frequency));
            let published = PUBLISHED[0].1.unwrap_or_default();
            rows.push(OctaveDecay {
                mass_kg: mass,
                octave_hz: octave,
                tones: modes.len(),
                decay_s: [all, alone],
                radiated: mean(&|mode| mode.radiated / mode.loss),
                published_s: [1, 0].map(|k| 6.0 * LN_10 / (published[k] * TAU * octave)),
            });
        }
    }
    Ok(rows)
}
