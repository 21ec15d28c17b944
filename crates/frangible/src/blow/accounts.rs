//! Accounts of a blow: the work that its contacts do on the body, and what becomes of it.

use super::bank::{BankState, dot};
use super::flight::{Flight, Setup};

/// Energy balance of a blow, J: the work less `damped`, `faces` and `released` is `kept`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct BlowEnergy {
    /// Work of the contacts on the vibration of the body and on its pieces, friction included.
    pub work: f64,
    /// Energy dissipated by damping until the contacts part.
    pub damped: f64,
    /// Energy dissipated where crack faces close and press on each other, until the contacts part.
    pub faces: f64,
    /// Motion of pieces that become too small to move on their own, until the contacts part.
    pub released: f64,
    /// Energy of the vibration and of the pieces when the contacts part.
    pub kept: f64,
    /// Kinetic energy of the separated pieces relative to the rigid motion of the whole body, at the end.
    pub pieces: f64,
}

/// Accounts of the contacts so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Accounts {
    /// Displacement of the body at each contact, along its push, m, and force, N, when the work was last summed.
    ways: Vec<f64>,
    forces: Vec<f64>,
    /// The displacements before the last sum, m.
    before: Vec<f64>,
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
    #[inline(always)]
    pub(super) fn add_work(
        &mut self,
        setup: Setup<'_>,
        body: (&BankState, &Flight),
        forces: &[f64],
    ) {
        self.before.clone_from(&self.ways);
        self.rebase(setup, body, forces);
        let sums = self.forces.iter().zip(forces).map(|(a, b)| 0.5 * (a + b));
        let moved = self.ways.iter().zip(&self.before).map(|(a, b)| a - b);
        self.work += sums.zip(moved).map(|(f, d)| f * d).sum::<f64>();
        self.forces.clear();
        self.forces.extend_from_slice(forces);
    }

    /// Recomputes the displacements at the contacts without adding work, after a contact has moved to another piece.
    #[inline(always)]
    pub(super) fn rebase(
        &mut self,
        setup: Setup<'_>,
        (state, flight): (&BankState, &Flight),
        forces: &[f64],
    ) {
        let plan = setup.plan;
        let rows = plan.own_compliance.chunks_exact(forces.len().max(1));
        self.ways.clear();
        for (k, (way, row)) in plan.ways.iter().zip(rows).enumerate() {
            let rest = row.iter().zip(forces).map(|(c, f)| c * f).sum::<f64>();
            let swing = dot(way, &state.x);
            self.ways.push(swing + rest + flight.way(setup, k));
        }
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

    /// Returns the energy balance. `pieces`: kinetic energy of the separated pieces at the end, J.
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
