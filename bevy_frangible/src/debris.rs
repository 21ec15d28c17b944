//! How many pieces there may be, and which of them go.

use std::collections::VecDeque;
use std::time::Duration;

use bevy::prelude::*;
use frangible::Fragment;

use crate::{Broken, FragmentOf};

/// How many pieces of broken bodies there may be, and which are too small to matter. Pieces that something outside holds do not count and
/// stay. An engine's own sleep serves the others.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct DebrisBudget {
    /// Pieces kept at most. Default 1000. Those of the oldest break are despawned first, of one break the lightest.
    pub pieces: usize,
    /// Lighter fragments are dust: without a collider they fall through everything, cost next to nothing, and are despawned
    /// [`DebrisBudget::dust_time`] after the break. kg, default 1e-5, a chip of glass 1.5 mm wide.
    pub dust_mass: f64,
    /// Default 1 s.
    pub dust_time: Duration,
}

impl Default for DebrisBudget {
    fn default() -> Self {
        Self {
            pieces: 1000,
            dust_mass: 1e-5,
            dust_time: Duration::from_secs(1),
        }
    }
}

impl DebrisBudget {
    /// Whether a fragment gets no collider.
    #[must_use]
    pub fn is_dust(&self, fragment: &Fragment) -> bool {
        fragment.mass.mass < self.dust_mass && !fragment.supported
    }
}

/// The pieces that may go, the first to go first, and dust with the time at which it goes.
#[derive(Resource, Default)]
pub(crate) struct Heap {
    pieces: VecDeque<Entity>,
    dust: VecDeque<(Duration, Entity)>,
}

/// Remembers the pieces of a break, which are sorted from the largest.
pub(crate) fn remember(world: &mut World, fragments: &[Fragment], entities: &[Entity]) {
    let budget = world.resource::<DebrisBudget>().clone();
    let gone_at = world.resource::<Time<Fixed>>().elapsed() + budget.dust_time;
    let mut heap = world.resource_mut::<Heap>();
    for (fragment, &entity) in fragments.iter().zip(entities).rev() {
        if budget.is_dust(fragment) {
            heap.dust.push_back((gone_at, entity));
        } else if !fragment.supported {
            heap.pieces.push_back(entity);
        }
    }
}

/// Despawns what is too much.
pub(crate) fn clear_up(
    mut heap: ResMut<Heap>,
    budget: Res<DebrisBudget>,
    time: Res<Time<Fixed>>,
    pieces: Query<(), (With<FragmentOf>, Without<Broken>)>,
    mut commands: Commands,
) {
    while let Some((_, entity)) = heap.dust.pop_front_if(|(at, _)| *at <= time.elapsed()) {
        commands.entity(entity).try_despawn();
    }
    if heap.pieces.len() <= budget.pieces {
        return;
    }
    heap.pieces.retain(|&entity| pieces.contains(entity));
    let surplus = heap.pieces.len().saturating_sub(budget.pieces);
    for entity in heap.pieces.drain(..surplus) {
        commands.entity(entity).try_despawn();
    }
}
