//! Evaluation of queued impacts by the fracture model, immediately or in the background.
//!
//! If the result is available in the step of the impact, the impulse of the fracture model replaces that of the engine (`exchange.rs`). After a
//! delay, the engine's impulse is kept, since the bodies have moved on.

use std::collections::{BTreeMap, BTreeSet};

use super::hit::HitBodies;
use crate::error::WorldError;
use crate::impulses::blows::{Meeting, share_out};
use crate::impulses::exchange::Families;
use crate::stepping::answer::{Answer, Verdict};
use crate::stepping::judge::Case;
use crate::timings::Watch;
use crate::world::{BreakableWorld, Key, key};

impl BreakableWorld {
    /// Puts those first in line to the fracture: at once, or elsewhere until `delay` steps from now.
    pub(super) fn serve(
        &mut self,
        budget: usize,
        delay: usize,
        before: &HitBodies,
    ) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        let turn = self.next_in_line(budget, delay);
        let mut at_once = turn.cheap;
        let mut done = Ok(());
        if delay == 0 {
            at_once.extend(
                turn.dear
                    .into_iter()
                    .map(|(body, impact, _)| (body, impact)),
            );
        } else {
            let due = self.state.steps + delay as u64;
            for (body, impact, cost) in turn.dear {
                match self.judge_elsewhere(body, impact, cost, due) {
                    Ok(case) => self.cases.push_back(case),
                    Err(error) => done = done.and(Err(error)),
                }
            }
        }
        let answers = self.judge(at_once);
        self.timings.fracture += watch.lap();
        let mut blows = self.fresh_blows(&answers, &turn.fresh, before);
        let mut families = Families::new();
        for answer in answers {
            self.count(&answer);
            let body = key(answer.body);
            let blow = blows.remove(&body).unwrap_or_default();
            match self.obey(answer, &blow, &families, before) {
                Ok(fragments) => families.extend(fragments.map(|f| (body, f))),
                Err(error) => done = done.and(Err(error)),
            }
        }
        self.timings.fragments += watch.lap();
        done
    }

    /// Impulses between bodies from the blows of the step just taken: those that held give them at once, those of bodies
    /// that break are returned. A verdict that comes later finds the bodies elsewhere: there the engine's blow stands.
    fn fresh_blows(
        &mut self,
        answers: &[Answer],
        fresh: &BTreeSet<Key>,
        before: &HitBodies,
    ) -> BTreeMap<Key, Vec<Meeting>> {
        let (mut held, mut broke) = (Vec::new(), BTreeMap::new());
        for answer in answers.iter().filter(|a| fresh.contains(&key(a.body))) {
            let meetings = |report| self.meetings(answer.body, before, &answer.impact, report);
            match &answer.verdict {
                Ok(Verdict::Held(outcome)) => held.extend(meetings(outcome.report())),
                Ok(Verdict::Broke(fracture, _)) => {
                    broke.insert(key(answer.body), meetings(&fracture.report));
                }
                Err(_) => {}
            }
        }
        // If two bodies met, the one that breaks tells how long the other pushed.
        held.retain(|m: &Meeting| m.partner.is_none_or(|p| !broke.contains_key(&key(p))));
        share_out(&mut broke.values_mut().flatten().collect::<Vec<_>>());
        self.give_blows(held, before);
        broke
    }

    /// Carries out the verdicts of other threads that are due.
    pub(super) fn conclude(&mut self) -> Result<(), WorldError> {
        let mut watch = Watch::start();
        let mut done = Ok(());
        let now = self.state.steps;
        // Cases that no other thread has begun with are done here, rather than waited for.
        let due = self.cases.iter().take_while(|case| case.due <= now);
        due.for_each(Case::help);
        while let Some(case) = self.cases.pop_front_if(|case| case.due <= now) {
            let body = self.breakable(case.body);
            let answers = match body.is_some_and(|body| case.is_outdated(body)) {
                true => self.judge(vec![case.question()]),
                false => vec![case.answer()],
            };
            self.timings.fracture += watch.lap();
            for answer in answers {
                self.count(&answer);
                if self.breakable(answer.body).is_some() {
                    let obeyed = self.obey(answer, &[], &Families::new(), &HitBodies::new());
                    done = done.and(obeyed.map(|_| ()));
                }
            }
            self.timings.fragments += watch.lap();
        }
        done
    }
}
