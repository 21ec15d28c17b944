//! A world put aside, to go back to.

use std::collections::{BTreeMap, VecDeque};

use frangible::{Body, FractureConfig};
use rapier3d::dynamics::{IntegrationParameters, RigidBodyHandle};
use rapier3d::math::Vector;

use crate::after::Waiting;
use crate::counts::LoadCounts;
use crate::motions::Motions;
use crate::pieces::Expected;
use crate::pushes::Push;
use crate::rest::Places;
use crate::resting::Burden;
use crate::snapshot::Snapshot;
use crate::surface::SurfaceProperties;
use crate::world::{BreakableWorld, Key};

/// The state of a [`BreakableWorld`] at one moment: see [`BreakableWorld::save`]. Shapes and assets are shared with the
/// world, so it takes about as much as the bodies' poses and contacts.
pub struct SavedWorld {
    snapshot: Snapshot,
    gravity: Vector,
    parameters: IntegrationParameters,
    fracture: FractureConfig,
    breakables: BTreeMap<Key, Body>,
    surfaces: BTreeMap<Key, SurfaceProperties>,
    collider_surfaces: BTreeMap<Key, SurfaceProperties>,
    places: Places,
    burdens: BTreeMap<Key, Burden>,
    pushes: Vec<Push>,
    debris: VecDeque<RigidBodyHandle>,
    dust: VecDeque<(RigidBodyHandle, f64)>,
    expected: VecDeque<Expected>,
    waiting: VecDeque<Waiting>,
    motions: Motions,
    steps: u64,
    refused_breaks: u64,
    undone_steps: u64,
    snapshots: u64,
    impact_counts: LoadCounts,
    rest_counts: LoadCounts,
}

impl BreakableWorld {
    /// Puts the world's state aside, between two steps. Events of the last step are not kept, nor are blows that other
    /// threads judge at the time ([`Breaking::AfterStep`](crate::Breaking::AfterStep) with a delay).
    #[must_use]
    pub fn save(&self) -> SavedWorld {
        SavedWorld {
            snapshot: Snapshot::take(&self.physics, &self.siblings),
            gravity: self.physics.gravity,
            parameters: self.physics.integration_parameters,
            fracture: self.config.fracture.clone(),
            breakables: self.breakables.clone(),
            surfaces: self.surfaces.clone(),
            collider_surfaces: self.collider_surfaces.clone(),
            places: self.places.clone(),
            burdens: self.burdens.clone(),
            pushes: self.pushes.clone(),
            debris: self.debris.clone(),
            dust: self.dust.clone(),
            expected: self.expected.clone(),
            waiting: self.waiting.clone(),
            motions: self.motions.clone(),
            steps: self.steps,
            refused_breaks: self.refused_breaks,
            undone_steps: self.undone_steps,
            snapshots: self.snapshots,
            impact_counts: self.impact_counts,
            rest_counts: self.rest_counts,
        }
    }

    /// Goes back to a state of this world: from there on it does what it did then, bit for bit.
    pub fn restore(&mut self, saved: &SavedWorld) {
        saved
            .snapshot
            .restore(&mut self.physics, &mut self.siblings);
        self.physics.gravity = saved.gravity;
        self.physics.integration_parameters = saved.parameters;
        self.config.fracture = saved.fracture.clone();
        self.breakables = saved.breakables.clone();
        self.surfaces = saved.surfaces.clone();
        self.collider_surfaces = saved.collider_surfaces.clone();
        self.places = saved.places.clone();
        self.burdens = saved.burdens.clone();
        self.pushes = saved.pushes.clone();
        self.debris = saved.debris.clone();
        self.dust = saved.dust.clone();
        self.expected = saved.expected.clone();
        self.waiting = saved.waiting.clone();
        self.motions = saved.motions.clone();
        self.steps = saved.steps;
        self.refused_breaks = saved.refused_breaks;
        self.undone_steps = saved.undone_steps;
        self.snapshots = saved.snapshots;
        self.impact_counts = saved.impact_counts;
        self.rest_counts = saved.rest_counts;
        self.events.clear();
        self.held.clear();
        self.cases.clear();
    }
}
