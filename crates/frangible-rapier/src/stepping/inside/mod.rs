//! Breaks inside the step: it is undone, the bodies give way to fragments, and it is taken again.
//!
//! In a step as the engine takes it a ball bounces off the pane that it breaks. So a step that may see an impact (`approach.rs`) begins
//! with a copy of the world. After it, each impact is put to the fracture (`questions.rs`). If a body broke: back to the copy, fragments
//! in its place with the velocities from before the impact, the blow's own impulse between the pieces and the striker, and the step is
//! taken again, so that the striker meets fragments and the engine resolves only what still approaches. If the bodies held, the blow's
//! impulses take the place of the engine's (`exchange.rs`). Theory §4a and §6.
//!
//! Several bodies may break in a step. A body that is hit only in the repeated step is asked then, up to [`MAX_REPEATS`] times, and a blow
//! that held counts only in the step that stands. Fragments are not asked in the step of their birth (`pieces.rs`).

mod questions;

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};

use crate::callbacks::{Callbacks, Held};
use crate::calm::guard::put_back;
use crate::error::WorldError;
use crate::fragments::replace::Replacement;
use crate::snapshot::Snapshot;
use crate::timings::Watch;
use crate::world::BreakableWorld;

use questions::Asked;

/// Largest number of times that a step is undone; a body that would break only after that breaks in a later step.
const MAX_REPEATS: usize = 4;

impl BreakableWorld {
    /// Takes a step of Rapier, and takes it again with the fragments of the bodies that break in it.
    pub(super) fn step_breaking_inside(&mut self, caller: Callbacks<'_>) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        let near = self.near();
        self.timings.copies += watch.lap();
        let (asked, before) = if near.is_empty() {
            self.advance_guarded(caller);
            (Asked::default(), None)
        } else {
            let (asked, before) = self.step_with_breaks(near, caller);
            (asked, Some(before))
        };
        self.upkeep();
        watch.lap();
        let kept = self.keep_cracks(asked);
        // A break's impulses are no weight either.
        let weighed = if self.weighs_now() && self.events.is_empty() {
            self.weigh(before.as_ref())
        } else {
            Ok(())
        };
        self.timings.loads += watch.lap();
        kept.and(weighed)
    }

    /// Takes the step. Returns the answers of the fracture in it, and the bodies as they were before it.
    fn step_with_breaks(
        &mut self,
        mut near: Vec<RigidBodyHandle>,
        caller: Callbacks<'_>,
    ) -> (Asked, RigidBodySet) {
        let mut watch = Watch::start();
        let base = Snapshot::take(&self.physics, &self.siblings);
        self.state.snapshots += 1;
        let mut asked = Asked::default();
        // The bodies before the step taken last, where that is not the first one.
        let mut before: Option<RigidBodySet> = None;
        let mut centres = self.guarded_centres();
        self.timings.copies += watch.lap();
        let mut said = Held::default();
        let hooks = caller.hooks;
        self.advance(Callbacks {
            hooks,
            events: &said,
        });
        for _ in 0..MAX_REPEATS {
            if !self.ask(&near, before.as_ref().unwrap_or(&base.bodies), &mut asked) {
                break;
            }
            watch.lap();
            near.retain(|&handle| asked.broken.iter().all(|b| b.parent != handle));
            self.state.undone_steps += 1;
            self.timings.undone += std::mem::take(&mut self.timings.rigid);
            said.forget();
            base.restore(&mut self.physics, &mut self.siblings);
            self.timings.copies += watch.lap();
            for broken in &mut asked.broken {
                let Replacement {
                    fragments,
                    released,
                } = self.replace(broken.parent, &broken.parts);
                self.bind_film(&broken.fracture, &fragments);
                (broken.fragments, broken.released) = (fragments, released);
            }
            self.pass_blows(&mut asked.broken);
            self.timings.fragments += watch.lap();
            before = Some(self.physics.bodies.clone());
            centres = self.guarded_centres();
            self.timings.copies += watch.lap();
            self.advance_finely(Callbacks {
                hooks,
                events: &said,
            });
        }
        said.tell(caller.events, &self.physics);
        let standing = std::mem::take(&mut asked.standing);
        self.give_blows(standing, before.as_ref().unwrap_or(&base.bodies));
        watch.lap();
        put_back(&mut self.physics, &centres);
        self.timings.upkeep += watch.lap();
        self.settle(std::mem::take(&mut asked.broken), &base.bodies);
        self.timings.fragments += watch.lap();
        (asked, base.bodies)
    }
}
