//! Counts of the loads put to the fracture, and of how cheaply most were refused.

use frangible::Outcome;
use frangible::internals::outcome::LookedAt;

/// Counts of the loads that a world put to the fracture, by outcome. Each load is one question; a load that a repeated step brings
/// again unchanged is not asked again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct LoadCounts {
    /// Loads asked: one body in one step each, with all its contacts.
    pub asked: u64,
    /// Contacts in them.
    pub contacts: u64,
    /// Refused by the sizes and durations of their impulses, without time steps ([`LookedAt::Sizes`], [`LookedAt::Impulses`]); steady
    /// loads by the size of their forces.
    pub by_impulses: u64,
    /// Refused by the amplitudes of the modes and bounds of the whole body, at every time step ([`LookedAt::Amplitudes`]).
    pub by_amplitudes: u64,
    /// Refused by bounds of parts of the body ([`LookedAt::Clusters`]).
    pub by_clusters: u64,
    /// Held after a look at stresses ([`LookedAt::Stresses`]).
    pub by_stresses: u64,
    /// Broke; also where there was no room for the pieces.
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
