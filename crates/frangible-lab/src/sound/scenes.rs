//! Scenes, played and heard.

use frangible_scenes::{
    Run, Scene, Sources, bake, energy_lost, energy_radiated, play, scene, sound, sound_config,
    sound_of,
};
use frangible_sound::{Listener, SPEED_OF_SOUND};
use serde::Serialize;

use crate::Result;

/// The scenes.
pub(super) const NAMES: [&str; 6] = ["glass", "plate", "brick", "chocolate", "piggy-bank", "wall"];

/// Heights of the glass, m.
const HEIGHTS: [f64; 3] = [0.4, 0.8, 1.6];

/// A scene and its sound.
#[derive(Clone, Debug, Serialize)]
pub struct HeardScene {
    /// Its name.
    pub name: String,
    /// Pieces at the end.
    pub pieces: usize,
    /// Strikes on something, and cracks that were heard.
    pub events: [usize; 2],
    /// Time of the first sound, s: as expected from the first blow and the distance, and as heard.
    #[serde(rename = "onset_s")]
    pub onset: [f64; 2],
    /// The loudest pressure, dB over 20 µPa: full scale of its WAV.
    #[serde(rename = "loudest_db")]
    pub loudest: f64,
    /// Mean of the samples over their root mean square.
    pub offset: f64,
    /// Time until the level of the last tenth of a second is 60 dB below the loudest, s.
    #[serde(rename = "long_s")]
    pub long: f64,
    /// Most bodies and resonators at once.
    pub most: [usize; 2],
    /// Times of the blows, s.
    #[serde(rename = "blows_s")]
    pub blows: Vec<f64>,
    /// Left channel.
    #[serde(skip)]
    pub samples: Vec<f32>,
    /// Energy that the scene lost, J.
    #[serde(rename = "lost_j")]
    pub lost: f64,
    /// Energy radiated, J, and at 1 m the loudest pressure and the highest level of a meter set to *fast*, dB: of all sources together, and of blows,
    /// cracks, touches and slides by themselves.
    #[serde(rename = "sources_j_db_db")]
    pub sources: [[f64; 3]; 5],
}

/// Time constant of a sound level meter set to *fast*, s.
pub(super) const FAST: f64 = 0.125;

impl HeardScene {
    /// Bakes, plays and hears a built-in scene.
    pub(super) fn compute(name: &str) -> Result<Self> {
        let scene = scene(name)?;
        let baked = bake(&scene)?;
        let run = play(&scene, &baked, &mut |_| {})?;
        let config = sound_config(&run, &scene);
        let rate = config.rate;
        let sounded = sound(&run, &scene, &config)?;
        let left: Vec<f32> = sounded.samples.iter().copied().step_by(2).collect();
        let recording = &run.recording;
        let place = |node: usize, time: f64| {
            let frame = (time * f64::from(recording.frame_rate)) as usize;
            recording.pose(node, frame).translation.as_dvec3()
        };
        let arrives = recording.blows.iter().map(|blow| {
            let way = (place(blow.node, blow.time) - config.listener.place).length();
            blow.time + way / SPEED_OF_SOUND
        });
        let touches = recording.touches.iter().map(|touch| {
            let way = (touch.point.as_dvec3() - config.listener.place).length();
            touch.time + way / SPEED_OF_SOUND
        });
        let wanted = arrives.chain(touches).fold(f64::INFINITY, f64::min);
        let found = left.iter().position(|s| s.abs() > 2e-4).unwrap_or(0);
        let power = |part: &[f32]| part.iter().map(|s| f64::from(s * s)).sum::<f64>();
        let all = power(&left).max(1e-30);
        let mean = left.iter().map(|&s| f64::from(s)).sum::<f64>() / left.len().max(1) as f64;
        let tenth = (0.1 * rate) as usize;
        let levels: Vec<f64> = left.chunks(tenth).map(power).collect();
        let loudest = levels.iter().copied().fold(0.0, f64::max);
        let last = levels
            .iter()
            .rposition(|&l| l > 1e-6 * loudest)
            .unwrap_or(0);
        Ok(Self {
            name: name.into(),
            pieces: run.breaks.iter().map(|b| b.masses.len()).sum(),
            events: [
                recording
                    .blows
                    .iter()
                    .map(|b| b.pulses.len())
                    .sum::<usize>()
                    + recording.touches.len(),
                recording.blows.iter().map(|b| b.cracks.len()).sum(),
            ],
            onset: [wanted, found as f64 / rate],
            loudest: sounded.peak_level(),
            offset: mean / (all / left.len().max(1) as f64).sqrt(),
            long: (last + 1) as f64 * 0.1,
            most: [sounded.report.most_bodies, sounded.report.most_resonators],
            blows: recording.blows.iter().map(|b| b.time).collect(),
            lost: energy_lost(&run),
            sources: sources(&run, &scene)?,
            samples: left,
        })
    }
}

/// Measures of the sources of a scene at 1 m from the camera's target, as in [`HeardScene::sources`].
fn sources(run: &Run, scene: &Scene) -> Result<[[f64; 3]; 5]> {
    let mut config = sound_config(run, scene);
    let target = run.recording.camera.target.as_dvec3();
    let away = (config.listener.place - target).normalize();
    config.listener = Listener::at(target + away, target);
    let alone = |which: usize| Sources {
        blows: which == 1,
        cracks: which == 2,
        touches: which == 3,
        slides: which == 4,
    };
    let mut found = [[0.0; 3]; 5];
    for (which, found) in found.iter_mut().enumerate() {
        let sources = match which {
            0 => Sources::ALL,
            _ => alone(which),
        };
        let heard = sound_of(run, scene, &config, sources)?;
        let (mut mean, mut most) = (0.0_f64, 1e-20_f64);
        let share = 1.0 - (-1.0 / (FAST * config.rate)).exp();
        for sample in heard.samples.iter().step_by(2) {
            mean += share * (f64::from(*sample).powi(2) - mean);
            most = most.max(mean);
        }
        let fast = 10.0 * (most / 4e-10).log10();
        *found = [
            energy_radiated(run, scene, sources)?,
            heard.peak_level(),
            fast,
        ];
    }
    Ok(found)
}

/// Seeds of the glass for each height.
pub(super) const SEEDS: u64 = 8;

/// A height, m, and the level of the sound's energy at the left ear, dB over 1 Pa²·s: its mean over some seeds and the standard error of that.
pub type Drop = [f64; 3];

/// The glass dropped from some heights.
pub(super) fn drops() -> Result<Vec<Drop>> {
    let mut drops = Vec::new();
    for height in HEIGHTS {
        let mut scene = scene("glass")?;
        scene.drop_all(height);
        let baked = bake(&scene)?;
        let mut levels = Vec::new();
        for seed in 1..=SEEDS {
            scene.seed = seed;
            let run = play(&scene, &baked, &mut |_| {})?;
            let config = sound_config(&run, &scene);
            let samples = sound(&run, &scene, &config)?.samples;
            let left = samples.iter().step_by(2);
            let energy: f64 = left.map(|&s| f64::from(s).powi(2)).sum();
            levels.push(10.0 * (energy / config.rate).log10());
        }
        let count = levels.len() as f64;
        let mean = levels.iter().sum::<f64>() / count;
        let squares: f64 = levels.iter().map(|l| (l - mean).powi(2)).sum();
        drops.push([height, mean, (squares / (count - 1.0) / count).sqrt()]);
    }
    Ok(drops)
}
