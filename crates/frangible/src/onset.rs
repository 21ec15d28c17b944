//! When cracks can begin in an impact, looked for a bit at a time: for loops that have to answer in time.

use crate::body::Body;
use crate::config::FractureConfig;
use crate::crack::{Peak, StressField, Suspects};
use crate::impact::Vibration;
use crate::modal::Motion;
use crate::refuse::Culling;
use crate::stress::{DisplacementBatch, STRIDE, lane, largest_eigenvalue};

/// What is known of the beginning of cracks in an impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Onset {
    /// No weak point's stress passes its strength: the body holds.
    Never,
    /// At this time step a weak point's stress passes its strength for the first time. A crack starts if it also has the energy.
    At(usize),
    /// Not before this time step; the rest has not been looked at.
    NotBefore(usize),
}

/// Looks for the first time step of an impact at which a crack can start.
#[derive(Clone, Debug)]
pub struct OnsetSearch {
    vibration: Vibration,
    motion: Motion,
    /// Where it looks.
    room: Option<(DisplacementBatch, Suspects)>,
    onset: Onset,
}

impl OnsetSearch {
    /// Begins the search in an impact that has begun.
    #[must_use]
    pub fn new(body: &Body, vibration: Vibration) -> Self {
        Self {
            motion: vibration.motion(body),
            vibration,
            room: None,
            onset: Onset::NotBefore(0),
        }
    }

    /// Goes on looking. Time steps are looked at fifteen at a time; of those that the bounds do not clear, at most `looks` such
    /// batches. One look costs a product of all mode shapes with fifteen amplitudes, at most: 0.4 ms of 3 000 analysis nodes and 100
    /// modes. The answers hang on nothing but the input: not on the machine, nor on how the looks are shared out.
    ///
    /// A body with cracks from earlier impacts, which move at lower stresses, is not looked at: for it the answer stays
    /// [`Onset::NotBefore`].
    pub fn look(&mut self, body: &Body, config: &FractureConfig, looks: usize) -> Onset {
        if let Onset::NotBefore(first) = self.onset
            && body.state().is_intact()
        {
            self.onset = self.look_from(first, body, config, looks);
        }
        self.onset
    }

    /// What is known so far.
    #[must_use]
    pub fn onset(&self) -> Onset {
        self.onset
    }

    /// The impact, and the time step to end it from: [`Vibration::end`].
    #[must_use]
    pub fn into_impact(self) -> (Vibration, usize) {
        let first_step = match self.onset {
            Onset::Never => self.motion.steps(),
            Onset::At(step) | Onset::NotBefore(step) => step,
        };
        (self.vibration, first_step)
    }

    fn look_from(
        &mut self,
        from: usize,
        body: &Body,
        config: &FractureConfig,
        mut looks: usize,
    ) -> Onset {
        let (asset, motion) = (&**body.asset(), &self.motion);
        let mut culling = Culling::new(body, config, motion);
        for first in (from..motion.steps()).step_by(STRIDE) {
            let steps = first..(first + STRIDE).min(motion.steps());
            culling.begin();
            for step in steps.clone() {
                let root = culling.root(motion, step);
                culling.survive(motion, step, root, lane(step));
            }
            if culling.survivors().next().is_none() {
                continue;
            }
            if looks == 0 {
                return Onset::NotBefore(first);
            }
            looks -= 1;
            let room = || (DisplacementBatch::new(asset), Suspects::default());
            let (displacement, suspects) = self.room.get_or_insert_with(room);
            let pressed = &self.vibration.pressed;
            let mut field = StressField::new(body, config, motion, pressed, displacement);
            field.step = first;
            field.displacement.seek(motion, first);
            let survivors = culling.survivors();
            suspects.find(body, &mut field, survivors, &[], at_strength(body));
            for step in steps {
                if passes(body, suspects, step) {
                    return Onset::At(step);
                }
            }
        }
        Onset::Never
    }
}

/// Whether the stress of any suspect passes its strength at a step of their batch.
fn passes(body: &Body, suspects: &Suspects, step: usize) -> bool {
    let k = lane(step);
    suspects.at(k).any(|suspect| {
        let strength = body.strength(suspect.tet);
        // The bound needs no trigonometry.
        suspect.bounds[k] > strength && largest_eigenvalue(&suspect.state.stress(k)) > strength
    })
}

/// A peak that only points above their strength pass.
fn at_strength(body: &Body) -> Peak {
    Peak {
        tension: f32::INFINITY,
        tet: 0,
        as_weakest: body.weakest() as f32,
    }
}
