//! After a break: the cracks' energy is taken from the motion, and the break is recorded.
//!
//! The cracks are paid first from what the motion has lost by the blow that made them (`exchange.rs`), which went into
//! vibration, and only the rest is taken as a toll ([`frangible::internals::rigid`]). Kinetic energy and the cracks' energy together never rise.
//!
//! Energy is counted over all bodies that pushed each other in the step, however far the pushes went: a ball that breaks a shelf
//! throws the shelf's pieces against a bowl, which may break in the same step by energy that no body had that touched it before.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use frangible::{Fracture, Striker};
use rapier3d::dynamics::{ImpulseJointHandle, RigidBody, RigidBodyHandle, RigidBodySet};
use rapier3d::math::Vector;

use crate::contact::contacts::Impact;
use crate::contact::surface::SurfaceProperties;
use crate::event::{BreakCause, BreakEvent};
use crate::fragments::replace::{Parts, is_debris, is_dust};
use crate::impulses::blows::Meeting;
use crate::impulses::exchange::Families;
use crate::impulses::motion::kinetic_energy;
use crate::impulses::plain::take_energy;
use crate::world::{BreakableWorld, Key, key};

/// A body that breaks in this step.
pub(crate) struct Broken {
    pub(crate) parent: RigidBodyHandle,
    pub(crate) cause: BreakCause,
    pub(crate) fracture: Arc<Fracture>,
    pub(crate) parts: Parts,
    pub(crate) impact: Impact,
    pub(crate) fragments: Vec<RigidBodyHandle>,
    /// Joints that no fragment holds.
    pub(crate) released: Vec<ImpulseJointHandle>,
    /// Its contacts, where the blow was integrated.
    pub(crate) blow: Vec<Meeting>,
    /// It and its striker touched nothing else in the step of the blow.
    pub(crate) alone: bool,
    /// Energy that the motion has lost by that blow, J: the vibration's, from which the cracks are paid first.
    pub(crate) lost: f64,
}

/// Bodies that pushed each other in a step: each before it, with its pieces after it.
#[derive(Default)]
struct Group {
    members: Vec<(RigidBodyHandle, Vec<RigidBodyHandle>)>,
    /// Fracture energy of those that broke, J.
    cracks: f64,
    /// Kinetic energy before the step, and the work of gravity in it, J.
    brought: [f64; 2],
    /// Energy that tolls still have to take from its motion so that none is made, J.
    shortage: f64,
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
}

impl BreakableWorld {
    /// Forgets the broken body, and remembers what its fragments are.
    fn hand_over(&mut self, broken: &Broken) -> Option<frangible::Body> {
        let body = self.state.breakables.remove(&key(broken.parent))?;
        self.state.burdens.remove(&key(broken.parent));
        self.state.surfaces.remove(&key(broken.parent));
        let surface = SurfaceProperties::of(body.asset().material(), Striker::EDGE_RADIUS);
        let now = self.time();
        for (&handle, fragment) in broken.fragments.iter().zip(&broken.fracture.fragments) {
            self.state.surfaces.insert(key(handle), surface);
            // Splinters stay on their film.
            if !broken.fracture.film().is_empty() {
                continue;
            }
            if is_debris(fragment, &self.config) {
                self.state.debris.push_back(handle);
            }
            if is_dust(fragment, &self.config) {
                self.state.dust.push_back((handle, now));
            }
        }
        self.note_clumps(body.asset(), &broken.fracture, &broken.fragments);
        if broken.fracture.film().is_empty() {
            self.expect_pieces(&body, broken);
        }
        Some(body)
    }

    /// Takes the cracks' energy of all breaks of a step from the motion and records them.
    pub(crate) fn settle(&mut self, broken: Vec<Broken>, before: &RigidBodySet) {
        let families: Families = (broken.iter())
            .map(|b| (key(b.parent), b.fragments.clone()))
            .collect();
        let (mut groups, group_of) = self.groups(&broken, &families);
        for group in &mut groups {
            let work = self.work_of_gravity(group, before).max(0.0);
            let energy = group.energy_before(before);
            group.brought = [energy, work];
            // Rapier's restitution at many contacts at once can gain some energy; a break and its cracks never do.
            group.shortage = group.energy_after(&self.physics.bodies) - energy - work;
        }
        for (broken, &group) in broken.iter().zip(&group_of) {
            let cracks = broken.fracture.report.fracture_energy;
            groups[group].cracks += cracks;
            groups[group].shortage += broken.lost.min(cracks);
        }
        let first = self.events.len();
        let mut recorded = Vec::new();
        for (mut broken, group) in broken.into_iter().zip(group_of) {
            let others: Vec<RigidBodyHandle> = (broken.impact.strikers.iter())
                .flat_map(|&s| self.what_became_of(Some(s), &families))
                .collect();
            broken
                .impact
                .strikers
                .retain(|&s| self.physics.bodies.contains(s));
            let cracks = broken.fracture.report.fracture_energy;
            let lost = broken.lost.min(cracks);
            let shortage = &mut groups[group].shortage;
            let toll = cracks - lost + shortage.max(0.0);
            let paid = take_energy(&mut self.physics.bodies, &broken.fragments, &others, toll);
            *shortage -= paid - (cracks - lost).min(paid);
            let parent = before.get(broken.parent);
            if self.record(broken, parent, (lost + paid).min(cracks)) {
                recorded.push(group);
            }
        }
        // Bodies that broke each other pay one after the other: the energy left is known only now.
        for (event, group) in self.events[first..].iter_mut().zip(recorded) {
            let group = &groups[group];
            [event.kinetic_before, event.work] = group.brought;
            event.kinetic_after = group.energy_after(&self.physics.bodies);
            event.cracks_together = group.cracks;
        }
    }

    /// The groups of bodies that pushed each other in the step just taken, as far as a body broke in them, and which group each of
    /// `broken` belongs to.
    fn groups(&self, broken: &[Broken], families: &Families) -> (Vec<Group>, Vec<usize>) {
        // A piece stands for the body that it was before the step.
        let parents: BTreeMap<Key, RigidBodyHandle> = (broken.iter())
            .flat_map(|b| b.fragments.iter().map(|&f| (key(f), b.parent)))
            .collect();
        let was = |h: RigidBodyHandle| parents.get(&key(h)).copied().unwrap_or(h);
        let mut groups: Vec<Group> = Vec::new();
        let mut known: BTreeMap<Key, usize> = BTreeMap::new();
        let mut group_of = Vec::with_capacity(broken.len());
        for one in broken {
            if let Some(&group) = known.get(&key(one.parent)) {
                group_of.push(group);
                continue;
            }
            let number = groups.len();
            let mut group = Group::default();
            let mut next = vec![one.parent];
            let mut seen = BTreeSet::from([key(one.parent)]);
            while let Some(handle) = next.pop() {
                known.insert(key(handle), number);
                let now = self.what_became_of(Some(handle), families);
                let met = broken.iter().flat_map(|b| {
                    let strikers = b.impact.strikers.iter().map(|&s| (s, b.parent));
                    strikers.flat_map(|(a, b)| [(a, b), (b, a)])
                });
                let met = met.filter(|&(_, b)| b == handle).map(|(a, _)| a);
                let touching = now.iter().flat_map(|&h| self.pushed_with(h));
                for other in met.chain(touching).map(was) {
                    // A fixed body passes nothing on.
                    let there = self.physics.bodies.get(other);
                    let moves = there.is_none_or(RigidBody::is_dynamic);
                    if seen.insert(key(other)) && moves {
                        next.push(other);
                    }
                }
                group.members.push((handle, now));
            }
            groups.push(group);
            group_of.push(number);
        }
        (groups, group_of)
    }

    /// Bodies that a body touched in the step just taken, or is tied to.
    fn pushed_with(&self, handle: RigidBodyHandle) -> impl Iterator<Item = RigidBodyHandle> {
        let physics = &self.physics;
        let body = physics.bodies.get(handle);
        let colliders = body.map_or(&[][..], |b| b.colliders());
        let pairs = colliders
            .iter()
            .flat_map(|&c| physics.narrow_phase.contact_pairs_with(c));
        let touching = pairs
            .filter(|p| p.has_any_active_contact())
            .flat_map(|p| [p.collider1, p.collider2])
            .filter_map(|c| physics.colliders.get(c).and_then(|c| c.parent()));
        let joints = physics.impulse_joints.attached_joints(handle);
        let tied = joints.flat_map(|(a, b, ..)| [a, b]);
        touching.chain(tied).filter(move |&h| h != handle)
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
        let cracks = broken.fracture.report.fracture_energy;
        let (pose, linvel, angvel) = parent.map_or_else(Default::default, |b| {
            (*b.position(), b.linvel(), b.angvel())
        });
        self.events.push(BreakEvent {
            step: self.state.steps,
            parent: broken.parent,
            cause: broken.cause,
            asset: Arc::clone(body.asset()),
            fragments: broken.fragments,
            released_joints: broken.released,
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
            cracks_together: cracks,
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
            // Fragments of a held body begin their fall with the step.
            let bodies = pieces.iter().filter_map(|&h| self.physics.bodies.get(h));
            let loose = bodies.filter(|b| b.is_dynamic());
            loose.map(|b| fall(b, Vector::ZERO)).sum()
        };
        group.members.iter().map(work).sum()
    }
}
