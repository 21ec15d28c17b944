//! Counts of the loads put to the fracture, and of how cheaply most were refused.

use frangible::Outcome;
use frangible::internals::outcome::LookedAt;

/// Counts of the loads that a world tested for fracture, by outcome. A load that a repeated step reproduces unchanged counts once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct LoadCounts {
    /// Loads tested: each is one body in one step, with all its contacts.
    pub asked: u64,
    /// Contacts of these loads.
    pub contacts: u64,
    /// Ruled out by the sizes and durations of the impulses, without time steps ([`LookedAt::Sizes`], [`LookedAt::Impulses`]); sustained
    /// loads by the size of their forces.
    pub by_impulses: u64,
    /// Ruled out by the modal amplitudes and a bound for the whole body, at every time step ([`LookedAt::Amplitudes`]).
    pub by_amplitudes: u64,
    /// Ruled out by bounds for the clusters of the body ([`LookedAt::Clusters`]).
    pub by_clusters: u64,
    /// Held according to the computed stresses ([`LookedAt::Stresses`]).
    pub by_stresses: u64,
    /// Broke, including breaks suppressed for lack of room for the pieces.
    pub broke: u64,
}

impl LoadCounts {
    /// Counts one answer: how closely the load was looked at, or that the body broke.
    pub(crate) fn count(&mut self, contacts: usize, held: Option<LookedAt>) {
        self.asked += 1;
        self.contacts += contacts as u64;
        let of = match held {
            None => &mut self.broke,
            Some(LookedAt::Sizes | LookedAt::Impulses) => &mut self.by_impulses,
            Some(LookedAt::Amplitudes) => &mut self.by_amplitudes,
            Some(LookedAt::Clusters) => &mut self.by_clusters,
            // Stresses; a look that this version does not know counts as the closest.
            Some(_) => &mut self.by_stresses,
        };
        *of += 1;
    }
}

/// Depth to which an outcome was looked at; none where the body broke.
pub(crate) fn held(outcome: &Outcome) -> Option<LookedAt> {
    match outcome {
        Outcome::Broke(_) => None,
        outcome => Some(outcome.report().looked_at),
    }
}
