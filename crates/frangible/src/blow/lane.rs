//! One motion of the pieces that have parted, and the corners of their faces: see `flight.rs` for the equation.

use super::bank::Bank;
use super::parted::Parted;
use super::plan::Plan;
use super::solver::Solver;

/// Most rounds over the corners until those that press are those that are closed.
const MOST_ROUNDS: usize = 8;

/// One motion of the pieces.
#[derive(Clone, Debug)]
pub(super) struct Lane {
    /// Number of the first mode among the oscillators.
    pub(super) first: usize,
    /// c and ċ: unknowns of the pieces, and their rates.
    pub(super) at: Vec<f64>,
    pub(super) rate: Vec<f64>,
    /// Right side of the equation of the tick and its solution without corners, and c̄, as if no force grew.
    pub(super) given: Vec<f64>,
    pub(super) middle: Vec<f64>,
    /// The gaps of all corners at the end of the tick if none pressed, m.
    pub(super) gaps: Vec<f64>,
    /// Weighted mean of ω Q over the tick, and then the elastic force on each mode.
    pub(super) force: Vec<f64>,
    /// Kind of its pushes: 0 with friction, 1 without.
    pub(super) pushes: usize,
    /// True for each corner that presses, now and in the tick before.
    pub(super) press: Vec<bool>,
    pub(super) pressed: Vec<bool>,
    /// Gap at which each corner closes, m: 0, or the negative gap that it had when its face came about. So pieces that slide along a rough face are
    /// not pushed apart by the parts that it is cut into.
    pub(super) closed: Vec<f64>,
    /// Energy that faces have lost by pressing on each other, and that partings have set free, J.
    pub(super) lost: [f64; 2],
    pub(super) solver: Solver,
}

impl Lane {
    /// Solves the tick, with those corners pressing that are closed at its end.
    #[inline(always)]
    pub(super) fn settle(
        &mut self,
        parted: &Parted,
        plan: &Plan,
        bank: &Bank,
        gone_on: &[Option<usize>],
    ) {
        self.solver.solve(&self.given, &mut self.middle);
        self.given.copy_from_slice(&self.middle);
        self.pressed.clone_from(&self.press);
        self.gaps.clear();
        let corners = parted.corners.iter().zip(&self.closed);
        self.gaps.extend(corners.map(|(corner, closed)| {
            2.0 * corner.gap(&self.middle) - corner.gap(&self.at) - closed
        }));
        let mut anew = false;
        for round in 0.. {
            let is_pressed = self.solver.is_pressed();
            if is_pressed || round > 0 {
                self.middle.copy_from_slice(&self.given);
                self.solver.hold(&self.gaps, &mut self.middle);
            }
            if round == MOST_ROUNDS {
                break;
            }
            let mut changes = false;
            let corners = self.press.iter_mut().zip(&parted.corners);
            for ((press, corner), gap) in corners.zip(&self.gaps) {
                // Corners that press move the others.
                let more = match is_pressed {
                    true => 2.0 * (corner.gap(&self.middle) - corner.gap(&self.given)),
                    false => 0.0,
                };
                let closes = gap + more < 0.0;
                changes |= std::mem::replace(press, closes) != closes;
            }
            if !changes {
                break;
            }
            self.solver.press(parted, plan, &self.press);
            anew = true;
        }
        if anew {
            self.solver.answer(parted, plan, bank, gone_on);
        }
    }

    /// Adds what the faces lose in a tick: the work of the corners' forces, which act as they are at its end, less the energy of their springs.
    pub(super) fn lose(&mut self, parted: &Parted) {
        let corners = parted.corners.iter().zip(&self.closed);
        let states = self.pressed.iter().zip(&self.press);
        for ((corner, closed), (&before, &now)) in corners.zip(states) {
            if !before && !now {
                continue;
            }
            let first = corner.gap(&self.at) - closed;
            let last = 2.0 * corner.gap(&self.middle) - corner.gap(&self.at) - closed;
            let held = |press: bool, gap: f64| if press { 0.5 * gap * gap } else { 0.0 };
            let given = if now { last * (last - first) } else { 0.0 };
            self.lost[0] += corner.stiffness * (given + held(before, first) - held(now, last));
        }
    }
}
