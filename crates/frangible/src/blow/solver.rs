//! Solver of a tick of the pieces that move on their own: see `flight.rs` for the equation.

use super::bank::Bank;
use super::parted::Parted;
use super::plan::Plan;
use super::solve::{add, add_products, add_rows, dot, factor, inverse, mirror, solve, squares};

/// Solver of ticks of one length. The corners that press form a system of their own, with one unknown each: with C the matrix without corners, the
/// unknowns of the pieces are `C⁻¹b + Σ y μ`, `y = C⁻¹g`, and `(1/2κ + gᵀy) μ = −e/2` gives the corners' forces μ, e the gaps at the end of the tick
/// if none pressed (Woodbury).
#[derive(Clone, Debug, Default)]
pub(super) struct Solver {
    pub(super) tick: f64,
    /// W, reduced by the oscillators' response within the tick.
    pub(super) stiffness: Vec<f64>,
    /// Inverse of the matrix without corners.
    inverse: Vec<f64>,
    /// Number of the first mode among the oscillators.
    first: usize,
    /// Response to a newton of growth of each contact's force, without corners and with those that press.
    free: Vec<Answer>,
    pub(super) answers: Vec<Answer>,
    /// Displacement of each contact through the pieces per newton of growth of each force, m/N: row-major.
    pub(super) give: Vec<f64>,
    /// Response to a newton at each corner, known once it has pressed.
    corners: Vec<Option<Answer>>,
    /// The corners that press, the factor of their system, and their forces, N.
    pressing: Vec<usize>,
    held: Vec<f64>,
    forces: Vec<f64>,
}

/// Response to a force within a tick.
#[derive(Clone, Debug)]
pub(super) struct Answer {
    /// Change of c̄.
    pub(super) middle: Vec<f64>,
    /// Change of the elastic force on each mode.
    pub(super) force: Vec<f64>,
}

impl Answer {
    /// Response to a push on the pieces, with this inverse of the matrix.
    #[inline(always)]
    fn to(push: &[f64], inverse: &[f64], parted: &Parted, plan: &Plan, tick: f64) -> Self {
        let mut middle = vec![0.0; push.len()];
        add_products(&mut middle, inverse, push);
        let ahead = 1.0 + 2.0 * plan.rayleigh[0] / tick;
        let mut force = vec![0.0; plan.modes];
        add_rows(&mut force, &middle, &parted.held);
        let frequencies = plan.oscillators.iter();
        force
            .iter_mut()
            .zip(frequencies)
            .for_each(|(f, (w, _))| *f *= ahead * w * w);
        Self { middle, force }
    }

    /// Adds `times` × another response.
    fn add(&mut self, times: f64, other: &Self) {
        add(&mut self.middle, times, &other.middle);
        add(&mut self.force, times, &other.force);
    }
}

impl Solver {
    /// Solver without corners yet. `pushes`: 0 with friction, 1 without; `first`: number of the first mode among the oscillators.
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
        // λ, reduced by the oscillator's own response to the force.
        let held = bank.held_by(0..plan.modes);
        let springs = plan.oscillators.iter().zip(held).map(|((w, _), held)| {
            let taken = (0.5 + alpha) * w * held;
            w * w * (1.0 - taken).max(0.0)
        });
        let springs: Vec<f64> = springs.collect();
        let mut stiffness = squares(&parted.held, n, &springs);
        mirror(&mut stiffness, n);
        let inertia = 4.0 / (tick * tick) + 2.0 * beta / tick;
        let sums = parted.mass.iter().zip(&stiffness);
        let sums = sums.map(|(m, s)| m * inertia + (1.0 + 2.0 * alpha) * s);
        let inverse = inverse(sums.collect(), n);
        let growth = |(z, drive): (&[f64], &Vec<f64>)| {
            let swing = bank.ramp_by(first..first + plan.modes, drive);
            let swing = swing.zip(&plan.oscillators);
            let swing = swing.map(|(x, (w, _))| (0.5 + alpha) * w * x);
            let swing: Vec<f64> = swing.collect();
            let mut push: Vec<f64> = z.iter().map(|z| 0.5 * z).collect();
            add_products(&mut push, &parted.held, &swing);
            Answer::to(&push, &inverse, parted, plan, tick)
        };
        let contacts = parted.pushes(pushes, gone_on).zip(&plan.drive);
        let free = contacts.map(growth).collect();
        Self {
            tick,
            stiffness,
            inverse,
            first,
            free,
            corners: vec![None; parted.corners.len()],
            ..Self::default()
        }
    }

    /// Solves without corners.
    #[inline(always)]
    pub(super) fn solve(&self, given: &[f64], middle: &mut [f64]) {
        middle.fill(0.0);
        add_products(middle, &self.inverse, given);
    }

    /// Lets these corners press from now on; the responses to the contacts must then be [computed anew](Self::answer).
    #[inline(always)]
    pub(super) fn press(&mut self, parted: &Parted, plan: &Plan, press: &[bool]) {
        self.pressing.clear();
        self.pressing
            .extend((0..press.len()).filter(|&corner| press[corner]));
        let count = self.pressing.len();
        self.held.clear();
        self.held.resize(count * count, 0.0);
        for (row, &k) in self.pressing.iter().enumerate() {
            let corner = &parted.corners[k];
            self.corners[k].get_or_insert_with(|| {
                let mut push = vec![0.0; parted.unknowns()];
                corner.push(1.0, &mut push);
                Answer::to(&push, &self.inverse, parted, plan, self.tick)
            });
            let known = self.pressing[..=row].iter().enumerate();
            for (column, answer) in
                known.filter_map(|(at, &l)| Some((at, self.corners[l].as_ref()?)))
            {
                let give = corner.gap(&answer.middle);
                self.held[row * count + column] = give;
                self.held[column * count + row] = give;
            }
            self.held[row * count + row] += 0.5 / corner.stiffness;
        }
        self.held = factor(std::mem::take(&mut self.held), count);
    }

    /// Returns true if any corner presses.
    #[inline(always)]
    pub(super) fn is_pressed(&self) -> bool {
        !self.pressing.is_empty()
    }

    /// Adds to c̄ the effect of the corners that press. `gaps`: gaps of all corners at the end of the tick if none pressed, m.
    #[inline(always)]
    pub(super) fn hold(&mut self, gaps: &[f64], middle: &mut [f64]) {
        self.forces.clear();
        self.forces
            .extend(self.pressing.iter().map(|&k| -0.5 * gaps[k]));
        solve(&self.held, &mut self.forces);
        let pressing = self.pressing.iter().zip(&self.forces);
        for (answer, &force) in pressing.filter_map(|(&k, f)| Some((self.corners[k].as_ref()?, f)))
        {
            add(middle, force, &answer.middle);
        }
    }

    /// Computes the responses to growth of the contacts' forces, with the corners that press now.
    #[inline(always)]
    pub(super) fn answer(
        &mut self,
        parted: &Parted,
        plan: &Plan,
        bank: &Bank,
        gone_on: &[Option<usize>],
    ) {
        self.answers.clone_from(&self.free);
        for answer in &mut self.answers {
            self.forces.clear();
            let gaps = self.pressing.iter();
            let gaps = gaps.map(|&k| -parted.corners[k].gap(&answer.middle));
            self.forces.extend(gaps);
            solve(&self.held, &mut self.forces);
            for (&k, &force) in self.pressing.iter().zip(&self.forces) {
                if let Some(corner) = &self.corners[k] {
                    answer.add(force, corner);
                }
            }
        }
        let count = plan.sites.len();
        self.give.clear();
        self.give.resize(count * count, 0.0);
        for k in 0..count {
            for (l, answer) in self.answers.iter().enumerate() {
                let through_modes = bank.held_gap(&plan.gap[k], self.first, &answer.force);
                self.give[k * count + l] =
                    through_modes + 2.0 * dot(parted.push(k, gone_on), &answer.middle);
            }
        }
    }
}
