//! A scene put aside, to go back to.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::Body;
use frangible_rapier::SavedWorld;

use super::swing::Swung;
use super::{LiveScene, Thing};
use crate::stage::Thrown;

/// The state of a [`LiveScene`] at one moment; shapes are shared with it.
pub struct SavedScene {
    world: SavedWorld,
    things: Vec<Arc<Thing>>,
    whole: BTreeMap<(u32, u32), Body>,
    ticks: u64,
    fine_until: u64,
    throws: usize,
    thrown: Vec<Thrown>,
    swings: Vec<Swung>,
}

impl SavedScene {
    /// Simulated time of the state, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.ticks as f64 / super::TICKS_PER_SECOND as f64
    }
}

impl LiveScene {
    /// Puts the state aside, between two steps.
    #[must_use]
    pub fn save(&self) -> SavedScene {
        SavedScene {
            world: self.world.save(),
            things: self.things.clone(),
            whole: self.whole.clone(),
            ticks: self.ticks,
            fine_until: self.fine_until,
            throws: self.throws,
            thrown: self.schedule.thrown.clone(),
            swings: self.swings.clone(),
        }
    }

    /// Goes back to a state of this scene; from there on the same happens again, bit for bit.
    pub fn restore(&mut self, saved: &SavedScene) {
        self.world.restore(&saved.world);
        self.things.clone_from(&saved.things);
        self.whole.clone_from(&saved.whole);
        self.ticks = saved.ticks;
        self.fine_until = saved.fine_until;
        self.throws = saved.throws;
        self.schedule.thrown.clone_from(&saved.thrown);
        self.swings.clone_from(&saved.swings);
    }
}
