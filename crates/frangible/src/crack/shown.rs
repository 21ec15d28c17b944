//! The stress of a motion as cracks feel it, for those who look at it.

use crate::body::Body;
use crate::config::FractureConfig;
use crate::motion::{DisplacementBatch, Motion};
use crate::stress::{Symmetric3, lane, largest_eigenvalue};

use super::StressField;

/// The stress of a vibration at the places of a body where cracks could start: at the flaw on the surface of each fracture
/// tetrahedron that has one, else at its centroid.
///
/// All that a break sees is in it: the modes that are followed, those that follow the force, and the near field of contacts on walls.
pub struct ShownStress<'a> {
    body: &'a Body,
    config: &'a FractureConfig,
    motion: &'a Motion,
    pressed: &'a [u32],
    displacement: DisplacementBatch,
}

impl<'a> ShownStress<'a> {
    /// `pressed`: the triangles of the surface that contacts press on ([`Vibration::pressed`](crate::internals::Vibration::pressed)).
    #[must_use]
    pub fn new(
        body: &'a Body,
        config: &'a FractureConfig,
        pressed: &'a [u32],
        motion: &'a Motion,
    ) -> Self {
        Self {
            body,
            config,
            motion,
            pressed,
            displacement: DisplacementBatch::new(&body.asset),
        }
    }

    /// The stress on the outer surface at a time step, Pa: triangles and what a flaw in each of them feels. A triangle whose tetrahedron
    /// has its flaw in another one is left out.
    pub fn on_surface(&mut self, step: usize) -> Vec<(u32, Symmetric3)> {
        let asset = &*self.body.asset;
        self.displacement.seek(self.motion, step);
        let mut field = StressField::new(
            self.body,
            self.config,
            self.motion,
            self.pressed,
            &mut self.displacement,
        );
        field.step = step;
        let flaw = |e: usize| self.body.prepared.skin.flaw(asset.place(e));
        (0..asset.fracture.tets.len())
            .filter_map(|e| {
                let triangle = flaw(e)?.triangle;
                Some((triangle, field.at_weak_point(e).stress(lane(step))))
            })
            .collect()
    }

    /// The largest principal tension anywhere at every time step, Pa.
    pub fn largest_tensions(&mut self) -> Vec<f32> {
        let tets = self.body.asset.fracture.tets.len();
        let steps = self.motion.steps();
        let mut largest = vec![0.0_f32; steps];
        for first in (0..steps).step_by(DisplacementBatch::STRIDE) {
            self.displacement.seek(self.motion, first);
            let mut field = StressField::new(
                self.body,
                self.config,
                self.motion,
                self.pressed,
                &mut self.displacement,
            );
            field.step = first;
            let last = (first + DisplacementBatch::STRIDE).min(steps);
            for e in 0..tets {
                let lanes = field.at_weak_point(e);
                for (step, most) in (first..last).zip(&mut largest[first..last]) {
                    *most = most.max(largest_eigenvalue(&lanes.stress(lane(step))));
                }
            }
        }
        largest
    }
}
