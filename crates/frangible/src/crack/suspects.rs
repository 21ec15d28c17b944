//! Which weak points may crack, or raise the peak, at the steps of a batch: all steps of a point at once, so that the
//! arithmetic runs over the steps side by side. What cracks do in the meantime only takes suspects away: release
//! waves never raise the largest tension (λ_max(Q σ Q) ≤ max(λ_max(σ), 0), `stress/shadow.rs`).

use super::field::StressField;
use super::initiation::Peak;
use crate::body::Body;
use crate::stress::{BATCH, Lanes, StressLanes};

/// A weak point whose stress may pass its strength, or the peak so far, at a step of a batch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Suspect {
    /// Its place among the body's weak points, in the order of the clusters.
    pub(crate) place: u32,
    pub(crate) tet: u32,
    /// Stress and strain energy at the steps of the batch.
    pub(crate) state: StressLanes,
    /// Upper bounds of the largest principal tension, Pa.
    pub(crate) bounds: Lanes,
}

/// Suspects of the steps of a batch.
#[derive(Default)]
pub(crate) struct Suspects {
    points: Vec<Suspect>,
    of_step: [Vec<u32>; BATCH],
}

impl Suspects {
    /// Looks at all points of the clusters that survive at any step of the field's batch. `survivors`: places of the clusters
    /// in the body's list, bit k set where step k needs a look.
    pub(crate) fn find(
        &mut self,
        body: &Body,
        field: &mut StressField,
        survivors: impl Iterator<Item = (u32, u8)>,
        peak: Peak,
    ) {
        self.points.clear();
        self.of_step.iter_mut().for_each(Vec::clear);
        // With the widest vectors that this processor has; the same operations in the same order, so the same bits.
        pulp::Arch::new().dispatch(Look {
            suspects: self,
            body,
            field,
            survivors,
            peak,
        });
    }

    #[inline(always)]
    fn note(&mut self, body: &Body, suspect: Suspect, steps: u8, peak: Peak) {
        let resistance = &body.resistance;
        let strength = resistance.strength(suspect.tet);
        let limit = peak.tension.min(strength);
        let mut passing = 0_u8;
        for (k, &bound) in suspect.bounds.iter().enumerate() {
            let passes = bound > limit || resistance.as_weakest(bound, strength) > peak.as_weakest;
            passing |= u8::from(passes) << k;
        }
        passing &= steps;
        if passing == 0 {
            return;
        }
        let number = self.points.len() as u32;
        self.points.push(suspect);
        while passing != 0 {
            self.of_step[passing.trailing_zeros() as usize].push(number);
            passing &= passing - 1;
        }
    }

    /// Those of step `k` of the batch.
    pub(crate) fn at(&self, k: usize) -> impl Iterator<Item = &Suspect> {
        self.of_step[k].iter().map(|&i| &self.points[i as usize])
    }
}

/// The look at all points of some clusters.
struct Look<'a, 'f, I> {
    suspects: &'a mut Suspects,
    body: &'a Body,
    field: &'a mut StressField<'f>,
    survivors: I,
    peak: Peak,
}

impl<I: Iterator<Item = (u32, u8)>> pulp::NullaryFnOnce for Look<'_, '_, I> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (cluster, steps) in self.survivors {
            let places = self.body.clusters.places(cluster as usize);
            for (place, &tet) in places.zip(self.body.clusters.tets(cluster as usize)) {
                let state = self.field.at_weak_point(tet as usize);
                let suspect = Suspect {
                    place: place as u32,
                    tet,
                    bounds: state.tension_bounds(),
                    state,
                };
                self.suspects.note(self.body, suspect, steps, self.peak);
            }
        }
    }
}
