//! Shards that land on a stone floor: their level by mass and speed, and their decay.

use std::f64::consts::TAU;

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible_sound::{
    AudibleDamping, Cast, Hearing, Listener, Plate, PlateMaterial, Pose, RecordedTouch, SoundFloor,
    Sounding, SynthConfig,
    glam::{DQuat, DVec3},
};
use serde::Serialize;

use super::RATE;
use crate::Result;

/// Thickness of the shards, m, and ratio of their sides.
pub(super) const THICK: f64 = 0.003;
pub(super) const RATIO: f64 = 1.5;

/// Masses, kg, and speeds, m/s.
const MASSES: [f64; 4] = [3e-4, 1e-3, 5e-3, 2e-2];
const SPEEDS: [f64; 3] = [0.5, 1.0, 3.0];

/// Part of the speed that a landing returns.
const BOUNCE: f64 = 0.3;

/// A shard that lands on a corner, tilted by 45°, 1 m away.
#[derive(Clone, Debug, Serialize)]
pub struct Landing {
    /// Mass, kg.
    #[serde(rename = "mass_kg")]
    pub mass: f64,
    /// Longer side, m.
    #[serde(rename = "side_m")]
    pub side: f64,
    /// For each of `SPEEDS`: the loudest pressure, and the highest level of a meter set to *fast*, dB.
    #[serde(rename = "levels_db")]
    pub levels: Vec<[f64; 2]>,
    /// Growth of both with ten times the speed, dB.
    #[serde(rename = "per_decade_db")]
    pub growth: [f64; 2],
    /// Lowest tone, Hz; its time of decay by 60 dB, s; and that of the material alone.
    #[serde(rename = "lowest_hz_s_s")]
    pub lowest: [f64; 3],
}

/// All of them.
pub(super) fn all() -> Result<Vec<Landing>> {
    MASSES.into_iter().map(Landing::compute).collect()
}

/// The world of one shard.
struct One {
    sounding: Sounding,
    vertices: Vec<Vec3>,
    pose: Pose,
}

/// The triangles of a box whose corner k is at + where a bit of k is set.
const TRIANGLES: [[u32; 3]; 12] = [
    [0, 2, 1],
    [1, 2, 3],
    [4, 5, 6],
    [5, 7, 6],
    [0, 1, 4],
    [1, 5, 4],
    [2, 6, 3],
    [3, 6, 7],
    [0, 4, 2],
    [2, 4, 6],
    [1, 3, 5],
    [3, 7, 5],
];

impl Cast for One {
    fn name(&self, _: usize) -> &str {
        "shard"
    }
    fn sounding(&self, _: usize) -> &Sounding {
        &self.sounding
    }
    fn vertices(&self, _: usize) -> &[Vec3] {
        &self.vertices
    }
    fn triangles(&self, _: usize) -> Vec<[u32; 3]> {
        TRIANGLES.to_vec()
    }
    fn balls(&self, _: f64) -> Vec<usize> {
        Vec::new()
    }
    fn pose(&self, _: usize, _: f64) -> Pose {
        self.pose
    }
    fn floor(&self) -> Option<f32> {
        Some(0.0)
    }
}

impl Landing {
    fn compute(mass: f64) -> Result<Self> {
        let glass = Material::preset("glass")?;
        let width = (mass / (glass.density * THICK * RATIO)).sqrt();
        let sides = [RATIO * width, width, THICK];
        let half = sides.map(|side| 0.5 * side as f32);
        let corner = |k: usize| {
            let at = |bit: usize, half: f32| if k & bit > 0 { half } else { -half };
            Vec3::new(at(1, half[0]), at(2, half[1]), at(4, half[2]))
        };
        let vertices: Vec<Vec3> = (0..8).map(corner).collect();
        let rotation =
            Quat::from_rotation_x(std::f32::consts::FRAC_PI_4) * Quat::from_rotation_y(0.3);
        let lowest = (vertices.iter().map(|&v| rotation * v))
            .min_by(|a, b| a.y.total_cmp(&b.y))
            .unwrap_or_default();
        let one = One {
            sounding: Sounding::Piece(glass.clone(), mass),
            pose: Pose {
                translation: -lowest,
                rotation,
            },
            vertices,
        };
        let plate = PlateMaterial {
            youngs_modulus: glass.youngs_modulus,
            poisson_ratio: glass.poisson_ratio,
            density: glass.density,
            damping: AudibleDamping::of(&glass),
        };
        let (_, body) = Plate::new("shard", sides, DQuat::IDENTITY, &plate)?;
        let back = rotation.inverse();
        let yields = body.yields(back * lowest, back * Vec3::Y);
        let levels = SPEEDS.map(|speed| {
            let touch = RecordedTouch {
                time: 0.0,
                nodes: (0, None),
                point: Vec3::ZERO,
                normal: Vec3::Y,
                impulse: (1.0 + BOUNCE) * speed / yields,
                speed,
            };
            heard(&one, &touch)
        });
        let levels: Vec<[f64; 2]> = levels.into_iter().collect::<Result<_>>()?;
        let decades = (SPEEDS[2] / SPEEDS[0]).log10();
        let growth = [0, 1].map(|k| (levels[2][k] - levels[0][k]) / decades);
        let tone = body.modes.first().map_or([f64::NAN; 3], |mode| {
            let material = plate.damping.loss(TAU * mode.frequency);
            let alone = 6.0 * std::f64::consts::LN_10 / material;
            [mode.frequency, mode.reverberation(), alone]
        });
        Ok(Self {
            mass,
            side: sides[0],
            levels,
            growth,
            lowest: tone,
        })
    }
}

/// The loudest pressure of a landing 1 m away, and the highest level of a meter set to *fast*, dB.
fn heard(one: &One, touch: &RecordedTouch) -> Result<[f64; 2]> {
    let listener = Listener {
        channels: 1,
        ..Listener::at(DVec3::new(0.7, 0.5, 0.51), DVec3::ZERO)
    };
    let mut config = SynthConfig::new(listener);
    let stone = Material::preset("stone")?;
    config.floor = Some(SoundFloor::of(&stone, 0.0));
    let mut hearing = Hearing::new(config, Some(stone))?;
    hearing.touch(one, touch)?;
    let samples = hearing.until_silence(2.0)?;
    let share = 1.0 - (-1.0 / (super::scenes::FAST * RATE)).exp();
    let (mut mean, mut most, mut peak) = (0.0_f64, 1e-20_f64, 1e-10_f64);
    for sample in samples {
        let pressure = f64::from(sample);
        mean += share * (pressure * pressure - mean);
        most = most.max(mean);
        peak = peak.max(pressure.abs());
    }
    Ok([20.0 * (peak / 2e-5).log10(), 10.0 * (most / 4e-10).log10()])
}
