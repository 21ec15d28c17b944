//! Results of a blow: impulses, durations, energies, and the reports of its contacts.

use super::{Blow, BlowEnergy};
use crate::contact::ContactReport;

impl Blow {
    /// Modal impulses of the contacts, N·s/√kg, as prescribed impulses have them.
    pub(crate) fn modal_impulse(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.plan.modes];
        for (k, drive) in self.plan.drive.iter().enumerate() {
            let forces = self.record.forces_of(&self.plan, k);
            let impulse = forces.sum::<f64>() * self.substep();
            for (sum, xi) in sums.iter_mut().zip(drive) {
                *sum += impulse * xi;
            }
        }
        sums
    }

    /// Duration of the contacts, s: time until the last force ends.
    pub(crate) fn duration(&self) -> f64 {
        let count = self.plan.sites.len();
        let last = self.record.forces.iter().rposition(|&f| f > 0.0);
        last.map_or(0.0, |i| (i / count + 1) as f64 * self.substep())
    }

    /// Shortest expected duration of the contacts, s: Hertz's time, or a script's duration.
    pub(crate) fn expected_duration(&self) -> f64 {
        let times = self.plan.sites.iter().map(|s| s.duration);
        times.fold(f64::INFINITY, f64::min)
    }

    /// Returns the report of each contact.
    #[must_use]
    pub fn reports(&self) -> Vec<ContactReport> {
        let speeds = self.progress.contacts.speeds.iter().enumerate();
        let of = |(k, &speed): (usize, &f64)| self.record.report(&self.plan, k, -speed);
        speeds.map(of).collect()
    }

    /// Energy of all modes and wall oscillators when the contact parts, and energy that the motion of approach has lost, J. For one contact without
    /// damping or friction, they differ only by the error of the substeps, [the energy of its striker](Self::strikers_energy) and [the energy of
    /// crushing](ContactReport::crushing_energy).
    #[must_use]
    pub fn energies(&self) -> [f64; 2] {
        let mass = 1.0 / self.plan.inverse_mass[0];
        let before = f64::from(self.plan.sites[0].touch.contact.approach_speed);
        let after = self.progress.contacts.speeds[0];
        [
            self.progress.at_parting.map_or(0.0, |[of_body, _]| of_body),
            0.5 * mass * (before * before - after * after),
        ]
    }

    /// Energy balance of the blow.
    pub(crate) fn accounts(&self) -> BlowEnergy {
        let parted = self.parted.last();
        let pieces = parted.map_or(0.0, |parted| parted.kinetic_energy(&self.drifts()));
        self.progress.accounts.report(pieces)
    }

    /// Energy of the modes and wall oscillators of breakable strikers when the contact parts, J.
    #[must_use]
    pub fn strikers_energy(&self) -> f64 {
        (self.progress.at_parting).map_or(0.0, |[_, of_strikers]| of_strikers)
    }

    /// Energy of the body's vibration and of the pieces that move on their own, and the strain energy in it, at the end of each time step, J.
    #[doc(hidden)]
    #[must_use]
    pub fn energies_over_time(&self) -> &[[f64; 2]] {
        &self.record.energies
    }
}
