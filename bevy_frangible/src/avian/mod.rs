//! Bodies that break inside Avian's step.
//!
//! Avian calls its collision hooks for each pair of touching colliders, before it solves the contacts. There the impact on a breakable body
//! is evaluated with the speeds before the solver. If the blow was integrated, the pair's contacts are dropped for this step, so that the striker
//! keeps its velocity; after the step the impulse of the blow acts between it and the body. If that broke, the pieces replace it, the energy of the
//! cracks is taken from the motion, and a ball flies on through the pieces. No step has to be undone, but both are moved back to the point of
//! contact. With [`Breaking::AfterStep`] the hooks only record the blow.

mod after;
mod bodies;
mod calm;
mod colliders;
mod debris;
mod floor;
mod hooks;
mod later;
mod merge;
mod plain;
mod resting;
mod touches;

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::time::Duration;

use avian3d::prelude::*;
use bevy::prelude::*;
use frangible::{Contact, Material};

pub use colliders::ColliderDetail;
pub use hooks::FrangibleHooks;
pub use later::Breaking;
pub use resting::Carries;

use crate::break_apart::Judged;

/// Resource with the smallest approach speed at which a contact is tested for fracture, m/s. Default 0.5; a higher value means fewer tests.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct ImpactSpeed(pub f32);

impl Default for ImpactSpeed {
    fn default() -> Self {
        Self(0.5)
    }
}

/// Component with the material of a striker, an entity with a collider. Without it the striker is rigid, and flat unless its collider is a ball.
#[derive(Component, Clone, Debug)]
pub struct MadeOf(pub Material);

/// Blows on bodies in the current step.
#[derive(Resource, Default)]
struct Verdicts(Mutex<Vec<Verdict>>);

struct Verdict {
    body: Entity,
    /// None for a collider without a body.
    striker: Option<Entity>,
    contacts: Vec<Contact>,
    /// Time from the start of the step until the two touch, s.
    touched: f32,
    /// Positions of the body and of the striker then, m.
    places: [Vec3; 2],
    /// The solver has left the pair out: the blow was integrated, and acts after the step.
    left_out: bool,
    ruling: Ruling,
}

/// State of a blow.
enum Ruling {
    /// Judged inside the step.
    Now(Judged),
    /// To be judged after the step.
    Waits,
    /// Judged after its step, in which the whole body took the blow.
    Late(Judged),
}

/// Colliders of the pieces of bodies that are about to break, where they are made already.
#[derive(Resource, Default)]
struct Molds(BTreeMap<Entity, Vec<Option<Collider>>>);

/// Strikers that fly through the loose pieces of a body that broke, and until when at the latest, in the time of the fixed steps: what they meet there
/// is part of the blow.
#[derive(Resource, Default)]
struct Passages(BTreeMap<(Entity, Entity), Duration>);

/// A body as Avian moves it.
type Moving = (
    &'static Position,
    &'static Rotation,
    &'static LinearVelocity,
    &'static AngularVelocity,
    &'static ComputedMass,
    &'static ComputedAngularInertia,
    &'static ComputedCenterOfMass,
);

pub(crate) fn build(app: &mut App) {
    app.init_resource::<Verdicts>()
        .init_resource::<ColliderDetail>()
        .init_resource::<ImpactSpeed>()
        .init_resource::<Breaking>()
        .init_resource::<Molds>()
        .init_resource::<Passages>()
        .init_resource::<later::Docket>()
        .init_resource::<debris::Began>()
        .add_observer(bodies::give_collider)
        .add_observer(bodies::give_fragments)
        .add_observer(bodies::miss_collider)
        .add_observer(bodies::push)
        .add_observer(debris::leave)
        .add_systems(
            FixedPostUpdate,
            (
                debris::start_clock.before(PhysicsSystems::First),
                (
                    later::serve,
                    after::carry_out,
                    resting::weigh,
                    calm::settle,
                    debris::rest,
                    debris::stop_clock,
                )
                    .chain()
                    .after(PhysicsSystems::Last),
            ),
        );
}
