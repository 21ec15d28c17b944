//! The body's stress at one time step, evaluated where it is asked for.

use crate::asset::Asset;
use crate::stress::{DisplacementBatch, Elasticity, StressLanes, StressState};

/// Stress at fracture tetrahedra at one step.
pub(crate) struct StressField<'a> {
    pub(crate) asset: &'a Asset,
    pub(crate) displacement: &'a mut DisplacementBatch,
    pub(crate) elasticity: Elasticity,
    pub(crate) step: usize,
}

impl StressField<'_> {
    /// Stress and strain energy density at the centroid of fracture tetrahedron `e`.
    pub(crate) fn at(&mut self, e: usize) -> StressState {
        let gradient =
            self.displacement
                .gradient(self.asset, &self.asset.embedding.tets[e], self.step);
        self.elasticity.state(gradient)
    }

    /// The same at all steps of the batch.
    #[inline(always)]
    pub(crate) fn lanes(&mut self, e: usize) -> StressLanes {
        let point = &self.asset.embedding.tets[e];
        self.elasticity
            .lanes(&self.displacement.gradients(self.asset, point))
    }
}
