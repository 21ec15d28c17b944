//! Fragments that break again: their modes are found on other threads, and added at a fixed time of the simulation.
//!
//! A newborn fragment is a plain body: the blow that runs through it is the one that has just made it. It is breakable from [`BreakAgain::delay`] on.
//! The step waits for models that are not ready then, so that nothing depends on the speed of the machine. The number made at one time is limited, so
//! that this need not happen.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use bevy::prelude::*;
use frangible::internals::{BodyState, PieceModel, Portion};
use frangible::{Body, Fracture, FractureConfig, InputError};

use crate::work::{Promise, Workers};
use crate::{BreakFailed, BreakableBody, Broken};

/// Resource with the settings of fragments that can break again. Such a fragment has a [`BreakableBody`].
#[derive(Resource, Clone)]
pub struct BreakAgain {
    /// Model that computes the modes of pieces: `frangible_bake::pieces::Pieces` or a custom one. Default none: fragments are plain bodies.
    pub model: Option<Arc<dyn PieceModel>>,
    /// A fragment breaks again if it comes from fewer breaks than this, itself included. Default 3.
    pub generations: u32,
    /// Smallest mass of a fragment that can break again, kg. Default 2e-3, a shard of glass 20 mm wide.
    pub least_mass: f64,
    /// Smallest number of uncut tetrahedra of a fragment that can break again. Default 60.
    pub least_tets: usize,
    /// Age at which a fragment becomes breakable. Default 0.4 s. A step waits for modes that are not ready by then.
    pub delay: Duration,
    /// Age at which a fragment that is held becomes breakable, if that is sooner. Default zero, from the next step on: what flies through a pane meets
    /// the rest of it there. The step waits for its modes.
    pub held_delay: Duration,
    /// Largest number of bodies whose modes are computed at the same time. The largest fragments of a break come first; those that exceed the
    /// limit stay plain bodies. Default 4: the modes of a piece take some tens of milliseconds on one core.
    pub at_once: usize,
    /// Also computes new modes for bodies that are cracked but not broken. Default on.
    pub cracked: bool,
}

impl Default for BreakAgain {
    fn default() -> Self {
        Self {
            model: None,
            generations: 3,
            least_mass: 2e-3,
            least_tets: 60,
            delay: Duration::from_millis(400),
            held_delay: Duration::ZERO,
            at_once: 4,
            cracked: true,
        }
    }
}

/// Steps that a fragment is plain at least: it and its siblings part first.
const SOONEST: u32 = 3;

/// A body that is being made.
struct Expected {
    entity: Entity,
    due: Duration,
    /// The cracks of a body that is there already: it is replaced only if it still has them.
    cracks: Option<BodyState>,
    body: Promise<Option<Result<Body, InputError>>>,
}

/// Bodies that are being made, in the order in which they are due.
#[derive(Resource)]
pub(crate) struct Nursery {
    expected: VecDeque<Expected>,
    workers: Workers,
}

impl Default for Nursery {
    fn default() -> Self {
        Self {
            expected: VecDeque::new(),
            workers: Workers::new("modes of pieces", |cores| cores.div_ceil(4)),
        }
    }
}

impl Nursery {
    /// Number of further models that may be made now.
    fn free(&self, limits: &BreakAgain) -> usize {
        limits.at_once.saturating_sub(self.expected.len())
    }

    /// Has a body made on another thread.
    fn promise(
        &mut self,
        entity: Entity,
        due: Duration,
        cracks: Option<BodyState>,
        make: impl FnOnce() -> Option<Result<Body, InputError>> + Send + 'static,
    ) {
        let body = self.workers.begin(make);
        let after = self.expected.partition_point(|e| e.due <= due);
        let expected = Expected {
            entity,
            due,
            cracks,
            body,
        };
        self.expected.insert(after, expected);
    }
}

/// Time at which a model requested now is due.
fn due(time: &Time<Fixed>, delay: Duration) -> Duration {
    time.elapsed() + delay.max(SOONEST * time.timestep())
}

/// Has the fragments of a body that broke made breakable.
pub(crate) fn expect_pieces(
    world: &mut World,
    body: &Body,
    fracture: &Fracture,
    fragments: &[Entity],
) {
    let limits = world.resource::<BreakAgain>().clone();
    let Some(model) = limits.model.clone() else {
        return;
    };
    if body.generation() >= limits.generations {
        return;
    }
    let time = world.resource::<Time<Fixed>>();
    let loose = due(time, limits.delay);
    let held = loose.min(time.elapsed() + limits.held_delay);
    let mut nursery = world.resource_mut::<Nursery>();
    let free = nursery.free(&limits);
    let portions = fracture.portions(body, |k, f| k < free && f.mass.mass >= limits.least_mass);
    let fragments = fragments.iter().zip(&fracture.fragments);
    for ((&entity, fragment), portion) in fragments.zip(portions) {
        let large = |p: &Arc<Portion>| p.tets().len() >= limits.least_tets;
        let Some(portion) = portion.filter(large) else {
            continue;
        };
        let due = if fragment.supported { held } else { loose };
        let (parent, model) = (body.clone(), Arc::clone(&model));
        nursery.promise(entity, due, None, move || made(&parent, &portion, &*model));
    }
}

/// Has new modes found for a body that is cracked but whole.
pub(crate) fn expect_weaker(world: &mut World, entity: Entity, body: Body, config: FractureConfig) {
    let limits = world.resource::<BreakAgain>().clone();
    let Some(model) = limits.model.clone().filter(|_| limits.cracked) else {
        return;
    };
    let due = due(world.resource::<Time<Fixed>>(), limits.delay);
    let cracks = Some(body.state().clone());
    let mut nursery = world.resource_mut::<Nursery>();
    if nursery.free(&limits) == 0 {
        return;
    }
    nursery.promise(entity, due, cracks, move || {
        match Portion::of_cracked(&body, &config) {
            Ok(portion) => made(&body, &Arc::new(portion), &*model),
            Err(error) => Some(Err(error)),
        }
    });
}

/// Makes a body of its own, with the data that its first steady load would have to compute.
fn made(
    parent: &Body,
    portion: &Arc<Portion>,
    model: &dyn PieceModel,
) -> Option<Result<Body, InputError>> {
    let elastic = model.later(portion);
    let elastic = elastic.or_else(|| model.at_once(portion, parent))?;
    let body = parent.piece(portion, elastic);
    if let Ok(body) = &body {
        body.prepare_for_loads();
    }
    Some(body)
}

/// Lets those join that are due. Waits for those that are not ready.
pub(crate) fn join(
    mut nursery: ResMut<Nursery>,
    time: Res<Time<Fixed>>,
    bodies: Query<Option<&BreakableBody>, Without<Broken>>,
    mut commands: Commands,
) {
    let now = time.elapsed();
    while let Some(expected) = nursery.expected.pop_front_if(|e| e.due <= now) {
        let entity = expected.entity;
        // Nobody waits for a body that is gone, or broken.
        let Ok(known) = bodies.get(entity) else {
            continue;
        };
        let mut body = match expected.body.kept() {
            None => continue,
            Some(Ok(body)) => body,
            Some(Err(error)) => {
                let reason = format!("a piece cannot break again: {error}");
                commands.trigger(BreakFailed { entity, reason });
                continue;
            }
        };
        let joins = match (&expected.cracks, known) {
            // Cracked further meanwhile: then another one is on its way.
            (Some(cracks), known) => known.is_some_and(|known| known.0.state() == cracks),
            (None, None) => true,
            (None, Some(known)) => body.set_state(known.0.state().clone()).is_ok(),
        };
        if joins {
            commands.entity(entity).try_insert(BreakableBody(body));
        }
    }
}
