//! Queue of impacts that wait for evaluation by the fracture model.
//!
//! A collapsing heap of crockery is hit in a hundred places within a frame. Bodies are processed in the order of their impacts, as many per
//! step as the budget allows, but at least one. Impacts that a quick bound rejects cost nothing and bypass the queue.

use std::collections::{BTreeSet, VecDeque};

use frangible::Body;
use frangible::internals::is_harmless;
use rapier3d::dynamics::RigidBodyHandle;

use crate::contact::contacts::Impact;
use crate::world::{BreakableWorld, Key, key};

/// A body that waits to be put to the fracture, and its hardest blow so far.
#[derive(Clone, Debug)]
pub(crate) struct Waiting {
    pub(super) body: RigidBodyHandle,
    pub(super) impact: Impact,
    /// Tetrahedra to look at; none where a quick bound refuses the impact.
    pub(super) cost: usize,
    /// Number of the step of the blow.
    pub(super) step: u64,
}

/// Blows whose turn it is, in the order in which they waited.
#[derive(Default)]
pub(super) struct Turn {
    /// Blows that a quick bound refuses.
    pub(super) cheap: Vec<(RigidBodyHandle, Impact)>,
    /// Blows that use up the budget, with their work.
    pub(super) dear: Vec<(RigidBodyHandle, Impact, usize)>,
    /// Bodies that were hit in the step just taken.
    pub(super) fresh: BTreeSet<Key>,
}

impl BreakableWorld {
    /// Returns the bodies whose impacts wait for evaluation, in the order of the queue: see
    /// [`Breaking::AfterStep`](crate::Breaking::AfterStep).
    pub fn waiting(&self) -> impl Iterator<Item = RigidBodyHandle> {
        let judged = self.cases.iter().map(|case| case.body);
        judged.chain(self.state.waiting.iter().map(|w| w.body))
    }

    /// New blows go to the end of the line; a harder one on a body that waits takes the place of the old one.
    pub(super) fn queue(&mut self, blows: Vec<Waiting>) {
        let size = |impact: &Impact| impact.contacts.iter().map(|c| c.impulse).sum::<f32>();
        for blow in blows {
            match self.state.waiting.iter_mut().find(|w| w.body == blow.body) {
                Some(known) if size(&blow.impact) > size(&known.impact) => *known = blow,
                Some(_) => {}
                None => self.state.waiting.push_back(blow),
            }
        }
    }

    /// Takes the blows whose turn it is out of the line, and those on bodies that are gone.
    pub(super) fn next_in_line(&mut self, budget: usize, delay: usize) -> Turn {
        let mut turn = Turn::default();
        let mut later = VecDeque::new();
        let mut work = 0_usize;
        let under_way: usize = self.cases.iter().map(|case| case.cost).sum();
        // At least one body in a step, and at least one under way.
        let fits = |work: usize, cost: usize| {
            let work_with = work.saturating_add(cost);
            let later = under_way.saturating_add(work_with) <= budget.saturating_mul(delay);
            (work == 0 || work_with <= budget) && (under_way == 0 || later)
        };
        for waiting in std::mem::take(&mut self.state.waiting) {
            let handle = waiting.body;
            if self.breakable(handle).is_none() {
                continue;
            }
            if waiting.step == self.state.steps {
                turn.fresh.insert(key(handle));
            }
            let busy = self.cases.iter().any(|case| case.body == handle);
            if busy {
                later.push_back(waiting);
            } else if waiting.cost == 0 {
                turn.cheap.push((handle, waiting.impact));
            } else if fits(work, waiting.cost) {
                work += waiting.cost;
                turn.dear.push((handle, waiting.impact, waiting.cost));
            } else {
                // First come, first served: a blow behind one that must wait for the budget waits too.
                work = usize::MAX;
                later.push_back(waiting);
            }
        }
        self.state.waiting = later;
        turn
    }

    /// Work of putting an impact to the fracture, tetrahedra.
    pub(super) fn work(&self, body: &Body, impact: &Impact) -> usize {
        let config = &self.config.fracture;
        if self.clears_quickly && is_harmless(body, &impact.contacts, config) {
            0
        } else {
            body.asset().embedding().tets.len().max(1)
        }
    }
}
