//! The caller's physics hooks and event handler, combined with those of this crate.
//!
//! Events of a step that may be undone are held back until the step is final; events of undone steps are discarded. Hooks are called in every
//! step, including undone ones, so they may be called twice for the same step.

use std::sync::{Mutex, PoisonError};

use rapier3d::dynamics::{RigidBodySet, SoftBodySet, SoftBodyTearEvent};
use rapier3d::geometry::{ColliderSet, CollisionEvent, ContactPair, SolverFlags};
use rapier3d::math::Real;
use rapier3d::pipeline::{
    ContactModificationContext, EventHandler, PairFilterContext, PhysicsHooks, PhysicsWorld,
};

use crate::fragments::siblings::Siblings;

/// Hooks and event handler of the caller.
#[derive(Clone, Copy)]
pub(crate) struct Callbacks<'a> {
    pub(crate) hooks: &'a dyn PhysicsHooks,
    pub(crate) events: &'a dyn EventHandler,
}

impl Callbacks<'_> {
    /// The caller has no hooks and no event handler.
    pub(crate) const NONE: Callbacks<'static> = Callbacks {
        hooks: &(),
        events: &(),
    };
}

/// The caller's hooks first, then those of this crate on the result.
pub(crate) struct Hooks<'a> {
    pub(crate) own: &'a dyn PhysicsHooks,
    pub(crate) siblings: &'a Siblings,
}

impl PhysicsHooks for Hooks<'_> {
    fn filter_contact_pair(&self, context: &PairFilterContext<'_>) -> Option<SolverFlags> {
        self.own.filter_contact_pair(context)
    }

    fn filter_intersection_pair(&self, context: &PairFilterContext<'_>) -> bool {
        self.own.filter_intersection_pair(context)
    }

    fn modify_solver_contacts(&self, context: &mut ContactModificationContext<'_>) {
        self.own.modify_solver_contacts(context);
        self.siblings.modify_solver_contacts(context);
    }
}

/// An event that Rapier reported in a step.
enum Said {
    Collision(CollisionEvent, Option<Box<ContactPair>>),
    Force(Real, Box<ContactPair>, Real),
    Tear(SoftBodyTearEvent),
}

/// Events of a step that may yet be undone.
#[derive(Default)]
pub(crate) struct Held(Mutex<Vec<Said>>);

impl Held {
    fn say(&self, said: Said) {
        let mut list = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        list.push(said);
    }

    /// The step was undone.
    pub(crate) fn forget(&mut self) {
        let list = self.0.get_mut().unwrap_or_else(PoisonError::into_inner);
        list.clear();
    }

    /// The step stands: tells the caller, in the order in which Rapier spoke.
    pub(crate) fn tell(self, events: &dyn EventHandler, physics: &PhysicsWorld) {
        let list = self.0.into_inner().unwrap_or_else(PoisonError::into_inner);
        let (bodies, colliders) = (&physics.bodies, &physics.colliders);
        for said in &list {
            match said {
                Said::Collision(event, pair) => {
                    events.handle_collision_event(bodies, colliders, *event, pair.as_deref());
                }
                Said::Force(dt, pair, force) => {
                    events.handle_contact_force_event(*dt, bodies, colliders, pair, *force);
                }
                Said::Tear(event) => {
                    events.handle_soft_body_tear_event(&physics.soft_bodies, event);
                }
            }
        }
    }
}

impl EventHandler for Held {
    fn handle_collision_event(
        &self,
        _: &RigidBodySet,
        _: &ColliderSet,
        event: CollisionEvent,
        pair: Option<&ContactPair>,
    ) {
        self.say(Said::Collision(event, pair.cloned().map(Box::new)));
    }

    fn handle_contact_force_event(
        &self,
        dt: Real,
        _: &RigidBodySet,
        _: &ColliderSet,
        pair: &ContactPair,
        force: Real,
    ) {
        self.say(Said::Force(dt, Box::new(pair.clone()), force));
    }

    fn handle_soft_body_tear_event(&self, _: &SoftBodySet, event: &SoftBodyTearEvent) {
        self.say(Said::Tear(event.clone()));
    }
}
