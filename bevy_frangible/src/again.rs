//! Fragments that break again: how they vibrate is found on Bevy's task pool, and joined at a fixed time of the simulation.
//!
//! A newborn fragment is a plain body: the blow that runs through it is the one that has just made it. From [`BreakAgain::delay`] on it is
//! breakable with what the model has at once, from [`BreakAgain::later`] on with what takes longer. What is not ready then is waited for,
//! so that nothing hangs on the speed of the machine.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use bevy::prelude::*;
use bevy::tasks::{AsyncComputeTaskPool, Task, TaskPool, block_on};
use frangible::internals::{BodyState, Elastic, PieceModel, Portion};
use frangible::{Body, Fracture, FractureConfig, InputError};

use crate::{BreakFailed, BreakableBody, Broken};

/// Which fragments break again, and from when. A [`BreakableBody`] on a fragment tells that it can.
#[derive(Resource, Clone)]
pub struct BreakAgain {
    /// Finds how pieces vibrate: `frangible_bake::pieces::Pieces`, or a model of the game's own. Default none: fragments are plain bodies.
    pub model: Option<Arc<dyn PieceModel>>,
    /// A fragment breaks again if it comes from fewer breaks than this, itself included. Default 3.
    pub generations: u32,
    /// Lighter fragments do not break again, kg. Default 2e-3, a shard of glass 20 mm wide.
    pub least_mass: f64,
    /// Fragments of fewer uncut tetrahedra do not. Default 60.
    pub least_tets: usize,
    /// From so long after its birth a fragment can break. Default 20 ms: the blow that made it is over by then.
    pub delay: Duration,
    /// From so long after its birth it has the modes that take longer to find. Default 150 ms. What is not ready by then is waited for:
    /// raise it where that costs a frame.
    pub later: Duration,
    /// Find new modes for bodies that are cracked but whole, too. Default on.
    pub cracked: bool,
}

impl Default for BreakAgain {
    fn default() -> Self {
        Self {
            model: None,
            generations: 3,
            least_mass: 2e-3,
            least_tets: 60,
            delay: Duration::from_millis(20),
            later: Duration::from_millis(150),
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
    body: Task<Option<Result<Body, InputError>>>,
}

/// Bodies that are being made, in the order in which they are due.
#[derive(Resource, Default)]
pub(crate) struct Nursery(VecDeque<Expected>);

impl Nursery {
    /// Has a body made on another thread.
    fn promise(
        &mut self,
        entity: Entity,
        due: Duration,
        cracks: Option<BodyState>,
        make: impl FnOnce() -> Option<Result<Body, InputError>> + Send + 'static,
    ) {
        let pool = AsyncComputeTaskPool::get_or_init(TaskPool::new);
        let body = pool.spawn(async move { make() });
        let after = self.0.partition_point(|e| e.due <= due);
        let expected = Expected {
            entity,
            due,
            cracks,
            body,
        };
        self.0.insert(after, expected);
    }
}

/// When something is due that was asked for now.
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
    let Some(model) = limits.model else {
        return;
    };
    if body.generation() >= limits.generations {
        return;
    }
    let time = world.resource::<Time<Fixed>>();
    let (soon, later) = (due(time, limits.delay), due(time, limits.later));
    let portions = fracture.portions(body, |_, f| f.mass.mass >= limits.least_mass);
    let mut nursery = world.resource_mut::<Nursery>();
    for (&entity, portion) in fragments.iter().zip(portions) {
        let large = |p: &Arc<Portion>| p.tets().len() >= limits.least_tets;
        let Some(portion) = portion.filter(large) else {
            continue;
        };
        let (parent, whole, quick) = (body.clone(), Arc::clone(&portion), Arc::clone(&model));
        nursery.promise(entity, soon, None, move || {
            made(&parent, &whole, quick.at_once(&whole, &parent))
        });
        let (parent, exact) = (body.clone(), Arc::clone(&model));
        nursery.promise(entity, later, None, move || {
            made(&parent, &portion, exact.later(&portion))
        });
    }
}

/// Has new modes found for a body that is cracked but whole.
pub(crate) fn expect_weaker(world: &mut World, entity: Entity, body: Body, config: FractureConfig) {
    let limits = world.resource::<BreakAgain>();
    let Some(model) = limits.model.clone().filter(|_| limits.cracked) else {
        return;
    };
    let later = due(world.resource::<Time<Fixed>>(), limits.later);
    let cracks = Some(body.state().clone());
    let mut nursery = world.resource_mut::<Nursery>();
    nursery.promise(entity, later, cracks, move || {
        let portion = match Portion::of_cracked(&body, &config) {
            Ok(portion) => Arc::new(portion),
            Err(error) => return Some(Err(error)),
        };
        let elastic = model.later(&portion);
        let elastic = elastic.or_else(|| model.at_once(&portion, &body));
        made(&body, &portion, elastic)
    });
}

/// A body of its own, with what its first steady load would have to find out.
fn made(
    parent: &Body,
    portion: &Arc<Portion>,
    elastic: Option<Elastic>,
) -> Option<Result<Body, InputError>> {
    let body = parent.piece(portion, elastic?);
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
    while let Some(expected) = nursery.0.pop_front_if(|e| e.due <= now) {
        let entity = expected.entity;
        // What is gone, or broken, is not waited for.
        let Ok(known) = bodies.get(entity) else {
            continue;
        };
        let mut body = match block_on(expected.body) {
            None => continue,
            Some(Ok(body)) => body,
            Some(Err(error)) => {
                let reason = format!("a piece does not break again: {error}");
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
