//! Which weak points need a look at a time step: those of clusters whose stress bound passes the strength.

use crate::body::Body;
use crate::stress::{MARGIN, tension_bound};

/// Passes over clusters of weak points that cannot crack.
pub(crate) struct Culling<'a> {
    body: &'a Body,
    on: bool,
    /// Largest bound of what was passed over so far, Pa …
    pub(crate) passed_over: f32,
    /// … and as the weakest point would feel it, Pa.
    pub(crate) as_weakest: f32,
    /// Whether the bound of the whole body ever let a time step pass.
    pub(crate) asked_clusters: bool,
    survivors: Vec<u32>,
}

impl<'a> Culling<'a> {
    /// With `on` false every cluster needs a look at every step.
    pub(crate) fn new(body: &'a Body, on: bool) -> Self {
        Self {
            body,
            on,
            passed_over: 0.0,
            as_weakest: 0.0,
            asked_clusters: false,
            survivors: Vec::new(),
        }
    }

    /// Bound of the whole body, Pa, when the modes have these amplitudes, m·√kg.
    pub(crate) fn root(&self, amplitudes: &[f32]) -> f32 {
        let prepared = &self.body.prepared;
        let (stress, gradient) = &prepared.root;
        tension_bound(amplitudes, stress, gradient, prepared.quadratic_modulus)
    }

    /// Clusters to look at then, as places in the body's list; `root`: the bound of the whole body.
    pub(crate) fn survivors(&mut self, amplitudes: &[f32], root: f32) -> &[u32] {
        let (prepared, clusters) = (&self.body.prepared, &self.body.clusters.clusters);
        self.survivors.clear();
        if !self.on {
            self.survivors.extend(0..clusters.len() as u32);
            return &self.survivors;
        }
        let bound = |stress: &[f32], gradient: &[f32]| {
            tension_bound(amplitudes, stress, gradient, prepared.quadratic_modulus)
        };
        let resistance = &self.body.resistance;
        if root <= limit(resistance.weakest as f32) {
            self.passed_over = self.passed_over.max(root);
            self.as_weakest = self.as_weakest.max(root);
            return &self.survivors;
        }
        self.asked_clusters = true;
        let modes = amplitudes.len();
        for (i, &cluster) in clusters.iter().enumerate() {
            let row = cluster as usize * modes..(cluster as usize + 1) * modes;
            let of_cluster = bound(
                &prepared.bounds.stress[row.clone()],
                &prepared.bounds.gradient[row],
            );
            let weakest = self.body.clusters.weakest[i];
            if of_cluster <= limit(weakest) {
                self.passed_over = self.passed_over.max(of_cluster);
                let felt = resistance.as_weakest(of_cluster, weakest);
                self.as_weakest = self.as_weakest.max(felt);
            } else {
                self.survivors.push(i as u32);
            }
        }
        &self.survivors
    }
}

/// Below this bound no point reaches its strength where the smallest is this one, Pa.
fn limit(strength: f32) -> f32 {
    strength * (1.0 - MARGIN)
}
