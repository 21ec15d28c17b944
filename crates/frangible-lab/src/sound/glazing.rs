//! One window of two glasses, heard: tempered, and as it came from the float line.

use frangible::Material;
use frangible_scenes::{bake, play, scene, sound, sound_config};
use serde::Serialize;

use super::spectrum::Spectrum;
use crate::Result;

/// Materials of the window, with their names in pictures.
const GLASSES: [(&str, &str); 2] = [
    ("tempered-glass", "window-tempered"),
    ("glass", "window-annealed"),
];

/// Time over which a level is taken, s, and the fall after which a crash is over, dB.
const SHORT: f64 = 1e-3;
const OVER: f64 = 20.0;

/// Parts of the sound after the crash began, s: the crash, and the fall.
const CRASH: [f64; 2] = [0.0, 0.02];
const FALL: [f64; 2] = [0.1, 1.0];

/// The side window of the gallery, of one glass.
#[derive(Clone, Debug, Serialize)]
pub struct HeardGlass {
    /// Name of the material.
    pub glass: &'static str,
    /// Pieces at the end.
    pub pieces: usize,
    /// Dice that were heard when they came loose, and when they met something.
    pub dice: [u64; 2],
    /// Touches of pieces in the second after the break, and dice that met something, over the time that was simulated, 1/s.
    pub touches_per_s: [f64; 2],
    /// Loudest pressure, dB over 20 µPa.
    pub loudest_db: f64,
    /// Level of the loudest millisecond, of the crash's 20 ms, and of the fall, dB over 20 µPa.
    pub levels_db: [f64; 3],
    /// Time after which the level of a millisecond stays 20 dB below that of the loudest for 20 ms, s.
    pub crash_s: f64,
    /// Time in which 99 % of the energy came, s.
    pub most_s: f64,
    /// Centroid of the spectrum of the crash and of the fall, Hz.
    pub centroid_hz: [f64; 2],
    /// Level of the strongest tone of the fall over the middle one of its spectrum, dB: high where something rings.
    pub tone_db: f64,
    /// Name of the picture.
    #[serde(skip)]
    pub picture: &'static str,
    /// Left channel from shortly before the crash, Pa.
    #[serde(skip)]
    pub samples: Vec<f32>,
}

/// Both of them.
pub(super) fn all() -> Result<Vec<HeardGlass>> {
    GLASSES.into_iter().map(HeardGlass::compute).collect()
}

impl HeardGlass {
    fn compute((glass, picture): (&'static str, &'static str)) -> Result<Self> {
        let mut scene = scene("side-window")?;
        for body in &mut scene.bodies {
            body.material = Material::preset(glass)?;
        }
        let baked = bake(&scene)?;
        let run = play(&scene, &baked, &mut |_| {})?;
        let config = sound_config(&run, &scene);
        let rate = config.rate;
        let sounded = sound(&run, &scene, &config)?;
        let left: Vec<f32> = sounded.samples.iter().copied().step_by(2).collect();
        let loudest = (0..left.len()).max_by(|&a, &b| left[a].abs().total_cmp(&left[b].abs()));
        let begins = loudest
            .unwrap_or(0)
            .saturating_sub((2.0 * SHORT * rate) as usize);
        let after = &left[begins..];
        let part = |[from, to]: [f64; 2]| {
            let at = |time: f64| ((time * rate) as usize).min(after.len());
            &after[at(from)..at(to)]
        };
        let level = |part: &[f32]| 10.0 * (power(part) / 4e-10).max(1e-30).log10();
        let short: Vec<f64> = after.chunks((SHORT * rate) as usize).map(level).collect();
        let most = short.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let calm = short.windows(20);
        let first = short.iter().position(|&l| l >= most).unwrap_or(0);
        let over = (calm.enumerate().skip(first))
            .find(|(_, next)| next.iter().all(|&l| l < most - OVER))
            .map_or(short.len(), |(at, _)| at);
        let energy = |part: &[f32]| power(part) * part.len() as f64;
        let (mut come, whole) = (0.0, energy(after));
        let sums = after.iter().position(|&s| {
            come += f64::from(s).powi(2);
            come >= 0.99 * whole
        });
        let broke = run.recording.blows.iter().find(|b| !b.pieces.is_empty());
        let broke = broke.map_or(0.0, |blow| blow.time);
        let touches = run.recording.touches.iter();
        let soon = touches.filter(|touch| (broke..broke + 1.0).contains(&touch.time));
        let spectrum = Spectrum::of(part(FALL), rate);
        Ok(Self {
            glass,
            pieces: run
                .recording
                .nodes
                .iter()
                .filter(|n| !n.visible.is_empty())
                .count(),
            dice: sounded.dice,
            touches_per_s: [
                soon.count() as f64,
                sounded.dice[1] as f64 / run.simulated.max(1e-3),
            ],
            loudest_db: sounded.peak_level(),
            levels_db: [most, level(part(CRASH)), level(part(FALL))],
            crash_s: SHORT * (over - first) as f64,
            most_s: sums.unwrap_or(0) as f64 / rate,
            centroid_hz: [
                Spectrum::of(part(CRASH), rate).centroid(),
                spectrum.centroid(),
            ],
            tone_db: spectrum.tonal(),
            picture,
            samples: part([0.0, 1.5]).to_vec(),
        })
    }
}

/// Mean of the squares.
fn power(part: &[f32]) -> f64 {
    part.iter().map(|&s| f64::from(s).powi(2)).sum::<f64>() / part.len().max(1) as f64
}
