//! Wall-clock times of the parts of a step: the only output that differs from run to run.

use std::ops::AddAssign;

use web_time::Instant;

/// Wall-clock times of the parts of the last [`step`](crate::BreakableWorld::step), s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StepTimings {
    /// Rapier's step; if it was repeated, only the final one.
    pub rigid: f64,
    /// Undone Rapier steps.
    pub undone: f64,
    /// Finding the bodies that may be hit, copying the world, and restoring the copy.
    pub copies: f64,
    /// Contacts of hit bodies.
    pub contacts: f64,
    /// [`frangible::impact()`], wall-clock time over all threads.
    pub fracture: f64,
    /// Making the shapes of fragments and replacing the body by them.
    pub fragments: f64,
    /// Testing sustained loads.
    pub loads: f64,
    /// Rolling resistance, sleep, the guard against tunnelling, bookkeeping.
    pub upkeep: f64,
}

impl StepTimings {
    /// Time of everything except Rapier's final step: the cost of breaking.
    #[must_use]
    pub fn ours(&self) -> f64 {
        let parts = [
            self.undone,
            self.copies,
            self.contacts,
            self.fracture,
            self.fragments,
            self.loads,
            self.upkeep,
        ];
        parts.iter().sum()
    }
}

impl AddAssign for StepTimings {
    fn add_assign(&mut self, other: Self) {
        self.rigid += other.rigid;
        self.undone += other.undone;
        self.copies += other.copies;
        self.contacts += other.contacts;
        self.fracture += other.fracture;
        self.fragments += other.fragments;
        self.loads += other.loads;
        self.upkeep += other.upkeep;
    }
}

/// A watch that tells the time since it was last asked, s.
pub(crate) struct Watch(Instant);

impl Watch {
    pub(crate) fn start() -> Self {
        Self(Instant::now())
    }

    pub(crate) fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let lap = now.duration_since(self.0).as_secs_f64();
        self.0 = now;
        lap
    }
}
