//! Times of the parts of a step. Wall clock: the only thing here that differs from run to run.

use std::ops::AddAssign;

use web_time::Instant;

/// Wall-clock times of the parts of the last [`step`](crate::BreakableWorld::step), s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StepTimings {
    /// Rapier's step; if it was taken again, the one that stands.
    pub rigid: f64,
    /// Rapier's steps that were undone.
    pub undone: f64,
    /// Finding the bodies that may be hit, copies of the world, and going back to them.
    pub copies: f64,
    /// Contacts of hit bodies.
    pub contacts: f64,
    /// [`frangible::impact()`], on as many threads as there are.
    pub fracture: f64,
    /// Shapes of fragments, and putting them in the place of the body.
    pub fragments: f64,
    /// Loads of bodies at rest.
    pub loads: f64,
    /// Rolling, rest, the guard against tunnelling, bookkeeping.
    pub upkeep: f64,
}

impl StepTimings {
    /// Time of all but Rapier's step: the cost of breaking.
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
