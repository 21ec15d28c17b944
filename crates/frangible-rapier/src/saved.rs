//! Saved states of a world.

use frangible::FractureConfig;
use rapier3d::dynamics::IntegrationParameters;
use rapier3d::math::Vector;

use crate::snapshot::Snapshot;
use crate::world::{BreakableWorld, State};

/// A saved state of a [`BreakableWorld`], made by [`BreakableWorld::save`]. Shapes and assets are shared with the world, so it takes about as
/// much memory as the poses and contacts of the bodies.
pub struct SavedWorld {
    snapshot: Snapshot,
    gravity: Vector,
    parameters: IntegrationParameters,
    fracture: FractureConfig,
    state: State,
}

impl BreakableWorld {
    /// Saves the state of the world between two steps. Events of the last step, and blows that other threads are computing
    /// ([`Breaking::AfterStep`](crate::Breaking::AfterStep) with a delay), are not saved.
    #[must_use]
    pub fn save(&self) -> SavedWorld {
        SavedWorld {
            snapshot: Snapshot::take(&self.physics, &self.siblings),
            gravity: self.physics.gravity,
            parameters: self.physics.integration_parameters,
            fracture: self.config.fracture.clone(),
            state: self.state.clone(),
        }
    }

    /// Restores a saved state of this world. Later steps are bit-identical to those after the save.
    pub fn restore(&mut self, saved: &SavedWorld) {
        saved
            .snapshot
            .restore(&mut self.physics, &mut self.siblings);
        self.physics.gravity = saved.gravity;
        self.physics.integration_parameters = saved.parameters;
        self.config.fracture = saved.fracture.clone();
        self.state = saved.state.clone();
        self.events.clear();
        self.held.clear();
        self.cases.clear();
    }
}
