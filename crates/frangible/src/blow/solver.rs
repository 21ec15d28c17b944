//! What solves a tick of the pieces that move on their own: see `flight.rs` for the equation.

use super::bank::Bank;
use super::parted::Parted;
use super::plan::Plan;
use super::solve::{dot, factor, solve};

/// What solves a tick of one length.
#[derive(Clone, Debug, Default)]
pub(super) struct Solver {
    pub(super) tick: f64,
    /// W less what the oscillators' answer within the tick takes from it.
    pub(super) stiffness: Vec<f64>,
    /// The matrix without corners, and its factor with those that press.
    matrix: Vec<f64>,
    pub(super) factor: Vec<f64>,
    /// Number of the first mode among the oscillators.
    first: usize,
    /// Right side of what each contact's force does when it grows by a newton.
    growths: Vec<Vec<f64>>,
    /// What each contact's force does when it grows by a newton within a tick.
    pub(super) answers: Vec<Answer>,
    /// What that moves each contact by through the pieces, m/N: row-major.
    pub(super) give: Vec<f64>,
}

#[derive(Clone, Debug)]
pub(super) struct Answer {
    /// Change of c̄.
    pub(super) middle: Vec<f64>,
    /// Change of the elastic force on each mode.
    pub(super) force: Vec<f64>,
}

impl Solver {
    /// Without corners yet. `pushes`: with friction, 0, or without, 1; `first`: number of the first mode among the oscillators.
    pub(super) fn new(
        parted: &Parted,
        plan: &Plan,
        bank: &Bank,
        (pushes, first): (usize, usize),
        gone_on: &[Option<usize>],
        tick: f64,
    ) -> Self {
        let n = parted.unknowns();
        let [alpha, beta] = [plan.rayleigh[0] / tick, plan.rayleigh[1]];
        // λ less what the oscillator's own answer to the force takes from it.
        let held = bank.held_by(0..plan.modes);
        let springs = plan.oscillators.iter().zip(held).map(|((w, _), held)| {
            let taken = (0.5 + alpha) * w * held;
            w * w * (1.0 - taken).max(0.0)
        });
        let springs: Vec<f64> = springs.collect();
        let mut stiffness = vec![0.0; n * n];
        let mut weighted = vec![0.0; plan.modes];
        for j in 0..n {
            let terms = weighted.iter_mut().zip(parted.row(j)).zip(&springs);
            terms.for_each(|((to, p), spring)| *to = p * spring);
            for k in 0..=j {
                let sum = dot(&weighted, parted.row(k));
                (stiffness[j * n + k], stiffness[k * n + j]) = (sum, sum);
            }
        }
        let inertia = 4.0 / (tick * tick) + 2.0 * beta / tick;
        let sums = parted.mass.iter().zip(&stiffness);
        let sums = sums.map(|(m, s)| m * inertia + (1.0 + 2.0 * alpha) * s);
        let matrix = sums.collect();
        let growth = |(z, drive): (&[f64], &Vec<f64>)| -> Vec<f64> {
            let swing = bank.ramp_by(first..first + plan.modes, drive);
            let swing = swing.zip(&plan.oscillators);
            let swing = swing.map(|(x, (w, _))| (0.5 + alpha) * w * x);
            let swing: Vec<f64> = swing.collect();
            let rows = parted.rows().zip(z);
            rows.map(|(row, z)| 0.5 * z + dot(row, &swing)).collect()
        };
        let contacts = parted.pushes(pushes, gone_on).zip(&plan.drive);
        let growths = contacts.map(growth).collect();
        Self {
            tick,
            stiffness,
            matrix,
            first,
            growths,
            ..Self::default()
        }
    }

    /// Solves with these corners pressing from now on; what contacts do is [to be found anew](Self::answer).
    #[inline(always)]
    pub(super) fn press(&mut self, parted: &Parted, press: &[bool]) {
        let n = parted.unknowns();
        let mut matrix = self.matrix.clone();
        for (_, corner) in press
            .iter()
            .zip(&parted.corners)
            .filter(|(press, _)| **press)
        {
            // The corner is felt where it is at the end of the tick, 2 c̄ − c.
            corner.stiffen(2.0, &mut matrix, n);
        }
        self.factor = factor(matrix, n);
    }

    /// Finds what the contacts' forces do when they grow, with the corners that press now.
    #[inline(always)]
    pub(super) fn answer(
        &mut self,
        parted: &Parted,
        plan: &Plan,
        bank: &Bank,
        gone_on: &[Option<usize>],
    ) {
        let ahead = 1.0 + 2.0 * plan.rayleigh[0] / self.tick;
        let answer = |growth: &Vec<f64>| {
            let mut middle = growth.clone();
            solve(&self.factor, &mut middle);
            let mut force = vec![0.0; plan.modes];
            for (row, c) in parted.rows().zip(&middle) {
                force
                    .iter_mut()
                    .zip(row)
                    .for_each(|(f, p)| *f += p * ahead * c);
            }
            let frequencies = plan.oscillators.iter();
            force
                .iter_mut()
                .zip(frequencies)
                .for_each(|(f, (w, _))| *f *= w * w);
            Answer { middle, force }
        };
        self.answers = self.growths.iter().map(answer).collect();
        let count = plan.sites.len();
        self.give = vec![0.0; count * count];
        for k in 0..count {
            for (l, answer) in self.answers.iter().enumerate() {
                let through_modes = bank.held_gap(&plan.gap[k], self.first, &answer.force);
                self.give[k * count + l] =
                    through_modes + 2.0 * dot(parted.push(k, gone_on), &answer.middle);
            }
        }
    }
}
