//! Breaks after the step, within a budget: for scenes of hundreds of bodies.
//!
//! The step is kept. The whole body takes the impact, and its fragments replace it later, with the motion that it has then: momentum, angular
//! momentum and energy are those of the whole body, and the energy of the cracks is taken from the motion as usual. Work is counted in
//! tetrahedra, not in time, so that the same bodies break in the same step on any machine.
//!
//! An impact is detected (`hit.rs`), waits in the queue (`line.rs`), and is evaluated by the fracture model, whose result is then applied
//! (`serve.rs`, `obey.rs`). If the body has new cracks by then, the impact is evaluated again. Resting loads do not wait.
//!
//! The cost of a heap grows with the number of collider parts, so the parts of a piece are merged into at most 12 with at most 48 points each.

mod hit;
pub(crate) mod line;
mod obey;
mod serve;

use rapier3d::dynamics::RigidBodyHandle;

use crate::callbacks::Callbacks;
use crate::error::WorldError;
use crate::timings::Watch;
use crate::world::BreakableWorld;

impl BreakableWorld {
    /// Takes a step of Rapier, and breaks bodies after it.
    pub(super) fn step_then_break(
        &mut self,
        budget: usize,
        delay: usize,
        caller: Callbacks<'_>,
    ) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        self.state.motions.note(&self.physics.bodies);
        let weighs = self.weighs_now();
        let overloaded: Vec<RigidBodyHandle> = if weighs {
            self.overloaded().collect()
        } else {
            Vec::new()
        };
        self.timings.upkeep += watch.lap();
        self.advance_guarded(caller);
        watch.lap();
        let before = self.hit_bodies(&overloaded);
        let blows = self.blows(&before);
        self.queue(blows);
        self.timings.contacts += watch.lap();
        self.upkeep();
        watch.lap();
        let weighed = if weighs {
            self.weigh(Some(&before))
        } else {
            Ok(())
        };
        self.timings.loads += watch.lap();
        let mut done = Ok(());
        for handle in overloaded {
            done = done.and(self.give_way_to_load(handle, &before));
        }
        done.and(self.serve(budget, delay, &before))
            .and(self.conclude())
            .and(weighed)
    }
}
