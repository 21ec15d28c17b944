//! Ledger of the energy that all cracks of an impact may spend together.

/// All cracks together spend no more than the strain energy of the motion, and nothing before it has come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ledger {
    /// If false, the cracks spend what they like, as the paper's do.
    kept: bool,
    /// Energy that may be spent in the end, J.
    budget: f64,
    /// Part of the budget that has come so far, J.
    come: f64,
    /// Energy spent so far, J.
    spent: f64,
}

impl Ledger {
    /// A ledger of this budget, J, all of which may be spent at once until [`Ledger::come`] says otherwise.
    pub(crate) fn new(kept: bool, budget: f64) -> Self {
        let budget = if kept { budget } else { f64::INFINITY };
        Self {
            kept,
            budget,
            come: budget,
            spent: 0.0,
        }
    }

    /// Notes the strain energy that has come so far, J.
    pub(crate) fn come(&mut self, energy: f64) {
        if self.kept {
            self.come = self.budget.min(energy);
        }
    }

    /// Caps the budget at the most that the motion brings, J.
    pub(crate) fn cap(&mut self, energy: f64) {
        if self.kept {
            self.budget = self.budget.min(energy);
        }
    }

    pub(crate) fn spend(&mut self, energy: f64) {
        self.spent += energy;
    }

    /// Energy spent so far, J.
    pub(crate) fn spent(&self) -> f64 {
        self.spent
    }

    /// Returns true if this energy, J, has come and is left. Energy that has not come may come yet.
    pub(crate) fn has(&self, energy: f64) -> bool {
        self.spent + energy <= self.come
    }

    /// Returns true if this energy, J, will be left at no time.
    pub(crate) fn never_has(&self, energy: f64) -> bool {
        self.spent + energy > self.budget
    }

    /// Returns true if something was spent and less than this is left, J.
    pub(crate) fn is_spent_to(&self, least: f64) -> bool {
        self.spent > 0.0 && self.budget - self.spent < least
    }
}

/// Energy that cracks at weak points lacked when they were last about to start: before it has come, stress is not asked for again, which is
/// costly to find. By then the crack may lie another way, which hardly changes its area.
#[derive(Clone, Debug, Default)]
pub(crate) struct Unpaid(Vec<f64>);

impl Unpaid {
    /// Energy that a crack at a weak point, by its place among them, lacked, J; zero if it was never about to start, or lacked nothing.
    pub(crate) fn of(&self, place: u32) -> f64 {
        self.0.get(place as usize).copied().unwrap_or(0.0)
    }

    /// Notes the energy that a crack at a weak point lacks, J.
    pub(crate) fn note(&mut self, place: u32, energy: f64) {
        let place = place as usize;
        if place >= self.0.len() {
            self.0.resize(place + 1, 0.0);
        }
        self.0[place] = energy;
    }
}

#[cfg(test)]
mod tests {
    use super::{Ledger, Unpaid};

    #[test]
    fn nothing_is_spent_that_has_not_come_and_nothing_beyond_the_budget() {
        let mut ledger = Ledger::new(true, 3.0);
        ledger.come(1.0);
        assert!(ledger.has(1.0) && !ledger.has(1.5) && !ledger.never_has(1.5));
        ledger.spend(1.0);
        ledger.come(9.0);
        assert!(ledger.has(2.0) && !ledger.has(2.5) && ledger.never_has(2.5));
        ledger.cap(1.5);
        ledger.come(9.0);
        assert!(ledger.has(0.5) && ledger.never_has(0.75));
        assert!(ledger.is_spent_to(0.75) && !ledger.is_spent_to(0.25));
    }

    #[test]
    fn without_it_everything_is_affordable() {
        let mut ledger = Ledger::new(false, 3.0);
        ledger.come(0.0);
        ledger.cap(0.0);
        ledger.spend(1e9);
        assert!(ledger.has(1e9) && !ledger.never_has(1e9) && !ledger.is_spent_to(1e9));
        assert_eq!(ledger.spent(), 1e9);
    }

    #[test]
    fn what_a_crack_lacked_is_known_by_its_place_until_it_lacks_something_else() {
        let mut unpaid = Unpaid::default();
        unpaid.note(7, 2.0);
        assert_eq!([0, 7, 8].map(|place| unpaid.of(place)), [0.0, 2.0, 0.0]);
        unpaid.note(7, 0.5);
        assert_eq!(unpaid.of(7), 0.5);
    }
}
