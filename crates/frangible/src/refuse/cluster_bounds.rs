//! Bounds of the stress in each cluster that holds weak points, from the largest amplitude of each mode.

use super::impact::Refusal;
use crate::body::Body;
use crate::bounds::{tension_bound, tension_bounds};
use crate::outcome::LookedAt;
use crate::stress::{Lanes, limit};

/// Bounds of all parts that hold weak points, asked one after another.
pub(crate) struct ClusterBounds<'a> {
    body: &'a Body,
    quadratic_modulus: f32,
}

impl<'a> ClusterBounds<'a> {
    pub(crate) fn new(body: &'a Body, quadratic_modulus: f32) -> Self {
        Self {
            body,
            quadratic_modulus,
        }
    }

    /// Number of parts.
    pub(crate) fn count(&self) -> usize {
        self.body.clusters.clusters.len()
    }

    /// Rows of the largest stress of each mode in a part, Pa per m·√kg, and of its gradient.
    #[inline(always)]
    pub(crate) fn rows(&self, part: usize) -> (&'a [f32], &'a [f32]) {
        let bounds = &self.body.prepared.bounds;
        let modes = self.body.asset.modes.count();
        self.body.clusters.rows(bounds, part, modes)
    }

    /// Upper bound of the stress in a part, Pa, when the modes move no farther than `amplitudes`, m·√kg.
    #[inline(always)]
    pub(crate) fn bound(&self, part: usize, amplitudes: &[f32]) -> f32 {
        let (stress, gradient) = self.rows(part);
        let modes = amplitudes.len();
        let (stress, gradient) = (&stress[..modes], &gradient[..modes]);
        tension_bound(amplitudes, stress, gradient, self.quadratic_modulus)
    }

    /// [`Self::bound`] at each step of a batch, from the size of each mode's amplitude at each, m·√kg.
    #[inline(always)]
    pub(super) fn bounds(&self, part: usize, sizes: &[Lanes]) -> Lanes {
        let (stress, gradient) = self.rows(part);
        let modes = sizes.len();
        let (stress, gradient) = (&stress[..modes], &gradient[..modes]);
        tension_bounds(sizes, stress, gradient, self.quadratic_modulus)
    }

    /// Bound below which no point of the part reaches its strength, Pa.
    pub(crate) fn limit(&self, part: usize) -> f32 {
        limit(self.body.clusters.weakest[part])
    }

    /// Returns the bound scaled to the strength of the body's weakest point, Pa.
    pub(crate) fn as_weakest(&self, part: usize, bound: f32) -> f32 {
        let weakest = self.body.clusters.weakest[part];
        self.body.resistance.as_weakest(bound, weakest)
    }
}

widest! {
    /// The bounds of all parts.
    fn all_bounds(parts: &ClusterBounds<'_>, amplitudes: &[f32], bounds: &mut [f32]) {
        for (part, bound) in bounds.iter_mut().enumerate() {
            *bound = parts.bound(part, amplitudes);
        }
    }
}

/// Refuses an impact if no weak point cracks when the modes move no farther than `amplitudes`, m·√kg: by the bounds of all parts.
pub(crate) fn refused_by_clusters(
    body: &Body,
    amplitudes: &[f32],
    quadratic_modulus: f32,
) -> Option<Refusal> {
    let parts = ClusterBounds::new(body, quadratic_modulus);
    let mut refusal = Refusal {
        looked_at: LookedAt::Impulses,
        bound: 0.0,
        as_weakest: 0.0,
    };
    let mut bounds = vec![0.0; parts.count()];
    all_bounds(&parts, amplitudes, &mut bounds);
    for (part, bound) in bounds.into_iter().enumerate() {
        let harmless = bound <= parts.limit(part);
        if !harmless {
            return None;
        }
        refusal.raise(bound, parts.as_weakest(part, bound));
    }
    Some(refusal)
}
