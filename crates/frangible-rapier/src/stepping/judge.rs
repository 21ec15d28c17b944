//! Impacts put to the fracture, several at once.
//!
//! Each body is a question of its own, so they are shared out among threads; the answers come back in the order of the
//! questions, and no answer hangs on another: any number of threads gives the same bits.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};

use frangible::internals::outcome::LookedAt;
use frangible::{Body, Fracture, Outcome};
use rapier3d::dynamics::RigidBodyHandle;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::config::WorldConfig;
use crate::contact::contacts::Impact;
use crate::counts::held;
use crate::error::WorldError;
use crate::fragments::replace::Parts;
use crate::world::{BreakFn, BreakableWorld, Key, key};

/// What an impact does to a body.
#[expect(clippy::large_enum_variant, reason = "one per impact, soon gone")]
pub(crate) enum Verdict {
    /// It stays whole.
    Held(Outcome),
    /// Its pieces, and their shapes and masses.
    Broke(Arc<Fracture>, Parts),
}

impl Verdict {
    /// How closely the load was looked at; none where the body broke.
    pub(crate) fn held(&self) -> Option<LookedAt> {
        match self {
            Self::Held(outcome) => held(outcome),
            Self::Broke(..) => None,
        }
    }
}

/// What it takes to judge, apart from the world.
#[derive(Clone)]
pub(crate) struct Judge {
    pub(crate) function: Arc<BreakFn>,
    pub(crate) config: Arc<WorldConfig>,
}

impl Judge {
    fn judge(&self, body: &Body, impact: &Impact) -> Result<Verdict, WorldError> {
        let outcome = (self.function)(body, &impact.contacts, &self.config.fracture)?;
        verdict(outcome, &self.config)
    }
}

/// An outcome, with shapes for its pieces.
pub(crate) fn verdict(outcome: Outcome, config: &WorldConfig) -> Result<Verdict, WorldError> {
    match outcome {
        Outcome::Broke(fracture) if fracture.fragments.len() > 1 => {
            let parts = Parts::new(&fracture, config)?;
            Ok(Verdict::Broke(Arc::new(*fracture), parts))
        }
        outcome => Ok(Verdict::Held(outcome)),
    }
}

/// A blow that is being judged elsewhere.
pub(crate) struct Case {
    pub(crate) body: RigidBodyHandle,
    pub(crate) impact: Impact,
    /// When the world asks for the verdict: number of the step.
    pub(crate) due: u64,
    work: Arc<Work>,
    verdict: Mutex<Receiver<Result<Verdict, WorldError>>>,
}

/// What has to be done for a verdict, once, by whoever comes first.
struct Work {
    judge: Judge,
    body: Body,
    impact: Impact,
    taken: AtomicBool,
    /// Nobody hears it when the world is gone.
    sender: Sender<Result<Verdict, WorldError>>,
}

impl Work {
    fn do_unless_taken(&self) {
        if !self.taken.swap(true, Ordering::Relaxed) {
            let _ = self.sender.send(self.judge.judge(&self.body, &self.impact));
        }
    }
}

impl Case {
    /// Does the work on this thread, if no other has begun with it.
    pub(crate) fn help(&self) {
        self.work.do_unless_taken();
    }

    /// Waits for the verdict.
    pub(crate) fn verdict(&self) -> Result<Verdict, WorldError> {
        let verdict = self.verdict.lock().unwrap_or_else(PoisonError::into_inner);
        verdict.recv().unwrap_or(Err(WorldError::JudgeFailed))
    }
}

impl BreakableWorld {
    /// One answer per question, in their order. A body that is not breakable is an error.
    pub(crate) fn judge(
        &self,
        questions: &[(RigidBodyHandle, Impact)],
    ) -> Vec<Result<Verdict, WorldError>> {
        if questions.is_empty() {
            return Vec::new();
        }
        let (judge, breakables) = (self.judge_of_now(), &self.state.breakables);
        let answer = |(handle, impact): &(RigidBodyHandle, Impact)| {
            judge.judge(breakable(breakables, *handle)?, impact)
        };
        if questions.len() < 2 || rayon::current_num_threads() < 2 {
            return questions.iter().map(answer).collect();
        }
        questions.par_iter().map(answer).collect()
    }

    /// Has a blow judged while the world goes on, until the step `due`.
    pub(crate) fn judge_elsewhere(
        &mut self,
        body: RigidBodyHandle,
        impact: Impact,
        due: u64,
    ) -> Result<Case, WorldError> {
        let (sender, verdict) = channel();
        let work = Arc::new(Work {
            judge: self.judge_of_now(),
            body: breakable(&self.state.breakables, body)?.clone(),
            impact: impact.clone(),
            taken: AtomicBool::new(false),
            sender,
        });
        let elsewhere = Arc::clone(&work);
        self.workshop.take(due, move || elsewhere.do_unless_taken());
        Ok(Case {
            body,
            impact,
            due,
            work,
            verdict: Mutex::new(verdict),
        })
    }

    fn judge_of_now(&self) -> Judge {
        Judge {
            function: Arc::clone(&self.break_function),
            config: Arc::new(self.config.clone()),
        }
    }
}

pub(crate) fn breakable(
    breakables: &BTreeMap<Key, Body>,
    handle: RigidBodyHandle,
) -> Result<&Body, WorldError> {
    let (index, generation) = handle.into_raw_parts();
    let body = breakables.get(&key(handle));
    body.ok_or(WorldError::NoBody { index, generation })
}
