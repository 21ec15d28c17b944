//! How much a body bears of a blow, by place and force: a few numbers per surface triangle, so that nearly all contacts of
//! a game are refused by one multiplication.
//!
//! An impulse J at a point b of the surface, put on by a force that is at most P J, moves mode i at most |φ_i(b)| J D_i(P), D_i its
//! [reach](crate::modal::Reaches), which for modes that follow the force grows with P. Over a triangle φ_i is linear and its length convex,
//! so with s_i the largest stress of mode i in the body no stress exceeds J · max over its corners of Σ_i s_i |φ_i| D_i(P). That number
//! is kept for values of P a factor apart, the next larger one counts; in sixteenths of octaves, rounded up, so that a triangle
//! takes as many bytes.

use glam::Vec3;

use super::load::carriers;
use crate::asset::Asset;
use crate::mesh::SurfacePoint;
use crate::modal::Reaches;
use crate::stress::dot;

/// Values of P that have numbers; below the smallest that one counts, above the largest none does.
const RUNGS: usize = 16;

/// Each is so many times the next smaller one: 1.6¹⁵ = 1150 from the smallest to the largest.
const RATIO: f32 = 1.6;

/// Codes to an octave.
const OCTAVE: f32 = 16.0;

/// Share of the numbers that rounding of sums over a few thousand terms cannot reach.
const ROUNDING: f32 = 1.0 + 1e-4;

/// Largest stress per impulse, Pa per N·s, of each surface triangle and largest force per impulse.
#[derive(Clone, Debug)]
pub(crate) struct PerImpulse {
    /// Largest force per impulse that has numbers, 1/s.
    highest: f32,
    codes: Vec<[u8; RUNGS]>,
    /// What a code stands for, Pa per N·s.
    numbers: Vec<f32>,
}

impl PerImpulse {
    /// `stress`: largest stress of each mode in the body, Pa per m·√kg.
    pub(crate) fn new(asset: &Asset, stress: &[f32], reaches: &Reaches) -> Self {
        let (rows, highest) = rungs(stress, reaches);
        let triangles = &asset.surface.triangles;
        let mut sums = vec![[0.0_f32; RUNGS]; asset.surface_positions().len()];
        if !stress.is_empty() {
            pulp::Arch::new().dispatch(AtNodes {
                asset,
                rows: &rows,
                sums: &mut sums,
            });
        }
        let most = sums
            .iter()
            .flatten()
            .fold(f32::MIN_POSITIVE, |a, &b| a.max(b))
            * ROUNDING;
        let numbers = (0..=u8::MAX).map(|code| most * (-f32::from(code) / OCTAVE).exp2());
        let codes = triangles.iter().map(|corners| {
            std::array::from_fn(|rung| {
                let of = corners.map(|node| sums[node as usize][rung]);
                let here = of.into_iter().fold(f32::MIN_POSITIVE, f32::max) * ROUNDING;
                // Towards zero: to a larger number.
                (OCTAVE * (most / here).log2()) as u8
            })
        });
        Self {
            highest,
            codes: codes.collect(),
            numbers: numbers.map(|n| n * ROUNDING).collect(),
        }
    }

    /// Most stress per impulse on a triangle, Pa per N·s, of a blow whose force is at most `force` per impulse, 1/s.
    pub(crate) fn of(&self, triangle: u32, force: f32) -> f32 {
        if force.is_nan() || force > self.highest {
            return f32::INFINITY;
        }
        // The first logarithm rounds, so that a whole number may be the next one: each rung stands for a little more.
        let rung = (self.highest / force).log2() * RATIO.log2().recip();
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

/// The sums at all nodes of the surface.
struct AtNodes<'a> {
    asset: &'a Asset,
    rows: &'a [Vec<f32>; RUNGS],
    sums: &'a mut [[f32; RUNGS]],
}

impl pulp::NullaryFnOnce for AtNodes<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let mut shapes = Shapes::new(self.rows[0].len());
        let mut known = vec![false; self.sums.len()];
        for (triangle, corners) in self.asset.surface.triangles.iter().enumerate() {
            for (k, &node) in corners.iter().enumerate() {
                if known[node as usize] {
                    continue;
                }
                known[node as usize] = true;
                shapes.find(self.asset, triangle as u32, k);
                // A loop, not a map: its closure would not be compiled for the wider vectors.
                for (sum, row) in self.sums[node as usize].iter_mut().zip(self.rows) {
                    *sum = dot(&shapes.lengths, row);
                }
            }
        }
    }
}

/// The mode shapes at a corner of the surface.
struct Shapes {
    /// φ_x, φ_y, φ_z of every mode, 1/√kg.
    axes: [Vec<f32>; 3],
    /// |φ|.
    lengths: Vec<f32>,
}

impl Shapes {
    fn new(modes: usize) -> Self {
        Self {
            axes: std::array::from_fn(|_| vec![0.0; modes]),
            lengths: vec![0.0; modes],
        }
    }

    /// At a triangle's corner.
    #[inline(always)]
    fn find(&mut self, asset: &Asset, triangle: u32, corner: usize) {
        self.axes.iter_mut().for_each(|axis| axis.fill(0.0));
        let mut weights = [0.0; 3];
        weights[corner] = 1.0;
        let at = SurfacePoint {
            triangle,
            weights,
            position: Vec3::ZERO,
        };
        let (carriers, count) = carriers(asset, &at);
        for &(node, weight) in carriers[..count].iter().filter(|c| c.1 != 0.0) {
            for (axis, sums) in self.axes.iter_mut().enumerate() {
                let row = asset.modes.row(3 * node as usize + axis);
                for (sum, &phi) in sums.iter_mut().zip(row) {
                    *sum += weight * phi;
                }
            }
        }
        let [x, y, z] = &self.axes;
        for (((length, x), y), z) in self.lengths.iter_mut().zip(x).zip(y).zip(z) {
            *length = (x * x + y * y + z * z).sqrt();
        }
    }
}
