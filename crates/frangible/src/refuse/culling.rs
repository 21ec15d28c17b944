//! Weak points that need a look at a time step: those of clusters whose stress bound passes the strength.

use std::ops::Range;

use super::cluster_bounds::ClusterBounds;
use crate::body::Body;
use crate::bounds::tension_bound;
use crate::config::FractureConfig;
use crate::motion::Motion;
use crate::near_field::NearField;
use crate::stress::{BATCH, Lanes, Steps, Wide, lane, limit};

/// Passes over clusters of weak points that cannot crack.
pub(crate) struct Culling<'a> {
    body: &'a Body,
    on: bool,
    quadratic_modulus: f32,
    /// Largest bound of the skipped stresses so far, Pa.
    pub(crate) passed_over: f32,
    /// Largest bound of the skipped stresses so far, scaled to the strength of the weakest point, Pa.
    pub(crate) as_weakest: f32,
    /// True if the bound of the whole body ever failed to refuse a time step.
    pub(crate) asked_clusters: bool,
    /// Bit k of a cluster's entry: step k of the batch needs a look at the cluster.
    survivors: Vec<Steps>,
    /// Size of each mode's amplitude at the steps of the batch looked at last, m·√kg.
    sizes: Vec<Lanes>,
    /// Largest stress of each residual shape, Pa/N: in the whole body, and in each cluster.
    residuals: Vec<(f32, Vec<f32>)>,
    /// For each near field and cluster the distance in the field's table that bounds the field there.
    near: Vec<Vec<Option<usize>>>,
}

impl<'a> Culling<'a> {
    /// Serves motions that have the same complement to the modes as this one. Without `config.culling` every cluster needs a look at
    /// every step.
    pub(crate) fn new(body: &'a Body, config: &FractureConfig, motion: &Motion) -> Self {
        let quadratic_modulus = body.quadratic_modulus(config);
        let complement = &motion.complement;
        // What follows the force has no bound of its gradient.
        let on = config.culling && (quadratic_modulus == 0.0 || complement.is_empty());
        let parts = ClusterBounds::new(body, quadratic_modulus);
        let count = parts.count();
        let residuals = complement.residuals.iter().filter(|_| on).map(|residual| {
            let of_part = |part| residual.bound(parts.rows(part).0);
            let whole = residual.bound(&body.prepared.whole.0);
            (whole, (0..count).map(of_part).collect())
        });
        let centroids = &body.prepared.centroids;
        let near = complement.near.iter().filter(|_| on).map(|near| {
            let of_part = |part| {
                let tets = body.clusters.tets(part).iter();
                // A weak point lies no farther from the centroid than an edge is long, and its samples no farther than that from its flaw.
                let places = tets.map(|&tet| near.distance(centroids[tet as usize]));
                let around = match body.clusters.deepest[part] {
                    depth if depth > 0.0 => depth + 2.0 * body.prepared.longest_edge,
                    _ => body.prepared.longest_edge,
                };
                let nearest = places.fold(f32::INFINITY, f32::min) - around;
                near.below(near.nearest_along(nearest))
            };
            (0..count).map(of_part).collect()
        });
        Self {
            residuals: residuals.collect(),
            near: near.collect(),
            body,
            on,
            quadratic_modulus,
            passed_over: 0.0,
            as_weakest: 0.0,
            asked_clusters: false,
            survivors: vec![0; count],
            sizes: vec![[0.0; BATCH]; motion.modes],
        }
    }

    /// Bound of the whole body at a time step of the motion, Pa.
    pub(crate) fn root(&self, motion: &Motion, step: usize) -> f32 {
        let (stress, gradient) = &self.body.prepared.whole;
        let (stress, gradient) = (&stress[..motion.modes], &gradient[..motion.modes]);
        let modes = tension_bound(motion.at(step), stress, gradient, self.quadratic_modulus);
        if !self.on {
            // Nothing but old cracks' fronts asks, and they need not be spared.
            return if motion.complement.is_empty() {
                modes
            } else {
                f32::INFINITY
            };
        }
        let complement = &motion.complement;
        let residuals = self.residuals.iter().zip(&complement.residuals);
        let still: f32 = residuals.map(|((s, _), r)| s * r.force(step).abs()).sum();
        let near: f32 = complement
            .near
            .iter()
            .map(|n| n.most(n.below(0.0), step))
            .sum();
        modes + still + near
    }

    /// Begins a batch with these time steps: finds the clusters that need a look at them. Returns the bound of the whole body at each, Pa.
    pub(crate) fn look(&mut self, motion: &Motion, steps: Range<usize>) -> Lanes {
        let mut roots = [0.0; BATCH];
        let mut asked = 0;
        for step in steps.clone() {
            let k = lane(step);
            roots[k] = self.root(motion, step);
            if self.on && roots[k] <= limit(self.body.resistance.weakest as f32) {
                self.passed_over = self.passed_over.max(roots[k]);
                self.as_weakest = self.as_weakest.max(roots[k]);
            } else {
                asked |= 1 << k;
            }
        }
        self.survivors.fill(if self.on { 0 } else { asked });
        if self.on && asked != 0 {
            self.asked_clusters = true;
            let steps = steps.filter(|&step| asked >> lane(step) & 1 == 1);
            ask_clusters(self, motion, steps);
        }
        roots
    }

    /// Bound of a cluster's stress, Pa: that of the modes, and what the forces on the residual shapes, N, and the near fields add.
    #[inline(always)]
    fn with_complement(
        &self,
        mut bound: f32,
        part: usize,
        motion: &Motion,
        force: impl Fn(usize) -> f32,
        near: impl Fn(&NearField, Option<usize>) -> f32,
    ) -> f32 {
        for (i, (_, of_parts)) in self.residuals.iter().enumerate() {
            bound += force(i) * of_parts[part];
        }
        for (of_parts, field) in self.near.iter().zip(&motion.complement.near) {
            bound += near(field, of_parts[part]);
        }
        bound
    }

    /// Returns true if any cluster needs a look at step `k` of the batch.
    pub(crate) fn survives(&self, k: usize) -> bool {
        self.survivors.iter().any(|steps| steps >> k & 1 == 1)
    }

    /// Clusters that need a look at any step of the batch, as places in the body's list, with a bit for each such step.
    pub(crate) fn survivors(&self) -> impl Iterator<Item = (u32, Steps)> {
        let survivors = (0..).zip(self.survivors.iter().copied());
        survivors.filter(|&(_, steps)| steps != 0)
    }
}

widest! {
    /// Finds the clusters that may crack at some time steps of a batch.
    fn ask_clusters[S: Iterator<Item = usize> + Clone](
        culling: &mut Culling<'_>,
        motion: &Motion,
        steps: S,
    ) {
        let parts = ClusterBounds::new(culling.body, culling.quadratic_modulus);
        let mut sizes = std::mem::take(&mut culling.sizes);
        sizes.fill([0.0; BATCH]);
        for step in steps.clone() {
            for (size, q) in sizes.iter_mut().zip(motion.at(step)) {
                size[lane(step)] = q.abs();
            }
        }
        let farthest: Vec<f32> = sizes.iter().map(|q| Wide(*q).largest()).collect();
        let forces = motion.complement.residuals.iter();
        let forces: Vec<f32> = forces
            .map(|r| (steps.clone().map(|step| r.force(step).abs())).fold(0.0, f32::max))
            .collect();
        for part in 0..parts.count() {
            // What bounds all steps at once mostly does; where it might hide what the bound of a step tells, each is asked.
            let near = |near: &NearField, at| {
                (steps.clone().map(|step| near.most(at, step))).fold(0.0, f32::max)
            };
            let modes = parts.bound(part, &farthest);
            let most = culling.with_complement(modes, part, motion, |i| forces[i], near);
            if most <= parts.limit(part)
                && most <= culling.passed_over
                && parts.as_weakest(part, most) <= culling.as_weakest
            {
                continue;
            }
            let modes = parts.bounds(part, &sizes);
            for step in steps.clone() {
                let force = |i: usize| motion.complement.residuals[i].force(step).abs();
                let near = |near: &NearField, at| near.most(at, step);
                let modes = modes[lane(step)];
                let bound = culling.with_complement(modes, part, motion, force, near);
                if bound <= parts.limit(part) {
                    culling.passed_over = culling.passed_over.max(bound);
                    culling.as_weakest = (culling.as_weakest).max(parts.as_weakest(part, bound));
                } else {
                    culling.survivors[part] |= 1 << lane(step);
                }
            }
        }
        culling.sizes = sizes;
    }
}
