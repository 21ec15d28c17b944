//! The integration of a blow, substep by substep.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::bank::{BankState, Pushes, dot, padded};
use super::contacts::Contacts;
use super::plan::Plan;

/// A blow of so many substeps is cut off: a contact that lasts this long is none of a blow's.
const MOST_SUBSTEPS: usize = 60_000;

/// Most time steps of one impact; a longer motion is cut there (the cut shows in the report's number of steps).
const MOST_STEPS: usize = 20_000;

/// Mode i is significantly excited when its amplitude reaches this share of the largest.
const SIGNIFICANT: f64 = 0.05;

/// Periods of the lowest significantly excited mode that are looked at.
const PERIODS: f64 = 1.5;

/// From a substep on the body gives way by so much more under a contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Softening {
    pub(super) contact: usize,
    pub(super) substep: usize,
    /// m/N; infinite where nothing bears the contact any more.
    pub(super) compliance: f64,
}

/// What an integration found.
pub(super) struct Record {
    /// Forces after each substep, N.
    pub(super) forces: Vec<f64>,
    /// Amplitudes of the modes at each time step, m·√kg.
    pub(super) amplitudes: Vec<f32>,
    /// ω p of all wall oscillators at each time step until the near field has gone, m·√kg/s.
    pub(super) swing: Vec<f32>,
    /// How many oscillators there are in a row of `swing`, at least 1.
    pub(super) width: usize,
    pub(super) near_steps: usize,
    pub(super) contact_steps: usize,
    /// Speed of each striker into the body after the blow, m/s.
    pub(super) speeds: Vec<f64>,
    pub(super) peak_energy: f64,
    /// Largest strain energy until the end of each time step, J.
    pub(super) strain_energy: Vec<f64>,
    /// Energy of the body's oscillators when the contacts parted for the last time, and of waves that had left before, J.
    pub(super) energy_at_parting: f64,
    /// Energy of waves that left before a striker touched again, J: the body's, and those of breakable strikers.
    left: [f64; 2],
    /// The same of breakable strikers, J.
    pub(super) strikers_energy: f64,
}

/// The integration.
pub(super) struct Run<'a> {
    pub(super) plan: &'a Plan,
    /// Forces from the beginning on that are known already.
    pub(super) known: &'a [f64],
    pub(super) softer: &'a [Softening],
    /// Whether nothing is looked at after the contact.
    pub(super) instant: bool,
    /// Whether strikers are followed that the body swings back against.
    pub(super) returns: bool,
}

impl pulp::NullaryFnOnce for Run<'_> {
    type Output = Record;

    #[inline(always)]
    fn call(self) -> Record {
        let plan = self.plan;
        let mut state = BankState::rest(plan.oscillators.len());
        let mut contacts = Contacts::new(plan);
        let mut record = Record::new(plan);
        self.push(&mut record, &mut state, &mut contacts);
        let window = self.window(0..plan.modes, &state);
        // Two bodies that both vibrate wait equally long for each other.
        let windows = (plan.strikers.iter()).map(|modes| self.window(modes.clone(), &state));
        let end = windows.fold(window, f64::max);
        while let Some(steps) = self.return_after(&record, &state, &contacts, end) {
            self.wait(steps, &mut record, &mut state, &mut contacts);
            self.push(&mut record, &mut state, &mut contacts);
        }
        record.speeds = contacts.speeds;
        state.keep(plan.own);
        self.ring(&mut record, state, window);
        record
    }
}

impl Run<'_> {
    /// Follows the contacts until all have parted, to the end of that time step. Where strikers may return, it is at the end of a time step
    /// that they have to have parted.
    #[inline(always)]
    fn push(&self, record: &mut Record, state: &mut BankState, contacts: &mut Contacts<'_>) {
        let plan = self.plan;
        let count = plan.sites.len();
        let pushes = plan.pushes();
        let mut substep = record.forces.len() / count;
        let mut parted = false;
        while !(parted && substep.is_multiple_of(plan.substeps)) {
            let t = (substep + 1) as f64 * contacts.dt;
            plan.fine.coast(state, &pushes, &contacts.forces);
            contacts.foresee(state);
            contacts.soften(self.softer, substep..substep + 1);
            match self.known.get(substep * count..(substep + 1) * count) {
                Some(known) => contacts.next.copy_from_slice(known),
                None if parted => contacts.next.fill(0.0),
                None => contacts.solve(t),
            }
            contacts.grow();
            plan.fine.grow(state, &pushes, &contacts.growth);
            contacts.advance();
            record.forces.extend_from_slice(&contacts.forces);
            substep += 1;
            let whole = substep.is_multiple_of(plan.substeps);
            if whole {
                record.sample(plan, state, &contacts.forces, true);
            }
            if !parted && (whole || !self.returns) {
                parted = contacts.have_parted(state, t) || substep >= MOST_SUBSTEPS;
                if parted {
                    let own = padded(plan.own);
                    let ringing = [0..own, own..state.x.len()].map(|of| energies(state, of)[0]);
                    record.energy_at_parting = record.left[0] + ringing[0];
                    record.strikers_energy = record.left[1] + ringing[1];
                }
            }
        }
        record.contact_steps = substep / plan.substeps;
    }

    /// How long the motion of a body with these modes is looked at, from the beginning of the blow, s.
    #[inline(always)]
    pub(super) fn window(&self, modes: Range<usize>, state: &BankState) -> f64 {
        let oscillators = &self.plan.oscillators;
        let amplitude = |i: usize| libm::hypot(state.x[i], state.v[i]) / oscillators[i].0;
        let largest = modes.clone().map(amplitude).fold(0.0, f64::max);
        let low = { modes }.find(|&i| amplitude(i) >= SIGNIFICANT * largest);
        PERIODS * low.map_or(0.0, |i| TAU / oscillators[i].0)
    }

    /// Time steps from now to the last one before a striker touches again, where it does before `end`, s.
    #[inline(always)]
    fn return_after(
        &self,
        record: &Record,
        state: &BankState,
        contacts: &Contacts<'_>,
        end: f64,
    ) -> Option<usize> {
        let plan = self.plan;
        if !self.returns || self.instant || record.forces.len() >= MOST_SUBSTEPS * plan.sites.len()
        {
            return None;
        }
        let left = end - record.contact_steps as f64 * plan.time_step;
        let left = left.min(contacts.within_reach(state));
        let steps = (left / plan.time_step).ceil().max(0.0) as usize;
        let mut state = state.clone();
        (1..=steps.min(MOST_STEPS))
            .find(|&step| {
                self.coast(&mut state);
                self.forget_waves(step, &mut state);
                contacts.touch_at(&state, step as f64 * plan.time_step)
            })
            .map(|step| step - 1)
    }

    /// Lets so many time steps pass in which nothing touches.
    #[inline(always)]
    fn wait(
        &self,
        steps: usize,
        record: &mut Record,
        state: &mut BankState,
        contacts: &mut Contacts<'_>,
    ) {
        let plan = self.plan;
        for step in 1..=steps {
            let first = record.contact_steps * plan.substeps;
            contacts.soften(self.softer, first..first + plan.substeps);
            self.coast(state);
            let left = self.forget_waves(step, state);
            record.left = [0, 1].map(|side| record.left[side] + left[side]);
            for (way, speed) in contacts.ways.iter_mut().zip(&contacts.speeds) {
                *way += speed * plan.time_step;
            }
            let substeps = std::iter::repeat_n(0.0, plan.substeps * plan.sites.len());
            record.forces.extend(substeps);
            record.sample(plan, state, &contacts.forces, true);
            record.contact_steps += 1;
        }
    }

    /// A time step in which nothing touches.
    #[inline(always)]
    fn coast(&self, state: &mut BankState) {
        self.plan.step.coast(state, &Pushes::NONE, &[]);
    }

    /// Time steps until waves from this angular frequency on, rad/s, have left the place of the contact: half a period of the lowest.
    #[inline(always)]
    fn leave_after(&self, lowest: f64) -> usize {
        ((PI / lowest / self.plan.time_step).ceil() as usize).min(MOST_STEPS)
    }

    /// Forgets the waves that leave in the time step of this number after the contacts parted. Returns the energy of the body's own, and
    /// of those of breakable strikers, J.
    #[inline(always)]
    fn forget_waves(&self, step: usize, state: &mut BankState) -> [f64; 2] {
        let mut energy = [0.0; 2];
        for (waves, lowest) in &self.plan.waves {
            if self.leave_after(*lowest) == step {
                let (x, v) = (&mut state.x[waves.clone()], &mut state.v[waves.clone()]);
                let squares: f64 = x.iter().chain(v.iter()).map(|x| x * x).sum();
                energy[usize::from(waves.start >= self.plan.own)] += 0.5 * squares;
                x.fill(0.0);
                v.fill(0.0);
            }
        }
        energy
    }

    /// The free motion after the contacts, to the end of the window, s.
    #[inline(always)]
    fn ring(&self, record: &mut Record, mut state: BankState, window: f64) {
        let plan = self.plan;
        let time_step = plan.time_step;
        if self.instant {
            record.near_steps = record.contact_steps;
            return;
        }
        let near = plan.sites.iter().filter_map(|s| s.near.as_ref());
        let leave = near.map(|n| self.leave_after(n.wall.lowest)).max();
        record.near_steps = record.contact_steps + leave.unwrap_or(0);
        for _ in record.contact_steps..record.near_steps {
            self.coast(&mut state);
            record.sample(plan, &state, &[], true);
        }
        let rest = window - record.near_steps as f64 * time_step;
        let steps = (rest / (plan.coarser * time_step)).ceil().max(0.0) as usize;
        let steps = steps.min(MOST_STEPS);
        record.amplitudes.reserve_exact(steps * plan.modes);
        for _ in 0..steps {
            plan.coarse.coast(&mut state, &Pushes::NONE, &[]);
            record.sample(plan, &state, &[], false);
        }
    }
}

impl Record {
    fn new(plan: &Plan) -> Self {
        Self {
            forces: Vec::new(),
            amplitudes: Vec::new(),
            swing: Vec::new(),
            width: (plan.own - plan.modes).max(1),
            near_steps: 0,
            contact_steps: 0,
            speeds: Vec::new(),
            peak_energy: 0.0,
            strain_energy: Vec::new(),
            energy_at_parting: 0.0,
            left: [0.0; 2],
            strikers_energy: 0.0,
        }
    }

    #[inline(always)]
    fn sample(&mut self, plan: &Plan, state: &BankState, forces: &[f64], near: bool) {
        let (modes, all) = (plan.modes, plan.own);
        let amplitudes = state.x[..modes].iter().zip(&plan.periods);
        self.amplitudes
            .extend(amplitudes.map(|(x, period)| (x * period) as f32));
        if near {
            self.swing
                .extend(state.x[modes..all].iter().map(|&x| x as f32));
        }
        let count = forces.len();
        let mut held = 0.0;
        for k in 0..count {
            for l in 0..count {
                held += 0.5 * forces[k] * plan.own_compliance[k * count + l] * forces[l];
            }
        }
        let [whole, strain] = energies(state, 0..padded(all));
        self.peak_energy = self.peak_energy.max(whole + held);
        let before = self.strain_energy.last().copied().unwrap_or(0.0);
        self.strain_energy.push(before.max(strain + held));
    }
}

/// Energy and strain energy of some oscillators, in whole groups, J.
#[inline(always)]
fn energies(state: &BankState, which: Range<usize>) -> [f64; 2] {
    let (x, v) = (&state.x[which.clone()], &state.v[which]);
    let strain = 0.5 * dot(x, x);
    [strain + 0.5 * dot(v, v), strain]
}
