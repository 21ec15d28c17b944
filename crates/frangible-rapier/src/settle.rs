//! After a break: the cracks' energy is taken from the motion, and the break is recorded.
//!
//! The cracks are paid first from what the motion has lost by the blow that made them (`exchange.rs`), which went into
//! vibration, and only the rest is taken as a toll (`toll.rs`). Kinetic energy and the cracks' energy together never rise.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::Fracture;
use rapier3d::dynamics::{RigidBody, RigidBodyHandle, RigidBodySet};
use rapier3d::math::Vector;

use crate::blows::Meeting;
use crate::contacts::Impact;
use crate::event::{BreakCause, BreakEvent};
use crate::motion::kinetic_energy;
use crate::replace::{Parts, is_debris, is_dust};
use crate::surface::{EDGE_RADIUS, SurfaceProperties};
use crate::toll::take_energy;
use crate::world::{BreakableWorld, Key, key};

/// A body that breaks in this step.
pub(crate) struct Broken {
    pub(crate) parent: RigidBodyHandle,
    pub(crate) cause: BreakCause,
    pub(crate) fracture: Arc<Fracture>,
    pub(crate) parts: Parts,
    pub(crate) impact: Impact,
    pub(crate) fragments: Vec<RigidBodyHandle>,
    /// Its contacts, where the blow was integrated.
    pub(crate) blow: Vec<Meeting>,
    /// What the motion has lost by that blow, J: the vibration's, from which the cracks are paid first.
    pub(crate) lost: f64,
}

/// A body that broke, with all that hit it: before the step, and what has become of each.
struct Group {
    members: Vec<(RigidBodyHandle, Vec<RigidBodyHandle>)>,
}

impl Group {
    fn energy_before(&self, before: &RigidBodySet) -> f64 {
        let bodies = self.members.iter().filter_map(|(h, _)| before.get(*h));
        bodies.map(kinetic_energy).sum()
    }

    fn energy_after(&self, bodies: &RigidBodySet) -> f64 {
        let pieces = self.members.iter().flat_map(|(_, pieces)| pieces);
        pieces
            .filter_map(|&h| bodies.get(h))
            .map(kinetic_energy)
            .sum()
    }

    /// What the others have become.
    fn others(&self) -> Vec<RigidBodyHandle> {
        let others = self.members.iter().skip(1);
        others.flat_map(|(_, pieces)| pieces).copied().collect()
    }
}

impl BreakableWorld {
    /// Forgets the broken body, and remembers what its fragments are.
    fn hand_over(&mut self, broken: &Broken) -> Option<frangible::Body> {
        let body = self.breakables.remove(&key(broken.parent))?;
        self.burdens.remove(&key(broken.parent));
        self.surfaces.remove(&key(broken.parent));
        let surface = SurfaceProperties::of(&body.asset().material, EDGE_RADIUS);
        let now = self.time();
        for (&handle, fragment) in broken.fragments.iter().zip(&broken.fracture.fragments) {
            self.surfaces.insert(key(handle), surface);
            if is_debris(fragment, &self.config) {
                self.debris.push_back(handle);
            }
            if is_dust(fragment, &self.config) {
                self.dust.push_back((handle, now));
            }
        }
        self.expect_pieces(&body, broken);
        Some(body)
    }

    /// Takes the cracks' energy of all breaks of a step from the motion and records them.
    pub(crate) fn settle(&mut self, broken: Vec<Broken>, before: &RigidBodySet) {
        let families: BTreeMap<Key, Vec<RigidBodyHandle>> = broken
            .iter()
            .map(|b| (key(b.parent), b.fragments.clone()))
            .collect();
        let mut groups = Vec::new();
        let first = self.events.len();
        for mut broken in broken {
            let mut members = vec![(broken.parent, broken.fragments.clone())];
            for &striker in &broken.impact.strikers {
                let alive = || {
                    let there = self.physics.bodies.contains(striker);
                    there.then(|| vec![striker])
                };
                let pieces = families.get(&key(striker)).cloned().or_else(alive);
                members.extend(pieces.map(|pieces| (striker, pieces)));
            }
            let group = Group { members };
            broken
                .impact
                .strikers
                .retain(|&s| self.physics.bodies.contains(s));
            let work = self.work_of_gravity(&group, before).max(0.0);
            let energy = group.energy_before(before);
            // Rapier's restitution at many contacts at once can gain some energy; a break and its cracks never do.
            let gain = group.energy_after(&self.physics.bodies) - energy - work;
            let cracks = broken.fracture.report.fracture_energy;
            let lost = broken.lost.min(cracks);
            let toll = (cracks - lost).max(cracks + gain);
            let bodies = &mut self.physics.bodies;
            let paid = take_energy(bodies, &broken.fragments, &group.others(), toll);
            let parent = before.get(broken.parent);
            if self.record(broken, parent, (lost + paid).min(cracks)) {
                groups.push((group, energy, work));
            }
        }
        // Bodies that broke each other pay one after the other: what is left is known only now.
        for (event, (group, energy, work)) in self.events[first..].iter_mut().zip(groups) {
            event.kinetic_before = energy;
            event.kinetic_after = group.energy_after(&self.physics.bodies);
            event.work = work;
        }
    }

    /// Records a break; its energies are the caller's to fill in. False when the body was none of ours.
    pub(crate) fn record(
        &mut self,
        broken: Broken,
        parent: Option<&RigidBody>,
        energy_paid: f64,
    ) -> bool {
        let Some(body) = self.hand_over(&broken) else {
            return false;
        };
        let (pose, linvel, angvel) = parent.map_or_else(Default::default, |b| {
            (*b.position(), b.linvel(), b.angvel())
        });
        self.events.push(BreakEvent {
            step: self.steps,
            parent: broken.parent,
            cause: broken.cause,
            asset: Arc::clone(body.asset()),
            fragments: broken.fragments,
            fracture: broken.fracture,
            contacts: broken.impact.contacts,
            strikers: broken.impact.strikers,
            pose,
            linvel,
            angvel,
            energy_paid,
            kinetic_before: 0.0,
            kinetic_after: 0.0,
            work: 0.0,
        });
        true
    }

    /// Work of gravity on the group in the step, J.
    fn work_of_gravity(&self, group: &Group, before: &RigidBodySet) -> f64 {
        let dt = self.physics.integration_parameters.dt;
        let gravity = self.physics.gravity;
        let fall = |body: &RigidBody, start: Vector| {
            let pull = gravity * body.gravity_scale();
            f64::from(body.mass() * (pull * dt).dot(start + 0.5 * dt * pull))
        };
        let work = |(handle, pieces): &(RigidBodyHandle, Vec<RigidBodyHandle>)| {
            let Some(body) = before.get(*handle) else {
                return 0.0;
            };
            if body.is_dynamic() {
                return fall(body, body.linvel());
            }
            // Fragments of what was held begin their fall with the step.
            let bodies = pieces.iter().filter_map(|&h| self.physics.bodies.get(h));
            let loose = bodies.filter(|b| b.is_dynamic());
            loose.map(|b| fall(b, Vector::ZERO)).sum()
        };
        group.members.iter().map(work).sum()
    }
}
