//! Impacts and loads to be evaluated by the fracture model in a step that may still be undone.
//!
//! A step is taken up to five times, each time with new impacts. An impact that recurs unchanged is not evaluated again, since the body is
//! known to hold. Resting loads are evaluated only for bodies without a new impact that have been close to breaking for some steps
//! (`resting.rs`).

use std::collections::{BTreeMap, BTreeSet};

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};

use crate::contact::contacts::Impact;
use crate::error::WorldError;
use crate::event::{BreakCause, HeldEvent};
use crate::impulses::blows::Meeting;
use crate::impulses::settle::Broken;
use crate::stepping::answer::{Answer, Verdict};
use crate::timings::Watch;
use crate::world::{BreakableWorld, Key, key};

/// Answers of the fracture in this step.
#[derive(Default)]
pub(super) struct Asked {
    pub(super) broken: Vec<Broken>,
    pub(super) held: BTreeMap<Key, (Impact, HeldEvent)>,
    /// Blows of the step last taken that held.
    pub(super) standing: Vec<Meeting>,
    error: Option<WorldError>,
}

/// Questions to ask after a step.
#[derive(Default)]
struct Questions {
    /// Impacts to be evaluated by the fracture model.
    blows: Vec<(RigidBodyHandle, Impact)>,
    /// Results for overloaded bodies.
    loads: Vec<Answer>,
    /// Bodies that are known to withstand their impact.
    known: Vec<RigidBodyHandle>,
}

impl BreakableWorld {
    /// Puts the impacts of the step just taken to the fracture; true when a body broke.
    pub(super) fn ask(
        &mut self,
        near: &[RigidBodyHandle],
        before: &RigidBodySet,
        asked: &mut Asked,
    ) -> bool {
        let mut watch = Watch::start();
        let Questions {
            blows,
            loads,
            known,
        } = self.questions(near, before, asked);
        let mut standing = known;
        standing.extend(blows.iter().map(|(body, _)| *body));
        standing.sort_by_key(|&handle| key(handle));
        self.timings.contacts += watch.lap();
        let mut answers = self.judge(blows);
        answers.extend(loads);
        answers.sort_by_key(|answer| key(answer.body));
        self.timings.fracture += watch.lap();
        let mut news = false;
        for answer in answers {
            self.count(&answer);
            news |= self.hear(answer, before, asked);
        }
        asked.standing.clear();
        if !news {
            // A blow that came in a step that was undone, and not again, has done nothing, unless the other body broke by it.
            let stands: BTreeSet<Key> = standing.iter().map(|&handle| key(handle)).collect();
            let (held, broken) = (&mut asked.held, &asked.broken);
            held.retain(|body, (_, event)| {
                let broke = || {
                    broken
                        .iter()
                        .any(|b| b.impact.strikers.contains(&event.body))
                };
                stands.contains(body) || broke()
            });
            for handle in standing {
                if let Some((impact, event)) = asked.held.get(&key(handle)) {
                    let meetings = self.meetings(handle, before, impact, &event.report);
                    asked.standing.extend(meetings);
                }
            }
        }
        news
    }

    fn questions(
        &self,
        near: &[RigidBodyHandle],
        before: &RigidBodySet,
        asked: &Asked,
    ) -> Questions {
        let mut questions = Questions::default();
        for &handle in near {
            if self.breakable(handle).is_none() {
                continue;
            }
            let impact = self.impact_on(handle, before);
            if !impact.contacts.is_empty() {
                let held = asked.held.get(&key(handle));
                if held.is_none_or(|(held, _)| *held != impact) {
                    questions.blows.push((handle, impact));
                    continue;
                }
                questions.known.push(handle);
            }
            questions.loads.extend(self.judge_load(handle, before));
        }
        questions
    }

    /// Takes note of an answer; true when it broke the body.
    fn hear(&mut self, answer: Answer, before: &RigidBodySet, asked: &mut Asked) -> bool {
        let Answer {
            body,
            cause,
            impact,
            verdict,
        } = answer;
        let (fracture, parts) = match verdict {
            Ok(Verdict::Broke(fracture, parts)) => (fracture, parts),
            Ok(Verdict::Held(outcome)) => {
                if cause == BreakCause::Impact
                    && let Some(event) = self.held_event(body, impact.contacts.clone(), outcome)
                {
                    asked.held.insert(key(body), (impact, event));
                }
                return false;
            }
            Err(error) => {
                asked.error.get_or_insert(error);
                return false;
            }
        };
        let taken = asked.broken.iter().map(|b| b.fracture.fragments.len());
        if !self.has_room(&fracture, taken.sum(), body) {
            return false;
        }
        // On a film the pieces give way together, and the striker meets them as the engine has it.
        let blow = match fracture.film().is_empty() {
            true => self.meetings(body, before, &impact, &fracture.report),
            false => Vec::new(),
        };
        let met: Vec<RigidBodyHandle> = impact.partners.iter().copied().flatten().collect();
        let alone = self.are_alone(&[&[body][..], &met].concat());
        asked.broken.push(Broken {
            parent: body,
            alone,
            cause,
            fracture,
            parts,
            impact,
            fragments: Vec::new(),
            released: Vec::new(),
            blow,
            lost: 0.0,
        });
        asked.held.remove(&key(body));
        true
    }

    /// Bodies that held keep the cracks they got.
    ///
    /// # Errors
    /// The first error of the step.
    pub(super) fn keep_cracks(&mut self, mut asked: Asked) -> Result<(), WorldError> {
        for (_, event) in asked.held.values() {
            if let Some(state) = &event.state
                && let Err(error) = self.crack(event.body, state)
            {
                asked.error.get_or_insert(error);
            }
        }
        if asked.held.values().any(|(_, event)| event.state.is_some()) {
            self.weigh_anew();
        }
        if self.config.record_held {
            self.held
                .extend(asked.held.into_values().map(|(_, event)| event));
        }
        asked.error.map_or(Ok(()), Err)
    }
}
