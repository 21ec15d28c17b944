//! How pieces that have parted move while a blow goes on and after it, tick by tick.
//!
//! Oscillators are stepped exactly under forces that are linear over a tick, and under the elastic force of the pieces that is constant over it,
//! `B ((1 + α/h) c₁ − α c/h)` with B = ΛP and c₁ the pieces' unknowns at its end:
//!
//! `[M (1 + βh)/h² + (1 + α/h) W + Σ κ g gᵀ] c₁ = M (c + hw)/h² + βMc/h + αWc/h + Bᵀ(Q + αV) + zF₁`, W = PᵀΛP, w = ċ, V = Q̇,
//!
//! g what opens a corner of two faces that press on each other, κ its spring. Without loads the energy changes by exactly
//! `−½ ΔcᵀWΔc − ½ ΔwᵀMΔw − ½ κ (g·Δc)²`, so it cannot grow, whatever the tick.

use super::bank::{Bank, BankState};
use super::parted::Parted;
use super::plan::Plan;
use super::solve::{dot, factor, solve};

/// Rounds over the corners until those that press are those that are closed.
const MOST_ROUNDS: usize = 8;

/// The motion of the pieces.
pub(super) struct Flight<'a> {
    plan: &'a Plan,
    /// What parts, in the order of time, and how many of these have.
    all: &'a [Parted],
    next: usize,
    parted: Option<&'a Parted>,
    /// α, s, and β, 1/s.
    damping: [f64; 2],
    /// The motion under all forces and, where any contact rubs, the motion under the normal forces alone.
    lanes: Vec<Lane>,
    /// Which corners press.
    press: Vec<bool>,
    /// The gap at which each closes, m: 0, or what it was when its face came about. Pieces that slide along a rough face are not pushed apart
    /// by the parts that it is cut into.
    closed: Vec<f64>,
    solver: Solver,
}

/// One motion of the pieces.
struct Lane {
    /// Number of the first mode among the oscillators.
    first: usize,
    /// c and ċ.
    at: Vec<f64>,
    rate: Vec<f64>,
    /// Right side of the equation of the tick without the contacts' forces, and its solution.
    given: Vec<f64>,
    foreseen: Vec<f64>,
    /// The elastic force on each mode.
    force: Vec<f64>,
    /// Its motion is that of pushes with friction, 0, or without, 1.
    pushes: usize,
}

/// What solves a tick of one length.
#[derive(Default)]
struct Solver {
    tick: f64,
    factor: Vec<f64>,
    /// A⁻¹z of each contact, and what it pushes the modes with: with friction and without.
    answers: [Vec<Answer>; 2],
    /// What a newton at the end of a tick moves each contact by through the pieces, m/N: row-major.
    give: Vec<f64>,
}

struct Answer {
    shift: Vec<f64>,
    force: Vec<f64>,
}

impl<'a> Flight<'a> {
    /// Nothing has parted yet.
    pub(super) fn new(plan: &'a Plan, all: &'a [Parted]) -> Self {
        let lane = |(pushes, first)| Lane {
            first,
            at: Vec::new(),
            rate: Vec::new(),
            given: Vec::new(),
            foreseen: Vec::new(),
            force: vec![0.0; plan.modes],
            pushes,
        };
        let felt = (plan.felt_first > 0).then_some((1, plan.felt_first));
        Self {
            plan,
            all,
            next: 0,
            parted: None,
            damping: plan.rayleigh,
            lanes: [(0, 0)].into_iter().chain(felt).map(lane).collect(),
            press: Vec::new(),
            closed: Vec::new(),
            solver: Solver::default(),
        }
    }

    /// Whether any piece moves on its own.
    #[inline(always)]
    pub(super) fn is_on(&self) -> bool {
        self.parted.is_some()
    }

    /// Lets part what has parted by now: `due` says of each whether it has.
    pub(super) fn part(&mut self, due: impl Fn(&Parted) -> bool) {
        while let Some(parted) = self.all.get(self.next).filter(|p| due(p)) {
            let n = parted.unknowns();
            for lane in &mut self.lanes {
                lane.at = parted.inherit(self.parted, &lane.at);
                lane.rate = parted.inherit(self.parted, &lane.rate);
                lane.given = vec![0.0; n];
                lane.foreseen = vec![0.0; n];
            }
            self.parted = Some(parted);
            self.next += 1;
            self.press = vec![false; parted.corners.len()];
            let gaps = parted.corners.iter();
            let gaps = gaps.map(|corner| dot(&corner.opening, &self.lanes[0].at).min(0.0));
            self.closed = gaps.collect();
            self.solver.tick = 0.0;
        }
    }

    /// Once nothing pushes any more: the body swings alone.
    pub(super) fn end_contacts(&mut self) {
        self.lanes.truncate(1);
    }

    /// Finds where the pieces are at the end of a tick of this length, s, if these forces, N, last, and what that pushes the modes with.
    #[inline(always)]
    pub(super) fn foresee(&mut self, state: &BankState, bank: &Bank, tick: f64, forces: &[f64]) {
        let Some(parted) = self.parted else { return };
        if self.solver.tick != tick {
            self.solver = Solver::new(self, parted, bank, tick);
        }
        let [alpha, beta] = self.damping;
        let n = parted.unknowns();
        for lane in &mut self.lanes {
            let own = lane.first..lane.first + self.plan.modes;
            let states = state.x[own.clone()].iter().zip(&state.v[own]);
            for ((force, (x, v)), (w, _)) in lane.force.iter_mut().zip(states).zip(&self.plan.oscillators) {
                *force = w * (x + alpha * w * v);
            }
            let h = 1.0 / tick;
            for j in 0..n {
                let row = j * n..(j + 1) * n;
                let (mass, stiffness) = (&parted.mass[row.clone()], &parted.stiffness[row]);
                let (mut sum, mut held) = (0.0, 0.0);
                for k in 0..n {
                    sum += mass[k] * ((lane.at[k] * h + lane.rate[k]) * h + beta * lane.at[k] * h);
                    held += stiffness[k] * lane.at[k];
                }
                let row = &parted.held[j * self.plan.modes..(j + 1) * self.plan.modes];
                lane.given[j] = sum + alpha * h * held + dot(row, &lane.force);
            }
        }
        self.settle(parted, bank, forces);
        let [alpha, _] = self.damping;
        let (ahead, behind) = (1.0 + alpha / tick, alpha / tick);
        for lane in &mut self.lanes {
            lane.force.fill(0.0);
            for j in 0..n {
                let pull = ahead * lane.foreseen[j] - behind * lane.at[j];
                let row = &parted.held[j * self.plan.modes..(j + 1) * self.plan.modes];
                lane.force.iter_mut().zip(row).for_each(|(f, p)| *f += p * pull);
            }
            let frequencies = self.plan.oscillators.iter();
            lane.force.iter_mut().zip(frequencies).for_each(|(f, (w, _))| *f *= w * w);
        }
    }

    /// Solves the tick, with those corners pressing that are closed at its end.
    #[inline(always)]
    fn settle(&mut self, parted: &Parted, bank: &Bank, forces: &[f64]) {
        for round in 0.. {
            for lane in &mut self.lanes {
                lane.foreseen.copy_from_slice(&lane.given);
                let corners = self.press.iter().zip(&parted.corners).zip(&self.closed);
                for ((_, corner), closed) in corners.filter(|((press, _), _)| **press) {
                    let push = corner.stiffness * closed;
                    let pairs = lane.foreseen.iter_mut().zip(&corner.opening);
                    pairs.for_each(|(b, g)| *b += push * g);
                }
                solve(&self.solver.factor, &mut lane.foreseen);
            }
            if round == MOST_ROUNDS || self.press.is_empty() {
                break;
            }
            let lane = &self.lanes[0];
            let answers = &self.solver.answers[0];
            let mut changes = false;
            let corners = self.press.iter_mut().zip(&parted.corners);
            for ((press, corner), closed) in corners.zip(&self.closed) {
                let mut gap = dot(&corner.opening, &lane.foreseen) - closed;
                for (answer, force) in answers.iter().zip(forces) {
                    gap += force * dot(&corner.opening, &answer.shift);
                }
                changes |= std::mem::replace(press, gap < 0.0) != (gap < 0.0);
            }
            if !changes {
                break;
            }
            self.solver = Solver::new(self, parted, bank, self.solver.tick);
        }
    }

    /// Pushes the oscillators with what has been foreseen.
    #[inline(always)]
    pub(super) fn push(&self, state: &mut BankState, bank: &Bank) {
        if self.is_on() {
            for lane in &self.lanes {
                bank.hold(state, lane.first, &lane.force, 1.0);
            }
        }
    }

    /// How far the pieces have moved a contact by the end of the tick if no force pushes then, m.
    #[inline(always)]
    pub(super) fn gap(&self, contact: usize) -> f64 {
        let Some(parted) = self.parted else { return 0.0 };
        dot(&parted.pushes[1][contact], &self.felt().foreseen)
    }

    /// How fast they move it, m/s.
    pub(super) fn gap_speed(&self, contact: usize) -> f64 {
        let Some(parted) = self.parted else { return 0.0 };
        dot(&parted.pushes[1][contact], &self.felt().rate)
    }

    /// What a newton at the end of the tick at one contact moves another by through the pieces, m/N: row-major; empty where nothing has parted.
    #[inline(always)]
    pub(super) fn give(&self) -> &[f64] {
        &self.solver.give
    }

    fn felt(&self) -> &Lane {
        &self.lanes[self.lanes.len() - 1]
    }

    /// Ends the tick under these forces, N.
    #[inline(always)]
    pub(super) fn end(&mut self, state: &mut BankState, bank: &Bank, forces: &[f64]) {
        if !self.is_on() {
            return;
        }
        let tick = self.solver.tick;
        for lane in &mut self.lanes {
            for (answer, &force) in self.solver.answers[lane.pushes].iter().zip(forces) {
                if force != 0.0 {
                    let shifts = lane.foreseen.iter_mut().zip(&answer.shift);
                    shifts.for_each(|(c, x)| *c += x * force);
                    bank.hold(state, lane.first, &answer.force, force);
                }
            }
            for ((at, rate), new) in lane.at.iter_mut().zip(&mut lane.rate).zip(&lane.foreseen) {
                *rate = (new - *at) / tick;
                *at = *new;
            }
        }
    }

    /// Takes P c from the amplitudes of the modes, m·√kg.
    #[inline(always)]
    pub(super) fn leave_elastic(&self, amplitudes: &mut [f64]) {
        let Some(parted) = self.parted else { return };
        let rows = parted.held.chunks_exact(self.plan.modes.max(1));
        for (row, c) in rows.zip(&self.lanes[0].at) {
            amplitudes.iter_mut().zip(row).for_each(|(q, p)| *q -= p * c);
        }
    }

    /// Kinetic energy of what the modes do not hold of the pieces' motion, and energy of the faces that press, J.
    pub(super) fn energies(&self) -> [f64; 2] {
        let Some(parted) = self.parted else { return [0.0; 2] };
        let lane = &self.lanes[0];
        let rows = parted.mass.chunks_exact(lane.rate.len());
        let kinetic = lane.rate.iter().zip(rows);
        let kinetic = kinetic.map(|(w, row)| 0.5 * w * dot(row, &lane.rate)).sum();
        let corners = self.press.iter().zip(&parted.corners).zip(&self.closed);
        let springs = corners.filter(|((press, _), _)| **press).map(|((_, corner), closed)| {
            let gap = dot(&corner.opening, &lane.at) - closed;
            0.5 * corner.stiffness * gap * gap
        });
        [kinetic, springs.sum()]
    }
}

impl Solver {
    fn new(flight: &Flight, parted: &Parted, bank: &Bank, tick: f64) -> Self {
        let n = parted.unknowns();
        let [alpha, beta] = flight.damping;
        let ahead = 1.0 + alpha / tick;
        let inertia = (1.0 + beta * tick) / (tick * tick);
        let sums = parted.mass.iter().zip(&parted.stiffness);
        let mut matrix: Vec<f64> = sums.map(|(m, w)| m * inertia + ahead * w).collect();
        let pressing = flight.press.iter().zip(&parted.corners).filter(|(press, _)| **press);
        for (_, corner) in pressing {
            for (j, a) in corner.opening.iter().enumerate().filter(|(_, a)| **a != 0.0) {
                let row = &mut matrix[j * n..(j + 1) * n];
                row.iter_mut().zip(&corner.opening).for_each(|(m, b)| *m += corner.stiffness * a * b);
            }
        }
        let factor = factor(&matrix, n);
        let modes = flight.plan.modes;
        let answer = |z: &Vec<f64>| {
            let mut shift = z.clone();
            solve(&factor, &mut shift);
            let mut force = vec![0.0; modes];
            for (row, c) in parted.held.chunks_exact(modes.max(1)).zip(&shift) {
                force.iter_mut().zip(row).for_each(|(f, p)| *f += p * c * ahead);
            }
            let frequencies = flight.plan.oscillators.iter();
            force.iter_mut().zip(frequencies).for_each(|(f, (w, _))| *f *= w * w);
            Answer { shift, force }
        };
        let answers = parted.pushes.each_ref().map(|pushes| pushes.iter().map(answer).collect());
        let answers: [Vec<Answer>; 2] = answers;
        let count = parted.pushes[1].len();
        let first = flight.felt().first;
        let mut give = vec![0.0; count * count];
        for k in 0..count {
            for (l, answer) in answers[1].iter().enumerate() {
                let through_modes = bank.held_gap(&flight.plan.gap[k], first, &answer.force);
                give[k * count + l] = through_modes + dot(&parted.pushes[1][k], &answer.shift);
            }
        }
        Self { tick, factor, answers, give }
    }
}
