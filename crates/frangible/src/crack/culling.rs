//! Which weak points need a look at a time step: those of clusters whose stress bound passes the strength.

use super::parts::Parts;
use crate::body::Body;
use crate::config::FractureConfig;
use crate::stress::{MARGIN, tension_bound};

/// Passes over clusters of weak points that cannot crack.
pub(crate) struct Culling<'a> {
    body: &'a Body,
    on: bool,
    quadratic_modulus: f32,
    /// Largest bound of what was passed over so far, Pa …
    pub(crate) passed_over: f32,
    /// … and as the weakest point would feel it, Pa.
    pub(crate) as_weakest: f32,
    /// Whether the bound of the whole body ever let a time step pass.
    pub(crate) asked_clusters: bool,
    /// Of each cluster, a bit for each step of the batch that needs a look.
    survivors: Vec<u8>,
    /// Bounds of the clusters at the step looked at last, Pa.
    bounds: Vec<f32>,
}

impl<'a> Culling<'a> {
    /// Without `config.culling` every cluster needs a look at every step.
    pub(crate) fn new(body: &'a Body, config: &FractureConfig) -> Self {
        Self {
            body,
            on: config.culling,
            quadratic_modulus: body.quadratic_modulus(config),
            passed_over: 0.0,
            as_weakest: 0.0,
            asked_clusters: false,
            survivors: vec![0; body.clusters.clusters.len()],
            bounds: Vec::new(),
        }
    }

    /// Bound of the whole body, Pa, when the modes have these amplitudes, m·√kg.
    pub(crate) fn root(&self, amplitudes: &[f32]) -> f32 {
        let prepared = &self.body.prepared;
        let (stress, gradient) = &prepared.whole;
        tension_bound(amplitudes, stress, gradient, self.quadratic_modulus)
    }

    /// Clusters to look at when the modes have these amplitudes at step `k` of a batch, added to the batch's list;
    /// `root`: the bound of the whole body.
    pub(crate) fn survive(&mut self, amplitudes: &[f32], root: f32, k: usize) {
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
        let parts = Parts::new(self.body, self.quadratic_modulus);
        parts.bounds(amplitudes, &mut self.bounds);
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
    pub(crate) fn survivors(&self) -> impl Iterator<Item = (u32, u8)> {
        let survivors = (0..).zip(self.survivors.iter().copied());
        survivors.filter(|&(_, steps)| steps != 0)
    }
}

/// Below this bound no point reaches its strength where the smallest is this one, Pa.
pub(super) fn limit(strength: f32) -> f32 {
    strength * (1.0 - MARGIN)
}
