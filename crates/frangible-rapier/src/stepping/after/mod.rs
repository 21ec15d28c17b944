//! Breaks after the step, within a budget: for scenes of hundreds of bodies.
//!
//! The step stands. A whole body takes its blow, and gives way to its fragments when its turn comes, at the motion it has
//! then: momentum, angular momentum and energy are those of the whole body, and the cracks' energy is taken from the
//! motion as ever. Work is counted in tetrahedra, not in time, so that the same bodies break in the same step on any machine.
//!
//! A blow passes three places: it is found (`hit.rs`), waits in line for its turn (`line.rs`), and is put to the fracture, whose verdict is
//! carried out (`serve.rs`, `obey.rs`). Where the body has got other cracks before the verdict comes, the blow is put to the fracture once
//! more. What a body carries does not wait.
//!
//! A heap costs what its colliders have parts, so the cell shares of a piece are merged to 12 of at most 48 points each.

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
