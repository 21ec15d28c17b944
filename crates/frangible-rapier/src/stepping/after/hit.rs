//! Detection of bodies that were hit in the last step, without a copy of the world.
//!
//! Only the poses and velocities of bodies are stored before the step (`motions.rs`). They determine which contact pairs may have
//! collided fast enough; the state before the step is reconstructed only for the breakable bodies among these and for the bodies that touch
//! them.

use std::collections::{BTreeMap, BTreeSet};

use rapier3d::dynamics::{RigidBody, RigidBodyHandle};

use super::line::Waiting;
use crate::world::{BreakableWorld, Key, key};

/// Bodies as they were before the step, those that were hit and what hit them.
pub(super) type HitBodies = BTreeMap<Key, RigidBody>;

impl BreakableWorld {
    /// Bodies that may have been hit in the step just taken, with what touches them; and the overloaded ones.
    pub(super) fn hit_bodies(&self, overloaded: &[RigidBodyHandle]) -> HitBodies {
        let physics = &self.physics;
        let parent = |c| physics.colliders.get(c).and_then(|c| c.parent());
        let mut hit: BTreeSet<Key> = overloaded.iter().map(|&h| key(h)).collect();
        for pair in physics.narrow_phase.contact_pairs() {
            let (a, b) = (parent(pair.collider1), parent(pair.collider2));
            let fast = (self.state.motions).may_meet_at(self.config.impact_speed, a, b);
            let mut breakable = [a, b]
                .into_iter()
                .flatten()
                .filter(|&h| self.breakable(h).is_some())
                .peekable();
            if fast && breakable.peek().is_some() && pair.has_any_active_contact() {
                hit.extend(breakable.map(key));
            }
        }
        let mut bodies = HitBodies::new();
        let mut note = |handle: RigidBodyHandle| {
            if !bodies.contains_key(&key(handle))
                && let Some(body) = self.state.motions.body_before(physics, handle)
            {
                bodies.insert(key(handle), body);
            }
        };
        for (index, generation) in hit {
            let handle = RigidBodyHandle::from_raw_parts(index, generation);
            note(handle);
            let body = physics.bodies.get(handle);
            for &collider in body.map_or(&[][..], |b| b.colliders()) {
                for pair in physics.narrow_phase.contact_pairs_with(collider) {
                    [pair.collider1, pair.collider2]
                        .into_iter()
                        .filter_map(parent)
                        .for_each(&mut note);
                }
            }
        }
        bodies
    }

    /// Blows on the breakable ones among these bodies, in the order of their handles.
    pub(super) fn blows(&self, before: &HitBodies) -> Vec<Waiting> {
        let handles = before
            .keys()
            .map(|&(index, generation)| RigidBodyHandle::from_raw_parts(index, generation));
        let blows = handles.filter_map(|handle| {
            let body = self.breakable(handle)?;
            let impact = self.impact_on(handle, before);
            (!impact.contacts.is_empty()).then(|| Waiting {
                body: handle,
                cost: self.work(body, &impact),
                impact,
                step: self.state.steps,
            })
        });
        blows.collect()
    }
}
