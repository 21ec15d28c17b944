//! Scenes at their level: true to scale, and by loudness.

use frangible_scenes::{SCENE_NAMES, bake, play, scene, sound, sound_config};
use frangible_sound::{Leveller, Loudness, SPEED_OF_SOUND, TARGET};
use serde_json::{Value, json};

use crate::Result;

/// The scenes whose levels over time are kept.
const NAMES: [&str; 5] = ["glass", "plate", "pane", "brick", "bottle"];

/// Time over which a level is taken, s.
const SHORT: f64 = 0.02;

/// Time after a break from which touches are landings, s.
const LANDS: f64 = 0.15;

/// Levels below this are drawn as this, dB.
const LOWEST: f64 = -100.0;

/// A scene at two levels: true to scale, as loud as fits, and by loudness.
#[derive(Clone, Debug)]
pub struct HeardLevel {
    /// Its name.
    pub name: String,
    /// Levels of 20 ms, dB over full scale.
    pub levels: [Vec<f64>; 2],
    /// Loudness.
    pub loudness: [Loudness; 2],
    /// Loudness as played live, at a full scale that does not follow the scene.
    pub live: Loudness,
    /// Full scale, the pressure of a sample of 1, as a sound pressure level, dB over 20 µPa.
    pub full_scale: [f64; 2],
    /// Largest reduction of a loud sample and largest gain of a soft one, dB.
    pub changed: [f64; 2],
    /// The intervals of 20 ms in which a landing begins.
    pub landings: Vec<usize>,
    /// Level of the loudest 20 ms of the crash, dB over full scale.
    pub crash: [f64; 2],
}

/// All of the gallery. `hear` receives the share done, 0..=1.
pub(super) fn all(hear: &dyn Fn(f64)) -> Result<Vec<HeardLevel>> {
    let count = SCENE_NAMES.len() as f64;
    let one = |(k, name)| {
        hear(k as f64 / count);
        HeardLevel::compute(name)
    };
    SCENE_NAMES.into_iter().enumerate().map(one).collect()
}

impl HeardLevel {
    /// True if its levels over time are kept.
    pub(super) fn is_kept(&self) -> bool {
        NAMES.contains(&&*self.name)
    }

    /// Row of the table of all scenes.
    pub(super) fn row(&self) -> Value {
        let below = [0, 1].map(|k| self.below(k)[1]);
        json!({
            "scene": self.name,
            "full_scale_db": self.full_scale[1],
            "integrated_lufs": self.loudness[1].integrated,
            "true_peak_db": self.loudness[1].true_peak,
            "reduced_raised_db": self.changed,
            "crash_over_landings_db": below,
            "live_lufs": self.live.integrated,
            "live_true_peak_db": self.live.true_peak,
        })
    }

    /// Rows of the table, true to scale and by loudness, and the levels over time.
    pub(super) fn data(&self) -> [Value; 2] {
        let names = ["true", "loudness"];
        [0, 1].map(|k| {
            json!({
                "scene": self.name,
                "level": names[k],
                "full_scale_db": self.full_scale[k],
                "integrated_lufs": self.loudness[k].integrated,
                "true_peak_db": self.loudness[k].true_peak,
                "reduced_raised_db": self.changed.map(|changed| (k == 1).then_some(changed)),
                "crash_db": self.crash[k],
                "landings_below_db": self.below(k),
                "levels_db": self.levels[k].iter().map(|l| l.round()).collect::<Vec<_>>(),
                "landings": self.landings,
            })
        })
    }

    fn compute(name: &str) -> Result<Self> {
        let scene = scene(name)?;
        let baked = bake(&scene)?;
        let run = play(&scene, &baked, &mut |_| {})?;
        let config = sound_config(&run, &scene);
        let sounded = sound(&run, &scene, &config)?;
        let (channels, rate) = (config.listener.channels, config.rate);
        let loudest = sounded.loudest();
        let plain: Vec<f32> = (sounded.samples.iter())
            .map(|p| p / loudest as f32)
            .collect();
        let levelled = sounded.levelled(TARGET)?;
        let mut live = Vec::with_capacity(plain.len());
        Leveller::new(rate, channels, Leveller::LIVE)?.level(&sounded.samples, &mut live)?;
        let levels = [&plain, &levelled.samples].map(|samples| envelope(samples, channels, rate));
        let broke = run.recording.blows.iter().find(|b| !b.pieces.is_empty());
        let broke = broke.map_or(0.0, |blow| blow.time);
        let interval = |time: f64| (time / SHORT) as usize;
        let arrives = run.recording.touches.iter().map(|touch| {
            let way = (touch.point.as_dvec3() - config.listener.place).length();
            (touch.time, interval(touch.time + way / SPEED_OF_SOUND))
        });
        let count = levels[0].len();
        let mut landings: Vec<usize> = arrives
            .filter(|(time, at)| *time > broke + LANDS && *at < count)
            .map(|(_, at)| at)
            .collect();
        landings.sort_unstable();
        landings.dedup();
        let crash = [interval(broke), interval(broke + 0.1)].map(|at| at.min(count));
        let crash = [0, 1].map(|k| {
            let crash = levels[k][crash[0]..crash[1]].iter();
            crash.copied().fold(LOWEST, f64::max)
        });
        Ok(Self {
            name: name.into(),
            levels,
            loudness: [Loudness::of(&plain, channels, rate)?, levelled.loudness],
            live: Loudness::of(&live, channels, rate)?,
            full_scale: [loudest, levelled.full_scale.unwrap_or(loudest)]
                .map(|pressure| 20.0 * (pressure / 2e-5).log10()),
            changed: [levelled.leveller.reduction, levelled.leveller.raised],
            landings,
            crash,
        })
    }

    /// Levels of the landings below the crash, dB: the loudest, the one in the middle, and that which a tenth is softer than.
    fn below(&self, which: usize) -> [f64; 3] {
        let level = |&at: &usize| self.crash[which] - self.levels[which][at];
        let mut below: Vec<f64> = self.landings.iter().map(level).collect();
        below.sort_by(f64::total_cmp);
        [0.0, 0.5, 0.9].map(|share| {
            let at = (share * below.len() as f64) as usize;
            below.get(at).copied().unwrap_or(f64::NAN)
        })
    }
}

/// Levels of intervals of 20 ms, dB over full scale.
fn envelope(samples: &[f32], channels: usize, rate: f64) -> Vec<f64> {
    let count = channels * (SHORT * rate) as usize;
    let level = |part: &[f32]| {
        let power: f64 = part.iter().map(|&s| f64::from(s).powi(2)).sum();
        (10.0 * (power / count as f64).max(1e-30).log10()).max(LOWEST)
    };
    samples.chunks(count).map(level).collect()
}
