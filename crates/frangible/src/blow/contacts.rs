//! The contacts of a blow from substep to substep: displacements of the strikers, and contact forces.

use std::f64::consts::PI;

use super::bank::{BankState, dot_over};
use super::flight::{Flight, Setup};
use super::plan::Plan;

/// Most rounds over all contacts until their forces agree.
const MOST_ROUNDS: usize = 60;

/// State of the contacts between two substeps: lists with an entry per contact.
#[derive(Clone, Debug)]
pub(super) struct Contacts {
    /// Length of a substep, s.
    pub(super) dt: f64,
    /// Displacement of each striker relative to the rigid motion of the body, m, and its rate, m/s.
    ways: Vec<f64>,
    pub(super) speeds: Vec<f64>,
    /// Force now, force at the end of the substep, and growth in it, N.
    pub(super) forces: Vec<f64>,
    pub(super) next: Vec<f64>,
    pub(super) growth: Vec<f64>,
    /// Gaps at the end of the substep if no force grew, without the part that the residual compliance takes, m.
    bases: Vec<f64>,
    /// Compliance that cracks have added to the body, m/N.
    pub(super) weakness: Vec<f64>,
    /// Square roots of the springs' dents, m^½.
    roots: Vec<f64>,
    /// The largest forces so far, N.
    largest: Vec<f64>,
    /// Depth at which each striker touches, m: 0, or its depth when it went on to the group beside a piece that has flown off.
    deeper: Vec<f64>,
    /// Reduction of a gap per unit growth of one force within a substep, m/N: row-major, gap by gap.
    give: Vec<f64>,
}

impl Contacts {
    #[inline(always)]
    pub(super) fn new(plan: &Plan) -> Self {
        let count = plan.sites.len();
        let dt = plan.time_step / plan.substeps as f64;
        let mut give = vec![0.0; count * count];
        for k in 0..count {
            for l in 0..count {
                give[k * count + l] = plan.inverse_mass[k * count + l] * dt * dt / 6.0
                    + plan.fine.give(&plan.gap[k], &plan.drive[l]);
            }
        }
        let approach = |s: &super::plan::Site| f64::from(s.touch.contact.approach_speed);
        Self {
            dt,
            ways: vec![0.0; count],
            speeds: plan.sites.iter().map(approach).collect(),
            forces: vec![0.0; count],
            next: vec![0.0; count],
            growth: vec![0.0; count],
            bases: vec![0.0; count],
            weakness: vec![0.0; count],
            roots: vec![0.0; count],
            largest: vec![0.0; count],
            deeper: vec![0.0; count],
            give,
        }
    }

    /// Computes the bases. `state`: the oscillators at the end of the substep if no force grew.
    #[inline(always)]
    pub(super) fn foresee(&mut self, setup: Setup<'_>, state: &BankState, flight: &Flight) {
        let (plan, dt) = (setup.plan, self.dt);
        let count = self.forces.len();
        for k in 0..count {
            let fall: f64 = (0..count)
                .map(|l| plan.inverse_mass[k * count + l] * self.forces[l])
                .sum();
            self.bases[k] = self.ways[k] + self.speeds[k] * dt
                - 0.5 * fall * dt * dt
                - dot_over(&plan.gap[k], &state.x, &plan.felt[k])
                - flight.gap(setup, k)
                - self.deeper[k];
        }
    }

    /// Computes the forces at the end of the substep, at the time t, s, contact by contact until they agree. `through_pieces`: reduction of a gap per
    /// unit growth of one force, through pieces that move on their own, m/N; empty where there are none.
    #[inline(always)]
    pub(super) fn solve(&mut self, plan: &Plan, t: f64, through_pieces: &[f64]) {
        let count = self.forces.len();
        self.next.copy_from_slice(&self.forces);
        for _ in 0..MOST_ROUNDS {
            let mut change = 0.0_f64;
            let mut largest = 0.0_f64;
            for k in 0..count {
                let found = self.force(plan, k, t, through_pieces);
                change = change.max((found - self.next[k]).abs());
                largest = largest.max(found);
                self.next[k] = found;
            }
            if count == 1 || change <= 1e-12 * largest {
                break;
            }
        }
    }

    /// Computes the force of contact `k` at the end of the substep from those of all others, N.
    #[inline(always)]
    fn force(&mut self, plan: &Plan, k: usize, t: f64, through_pieces: &[f64]) -> f64 {
        let count = self.forces.len();
        let through = |i: usize| through_pieces.get(i).copied().unwrap_or(0.0);
        match plan.sites[k].script {
            Some([impulse, duration]) if t < duration => {
                0.5 * PI * impulse / duration * libm::sin(PI * t / duration)
            }
            Some(_) => 0.0,
            None => {
                let mut gap = self.bases[k];
                for l in 0..count {
                    let i = k * count + l;
                    let give = self.give[i] + through(i);
                    gap += give * self.forces[l];
                    if l != k {
                        gap -= (give + plan.compliance[i]) * self.next[l];
                    }
                }
                let i = k * count + k;
                let give = self.give[i] + (plan.compliance[i] + self.weakness[k] + through(i));
                let spring = &plan.sites[k].spring;
                spring.force(gap, give, self.largest[k], &mut self.roots[k])
            }
        }
    }

    #[inline(always)]
    pub(super) fn grow(&mut self) {
        for k in 0..self.forces.len() {
            self.growth[k] = self.next[k] - self.forces[k];
        }
    }

    /// Moves the strikers to the end of the substep.
    #[inline(always)]
    pub(super) fn advance(&mut self, plan: &Plan) {
        let count = self.forces.len();
        for k in 0..count {
            let row = &plan.inverse_mass[k * count..(k + 1) * count];
            let (mut held, mut mean) = (0.0, 0.0);
            for ((b, f), g) in row.iter().zip(&self.forces).zip(&self.growth) {
                held += b * (0.5 * f + g / 6.0);
                mean += b * (f + 0.5 * g);
            }
            self.ways[k] += self.speeds[k] * self.dt - held * self.dt * self.dt;
            self.speeds[k] -= mean * self.dt;
        }
        self.forces.copy_from_slice(&self.next);
        for (largest, &force) in self.largest.iter_mut().zip(&self.forces) {
            *largest = force.max(*largest);
        }
    }

    /// Moves strikers that still approach on, in a substep, to the groups beside the pieces under them, which have flown off. They touch these at
    /// their present depth, so nothing is pressed at once. Returns true if any striker goes on.
    pub(super) fn go_on(
        &mut self,
        setup: Setup<'_>,
        state: &BankState,
        flight: &mut Flight,
        substep: usize,
    ) -> bool {
        let plan = setup.plan;
        let mut any = false;
        for (k, site) in plan.sites.iter().enumerate() {
            let comes = site.script.is_none() && self.speeds[k] > 0.0;
            if !comes || !flight.go_on(setup, k, substep) {
                continue;
            }
            let body = dot_over(&plan.gap[k], &state.x, &plan.felt[k]);
            self.deeper[k] = (self.ways[k] - body - flight.gap_now(setup, k)).max(0.0);
            (self.largest[k], self.roots[k]) = (0.0, 0.0);
            any = true;
        }
        any
    }

    /// Parts pieces, so that no gap jumps where the piece under a contact is too small by now, and moves with what is beside it.
    pub(super) fn carry(
        &mut self,
        setup: Setup<'_>,
        flight: &mut Flight,
        part: impl FnOnce(&mut Flight),
    ) {
        let ways = |flight: &Flight| -> Vec<f64> {
            let contacts = 0..self.deeper.len();
            contacts.map(|k| flight.gap_now(setup, k)).collect()
        };
        let before = ways(flight);
        part(flight);
        let changes = before.iter().zip(ways(flight));
        let changes: Vec<f64> = changes.map(|(before, after)| before - after).collect();
        let deeper = self.deeper.iter_mut().zip(changes);
        deeper.for_each(|(deeper, change)| *deeper += change);
    }

    /// Returns true if any striker approaches the rigid motion of the body; scripts do not count.
    pub(super) fn approach(&self, plan: &Plan) -> bool {
        let mut sites = plan.sites.iter().zip(&self.speeds);
        sites.any(|(site, &speed)| site.script.is_none() && speed > 0.0)
    }

    /// Returns true if all contact forces are zero.
    pub(super) fn are_open(&self) -> bool {
        self.forces.iter().all(|&f| f <= 0.0)
    }

    /// Returns true if the gaps of all contacts are open and growing, and all scripts are over.
    #[inline(always)]
    pub(super) fn have_parted(
        &self,
        setup: Setup<'_>,
        state: &BankState,
        flight: &Flight,
        t: f64,
    ) -> bool {
        let plan = setup.plan;
        if !self.are_open() {
            return false;
        }
        plan.sites.iter().enumerate().all(|(k, site)| {
            if let Some([_, duration]) = site.script {
                return t >= duration;
            }
            // `gap` is per ω q: times ω it is per q, and so per q̇.
            let give: f64 = (plan.gap[k].iter().zip(&plan.oscillators).zip(&state.v))
                .map(|((gap, (w, _)), v)| gap * w * v)
                .sum();
            self.speeds[k] < give + flight.gap_speed(setup, k)
        })
    }
}
