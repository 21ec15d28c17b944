//! Breaks after the step and within a budget of work, for scenes of hundreds of bodies.
//!
//! Hooks only take note of a blow that no quick bound refuses; the step stands. Bodies are judged in the order of their blows, on threads of their
//! own, while steps go on, and so are their pieces' meshes and colliders made. Work is counted in tetrahedra, not in time. A step waits for work that
//! is due and not ready, so that the same bodies break in the same step on any machine.

use std::collections::VecDeque;
use std::sync::PoisonError;

use avian3d::prelude::*;
use bevy::prelude::*;
use frangible::BodyState;
use frangible::{Body, Contact, FractureConfig, Outcome, impact};

use super::colliders::{ColliderDetail, of_fragment};
use super::{Molds, Ruling, Verdict, Verdicts};
use crate::break_apart::Judged;
use crate::meshes::{authored, faces};
use crate::work::{Promise, Workers};
use crate::{BreakableBody, DebrisBudget, Fracturing};

/// Time at which a breaking body is replaced by its fragments.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Breaking {
    /// Inside the step, so that a ball continues through the pane that it breaks.
    #[default]
    InsideStep,
    /// After the step, in which the whole body takes the blow: a ball loses as much speed as if the body had held.
    AfterStep {
        /// Work started per step, in tetrahedra of the bodies' fracture meshes; at least one body. The others wait in the order of their blows; if a
        /// waiting body is hit several times, the fastest blow counts.
        budget: usize,
        /// Number of steps from then to the break. 0: in the same step.
        delay: u32,
    },
}

impl Breaking {
    /// Starts about one body per step, with three steps to compute its break.
    #[must_use]
    pub const fn for_games() -> Self {
        Self::AfterStep {
            budget: 2_000,
            delay: 3,
        }
    }
}

/// A blow that waits for its turn.
struct Waiting {
    body: Entity,
    striker: Option<Entity>,
    contacts: Vec<Contact>,
}

impl Waiting {
    fn speed(&self) -> f32 {
        let speeds = self.contacts.iter().map(|c| c.approach_speed);
        speeds.fold(0.0, f32::max)
    }
}

/// A blow that is being judged.
struct Case {
    blow: Waiting,
    /// The cracks of the body that is judged: with others it is another body.
    cracks: BodyState,
    due: u64,
    judged: Promise<(Judged, Vec<Option<Collider>>)>,
}

/// Blows that wait and blows that are being judged, first come, first served.
#[derive(Resource)]
pub(super) struct Docket {
    line: VecDeque<Waiting>,
    cases: VecDeque<Case>,
    steps: u64,
    workers: Workers,
}

impl Default for Docket {
    fn default() -> Self {
        Self {
            line: VecDeque::new(),
            cases: VecDeque::new(),
            steps: 0,
            workers: Workers::new("breaks", |cores| cores.saturating_sub(1)),
        }
    }
}

impl Docket {
    /// A new blow goes to the end of the line; a faster one on a body that waits takes the place of the old one.
    fn queue(&mut self, blow: Waiting) {
        match self.line.iter_mut().find(|w| w.body == blow.body) {
            Some(known) if blow.speed() > known.speed() => *known = blow,
            Some(_) => {}
            None => self.line.push_back(blow),
        }
    }

    /// Begins with those first in line.
    fn begin(
        &mut self,
        budget: usize,
        due: u64,
        bodies: &Query<&BreakableBody>,
        (config, detail, debris): (&FractureConfig, ColliderDetail, &DebrisBudget),
    ) {
        let (mut work, mut later) = (0_usize, VecDeque::new());
        for blow in std::mem::take(&mut self.line) {
            let Ok(body) = bodies.get(blow.body) else {
                continue;
            };
            let cost = body.0.asset().embedding().tets.len().max(1);
            if self.cases.iter().any(|case| case.blow.body == blow.body) {
                later.push_back(blow);
            } else if work == 0 || work.saturating_add(cost) <= budget {
                work = work.saturating_add(cost);
                let (body, contacts) = (body.0.clone(), blow.contacts.clone());
                let (config, debris) = (config.clone(), debris.clone());
                let cracks = body.state().clone();
                let judged = self
                    .workers
                    .begin(move || judge(&body, &contacts, &config, &detail, &debris));
                self.cases.push_back(Case {
                    blow,
                    cracks,
                    due,
                    judged,
                });
            } else {
                // Whoever comes after one that must wait waits too.
                work = usize::MAX;
                later.push_back(blow);
            }
        }
        self.line = later;
    }
}

/// Computes the effect of a blow, with the colliders and faces of the pieces.
fn judge(
    body: &Body,
    contacts: &[Contact],
    config: &FractureConfig,
    detail: &ColliderDetail,
    debris: &DebrisBudget,
) -> (Judged, Vec<Option<Collider>>) {
    let outcome = impact(body, contacts, config);
    let Ok(Outcome::Broke(fracture)) = &outcome else {
        return (outcome.into(), Vec::new());
    };
    let fragments = fracture.fragments.iter();
    let colliders = fragments
        .clone()
        .map(|f| (!debris.is_dust(f)).then(|| of_fragment(f, detail)))
        .collect();
    let surface = authored(body.asset());
    let faces = fragments.map(|f| faces(f, surface)).collect();
    let judged = Judged {
        outcome,
        faces: Some(faces),
    };
    (judged, colliders)
}

/// Takes up the blows of the step, and rules on those that are due.
pub(super) fn serve(
    mut docket: ResMut<Docket>,
    (verdicts, mut molds): (Res<Verdicts>, ResMut<Molds>),
    bodies: Query<&BreakableBody>,
    (breaking, config): (Res<Breaking>, Res<Fracturing>),
    (detail, debris): (Res<ColliderDetail>, Res<DebrisBudget>),
) {
    docket.steps += 1;
    let mut list = verdicts.0.lock().unwrap_or_else(PoisonError::into_inner);
    let noted = |v: &mut Verdict| matches!(v.ruling, Ruling::Waits);
    let mut blows: Vec<Verdict> = list.extract_if(.., noted).collect();
    // Pairs come in any order.
    blows.sort_by_key(|v| (v.body, v.striker));
    for Verdict {
        body,
        striker,
        contacts,
        ..
    } in blows
    {
        docket.queue(Waiting {
            body,
            striker,
            contacts,
        });
    }
    if let Breaking::AfterStep { budget, delay } = *breaking {
        let due = docket.steps + u64::from(delay);
        docket.begin(budget, due, &bodies, (&config.0, *detail, &debris));
    } else {
        docket.line.clear();
    }
    let now = docket.steps;
    while let Some(case) = docket.cases.pop_front_if(|case| case.due <= now) {
        let body = case.blow.body;
        // Nobody waits for a body that is gone, or has other cracks by now.
        if bodies.get(body).is_ok_and(|b| *b.0.state() == case.cracks) {
            let (judged, colliders) = case.judged.kept();
            molds.0.insert(body, colliders);
            list.push(Verdict {
                body,
                striker: case.blow.striker,
                contacts: case.blow.contacts,
                touched: 0.0,
                places: [Vec3::ZERO; 2],
                left_out: false,
                ruling: Ruling::Late(judged),
            });
        }
    }
}
