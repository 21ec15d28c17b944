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
    /// Advances by one time step; returns the breaks in it.
    ///
    /// # Errors
    /// The fracture refused an asset or a contact. The step is complete and the body whole: go on, or remove it.
    pub fn step(&mut self) -> Result<&[BreakEvent], WorldError> {
        self.step_for(Callbacks::NONE)
    }

    /// [`step`](Self::step) with hooks and an event handler of the caller's own, as Rapier's pipeline takes them.
    ///
    /// A step in which a body breaks is undone and taken again. Events of an undone step are dropped; those of the step that stands come
    /// once it does, in the order in which Rapier spoke. Hooks are asked in every step taken. Colliders of fragments inherit
    /// what hooks and events their body's collider asked for, and have [`ActiveHooks::MODIFY_SOLVER_CONTACTS`] of our own, so
    /// `modify_solver_contacts` is asked of fragments in any case.
    ///
    /// # Errors
    /// Those errors that [`step`](Self::step) has.
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
        self.join_pieces();
        let pushed = self.apply_pushes();
        self.loosen_hit();
        self.timings.upkeep += watch.lap();
        let done = match self.config.breaking {
            Breaking::InsideStep => self.step_breaking_inside(caller),
            Breaking::AfterStep { budget, delay } => self.step_then_break(budget, delay, caller),
        };
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
        self.limit_debris(self.config.max_debris);
        self.settle_dust();
        self.retire();
        self.rebuild_rubble();
        self.fade();
        self.timings.upkeep += watch.lap();
    }
}
