//! A world put aside, to go back to.

use frangible::FractureConfig;
use rapier3d::dynamics::IntegrationParameters;
use rapier3d::math::Vector;

use crate::snapshot::Snapshot;
use crate::world::{BreakableWorld, State};

/// The state of a [`BreakableWorld`] at one moment: see [`BreakableWorld::save`]. Shapes and assets are shared with the
/// world, so it takes about as much as the bodies' poses and contacts.
pub struct SavedWorld {
    snapshot: Snapshot,
    gravity: Vector,
    parameters: IntegrationParameters,
    fracture: FractureConfig,
    state: State,
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
            state: self.state.clone(),
        }
    }

    /// Goes back to a state of this world: from there on it steps as it did then, bit for bit.
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
