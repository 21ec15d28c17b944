//! Weak points that stay calm between a few time steps, the knots, so that no other step needs a look at them.
//!
//! In the paper's model the largest principal tension is a convex function of the displacement gradient: strain of Green and Lagrange is one in
//! the sense of matrices, and Hooke's law keeps that unless λ is negative. So on a straight line between two knots the tension is
//! no larger than at the larger end. How far the gradient strays from that line is bounded mode by mode, as all stress of a cluster is. Few points
//! are left that need a look at all steps.

use super::field::StressField;
use crate::body::Body;
use crate::bounds::{sum_of_sizes, sums_of_sizes};
use crate::config::CrackTiming;
use crate::motion::{DisplacementBatch, Knots};
use crate::stress::{BATCH, Lanes, Law, STRIDE, Steps, Wide, limit};

/// Rounding, relative to what the modes could add up to.
const ROUNDING: f32 = 1e-5;

/// Search for the weak points that stay calm in one motion.
#[derive(Clone, Debug)]
pub(super) struct Calm {
    knots: Knots,
    displacement: DisplacementBatch,
    /// The batch of knots that is held.
    batch: usize,
    /// The gaps in it that hold the steps to look at, a bit each.
    own: Steps,
    /// Largest deviation of each mode from a straight line in its gaps, m·√kg.
    strays: Vec<Lanes>,
    /// The farthest that each mode moves at its knots, m·√kg.
    farthest: Vec<f32>,
    /// True for clusters whose points have been looked at in that batch.
    known: Vec<bool>,
    /// For each weak point, in the order of the clusters, the gaps in which it may crack, bit k for the gap that ends with the knot of lane k.
    restless: Vec<Steps>,
    /// Largest tension of each weak point in the gaps in which it does not, Pa.
    most: Vec<f32>,
}

impl Calm {
    /// Returns true if the search can be used: with culling, in motions of more than two batches, for instant cracks, and for stress at centroids by
    /// Hooke's law in space from modes alone.
    pub(super) fn serves(field: &StressField) -> bool {
        let config = field.config;
        config.culling
            && field.motion.steps() > 2 * STRIDE
            && config.timing == CrackTiming::Instant
            && !config.surface_flaws
            && !config.sized_flaws
            && !config.plane_stress_walls
            && field.near.0.is_empty()
            && field.displacement.residuals().is_empty()
            && field.asset.material.lame_lambda() >= 0.0
    }

    /// A search that knows nothing yet of the motion of a field.
    pub(super) fn of(body: &Body, field: &StressField) -> Self {
        let points = body.weak_tets().len();
        Self {
            knots: Knots::of(field.motion),
            displacement: DisplacementBatch::new(field.asset),
            batch: usize::MAX,
            own: 0,
            strays: Vec::new(),
            farthest: Vec::new(),
            known: vec![false; body.clusters.clusters.len()],
            restless: vec![0; points],
            most: vec![0.0; points],
        }
    }

    /// Makes sure that the knots about the field's step are held.
    pub(super) fn seek(&mut self, field: &StressField) {
        let (batch, own) = self.knots.about(field.step / STRIDE);
        self.own = own.fold(0, |bits, k| bits | 1 << k);
        if self.batch != batch {
            self.batch = batch;
            self.displacement.seek(&self.knots.motion, batch * STRIDE);
            self.strays = self.knots.strays(batch);
            let amplitudes = self.displacement.amplitudes().iter();
            let farthest = amplitudes.map(|q| Wide(q.map(f32::abs)).largest());
            self.farthest = farthest.collect();
            self.known.fill(false);
        }
    }

    /// Looks at the points of the cluster at place `cluster` of the body's list, unless it did.
    #[inline(always)]
    pub(super) fn look(&mut self, body: &Body, field: &StressField, cluster: usize) {
        if std::mem::replace(&mut self.known[cluster], true) {
            return;
        }
        let modes = self.farthest.len();
        let bounds = &body.prepared.bounds;
        let number = body.clusters.clusters[cluster] as usize;
        let (stress, gradient) = bounds.rows(number, body.asset.modes.count());
        let (stress, gradient) = (&stress[..modes], &gradient[..modes]);
        let rounding = ROUNDING * sum_of_sizes(&self.farthest, stress);
        let astray = sums_of_sizes(&self.strays, stress);
        let modulus = body.quadratic_modulus(field.config);
        let turned = match modulus > 0.0 {
            true => sums_of_sizes(&self.strays, gradient),
            false => Lanes::default(),
        };
        let points = body
            .clusters
            .places(cluster)
            .zip(body.clusters.tets(cluster));
        for (place, &tet) in points {
            let point = field.asset.embedded_tet(tet as usize);
            let gradients = self.displacement.gradients(field.asset, point);
            let state = field.elasticity.lanes(&gradients, Law::Solid);
            let (at, sizes) = (state.tension_bounds(), sizes(&gradients));
            let limit = limit(body.resistance.strength(tet));
            let mut bounds = Lanes::default();
            for k in 1..BATCH {
                // C : ½ ((G + R)ᵀ(G + R) − GᵀG), of a gradient G on the line from which R strays.
                let size = larger(sizes[k - 1], sizes[k]);
                let quadratic = modulus * turned[k] * (size + 0.5 * turned[k]);
                bounds[k] = larger(at[k - 1], at[k]) + astray[k] + quadratic + rounding;
            }
            let (mut restless, mut most) = (0, Wide(bounds).largest());
            if most > limit {
                most = 0.0;
                for (k, bound) in bounds.into_iter().enumerate() {
                    let calm = bound <= limit;
                    restless |= Steps::from(!calm) << k;
                    most = if calm { larger(most, bound) } else { most };
                }
            }
            (self.restless[place], self.most[place]) = (restless, most);
        }
    }

    /// Returns true if a weak point, by its place in the order of the clusters, may crack in the batch of steps that the knots were sought for.
    #[inline(always)]
    pub(super) fn is_restless(&self, place: usize) -> bool {
        self.restless[place] & self.own != 0
    }

    /// Largest tension of a weak point in the gaps in which it does not crack, Pa.
    #[inline(always)]
    pub(super) fn most(&self, place: usize) -> f32 {
        self.most[place]
    }
}

/// Norms of displacement gradients.
#[inline(always)]
fn sizes(gradients: &[[Wide; 3]; 3]) -> Lanes {
    let mut squares = Wide::default();
    for column in gradients {
        for entry in column {
            squares = squares + *entry * *entry;
        }
    }
    squares.sqrt().0
}

/// The larger of two numbers, neither of which is NaN.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}
