//! Load that a body carries wherever it acts: one number per body, so that most loads need not be looked at.
//!
//! A force f at a point b of the surface moves mode i to φ_i(b)·f / λ_i, at most |φ_i(b)| |f| / λ_i. Over a triangle φ_i
//! is linear and its length convex, so its largest value is at a corner. With s_i the largest stress of mode i in the
//! body, forces whose sizes add up to F cause no more stress than F · max over corners of Σ_i s_i |φ_i| / λ_i.

use super::harmless;
use crate::blow::SteadyNear;
use crate::body::Body;
use crate::bounds::{PerNewton, ROUNDING, surface_sums};

impl PerNewton {
    fn of(body: &Body) -> Self {
        let (asset, prepared) = (&*body.asset, &*body.prepared);
        let (stress, gradient) = &prepared.whole;
        // What a mode brings when it is pushed by one newton.
        let per_push = |most: &[f32]| {
            let pairs = most.iter().zip(&prepared.periods);
            pairs.map(|(m, period)| m * period * period).collect()
        };
        let rows: [Vec<f32>; 2] = [per_push(stress), per_push(gradient)];
        let mut most = Self::default();
        for sums in surface_sums(asset, &rows) {
            most.force = [0, 1].map(|k| most.force[k].max(sums[k] * ROUNDING));
        }
        // A wall may be pushed right where its near field is: bounded from the longest waves that the modes leave to it.
        let walls = asset.surface.walls.thickness.len() as u32;
        let near = (0..walls).filter_map(|t| SteadyNear::most_per_newton(body, t));
        most.force[0] += near.fold(0.0, f32::max);
        most.gravity = rows.map(|row| {
            let terms = prepared.weight.iter().zip(row);
            terms.map(|(w, r)| w.length() * r).sum::<f32>() * ROUNDING
        });
        most
    }
}

impl Body {
    /// Computes the bound that its first steady load asks for, so that the load does not have to wait for it.
    pub fn prepare_for_loads(&self) {
        self.prepared.per_newton.get_or_init(|| PerNewton::of(self));
    }
}

/// Lower bound of a body's margin, strength over stress, under forces whose sizes (N) add up to `total`, wherever they act, and
/// under `gravity` (m/s²) when it is held, after they have lasted for `duration` (s). Far below what [`rest`](crate::internals::rest) finds, but it
/// takes a handful of multiplications: above 1, nothing happens.
#[must_use]
pub fn rest_margin_at_least(body: &Body, total: f32, gravity: f32, duration: f64) -> f64 {
    let most = body.prepared.per_newton.get_or_init(|| PerNewton::of(body));
    let [stress, gradient] = [0, 1].map(|k| total * most.force[k] + gravity * most.gravity[k]);
    let bound = stress + 0.5 * body.prepared.quadratic_modulus * gradient * gradient;
    let left = body
        .resistance
        .left_after(duration, body.resistance.weakest);
    f64::from(harmless(body, left)) / f64::from(bound)
}
