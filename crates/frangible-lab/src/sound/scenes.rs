//! Scenes, played and heard.

use std::error::Error;

use frangible_scenes::{bake, play, scene, sound, sound_config};
use frangible_sound::SPEED_OF_SOUND;

/// The scenes.
pub(super) const NAMES: [&str; 6] = ["glass", "plate", "brick", "chocolate", "piggy-bank", "wall"];

/// Heights of the glass, m.
const HEIGHTS: [f64; 3] = [0.4, 0.8, 1.6];

/// A scene and its sound.
#[derive(Clone, Debug)]
pub struct HeardScene {
    /// Its name.
    pub name: String,
    /// Pieces at the end.
    pub pieces: usize,
    /// Strikes on something, and cracks that were heard.
    pub events: [usize; 2],
    /// When the first sound should arrive by the first blow and its way, and when it does, s.
    pub onset: [f64; 2],
    /// The loudest pressure, dB over 20 µPa, and by how much the limiter bent it, dB.
    pub loudest: [f64; 2],
    /// Mean of the samples over their root mean square.
    pub offset: f64,
    /// Time until the level of the last tenth of a second is 60 dB below the loudest, s.
    pub long: f64,
    /// Most bodies and resonators at once.
    pub most: [usize; 2],
    /// Times of the blows, s.
    pub blows: Vec<f64>,
    /// Left channel.
    pub samples: Vec<f32>,
    /// Energy at the left ear, Pa²·s.
    pub energy: f64,
}

impl HeardScene {
    /// Bakes, plays and hears a built-in scene; dropped from another height, m.
    pub(super) fn compute(name: &str, height: Option<f64>) -> Result<Self, Box<dyn Error>> {
        let mut scene = scene(name)?;
        if let Some(height) = height {
            scene.drop_all(height);
        }
        let baked = bake(&scene, &mut |_| {})?;
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
        let found = left.iter().position(|s| s.abs() > 1e-5).unwrap_or(0);
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
            loudest: [sounded.peak_level(), sounded.report.limiter.reduction],
            offset: mean / (all / left.len().max(1) as f64).sqrt(),
            long: (last + 1) as f64 * 0.1,
            most: [sounded.report.most_bodies, sounded.report.most_resonators],
            blows: recording.blows.iter().map(|b| b.time).collect(),
            energy: all / rate * config.full_scale * config.full_scale,
            samples: left,
        })
    }
}

/// The glass dropped from some heights: height, m, and energy of the sound, Pa²·s.
pub(super) fn drops() -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
    let heard = |height: f64| {
        let scene = HeardScene::compute("glass", Some(height))?;
        Ok([height, scene.energy])
    };
    HEIGHTS.into_iter().map(heard).collect()
}
