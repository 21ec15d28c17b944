//! Fragments that break again: their modes are found on other threads, and joined at a fixed step.
//!
//! A newborn fragment is a plain body: the blow that runs through it is the one that has just made it. From
//! [`PieceConfig::delay`] on it is breakable with the modes that the model has at once, from [`PieceConfig::later`] on with those that take
//! longer; with a [`PieceConfig::pace`], when a thread of that pace is expected to have come to it. Unfinished modes are then waited
//! for, so that no result depends on the speed of the machine.

use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use frangible::internals::BodyState;
use frangible::internals::piece::{Elastic, PieceModel, Portion};
use frangible::{Body, Fragment};
use rapier3d::dynamics::RigidBodyHandle;

use crate::config::PieceConfig;
use crate::impulses::settle::Broken;
use crate::workshop::Length;
use crate::world::{BreakableWorld, key};

/// A body that is being made.
#[derive(Clone)]
pub(crate) struct Expected {
    handle: RigidBodyHandle,
    /// Step at whose beginning it joins the world.
    due: u64,
    /// The cracks of a body that is there already: it is replaced only if it still has them.
    cracks: Option<BodyState>,
    body: Arc<Mutex<Made>>,
}

/// One of a model's two methods.
#[derive(Clone, Copy)]
enum Kind {
    AtOnce,
    Later,
}

/// Result of making a body: asked for once, and known to all that share it from then on.
enum Made {
    Soon(Receiver<Option<Body>>),
    Known(Option<Box<Body>>),
}

impl Expected {
    /// Waits for the body.
    fn body(&self) -> Option<Body> {
        let mut made = self.body.lock().unwrap_or_else(PoisonError::into_inner);
        if let Made::Soon(receiver) = &*made {
            let body = receiver.recv().ok().flatten();
            *made = Made::Known(body.map(Box::new));
        }
        match &*made {
            Made::Known(body) => body.as_deref().cloned(),
            Made::Soon(_) => None,
        }
    }
}

impl BreakableWorld {
    /// This world with a model that computes the modes of fragments, so that they can break again according to
    /// [`WorldConfig::pieces`](crate::WorldConfig::pieces). Without one they cannot.
    #[must_use]
    pub fn with_piece_model(self, model: impl PieceModel + 'static) -> Self {
        Self {
            piece_model: Some(Arc::new(model)),
            ..self
        }
    }

    /// Asks for breakable bodies in the place of the fragments of a body that broke.
    pub(crate) fn expect_pieces(&mut self, body: &Body, broken: &Broken) {
        let Some(model) = self.piece_model.clone() else {
            return;
        };
        let limits = self.config.pieces.clone();
        if body.generation() >= limits.generations {
            return;
        }
        let least = f64::from(limits.least_mass);
        let heavy = move |_: usize, fragment: &Fragment| fragment.mass.mass >= least;
        // Finding each fragment's part of the body takes a while: it is done once, by the first that needs it.
        let portions = Arc::new(OnceLock::new());
        let portion = |number: usize| {
            let (portions, fracture) = (Arc::clone(&portions), Arc::clone(&broken.fracture));
            let parent = body.clone();
            move || {
                let portions = portions.get_or_init(|| fracture.portions(&parent, heavy));
                let found: Option<&Option<Arc<Portion>>> = portions.get(number);
                let large = |p: &&Arc<Portion>| p.tets().len() >= limits.least_tets;
                found?.as_ref().filter(large).cloned()
            }
        };
        let whole = body.asset().mass().mass;
        // Fragments are ordered by their mass.
        let fragments = broken.fracture.fragments.iter().enumerate();
        for (&handle, (number, fragment)) in broken.fragments.iter().zip(fragments) {
            if !heavy(number, fragment) {
                continue;
            }
            let tets = (tets_of(body) as f64 * fragment.mass.mass / whole) as usize;
            let (at_once, parent, find) = (Arc::clone(&model), body.clone(), portion(number));
            let due = self.due(Kind::AtOnce, tets);
            self.promise(Length::Short, handle, due, None, move || {
                let portion = find()?;
                made(&parent, &portion, at_once.at_once(&portion, &parent))
            });
            let (later, parent, find) = (Arc::clone(&model), body.clone(), portion(number));
            let due = due.max(self.due(Kind::Later, tets));
            self.promise(Length::Long, handle, due, None, move || {
                let portion = find()?;
                made(&parent, &portion, later.later(&portion))
            });
        }
    }

    /// Asks for new modes of a body that is cracked but whole.
    pub(crate) fn expect_weaker(&mut self, handle: RigidBodyHandle) {
        let (Some(model), Some(body)) = (
            self.piece_model
                .clone()
                .filter(|_| self.config.pieces.cracked),
            self.state.breakables.get(&key(handle)).cloned(),
        ) else {
            return;
        };
        let (cracks, config) = (body.state().clone(), self.config.fracture.clone());
        let due = self.due(Kind::Later, tets_of(&body));
        self.promise(Length::Long, handle, due, Some(cracks), move || {
            let portion = Arc::new(Portion::of_cracked(&body, &config).ok()?);
            let elastic = model.later(&portion);
            let elastic = elastic.or_else(|| model.at_once(&portion, &body));
            made(&body, &portion, elastic)
        });
    }

    /// The step in which a body of this number of tetrahedra that is asked for now is due.
    fn due(&mut self, kind: Kind, tets: usize) -> u64 {
        let limits = &self.config.pieces;
        let (delay, at) = match kind {
            Kind::AtOnce => (limits.delay, 0),
            Kind::Later => (limits.later, 1),
        };
        let times = (self.piece_model.as_ref()).map_or([0.0; 2], |m| m.expected_times(tets));
        let dt = self.physics.integration_parameters.dt;
        let now = self.state.steps;
        let ready = &mut self.state.pieces_ready[at];
        *ready = ready.max(now as f64) + times[at] / f64::from(limits.pace * dt);
        let soonest = now + ((delay / dt).ceil() as u64).max(PieceConfig::SOONEST);
        soonest.max(ready.ceil() as u64)
    }

    /// Makes a body on another thread; it joins the world in the step `due`.
    fn promise(
        &mut self,
        length: Length,
        handle: RigidBodyHandle,
        due: u64,
        cracks: Option<BodyState>,
        make: impl FnOnce() -> Option<Body> + Send + 'static,
    ) {
        let (sender, body) = channel();
        self.workshop.take(length, due, move || {
            // Sending fails only when the world is gone.
            let _ = sender.send(make());
        });
        let body = Arc::new(Mutex::new(Made::Soon(body)));
        let after = self.state.expected.partition_point(|e| e.due <= due);
        let expected = Expected {
            handle,
            due,
            cracks,
            body,
        };
        self.state.expected.insert(after, expected);
    }

    /// Lets the bodies that are due join the world. Waits for those that are not ready.
    pub(crate) fn join_pieces(&mut self) {
        while let Some(expected) = self
            .state
            .expected
            .pop_front_if(|e| e.due <= self.state.steps)
        {
            let handle = expected.handle;
            if !self.physics.bodies.contains(handle) {
                continue;
            }
            let Some(mut body) = expected.body() else {
                continue;
            };
            let now = self.state.breakables.get(&key(handle));
            let joins = match (&expected.cracks, now) {
                // Gone, or cracked further meanwhile: then another one is on its way.
                (Some(cracks), now) => now.is_some_and(|now| now.state() == cracks),
                (None, None) => true,
                (None, Some(now)) => body.set_state(now.state().clone()).is_ok(),
            };
            if joins {
                self.state.breakables.insert(key(handle), body);
                self.weigh_anew();
            }
        }
    }
}

/// Tetrahedra of a body in which cracks can run.
fn tets_of(body: &Body) -> usize {
    let asset = body.asset();
    let portion = asset.portion();
    portion.map_or(asset.fracture().tets.len(), |portion| portion.tets().len())
}

/// A body of its own, with what its first steady load would have to find out.
fn made(parent: &Body, portion: &Arc<Portion>, elastic: Option<Elastic>) -> Option<Body> {
    let body = parent.piece(portion, elastic?);
    let body = body
        .inspect_err(|e| log::warn!("a piece cannot break again: {e}"))
        .ok()?;
    body.prepare_for_loads();
    Some(body)
}
