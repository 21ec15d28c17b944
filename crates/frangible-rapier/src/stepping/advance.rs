//! Rapier's own step, as fragments need it.
//!
//! Two things differ from a plain call of the engine. A blow runs through a chain of fragments one link per solver iteration, so a step with
//! fragments just born has more of these; with too few a piece between floor and chain is squeezed through a thin floor. And what the
//! engine let pass through a fixed surface all the same is put back in front of it (`guard.rs`).

use crate::callbacks::{Callbacks, Hooks};
use crate::calm::guard::{Centres, centres, put_back};
use crate::timings::Watch;
use crate::world::BreakableWorld;

/// Solver iterations of a step with newborn fragments, in units of an ordinary step's. Measured with 100 fragments:
/// 1, 2, 4 cost 5.0, 7.0, 8.2 ms for the whole breaking step; below 4, pieces left wedged gain energy afterwards.
const BREAK_ITERATIONS: usize = 4;

impl BreakableWorld {
    /// A step that is not undone, with the guard against tunnelling around it.
    pub(super) fn advance_guarded(&mut self, caller: Callbacks<'_>) {
        let mut watch = Watch::start();
        let centres = self.guarded_centres();
        self.timings.upkeep += watch.lap();
        self.advance(caller);
        watch.lap();
        put_back(&mut self.physics, &centres);
        self.timings.upkeep += watch.lap();
    }

    /// A step without the guard.
    pub(super) fn advance(&mut self, caller: Callbacks<'_>) {
        // Fragments of a blast are newborn when the step begins.
        if self.events.is_empty() {
            self.advance_plainly(caller);
        } else {
            self.advance_finely(caller);
        }
    }

    /// A step with fragments just born.
    pub(super) fn advance_finely(&mut self, caller: Callbacks<'_>) {
        let iterations = self.physics.integration_parameters.num_solver_iterations;
        self.physics.integration_parameters.num_solver_iterations = BREAK_ITERATIONS * iterations;
        self.advance_plainly(caller);
        self.physics.integration_parameters.num_solver_iterations = iterations;
    }

    fn advance_plainly(&mut self, caller: Callbacks<'_>) {
        let mut watch = Watch::start();
        let hooks = Hooks {
            own: caller.hooks,
            siblings: &self.siblings,
        };
        self.physics.step_with_events(&hooks, caller.events);
        self.timings.rigid += watch.lap();
    }

    /// Present centres of the bodies that the guard looks after.
    pub(super) fn guarded_centres(&self) -> Centres {
        let fragments = self.siblings.fragments();
        let plain = fragments.filter(|&h| self.breakable(h).is_none());
        centres(&self.physics, plain.chain(self.breakables()))
    }
}
