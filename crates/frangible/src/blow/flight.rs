//! Motion of pieces that have parted, during a blow and after it, tick by tick.
//!
//! The midpoint rule for the pieces, the exact step for the oscillators: over a tick h the pieces push these with the constant force B s,
//! B = ΛP, and with c̄ = (c + c₁)/2 the mean of the pieces' unknowns before and after it,
//!
//! `M (4 (c̄ − c)/h² − 2w/h) = ½ Bᵀ(Q + Q₁) − W s + α Bᵀ(Q₁ − Q)/h − β M (c₁ − c)/h + z (F + F₁)/2 − κ g (g · c₁)`, `s = c̄ + α (c₁ − c)/h`,
//!
//! W = PᵀΛP, w = ċ, g the gap of a corner per unknown, for corners of two faces that press on each other, κ its spring. Without damping, loads and
//! corners that open or close this keeps energy and the pieces' momentum, whatever the tick; a corner that opens or closes only loses energy.

use glam::DVec3;

use super::bank::{Bank, BankState};
use super::faces::Corner;
use super::lane::Lane;
use super::parted::Parted;
use super::plan::Plan;
use super::solve::{add, add_products, add_rows, dot};
use super::solver::Solver;

/// A blow, and the partings in it, in the order of time.
#[derive(Clone, Copy)]
pub(super) struct Setup<'a> {
    pub(super) plan: &'a Plan,
    pub(super) parted: &'a [Parted],
}

/// The motion of the pieces.
#[derive(Clone, Debug)]
pub(super) struct Flight {
    /// Number of partings so far.
    partings: usize,
    /// The substep in which each contact has gone on, since the last parting, to the group beside the one under it.
    pub(super) gone_on: Vec<Option<usize>>,
    /// The motion under all forces and, where any contact rubs, the motion under the normal forces alone.
    lanes: Vec<Lane>,
}

impl Flight {
    /// Motion before anything has parted.
    pub(super) fn new(plan: &Plan) -> Self {
        let lane = |(pushes, first)| Lane {
            first,
            at: Vec::new(),
            rate: Vec::new(),
            given: Vec::new(),
            middle: Vec::new(),
            gaps: Vec::new(),
            force: vec![0.0; plan.modes],
            pushes,
            press: Vec::new(),
            pressed: Vec::new(),
            closed: Vec::new(),
            lost: [0.0; 2],
            solver: Solver::default(),
        };
        let felt = (plan.felt_first > 0).then_some((1, plan.felt_first));
        Self {
            partings: 0,
            gone_on: vec![None; plan.sites.len()],
            lanes: [(0, 0)].into_iter().chain(felt).map(lane).collect(),
        }
    }

    /// Returns true if any piece moves on its own.
    #[inline(always)]
    pub(super) fn is_on(&self) -> bool {
        self.partings > 0
    }

    /// Returns the last parting so far, if any.
    #[inline(always)]
    fn parted<'a>(&self, setup: Setup<'a>) -> Option<&'a Parted> {
        setup.parted.get(self.partings.checked_sub(1)?)
    }

    /// Returns true if pieces part in this substep.
    #[inline(always)]
    pub(super) fn is_due(&self, setup: Setup<'_>, substep: usize) -> bool {
        let next = setup.parted.get(self.partings);
        next.is_some_and(|parted| parted.substep <= substep)
    }

    /// Parts the pieces that are due by now: `due` returns true for these.
    pub(super) fn part(
        &mut self,
        setup: Setup<'_>,
        state: &BankState,
        due: impl Fn(&Parted) -> bool,
    ) {
        while let Some(parted) = setup.parted.get(self.partings).filter(|p| due(p)) {
            let before = self.energy(setup, state);
            let known = self.parted(setup);
            let n = parted.unknowns();
            for lane in &mut self.lanes {
                lane.at = parted.inherit(known, &lane.at);
                lane.rate = parted.inherit(known, &lane.rate);
                lane.given = vec![0.0; n];
                lane.middle = vec![0.0; n];
                // Corners of faces that were there keep their state.
                let corners = known.map_or(&[][..], |parted| &parted.corners);
                let place = |corner: &Corner| corners.iter().position(|known| known.is(corner));
                let kept = parted.corners.iter().map(|corner| match place(corner) {
                    Some(k) => (lane.press[k], lane.closed[k]),
                    None => (false, corner.gap(&lane.at).min(0.0)),
                });
                (lane.press, lane.closed) = kept.collect();
                lane.solver.tick = 0.0;
            }
            self.partings += 1;
            self.gone_on.fill(None);
            let free = before - self.energy(setup, state);
            self.lanes[0].lost[1] += free;
        }
    }

    /// Moves a contact on, in a substep, to the group beside the one under it. Returns false if there is none or it has gone on already.
    pub(super) fn go_on(&mut self, setup: Setup<'_>, contact: usize, substep: usize) -> bool {
        let beside = self.parted(setup).and_then(|parted| parted.beside[contact]);
        if beside.is_none() || self.gone_on[contact].is_some() {
            return false;
        }
        self.gone_on[contact] = Some(substep);
        self.lanes
            .iter_mut()
            .for_each(|lane| lane.solver.tick = 0.0);
        true
    }

    /// Drops the motion under the normal forces alone: once nothing pushes any more, the body swings alone.
    pub(super) fn end_contacts(&mut self) {
        self.lanes.truncate(1);
    }

    /// Records the elastic forces before a tick of this length, s, and prepares the solvers for it.
    #[inline(always)]
    pub(super) fn begin(&mut self, setup: Setup<'_>, state: &BankState, bank: &Bank, tick: f64) {
        let Some(parted) = self.parted(setup) else {
            return;
        };
        let plan = setup.plan;
        let share = 0.5 - plan.rayleigh[0] / tick;
        for lane in &mut self.lanes {
            if lane.solver.tick != tick {
                let contacts = (lane.pushes, lane.first);
                lane.solver = Solver::new(parted, plan, bank, contacts, &self.gone_on, tick);
                lane.solver.press(parted, plan, &lane.press);
                lane.solver.answer(parted, plan, bank, &self.gone_on);
            }
            let own = lane.first..lane.first + plan.modes;
            let oscillators = state.x[own].iter().zip(&plan.oscillators);
            for (force, (x, (w, _))) in lane.force.iter_mut().zip(oscillators) {
                *force = share * w * x;
            }
        }
    }

    /// Computes the motion of the pieces in the tick if these forces, N, last. Pushes the oscillators, which have coasted through the tick, with it.
    #[inline(always)]
    pub(super) fn foresee(
        &mut self,
        setup: Setup<'_>,
        state: &mut BankState,
        bank: &Bank,
        forces: &[f64],
    ) {
        let Some(parted) = self.parted(setup) else {
            return;
        };
        let plan = setup.plan;
        let tick = self.felt().solver.tick;
        let [alpha, beta] = [plan.rayleigh[0] / tick, plan.rayleigh[1]];
        for lane in &mut self.lanes {
            let own = lane.first..lane.first + plan.modes;
            let oscillators = state.x[own].iter().zip(&plan.oscillators);
            for (force, (x, (w, _))) in lane.force.iter_mut().zip(oscillators) {
                *force += (0.5 + alpha) * w * x;
            }
            let (by_place, by_rate) = (4.0 / (tick * tick) + 2.0 * beta / tick, 2.0 / tick);
            let states = lane.at.iter().zip(&lane.rate);
            for (sum, (c, w)) in lane.middle.iter_mut().zip(states) {
                *sum = by_place * c + by_rate * w;
            }
            lane.given.fill(0.0);
            add_products(&mut lane.given, &parted.mass, &lane.middle);
            add_products(&mut lane.given, &parted.held, &lane.force);
            if alpha > 0.0 {
                let damped = lane.middle.iter_mut().zip(&lane.at);
                damped.for_each(|(to, at)| *to = 2.0 * alpha * at);
                add_products(&mut lane.given, &lane.solver.stiffness, &lane.middle);
            }
            let pushes = parted.pushes(lane.pushes, &self.gone_on);
            for (z, force) in pushes.zip(forces) {
                add(&mut lane.given, *force, z);
            }
            lane.settle(parted, plan, bank, &self.gone_on);
            let pulls = lane.given.iter_mut().zip(&lane.middle).zip(&lane.at);
            pulls.for_each(|((to, middle), at)| *to = middle + 2.0 * alpha * (middle - at));
            lane.force.fill(0.0);
            add_rows(&mut lane.force, &lane.given, &parted.held);
            let frequencies = plan.oscillators.iter();
            lane.force
                .iter_mut()
                .zip(frequencies)
                .for_each(|(f, (w, _))| *f *= w * w);
            bank.hold(state, lane.first, &lane.force, 1.0);
        }
    }

    /// Displacement of a contact by the pieces at the end of the tick if no force grows, m.
    #[inline(always)]
    pub(super) fn gap(&self, setup: Setup<'_>, contact: usize) -> f64 {
        let Some(parted) = self.parted(setup) else {
            return 0.0;
        };
        let (z, lane) = (parted.push(contact, &self.gone_on), self.felt());
        2.0 * dot(z, &lane.middle) - dot(z, &lane.at)
    }

    /// Displacement of the body under a contact by the pieces now, along its push with friction, m.
    pub(super) fn way(&self, setup: Setup<'_>, contact: usize) -> f64 {
        let parted = self.parted(setup);
        parted.map_or(0.0, |parted| {
            let mut pushes = parted.pushes(0, &self.gone_on);
            pushes
                .nth(contact)
                .map_or(0.0, |z| dot(z, &self.lanes[0].at))
        })
    }

    /// Displacement of a contact by the pieces now, m.
    pub(super) fn gap_now(&self, setup: Setup<'_>, contact: usize) -> f64 {
        let parted = self.parted(setup);
        parted.map_or(0.0, |parted| {
            dot(parted.push(contact, &self.gone_on), &self.felt().at)
        })
    }

    /// Speed at which the pieces move a contact, m/s.
    pub(super) fn gap_speed(&self, setup: Setup<'_>, contact: usize) -> f64 {
        let Some(parted) = self.parted(setup) else {
            return 0.0;
        };
        dot(parted.push(contact, &self.gone_on), &self.felt().rate)
    }

    /// Displacement of each contact, through the pieces, per newton that each force grows by in the tick, m/N: row-major; empty if nothing has
    /// parted.
    #[inline(always)]
    pub(super) fn give(&self) -> &[f64] {
        &self.felt().solver.give
    }

    fn felt(&self) -> &Lane {
        &self.lanes[self.lanes.len() - 1]
    }

    /// Ends the tick, over which the forces have grown by `growth`, N.
    #[inline(always)]
    pub(super) fn end(
        &mut self,
        setup: Setup<'_>,
        state: &mut BankState,
        bank: &Bank,
        growth: &[f64],
    ) {
        let Some(parted) = self.parted(setup) else {
            return;
        };
        for (number, lane) in self.lanes.iter_mut().enumerate() {
            let by_rate = 4.0 / lane.solver.tick;
            for (answer, &growth) in lane.solver.answers.iter().zip(growth) {
                if growth != 0.0 {
                    add(&mut lane.middle, growth, &answer.middle);
                    bank.hold(state, lane.first, &answer.force, growth);
                }
            }
            if number == 0 {
                lane.lose(parted);
            }
            for ((at, rate), middle) in lane.at.iter_mut().zip(&mut lane.rate).zip(&lane.middle) {
                *rate = by_rate * (middle - *at) - *rate;
                *at = 2.0 * middle - *at;
            }
        }
    }

    /// Computes q', the elastic part of the amplitudes, m·√kg.
    #[inline(always)]
    pub(super) fn elastic(&self, setup: Setup<'_>, state: &BankState, elastic: &mut Vec<f64>) {
        let amplitudes = state.x.iter().zip(&setup.plan.periods);
        elastic.clear();
        elastic.extend(amplitudes.map(|(x, period)| x * period));
        let Some(parted) = self.parted(setup) else {
            return;
        };
        for (row, c) in parted.rows().zip(&self.lanes[0].at) {
            add(elastic, -c, row);
        }
    }

    /// Energy that the pieces add to that of the modes, and strain energy in it, J, for this q'.
    pub(super) fn energies(
        &self,
        setup: Setup<'_>,
        state: &BankState,
        elastic: &[f64],
    ) -> [f64; 2] {
        let Some(parted) = self.parted(setup) else {
            return [0.0; 2];
        };
        let of_modes = elastic.iter().zip(&state.x).zip(&setup.plan.oscillators);
        let change: f64 = of_modes.map(|((q, x), (w, _))| q * q * w * w - x * x).sum();
        let lane = &self.lanes[0];
        let rows = parted.mass.chunks_exact(parted.unknowns());
        let moved = lane
            .rate
            .iter()
            .zip(rows)
            .map(|(w, row)| w * dot(row, &lane.rate));
        let corners = lane.press.iter().zip(&parted.corners).zip(&lane.closed);
        let pressed = corners
            .filter(|((press, _), _)| **press)
            .map(|((_, corner), closed)| {
                let gap = corner.gap(&lane.at) - closed;
                corner.stiffness * gap * gap
            });
        let strain = 0.5 * (change + pressed.sum::<f64>());
        [strain + 0.5 * moved.sum::<f64>(), strain]
    }

    /// Energy that the pieces add to that of the modes, J.
    fn energy(&self, setup: Setup<'_>, state: &BankState) -> f64 {
        let mut elastic = Vec::new();
        self.elastic(setup, state, &mut elastic);
        self.energies(setup, state, &elastic)[0]
    }

    /// Energy that faces have lost so far by pressing on each other, and that partings have set free, J.
    pub(super) fn lost(&self) -> [f64; 2] {
        self.lanes[0].lost
    }

    /// Velocity and angular velocity of each group but the reference, relative to the rigid motion of the whole body, m/s and rad/s.
    pub(super) fn drifts(&self, setup: Setup<'_>, state: &BankState) -> Vec<[DVec3; 2]> {
        let Some(parted) = self.parted(setup) else {
            return Vec::new();
        };
        let rate = &self.lanes[0].rate;
        let masses = parted.mass.chunks_exact(parted.unknowns());
        let momentum = parted.rows().zip(masses);
        let momentum = momentum.map(|(row, mass)| dot(row, &state.v) + dot(mass, rate));
        parted.velocities(&momentum.collect::<Vec<f64>>())
    }
}
