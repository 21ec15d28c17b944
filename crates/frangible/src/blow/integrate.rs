//! The integration of a blow, substep by substep.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::accounts::Accounts;
use super::bank::{Bank, BankState, Pushes, dot, padded};
use super::contacts::Contacts;
use super::flight::{Flight, Setup};
use super::plan::Plan;
use super::record::Record;
use crate::motion::Motion;

/// Most substeps of a blow, which is cut off there: a contact that lasts longer is not part of a blow.
pub(super) const MOST_SUBSTEPS: usize = 60_000;

/// Most time steps of each of the two parts of the motion after the contact; a longer part is cut there (the cut shows in the report's number
/// of steps).
const MOST_STEPS: usize = 20_000;

/// Time that a contact must stay open to be over once pieces move on their own, in its expected durations: it may close again, as a chip bounces
/// between the striker and the body that follows. It is over sooner if the striker leaves the body as a whole.
const OPEN: f64 = 1.0;

/// Mode i is significantly excited when its amplitude reaches this share of the largest.
const SIGNIFICANT: f64 = 0.05;

/// Least length of the motion, in periods of the lowest significantly excited mode.
const PERIODS: f64 = 1.5;

/// Largest angle that the highest mode turns by in a tick, rad, once pieces move on their own and no contact pushes. The scheme is stable at any
/// angle. Measured (a bar that parts in halves): up to this one its stress is off by no more than 0.04 of its rms.
const TICK_OF_PIECES: f64 = 0.8;

/// Compliance that cracks add to the body under a contact, from a substep on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Softening {
    pub(super) contact: usize,
    pub(super) substep: usize,
    /// Added compliance, m/N.
    pub(super) compliance: f64,
}

/// Progress of an integration.
#[derive(Clone, Debug)]
pub(super) struct Progress {
    pub(super) state: BankState,
    pub(super) contacts: Contacts,
    pub(super) flight: Flight,
    pub(super) accounts: Accounts,
    /// Number of time steps so far, and of substeps in those with contacts.
    pub(super) step: usize,
    pub(super) substep: usize,
    /// Number of substeps for which all contacts have been open.
    open: usize,
    /// Once the contacts have parted: energy of the body then, and of breakable strikers' oscillators, J.
    pub(super) at_parting: Option<[f64; 2]>,
    /// Known after the time step in which the contacts have parted.
    pub(super) after: Option<After>,
}

/// Lengths of the parts of a motion, known once the contacts have parted.
#[derive(Clone, Copy, Debug)]
pub(super) struct After {
    /// Time steps until the contacts have parted.
    pub(super) contact_steps: usize,
    /// Time steps until the near field has gone.
    pub(super) near_steps: usize,
    /// Time steps of the whole motion.
    pub(super) steps: usize,
}

/// An integration, from its present state on.
pub(super) struct Run<'a> {
    pub(super) setup: Setup<'a>,
    pub(super) softer: &'a [Softening],
    /// If true, the motion ends with the contacts.
    pub(super) instant: bool,
    /// Substeps after which the contacts are cut off.
    pub(super) longest: usize,
    /// Time step at which the integration pauses, if the motion has so many.
    pub(super) until: usize,
    pub(super) progress: &'a mut Progress,
    pub(super) record: &'a mut Record,
    pub(super) motion: &'a mut Motion,
}

widest! {
    /// Integrates until the pause, or to the end.
    pub(super) fn run(run: Run<'_>) {
        let mut run = run;
        while run.progress.after.is_none() && run.progress.step < run.until {
            run.push();
        }
        if run.progress.after.is_some() {
            run.ring();
        }
    }
}

impl Run<'_> {
    /// Integrates a time step in which contacts push.
    #[inline(always)]
    fn push(&mut self) {
        let (setup, plan) = (self.setup, self.setup.plan);
        let pushes = plan.pushes();
        let Progress {
            state,
            contacts,
            flight,
            accounts,
            substep,
            open,
            at_parting,
            ..
        } = &mut *self.progress;
        let shortest = (plan.sites.iter().map(|s| s.duration)).fold(f64::INFINITY, f64::min);
        let most_open = (OPEN * shortest / contacts.dt).min(MOST_SUBSTEPS as f64) as usize;
        for _ in 0..plan.substeps {
            let t = (*substep + 1) as f64 * contacts.dt;
            if flight.is_due(setup, *substep) {
                contacts.carry(setup, flight, |flight| {
                    flight.part(setup, state, |p| p.substep <= *substep);
                });
                accounts.rebase(setup, (state, flight), &contacts.forces);
            }
            flight.begin(setup, state, &plan.fine, contacts.dt);
            plan.fine.coast(state, &pushes, &contacts.forces);
            flight.foresee(setup, state, &plan.fine, &contacts.forces);
            contacts.foresee(setup, state, flight);
            for softer in self.softer.iter().filter(|s| s.substep == *substep) {
                contacts.weakness[softer.contact] = softer.compliance;
            }
            match at_parting {
                Some(_) => contacts.next.fill(0.0),
                None => contacts.solve(plan, t, flight.give()),
            }
            contacts.grow();
            plan.fine.grow(state, &pushes, &contacts.growth);
            flight.end(setup, state, &plan.fine, &contacts.growth);
            contacts.advance(plan);
            accounts.add_work(setup, (state, flight), &contacts.forces);
            self.record.forces.extend_from_slice(&contacts.forces);
            *substep += 1;
            if at_parting.is_some() {
                continue;
            }
            *open = match contacts.have_parted(setup, state, flight, t) {
                true => *open + 1,
                false => 0,
            };
            let comes = flight.is_on() && contacts.approach(plan);
            if *open > 0 && comes && *open >= most_open {
                // The pieces under the strikers have flown off: the strikers meet what is beside these.
                if contacts.go_on(setup, state, flight, *substep) {
                    accounts.rebase(setup, (state, flight), &contacts.forces);
                    *open = 0;
                }
            }
            let waits = comes && *open < most_open;
            if (*open > 0 && !waits) || *substep >= self.longest {
                flight.elastic(setup, state, &mut self.record.elastic);
                let [energy, _] = of_body(setup, flight, state, &self.record.elastic);
                let strikers = plan.strikers.start..padded(plan.strikers.end);
                *at_parting = Some([energy, energies(state, strikers)[0]]);
            }
        }
        self.progress.step += 1;
        self.sample(true);
        // Forces that are cut off still fall to zero within a substep.
        if self.progress.at_parting.is_some() && self.progress.contacts.are_open() {
            self.progress.state.keep(plan.own);
            self.progress.flight.end_contacts();
            self.progress.after = Some(self.after());
        }
    }

    /// Computes the lengths of the parts of the motion.
    fn after(&self) -> After {
        let plan = self.setup.plan;
        let (state, contact_steps) = (&self.progress.state, self.progress.step);
        if self.instant {
            return After {
                contact_steps,
                near_steps: contact_steps,
                steps: contact_steps,
            };
        }
        let time_step = plan.time_step;
        let amplitude = |i: usize| libm::hypot(state.x[i], state.v[i]) / plan.oscillators[i].0;
        let largest = (0..plan.modes).map(amplitude).fold(0.0, f64::max);
        let low = (0..plan.modes).find(|&i| amplitude(i) >= SIGNIFICANT * largest);
        let period = low.map_or(0.0, |i| TAU / plan.oscillators[i].0);
        // After the blow the waves of the near field leave within half a period of the lowest of them.
        let near = plan.sites.iter().filter_map(|s| s.near.as_ref());
        let leave = near.map(|n| PI / n.wall.lowest).fold(0.0, f64::max);
        let leave = ((leave / time_step).ceil() as usize).min(MOST_STEPS);
        let near_steps = contact_steps + leave;
        let rest = PERIODS * period - near_steps as f64 * time_step;
        let steps = (rest / (plan.coarser * time_step)).ceil().max(0.0) as usize;
        After {
            contact_steps,
            near_steps,
            steps: near_steps + steps.min(MOST_STEPS),
        }
    }

    /// Integrates the free motion after the contacts.
    #[inline(always)]
    fn ring(&mut self) {
        let (setup, plan) = (self.setup, self.setup.plan);
        let Some(after) = self.progress.after else {
            return;
        };
        let parts = [
            (after.near_steps, &plan.step, plan.time_step, true),
            (
                after.steps,
                &plan.coarse,
                plan.coarser * plan.time_step,
                false,
            ),
        ];
        for (end, bank, length, near) in parts {
            let mut finer = None;
            while self.progress.step < end.min(self.until) {
                let Progress {
                    state,
                    flight,
                    step,
                    ..
                } = &mut *self.progress;
                flight.part(setup, state, |p| p.step <= *step);
                if flight.is_on() {
                    let (ticks, bank) = finer.get_or_insert_with(|| ticks(plan, length));
                    let tick = length / *ticks as f64;
                    for _ in 0..*ticks {
                        flight.begin(setup, state, bank, tick);
                        bank.coast(state, &Pushes::NONE, &[]);
                        flight.foresee(setup, state, bank, &[]);
                        flight.end(setup, state, bank, &[]);
                    }
                } else {
                    bank.coast(state, &Pushes::NONE, &[]);
                }
                *step += 1;
                self.sample(near);
            }
        }
    }

    /// Records the time step that has ended.
    #[inline(always)]
    fn sample(&mut self, near: bool) {
        let (setup, plan) = (self.setup, self.setup.plan);
        let Progress {
            state,
            flight,
            accounts,
            contacts,
            after,
            ..
        } = &mut *self.progress;
        let record = &mut *self.record;
        flight.elastic(setup, state, &mut record.elastic);
        let elastic = record.elastic.iter().map(|&q| q as f32);
        self.motion.amplitudes.extend(elastic);
        if near {
            let swing = &state.x[plan.modes..plan.own];
            record.swing.extend(swing.iter().map(|&x| x as f32));
        }
        let forces: &[f64] = match after {
            None => &contacts.forces,
            Some(_) => &[],
        };
        let count = forces.len();
        let mut held = 0.0;
        for k in 0..count {
            for l in 0..count {
                held += 0.5 * forces[k] * plan.own_compliance[k * count + l] * forces[l];
            }
        }
        let [whole, strain] = of_body(setup, flight, state, &record.elastic);
        if count > 0 {
            accounts.add_losses(
                setup,
                (state, flight),
                &record.elastic,
                [whole + held, strain + held],
            );
        }
        record.energies.push([whole + held, strain + held]);
        self.motion.take_energies(whole + held, strain + held);
    }
}

/// Number of ticks in a step of this length, s, once pieces move on their own, and the body's oscillators through a tick.
fn ticks(plan: &Plan, length: f64) -> (usize, Bank) {
    let own = &plan.oscillators[..plan.own];
    let fastest = own[..plan.modes].last().map_or(0.0, |o| o.0);
    let ticks = (fastest * length / TICK_OF_PIECES).ceil().max(1.0) as usize;
    (ticks, Bank::new(own, length / ticks as f64))
}

impl Progress {
    /// Progress at the beginning of a blow.
    pub(super) fn new(plan: &Plan) -> Self {
        Self {
            state: BankState::rest(plan.oscillators.len()),
            contacts: Contacts::new(plan),
            flight: Flight::new(plan),
            accounts: Accounts::default(),
            step: 0,
            substep: 0,
            open: 0,
            at_parting: None,
            after: None,
        }
    }

    /// Returns true if the motion is over.
    pub(super) fn is_over(&self) -> bool {
        self.after.is_some_and(|after| self.step >= after.steps)
    }

    /// Number of time steps so far, up to the end of the near field.
    pub(super) fn near_steps(&self) -> usize {
        self.after
            .map_or(self.step, |after| after.near_steps.min(self.step))
    }
}

/// Energy of the body's vibration and pieces, without that of the residual compliance, and the strain energy in it, J, for this q'.
#[inline(always)]
fn of_body(setup: Setup<'_>, flight: &Flight, state: &BankState, elastic: &[f64]) -> [f64; 2] {
    let [whole, strain] = energies(state, 0..padded(setup.plan.own));
    let [more, more_strain] = flight.energies(setup, state, elastic);
    [whole + more, strain + more_strain]
}

/// Energy and strain energy of some oscillators, in whole groups, J.
#[inline(always)]
fn energies(state: &BankState, which: Range<usize>) -> [f64; 2] {
    let (x, v) = (&state.x[which.clone()], &state.v[which]);
    let strain = 0.5 * dot(x, x);
    [strain + 0.5 * dot(v, v), strain]
}
