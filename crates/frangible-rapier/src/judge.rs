//! Impacts put to the fracture, several at once.
//!
//! Each body is a question of its own, so they are shared out among threads; the answers come back in the order of the
//! questions, and no answer hangs on another: any number of threads gives the same bits.

use std::sync::Arc;

use frangible::{Fracture, Outcome};
use rapier3d::dynamics::RigidBodyHandle;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::contacts::Impact;
use crate::error::WorldError;
use crate::replace::Parts;
use crate::world::{BreakableWorld, key};

/// What an impact does to a body.
pub(crate) enum Verdict {
    /// It stays whole.
    Held(Outcome),
    /// Its pieces, and their shapes and masses.
    Broke(Arc<Fracture>, Parts),
}

impl BreakableWorld {
    /// One answer per question, in their order. A body that is not breakable holds.
    pub(crate) fn judge(
        &self,
        questions: &[(RigidBodyHandle, Impact)],
    ) -> Vec<Result<Verdict, WorldError>> {
        let answer = |question: &(RigidBodyHandle, Impact)| self.judge_one(question);
        if questions.len() < 2 {
            return questions.iter().map(answer).collect();
        }
        questions.par_iter().map(answer).collect()
    }

    fn judge_one(
        &self,
        (handle, impact): &(RigidBodyHandle, Impact),
    ) -> Result<Verdict, WorldError> {
        let Some(body) = self.breakables.get(&key(*handle)) else {
            let (index, generation) = handle.into_raw_parts();
            return Err(WorldError::NoBody { index, generation });
        };
        let judge = &self.break_function;
        self.verdict(judge(body, &impact.contacts, &self.config.fracture)?)
    }

    /// An outcome, with shapes for its pieces.
    pub(crate) fn verdict(&self, outcome: Outcome) -> Result<Verdict, WorldError> {
        match outcome {
            Outcome::Broke(fracture) if fracture.fragments.len() > 1 => {
                let parts = Parts::new(&fracture, &self.config)?;
                Ok(Verdict::Broke(Arc::new(*fracture), parts))
            }
            outcome => Ok(Verdict::Held(outcome)),
        }
    }
}
