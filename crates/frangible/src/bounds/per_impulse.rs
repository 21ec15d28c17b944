//! Largest stress of a blow, by place and force: a few numbers per surface triangle, so that nearly all contacts of
//! a game are refused by one multiplication.
//!
//! An impulse J at a point b of the surface, put on by a force that is at most P J, moves mode i at most |φ_i(b)| J D_i(P), D_i its
//! [reach](super::Reaches), which for modes that follow the force grows with P. Over a triangle φ_i is linear and its length convex,
//! so with s_i the largest stress of mode i in the body no stress exceeds J · max over its corners of Σ_i s_i |φ_i| D_i(P). That number
//! is kept for values of P a factor apart, the next larger one counts; in sixteenths of octaves, rounded up, so that a triangle
//! takes as many bytes.

use super::ROUNDING;
use super::reach::Reaches;
use super::surface_sums::surface_sums;
use crate::asset::Asset;

/// Count of the values of P that have numbers. Below the smallest value its number counts, above the largest none does.
const RUNGS: usize = 16;

/// Ratio of each value to the next smaller one: 1.6¹⁵ = 1150 from the smallest to the largest.
const RATIO: f32 = 1.6;

/// Codes per octave.
const OCTAVE: f32 = 16.0;

/// Largest stress per impulse, Pa per N·s, of each surface triangle and largest force per impulse.
#[derive(Clone, Debug)]
pub(crate) struct PerImpulse {
    /// Largest force per impulse that has numbers, 1/s.
    highest: f32,
    codes: Vec<[u8; RUNGS]>,
    /// Stress that each code stands for, Pa per N·s.
    numbers: Vec<f32>,
}

impl PerImpulse {
    /// `stress`: largest stress of each mode in the body, Pa per m·√kg.
    pub(crate) fn new(asset: &Asset, stress: &[f32], reaches: &Reaches) -> Self {
        let (rows, highest) = rungs(stress, reaches);
        let triangles = &asset.surface.triangles;
        let sums = surface_sums(asset, &rows);
        let most = sums
            .iter()
            .flatten()
            .fold(f32::MIN_POSITIVE, |a, &b| a.max(b))
            * ROUNDING;
        let numbers = (0..=u8::MAX).map(|code| most * libm::exp2f(-f32::from(code) / OCTAVE));
        let codes = triangles.iter().map(|corners| {
            std::array::from_fn(|rung| {
                let of = corners.map(|node| sums[node as usize][rung]);
                let here = of.into_iter().fold(f32::MIN_POSITIVE, f32::max) * ROUNDING;
                // Towards zero: to a larger number.
                (OCTAVE * libm::log2f(most / here)) as u8
            })
        });
        Self {
            highest,
            codes: codes.collect(),
            numbers: numbers.map(|n| n * ROUNDING).collect(),
        }
    }

    /// Largest stress per impulse on a triangle, Pa per N·s, of a blow whose force is at most `force` per impulse, 1/s.
    pub(crate) fn of(&self, triangle: u32, force: f32) -> f32 {
        if force.is_nan() || force > self.highest {
            return f32::INFINITY;
        }
        // The first logarithm rounds, so that a whole number may be the next one: each rung stands for a little more.
        let rung = libm::log2f(self.highest / force) * libm::log2f(RATIO).recip();
        let code = self.codes[triangle as usize][(rung as usize).min(RUNGS - 1)];
        self.numbers[usize::from(code)]
    }
}

/// s_i D_i of every mode for each largest force per impulse, and the largest of those, 1/s.
fn rungs(stress: &[f32], reaches: &Reaches) -> ([Vec<f32>; RUNGS], f32) {
    let highest = reaches.highest();
    let rows = std::array::from_fn(|rung| {
        let force = highest * RATIO.powi(-(rung as i32)) * ROUNDING;
        let weight = |(i, s): (usize, &f32)| s * reaches.most(i, force);
        stress.iter().enumerate().map(weight).collect()
    });
    (rows, highest)
}
