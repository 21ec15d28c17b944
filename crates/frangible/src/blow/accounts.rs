//! Accounts of a blow: the work that its contacts do on the body, and what becomes of it.

use super::bank::BankState;
use super::flight::{Flight, Setup};
use crate::outcome::BlowEnergy;

/// Accounts of the contacts so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Accounts {
    /// Displacement of the body at each contact, along its push, m, and force, N, when the work was last summed.
    ways: Vec<f64>,
    forces: Vec<f64>,
    /// q' at the last time step, m·√kg.
    elastic: Vec<f64>,
    /// Work of the contacts on the vibration and the pieces, J.
    work: f64,
    /// Energy that damping has taken, J.
    damped: f64,
    /// Energy that faces of pieces have lost when they closed, and that partings have set free, J.
    lost: [f64; 2],
    /// Energy of the body when the contacts parted, J.
    kept: f64,
}

impl Accounts {
    /// Adds the work of the contacts, whose forces, N, have changed linearly since it was last added.
    pub(super) fn add_work(
        &mut self,
        setup: Setup<'_>,
        body: (&BankState, &Flight),
        forces: &[f64],
    ) {
        let (before, at) = (std::mem::take(&mut self.ways), self.forces.len());
        self.forces.resize(forces.len(), 0.0);
        self.rebase(setup, body, forces);
        for k in 0..at {
            self.work += 0.5 * (forces[k] + self.forces[k]) * (self.ways[k] - before[k]);
        }
        self.forces.copy_from_slice(forces);
    }

    /// Takes the displacements of the body at the contacts anew: one that goes on to another piece has done no work by that.
    pub(super) fn rebase(
        &mut self,
        setup: Setup<'_>,
        (state, flight): (&BankState, &Flight),
        forces: &[f64],
    ) {
        let plan = setup.plan;
        let oscillators = plan.oscillators[..plan.own].iter().zip(&state.x);
        let rows = plan.own_compliance.chunks_exact(forces.len().max(1));
        let ways = plan.drive.iter().zip(rows).enumerate();
        let ways = ways.map(|(k, (drive, row))| {
            let swing = oscillators.clone().zip(drive);
            let swing = swing.map(|(((w, _), x), xi)| xi * x / w).sum::<f64>();
            let rest = row.iter().zip(forces).map(|(c, f)| c * f).sum::<f64>();
            swing + rest + flight.way(setup, k)
        });
        self.ways = ways.collect();
    }

    /// Adds the losses of a time step. `elastic`: q' at its end, m·√kg; `energies`: energy of the body then, and strain energy in it, J.
    pub(super) fn add_losses(
        &mut self,
        setup: Setup<'_>,
        (state, flight): (&BankState, &Flight),
        elastic: &[f64],
        [whole, strain]: [f64; 2],
    ) {
        let plan = setup.plan;
        let [alpha, beta] = plan.rayleigh;
        self.elastic.resize(elastic.len(), 0.0);
        let mut power = 2.0 * beta * (whole - strain);
        let changes = elastic.iter().zip(&self.elastic).zip(&plan.oscillators);
        for ((now, before), (w, _)) in changes {
            let rate = w * (now - before) / plan.time_step;
            power += alpha * rate * rate;
        }
        let waves = plan.oscillators[..plan.own].iter().zip(&state.v);
        let waves = waves.skip(plan.modes).map(|((_, d), v)| (d - beta) * v * v);
        self.damped += (power + waves.sum::<f64>()) * plan.time_step;
        self.elastic.copy_from_slice(elastic);
        self.lost = flight.lost();
        self.kept = whole;
    }

    /// What became of the work. `pieces`: kinetic energy of the pieces in the end, J.
    pub(super) fn report(&self, pieces: f64) -> BlowEnergy {
        BlowEnergy {
            work: self.work,
            damped: self.damped,
            faces: self.lost[0],
            released: self.lost[1],
            kept: self.kept,
            pieces,
        }
    }
}
