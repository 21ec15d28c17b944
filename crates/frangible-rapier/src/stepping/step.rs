//! The front door: one time step of a world whose bodies can break.
//!
//! A step has three parts. Before it, pieces that are ready join the bodies that can break, merged ones that may be hit
//! come loose (`loosen.rs`), and blasts and scripted blows act (`pushes.rs`). Then Rapier takes its step, and bodies break inside it or
//! after it, as [`Breaking`] says. After it, rolling bodies are slowed, resting ones kept in their place, and debris beyond its limit is removed;
//! the loads of bodies are looked at then (`resting.rs`).

use rapier3d::pipeline::{EventHandler, PhysicsHooks};

use crate::callbacks::Callbacks;
use crate::calm::rolling::resist_rolling;
use crate::config::Breaking;
use crate::error::WorldError;
use crate::event::BreakEvent;
use crate::timings::{StepTimings, Watch};
use crate::world::BreakableWorld;

impl BreakableWorld {
    /// Advances the world by one time step and returns the breaks in it.
    ///
    /// # Errors
    /// The fracture model rejected an asset or a contact. The step is complete and the body whole: continue, or remove the body.
    pub fn step(&mut self) -> Result<&[BreakEvent], WorldError> {
        self.step_for(Callbacks::NONE)
    }

    /// Like [`step`](Self::step), with the caller's own hooks and event handler.
    ///
    /// A step in which a body breaks is undone and repeated. Events of an undone step are dropped; events of the final step are delivered
    /// afterwards, in Rapier's order. Hooks are called in every attempt. Colliders of fragments inherit the active hooks and events of their
    /// body's collider and always have [`ActiveHooks::MODIFY_SOLVER_CONTACTS`], so `modify_solver_contacts` is called for all fragments.
    ///
    /// # Errors
    /// The errors of [`step`](Self::step).
    ///
    /// [`ActiveHooks::MODIFY_SOLVER_CONTACTS`]: rapier3d::pipeline::ActiveHooks::MODIFY_SOLVER_CONTACTS
    pub fn step_with(
        &mut self,
        hooks: &dyn PhysicsHooks,
        events: &dyn EventHandler,
    ) -> Result<&[BreakEvent], WorldError> {
        self.step_for(Callbacks { hooks, events })
    }

    fn step_for(&mut self, caller: Callbacks<'_>) -> Result<&[BreakEvent], WorldError> {
        let (mut watch, mut whole) = (Watch::start(), Watch::start());
        self.timings = StepTimings::default();
        self.events.clear();
        self.held.clear();
        self.forget_removed();
        self.siblings.step = self.state.steps;
        self.siblings.relaxation =
            self.config.overlap_relaxation * self.physics.integration_parameters.dt;
        self.siblings.end_passages(&self.physics);
        self.join_pieces();
        let pushed = self.apply_pushes();
        self.loosen_hit();
        self.timings.upkeep += watch.lap();
        let done = match self.config.breaking {
            Breaking::InsideStep => self.step_breaking_inside(caller),
            Breaking::AfterStep { budget, delay } => self.step_then_break(budget, delay, caller),
        };
        self.part_clumps();
        self.state.steps += 1;
        self.note_step_time(whole.lap());
        pushed.and(done).map(|()| &*self.events)
    }

    /// Upkeep after a step: rolling, rest, mortar, debris, dust and rubble.
    pub(super) fn upkeep(&mut self) {
        let mut watch = Watch::start();
        // A break's impulses are a blow, not a weight that rolls; its energy is settled already.
        if self.events.is_empty() {
            resist_rolling(&mut self.physics, self.config.rolling_arm);
        }
        if self.config.rest_drift > 0.0 {
            self.state
                .places
                .rest(&mut self.physics, self.config.rest_drift);
        }
        self.part_mortar();
        self.tear_film();
        self.limit_debris(self.config.max_debris);
        self.settle_dust();
        self.retire();
        self.rebuild_rubble();
        self.fade();
        self.timings.upkeep += watch.lap();
    }
}
