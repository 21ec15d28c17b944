//! Clumps of dice: pieces of a tempered wall, which hold by nothing but their shape.
//!
//! A clump parts after the step in which contacts change its motion by [`WorldConfig::impact_speed`](crate::WorldConfig::impact_speed) or more, into
//! [`PARTS`] smaller clumps with the motion that it has then, so momentum, angular momentum and energy stay as they are. Nothing has to be found out
//! by the fracture model. Clumps part until there are [`WorldConfig::max_clumps`](crate::WorldConfig::max_clumps), or until they are lighter than
//! [`PieceConfig::least_mass`](crate::PieceConfig::least_mass).

use std::sync::Arc;

use frangible::internals::outcome::Clump;
use frangible::{Asset, Fracture};
use rapier3d::dynamics::RigidBodyHandle;

use crate::event::{BreakCause, BreakEvent};
use crate::fragments::replace::{Parts, Replacement, is_debris, is_dust};
use crate::impulses::motion::kinetic_energy;
use crate::world::{BreakableWorld, key};

/// Clumps into which one parts.
const PARTS: usize = 4;

/// Clumps that part in a step, at most; the others wait.
const MOST: usize = 8;

/// A clump in the world.
#[derive(Clone)]
pub(crate) struct WorldClump {
    clump: Arc<Clump>,
    /// Asset of the wall.
    asset: Arc<Asset>,
    /// True if it is large enough to part.
    parts: bool,
}

impl BreakableWorld {
    /// Notes which fragments are clumps.
    pub(crate) fn note_clumps(
        &mut self,
        asset: &Arc<Asset>,
        fracture: &Fracture,
        fragments: &[RigidBodyHandle],
    ) {
        let least = f64::from(self.config.pieces.least_mass);
        for (k, (&handle, fragment)) in fragments.iter().zip(&fracture.fragments).enumerate() {
            let Some(clump) = fracture.clump(k) else {
                return;
            };
            let clump = WorldClump {
                clump: Arc::clone(clump),
                asset: Arc::clone(asset),
                parts: clump.count() > 1 && fragment.mass.mass >= least,
            };
            self.state.clumps.insert(key(handle), clump);
        }
    }

    /// Parts the clumps that were hit in the step just taken, and those that have waited.
    pub(crate) fn part_clumps(&mut self) {
        let clumps = self.state.clumps.iter().filter(|(_, clump)| clump.parts);
        let hit: Vec<RigidBodyHandle> = clumps
            .map(|(&(index, generation), _)| RigidBodyHandle::from_raw_parts(index, generation))
            .filter(|&handle| !self.state.parting.contains(&handle) && self.was_hit(handle))
            .collect();
        self.state.parting.extend(hit);
        // The largest first, so that the room is not used up for parting what has parted already.
        let clumps = &self.state.clumps;
        let count =
            |handle: &RigidBodyHandle| clumps.get(&key(*handle)).map_or(0, |c| c.clump.count());
        let order = |a: &RigidBodyHandle, b: &RigidBodyHandle| {
            count(b).cmp(&count(a)).then(key(*a).cmp(&key(*b)))
        };
        self.state.parting.make_contiguous().sort_by(order);
        for _ in 0..MOST {
            let Some(handle) = self.state.parting.pop_front() else {
                return;
            };
            let room = self.state.clumps.len() + PARTS <= self.config.max_clumps + 1
                && self.body_count() + PARTS <= self.config.max_bodies;
            if let Some(clump) = self
                .state
                .clumps
                .get(&key(handle))
                .cloned()
                .filter(|_| room)
            {
                self.part_clump(handle, &clump);
            }
        }
    }

    /// Returns true if contacts have changed the motion of a body by the speed at which impacts count.
    fn was_hit(&self, handle: RigidBodyHandle) -> bool {
        let physics = &self.physics;
        let Some(body) = physics.bodies.get(handle).filter(|b| !b.is_sleeping()) else {
            return false;
        };
        let colliders = body.colliders().iter();
        let pairs = colliders.flat_map(|&c| physics.narrow_phase.contact_pairs_with(c));
        let impulse: f32 = pairs.map(|pair| pair.total_impulse_magnitude()).sum();
        impulse >= self.config.impact_speed * body.mass()
    }

    fn part_clump(&mut self, handle: RigidBodyHandle, clump: &WorldClump) {
        let Some(parent) = self.physics.bodies.get(handle).cloned() else {
            return;
        };
        let fracture = clump.clump.parted(PARTS);
        let Ok(parts) = Parts::new(&fracture, &self.config) else {
            return;
        };
        let Replacement {
            fragments,
            released,
        } = self.replace(handle, &parts);
        self.state.clumps.remove(&key(handle));
        let surface = self.state.surfaces.remove(&key(handle));
        let now = self.time();
        for (&piece, fragment) in fragments.iter().zip(&fracture.fragments) {
            if let Some(surface) = surface {
                self.state.surfaces.insert(key(piece), surface);
            }
            if is_debris(fragment, &self.config) {
                self.state.debris.push_back(piece);
            }
            if is_dust(fragment, &self.config) {
                self.state.dust.push_back((piece, now));
            }
        }
        self.note_clumps(&clump.asset, &fracture, &fragments);
        let energy = kinetic_energy(&parent);
        self.events.push(BreakEvent {
            step: self.state.steps,
            parent: handle,
            cause: BreakCause::Impact,
            asset: Arc::clone(&clump.asset),
            fragments,
            released_joints: released,
            fracture: Arc::new(fracture),
            contacts: Vec::new(),
            strikers: Vec::new(),
            pose: *parent.position(),
            linvel: parent.linvel(),
            angvel: parent.angvel(),
            energy_paid: 0.0,
            kinetic_before: energy,
            kinetic_after: energy,
            work: 0.0,
            cracks_together: 0.0,
        });
    }
}
