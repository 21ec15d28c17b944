//! Evaluation of impacts and loads by the fracture model, in parallel.
//!
//! Bodies are independent, so they are distributed among threads; results are returned in the order of the input and are
//! bit-identical for any number of threads.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};

use frangible::Body;
use rapier3d::dynamics::RigidBodyHandle;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::calm::motions::Before;
use crate::config::WorldConfig;
use crate::contact::contacts::{Impact, Surfaces, impact_on};
use crate::error::WorldError;
use crate::event::BreakCause;
use crate::stepping::answer::{Answer, Verdict};
use crate::workshop::Length;
use crate::world::{BreakFn, BreakableWorld, Key, key};

/// Data needed to judge, apart from the world.
struct Judge {
    function: Arc<BreakFn>,
    config: WorldConfig,
}

impl Judge {
    fn judge(&self, body: &Body, impact: &Impact) -> Result<Verdict, WorldError> {
        let outcome = (self.function)(body, &impact.contacts, &self.config.fracture)?;
        Verdict::new(outcome, &self.config)
    }
}

/// A blow that is being judged elsewhere.
pub(crate) struct Case {
    pub(super) body: RigidBodyHandle,
    impact: Impact,
    /// Number of the step in which the world asks for the verdict.
    pub(super) due: u64,
    /// Its work, tetrahedra.
    pub(super) cost: usize,
    work: Arc<Work>,
    verdict: Mutex<Receiver<Result<Verdict, WorldError>>>,
}

/// Work for a verdict, done once, by the first thread that comes to it.
struct Work {
    judge: Judge,
    body: Body,
    impact: Impact,
    taken: AtomicBool,
    /// Fails only when the world is gone.
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
    pub(super) fn help(&self) {
        self.work.do_unless_taken();
    }

    /// Returns true if the body is no longer cracked as it was when the blow was put to the fracture: its verdict would take back what came since.
    pub(super) fn is_outdated(&self, now: &Body) -> bool {
        self.work.body.state() != now.state()
    }

    /// The question that was asked.
    pub(super) fn question(self) -> (RigidBodyHandle, Impact) {
        (self.body, self.impact)
    }

    /// Waits for the verdict.
    pub(super) fn answer(self) -> Answer {
        // The work holds a sender: with it here, a judge that failed would be waited for without end.
        drop(self.work);
        let verdict = self.verdict.into_inner();
        let verdict = verdict.unwrap_or_else(PoisonError::into_inner);
        Answer {
            body: self.body,
            cause: BreakCause::Impact,
            impact: self.impact,
            verdict: verdict.recv().unwrap_or(Err(WorldError::JudgeFailed)),
        }
    }
}

impl BreakableWorld {
    /// The impact on a body in the step just taken; `before` holds the bodies as they were before it.
    pub(super) fn impact_on(&self, handle: RigidBodyHandle, before: &impl Before) -> Impact {
        let surfaces = Surfaces {
            bodies: &self.state.surfaces,
            breakables: &self.state.breakables,
        };
        impact_on(handle, &self.physics, before, &surfaces, &self.config)
    }

    /// Judges impacts on bodies: one answer per question, in their order. A body that is not breakable is an error.
    pub(super) fn judge(&self, questions: Vec<(RigidBodyHandle, Impact)>) -> Vec<Answer> {
        if questions.is_empty() {
            return Vec::new();
        }
        let (judge, breakables) = (self.judge_of_now(), &self.state.breakables);
        let answer = |(body, impact): (RigidBodyHandle, Impact)| Answer {
            body,
            cause: BreakCause::Impact,
            verdict: breakable(breakables, body).and_then(|b| judge.judge(b, &impact)),
            impact,
        };
        if questions.len() < 2 || rayon::current_num_threads() < 2 {
            return questions.into_iter().map(answer).collect();
        }
        questions.into_par_iter().map(answer).collect()
    }

    /// Judges an overloaded body's load of the step just taken; none where the body is not overloaded.
    pub(super) fn judge_load(
        &self,
        handle: RigidBodyHandle,
        before: &impl Before,
    ) -> Option<Answer> {
        let body = self.state.breakables.get(&key(handle))?;
        let (impact, verdict) = match self.breaking_load(handle, body, before)? {
            Ok((load, outcome)) => (load, Verdict::new(outcome, &self.config)),
            Err(error) => (Impact::default(), Err(error)),
        };
        Some(Answer {
            body: handle,
            cause: BreakCause::Rest,
            impact,
            verdict,
        })
    }

    /// Puts a blow to the fracture on another thread while the world goes on, until the step `due`.
    pub(super) fn judge_elsewhere(
        &mut self,
        body: RigidBodyHandle,
        impact: Impact,
        cost: usize,
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
        (self.workshop).take(Length::Short, due, move || elsewhere.do_unless_taken());
        Ok(Case {
            body,
            impact,
            due,
            cost,
            work,
            verdict: Mutex::new(verdict),
        })
    }

    fn judge_of_now(&self) -> Judge {
        Judge {
            function: Arc::clone(&self.break_function),
            config: self.config.clone(),
        }
    }
}

/// The body behind a handle, which must be breakable.
pub(super) fn breakable(
    breakables: &BTreeMap<Key, Body>,
    handle: RigidBodyHandle,
) -> Result<&Body, WorldError> {
    let (index, generation) = handle.into_raw_parts();
    let body = breakables.get(&key(handle));
    body.ok_or(WorldError::NoBody { index, generation })
}
