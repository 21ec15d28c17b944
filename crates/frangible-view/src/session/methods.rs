//! Comparison of the last impact with other methods.

use std::sync::Arc;
use std::time::Duration;

use frangible::glam::Vec3;
use frangible_compare::{Broken, CompareError, Hit, Method, Options, compare};

use super::Session;
use crate::blow::Blow;
use crate::command::Subject;
use crate::error::ViewError;
use crate::jobs::{Job, Teller};
use crate::methods::{FIRST, Methods, Outcome, PANES};

/// Methods that are being computed, of a blow.
pub(super) struct MethodsJob {
    blow: Arc<Blow>,
    chosen: Vec<Method>,
    pub(super) job: Job<Result<Vec<Broken>, CompareError>>,
}

impl Session {
    /// Has the last impact broken by these methods, those that are known already left out; an empty list are those that are
    /// shown, or the first four.
    pub(super) fn compare_methods(&mut self, mut chosen: Vec<Method>) -> Result<(), ViewError> {
        let blow = Arc::clone(self.last_blow()?);
        if !blow.is_repeatable() || blow.number.is_none() {
            return Err(ViewError::NotNow(format!(
                "`{}` was already broken when it was hit; methods are compared on whole bodies only",
                blow.name
            )));
        }
        if chosen.is_empty() {
            chosen = match &self.methods {
                Some(methods) => methods.chosen.clone(),
                None => FIRST.to_vec(),
            };
        }
        if chosen.len() > PANES {
            return Err(ViewError::NotNow(format!(
                "{} methods do not fit on the screen; choose up to {PANES}",
                chosen.len()
            )));
        }
        let known = self
            .methods
            .as_ref()
            .filter(|m| Arc::ptr_eq(&m.blow, &blow));
        let known = known.map_or(Vec::new(), |methods| methods.outcomes.clone());
        let is_known = |method: &Method| {
            known
                .iter()
                .any(|outcome| outcome.numbers.method == *method)
        };
        let missing: Vec<Method> = chosen.iter().copied().filter(|m| !is_known(m)).collect();
        if missing.is_empty() {
            self.methods_job = None;
            self.show_methods(blow, chosen, known);
            return Ok(());
        }
        let ours = known
            .iter()
            .find(|outcome| outcome.numbers.method == Method::Ours);
        let cells = ours.map(|outcome| outcome.numbers.pieces.max(2));
        let hit = Arc::clone(&blow);
        self.methods_job = Some(MethodsJob {
            blow,
            chosen,
            job: Job::start(move |teller| by_methods(&hit, &missing, cells, teller)),
        });
        Ok(())
    }

    pub(super) fn poll_methods(&mut self, wait: Option<Duration>) -> bool {
        let Some(MethodsJob { job, .. }) = &self.methods_job else {
            return false;
        };
        let Some(result) = job.result(wait) else {
            return false;
        };
        let Some(MethodsJob { blow, chosen, .. }) = self.methods_job.take() else {
            return true;
        };
        match (result, self.live.as_ref()) {
            (Ok(all), Some(live)) => {
                let known = self
                    .methods
                    .as_ref()
                    .filter(|m| Arc::ptr_eq(&m.blow, &blow));
                let mut outcomes = known.map_or(Vec::new(), |m| m.outcomes.clone());
                let new = all
                    .into_iter()
                    .map(|broken| Outcome::new(broken, &blow, live));
                outcomes.extend(new.map(Arc::new));
                self.show_methods(blow, chosen, outcomes);
            }
            (Err(error), _) => self.complain(&error),
            (Ok(_), None) => {}
        }
        true
    }

    fn show_methods(&mut self, blow: Arc<Blow>, chosen: Vec<Method>, outcomes: Vec<Arc<Outcome>>) {
        let panes = |methods: &Methods| methods.chosen.len();
        let before = self.methods.as_deref().map_or(0, panes);
        let moved = before != chosen.len();
        let look_from = self.scene.as_ref().map_or(Vec3::Z, |scene| scene.look_from);
        self.methods = Some(Arc::new(Methods {
            blow,
            chosen,
            outcomes,
            look_from,
        }));
        if moved && self.subject == Subject::Methods {
            self.turn_to(Subject::Methods);
        }
        self.set_subject(Subject::Methods);
        self.paused = true;
    }
}

fn by_methods(
    blow: &Blow,
    methods: &[Method],
    cells: Option<usize>,
    teller: &Teller,
) -> Result<Vec<Broken>, CompareError> {
    let hit = Hit {
        body: &blow.body,
        contacts: &blow.contacts,
        config: &blow.config,
    };
    let mut options = Options::default();
    options.seed = blow.body.seed();
    options.cells = cells;
    let mut done = 0;
    compare(hit, methods, &options, &mut |method| {
        let share = f64::from(done) / methods.len() as f64;
        teller.tell(format!("computing {}", method.title()), share);
        done += 1;
    })
}
