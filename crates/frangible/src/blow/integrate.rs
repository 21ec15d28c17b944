//! The integration of a blow, substep by substep.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use glam::DVec3;

use super::bank::{Bank, BankState, Pushes, dot, padded};
use super::contacts::Contacts;
use super::flight::Flight;
use super::parted::Parted;
use super::plan::Plan;

/// A blow of so many substeps is cut off: a contact that lasts this long is none of a blow's.
const MOST_SUBSTEPS: usize = 60_000;

/// Most time steps of each of the two parts of the motion after the contact; a longer part is cut there (the cut shows in the report's number
/// of steps).
const MOST_STEPS: usize = 20_000;

/// Once pieces move on their own a contact that has opened may close again, as a chip bounces between the striker and the body that follows. It is
/// over when it has stayed open for so many times the time that it was expected to last, or when the striker leaves the body as a whole.
const OPEN: f64 = 1.0;

/// Mode i is significantly excited when its amplitude reaches this share of the largest.
const SIGNIFICANT: f64 = 0.05;

/// Periods of the lowest significantly excited mode that are looked at.
const PERIODS: f64 = 1.5;

/// Angle that the highest mode turns by in a tick, at most, once pieces move on their own and no contact pushes. The scheme is stable at any;
/// measured (a bar that parts in halves): up to this one its stress is off by no more than 0.04 of its rms.
const TICK_OF_PIECES: f64 = 0.8;

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
    /// Energy of the body's vibration and pieces, and the strain energy in it, at the end of each time step, J.
    pub(super) energies: Vec<[f64; 2]>,
    pub(super) energy_at_parting: f64,
    /// Energy of breakable strikers' oscillators at parting, J.
    pub(super) strikers_energy: f64,
    /// Velocity and angular velocity of each piece that moves on its own in the end, against the whole body's rigid motion, m/s and rad/s.
    pub(super) drifts: Vec<[DVec3; 2]>,
}

/// The integration.
pub(super) struct Run<'a> {
    pub(super) plan: &'a Plan,
    /// Forces from the beginning on that are known already.
    pub(super) known: &'a [f64],
    pub(super) softer: &'a [Softening],
    /// What has parted, in the order of time.
    pub(super) parted: &'a [Parted],
    /// Whether nothing is looked at after the contact.
    pub(super) instant: bool,
}

impl pulp::NullaryFnOnce for Run<'_> {
    type Output = Record;

    #[inline(always)]
    fn call(self) -> Record {
        let plan = self.plan;
        let count = plan.sites.len();
        let pushes = plan.pushes();
        let mut state = BankState::rest(plan.oscillators.len());
        let mut contacts = Contacts::new(plan);
        let mut record = Record::new(plan);
        let mut flight = Flight::new(plan, self.parted);
        let mut substep = 0;
        let mut parted = false;
        let mut open = 0;
        let shortest = (plan.sites.iter().map(|s| s.duration)).fold(f64::INFINITY, f64::min);
        let most_open = (OPEN * shortest / contacts.dt).min(MOST_SUBSTEPS as f64) as usize;
        while !(parted && substep % plan.substeps == 0) {
            let t = (substep + 1) as f64 * contacts.dt;
            flight.part(|p| p.substep <= substep);
            flight.begin(&state, &plan.fine, contacts.dt);
            plan.fine.coast(&mut state, &pushes, &contacts.forces);
            flight.foresee(&mut state, &plan.fine, &contacts.forces);
            contacts.foresee(&state, &flight);
            for softer in self.softer.iter().filter(|s| s.substep == substep) {
                contacts.weakness[softer.contact] = softer.compliance;
            }
            match self.known.get(substep * count..(substep + 1) * count) {
                Some(known) => contacts.next.copy_from_slice(known),
                None if parted => contacts.next.fill(0.0),
                None => contacts.solve(t, flight.give()),
            }
            contacts.grow();
            plan.fine.grow(&mut state, &pushes, &contacts.growth);
            flight.end(&mut state, &plan.fine, &contacts.growth);
            contacts.advance();
            record.forces.extend_from_slice(&contacts.forces);
            substep += 1;
            if substep % plan.substeps == 0 {
                record.sample(plan, &flight, &state, &contacts.forces, true);
            }
            if !parted {
                open = match contacts.have_parted(&state, &flight, t) {
                    true => open + 1,
                    false => 0,
                };
                let waits = flight.is_on() && open < most_open && contacts.approach();
                parted = (open > 0 && !waits) || substep >= MOST_SUBSTEPS;
                if parted {
                    record.energy_at_parting = of_body(plan, &flight, &state)[0];
                    let strikers = plan.strikers.start..padded(plan.strikers.end);
                    record.strikers_energy = energies(&state, strikers)[0];
                }
            }
        }
        record.contact_steps = substep / plan.substeps;
        record.speeds = contacts.speeds;
        state.keep(plan.own);
        flight.end_contacts();
        self.ring(&mut record, &mut state, &mut flight);
        record.drifts = flight.drifts(&state);
        record
    }
}

impl Run<'_> {
    /// The free motion after the contacts.
    #[inline(always)]
    fn ring(&self, record: &mut Record, state: &mut BankState, flight: &mut Flight) {
        let plan = self.plan;
        let time_step = plan.time_step;
        if self.instant {
            record.near_steps = record.contact_steps;
            return;
        }
        let amplitude = |i: usize| libm::hypot(state.x[i], state.v[i]) / plan.oscillators[i].0;
        let largest = (0..plan.modes).map(amplitude).fold(0.0, f64::max);
        let low = (0..plan.modes).find(|&i| amplitude(i) >= SIGNIFICANT * largest);
        let period = low.map_or(0.0, |i| TAU / plan.oscillators[i].0);
        // After the blow its waves leave within half a period of the lowest of them.
        let near = plan.sites.iter().filter_map(|s| s.near.as_ref());
        let leave = near.map(|n| PI / n.wall.lowest).fold(0.0, f64::max);
        let leave = ((leave / time_step).ceil() as usize).min(MOST_STEPS);
        record.near_steps = record.contact_steps + leave;
        let rest = PERIODS * period - record.near_steps as f64 * time_step;
        let steps = (rest / (plan.coarser * time_step)).ceil().max(0.0) as usize;
        let steps = steps.min(MOST_STEPS);
        record
            .amplitudes
            .reserve_exact((leave + steps) * plan.modes);
        let parts = [
            (leave, &plan.step, time_step, true),
            (steps, &plan.coarse, plan.coarser * time_step, false),
        ];
        let mut step = record.contact_steps;
        for (steps, bank, length, near) in parts {
            let mut finer = None;
            for _ in 0..steps {
                flight.part(|p| p.step <= step);
                if flight.is_on() {
                    let (ticks, bank) = finer.get_or_insert_with(|| self.ticks(length));
                    let tick = length / *ticks as f64;
                    for _ in 0..*ticks {
                        flight.begin(state, bank, tick);
                        bank.coast(state, &Pushes::NONE, &[]);
                        flight.foresee(state, bank, &[]);
                        flight.end(state, bank, &[]);
                    }
                } else {
                    bank.coast(state, &Pushes::NONE, &[]);
                }
                record.sample(plan, flight, state, &[], near);
                step += 1;
            }
        }
    }

    /// How many ticks a step of this length, s, has where pieces move on their own, and the oscillators through one.
    fn ticks(&self, length: f64) -> (usize, Bank) {
        let own = &self.plan.oscillators[..self.plan.own];
        let fastest = own[..self.plan.modes].last().map_or(0.0, |o| o.0);
        let ticks = (fastest * length / TICK_OF_PIECES).ceil().max(1.0) as usize;
        (ticks, Bank::new(own, length / ticks as f64))
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
            energies: Vec::new(),
            energy_at_parting: 0.0,
            strikers_energy: 0.0,
            drifts: Vec::new(),
        }
    }

    #[inline(always)]
    fn sample(
        &mut self,
        plan: &Plan,
        flight: &Flight,
        state: &BankState,
        forces: &[f64],
        near: bool,
    ) {
        let (modes, all) = (plan.modes, plan.own);
        let amplitudes = state.x[..modes].iter().zip(&plan.periods);
        let amplitudes = amplitudes.map(|(x, period)| x * period);
        match flight.elastic(state) {
            None => self.amplitudes.extend(amplitudes.map(|q| q as f32)),
            Some(elastic) => self.amplitudes.extend(elastic.iter().map(|&q| q as f32)),
        }
        let [whole, strain] = of_body(plan, flight, state);
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
        self.energies.push([whole + held, strain + held]);
    }
}

/// Energy of the body's vibration and pieces, without what follows the force, and the strain energy in it, J.
#[inline(always)]
fn of_body(plan: &Plan, flight: &Flight, state: &BankState) -> [f64; 2] {
    let [whole, strain] = energies(state, 0..padded(plan.own));
    let [more, more_strain] = flight.energies(state);
    [whole + more, strain + more_strain]
}

/// Energy and strain energy of some oscillators, in whole groups, J.
#[inline(always)]
fn energies(state: &BankState, which: Range<usize>) -> [f64; 2] {
    let (x, v) = (&state.x[which.clone()], &state.v[which]);
    let strain = 0.5 * dot(x, x);
    [strain + 0.5 * dot(v, v), strain]
}
