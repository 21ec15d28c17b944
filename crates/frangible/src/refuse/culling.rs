//! Which weak points need a look at a time step: those of clusters whose stress bound passes the strength.

use super::cluster_bounds::ClusterBounds;
use crate::body::Body;
use crate::bounds::tension_bound;
use crate::config::FractureConfig;
use crate::motion::Motion;
use crate::stress::{Steps, limit};

/// Passes over clusters of weak points that cannot crack.
pub(crate) struct Culling<'a> {
    body: &'a Body,
    on: bool,
    quadratic_modulus: f32,
    /// Largest bound of what was passed over so far, Pa.
    pub(crate) passed_over: f32,
    /// Largest bound of what was passed over so far, as the weakest point would feel it, Pa.
    pub(crate) as_weakest: f32,
    /// Whether the bound of the whole body ever let a time step pass.
    pub(crate) asked_clusters: bool,
    /// Bit k of a cluster's entry: step k of the batch needs a look at the cluster.
    survivors: Vec<Steps>,
    /// Bounds of the clusters at the step looked at last, Pa.
    bounds: Vec<f32>,
    /// Most stress of each residual shape, Pa/N: in the whole body, and in each cluster.
    residuals: Vec<(f32, Vec<f32>)>,
    /// For each near field and cluster a distance from the contact that none of its points is nearer than, m.
    distances: Vec<Vec<f32>>,
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
        let distances = complement.near.iter().filter(|_| on).map(|near| {
            let of_part = |part| {
                let tets = body.clusters.tets(part).iter();
                // A flaw lies no farther from the centroid than an edge is long.
                let places = tets.map(|&tet| near.distance(centroids[tet as usize]));
                let nearest = places.fold(f32::INFINITY, f32::min) - body.prepared.longest_edge;
                near.nearest_along(nearest)
            };
            (0..count).map(of_part).collect()
        });
        Self {
            residuals: residuals.collect(),
            distances: distances.collect(),
            body,
            on,
            quadratic_modulus,
            passed_over: 0.0,
            as_weakest: 0.0,
            asked_clusters: false,
            survivors: vec![0; count],
            bounds: Vec::new(),
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
        let near: f32 = complement.near.iter().map(|n| n.most(0.0, step)).sum();
        modes + still + near
    }

    /// Clusters to look at at a time step, number `k` of a batch, added to the batch's list; `root`: the bound of the whole body.
    pub(crate) fn survive(&mut self, motion: &Motion, step: usize, root: f32, k: usize) {
        if !self.on {
            self.survivors.iter_mut().for_each(|steps| *steps |= 1 << k);
            return;
        }
        if root <= limit(self.body.resistance.weakest as f32) {
            self.passed_over = self.passed_over.max(root);
            self.as_weakest = self.as_weakest.max(root);
            return;
        }
        self.asked_clusters = true;
        let parts = ClusterBounds::new(self.body, self.quadratic_modulus);
        parts.bounds(motion.at(step), &mut self.bounds);
        let complement = &motion.complement;
        for ((_, of_parts), residual) in self.residuals.iter().zip(&complement.residuals) {
            let force = residual.force(step).abs();
            for (bound, stress) in self.bounds.iter_mut().zip(of_parts) {
                *bound += force * stress;
            }
        }
        for (distances, near) in self.distances.iter().zip(&complement.near) {
            for (bound, &distance) in self.bounds.iter_mut().zip(distances) {
                *bound += near.most(distance, step);
            }
        }
        for (i, &of_part) in self.bounds.iter().enumerate() {
            if of_part <= parts.limit(i) {
                self.passed_over = self.passed_over.max(of_part);
                self.as_weakest = self.as_weakest.max(parts.as_weakest(i, of_part));
            } else {
                self.survivors[i] |= 1 << k;
            }
        }
    }

    /// Forgets the survivors: a new batch begins.
    pub(crate) fn begin(&mut self) {
        self.survivors.fill(0);
    }

    /// Whether any cluster needs a look at step `k` of the batch.
    pub(crate) fn survives(&self, k: usize) -> bool {
        self.survivors.iter().any(|steps| steps >> k & 1 == 1)
    }

    /// Clusters that need a look at any step of the batch, as places in the body's list, with a bit for each such step.
    pub(crate) fn survivors(&self) -> impl Iterator<Item = (u32, Steps)> {
        let survivors = (0..).zip(self.survivors.iter().copied());
        survivors.filter(|&(_, steps)| steps != 0)
    }
}
