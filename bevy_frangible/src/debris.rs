//! Limits on the number of pieces, and the treatment of pieces at rest.

use std::collections::VecDeque;
use std::time::Duration;

use bevy::prelude::*;
use frangible::Fragment;

use crate::{Broken, FragmentOf};

/// Resource with limits on the number of pieces, on the duration of a physics step, and on the mass of pieces. Supported pieces do not count
/// and are never removed.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct DebrisBudget {
    /// Largest number of pieces. Default 1000. Pieces of the oldest break are removed first, the lightest of a break first.
    pub pieces: usize,
    /// Largest mean duration of recent physics steps: while it is exceeded, each step removes one in fifty pieces. Default none. A value makes
    /// runs depend on the speed of the machine and so not reproducible.
    pub step_time: Option<Duration>,
    /// Mass below which fragments are dust, kg: without a collider they fall through everything, cost almost nothing, and are despawned
    /// [`DebrisBudget::dust_time`] after the break. Default 1e-5, a chip of glass 1.5 mm wide.
    pub dust_mass: f64,
    /// Time after the break at which dust is despawned. Default 1 s.
    pub dust_time: Duration,
    /// Treatment of pieces that have slept in Avian for [`DebrisBudget::rest_time`]. Default [`AtRest::Sleep`].
    pub at_rest: AtRest,
    /// Time of sleep after which [`DebrisBudget::at_rest`] applies. Default 2 s.
    pub rest_time: Duration,
    /// Time in which a removed piece, without its collider, shrinks to nothing. Default zero: it is removed at once.
    pub fade_time: Duration,
}

/// Treatment of pieces at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AtRest {
    /// Pieces sleep until something touches them.
    #[default]
    Sleep,
    /// Pieces become static, so nothing moves them and they cost no solver time. They can still break again.
    Freeze,
    /// Pieces of one body are merged into one static body, its [`Rubble`](crate::Rubble), with one collider, one mesh for the outer faces and one
    /// for the crack faces. Their own entities are despawned; they cannot break again and no longer count.
    Merge,
    /// Pieces are removed.
    Go,
}

impl Default for DebrisBudget {
    fn default() -> Self {
        Self {
            pieces: 1000,
            step_time: None,
            dust_mass: 1e-5,
            dust_time: Duration::from_secs(1),
            at_rest: AtRest::default(),
            rest_time: Duration::from_secs(2),
            fade_time: Duration::ZERO,
        }
    }
}

impl DebrisBudget {
    /// Returns true if a fragment is dust, which gets no collider.
    #[must_use]
    pub fn is_dust(&self, fragment: &Fragment) -> bool {
        fragment.mass.mass < self.dust_mass && !fragment.supported
    }
}

/// One in so many pieces goes in each step that is too long.
const SHARE: usize = 50;

/// The pieces that may go, the first to go first, and dust with the time at which it goes.
#[derive(Resource, Default)]
pub(crate) struct Heap {
    pieces: VecDeque<Entity>,
    dust: VecDeque<(Duration, Entity)>,
    /// Mean duration of the last steps of physics.
    pub(crate) step_time: Duration,
}

/// A piece that goes: when it began to, in the time of the fixed steps.
#[derive(Component)]
pub(crate) struct Fading(Duration);

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

/// Removes pieces beyond the budget.
pub(crate) fn clear_up(
    mut heap: ResMut<Heap>,
    budget: Res<DebrisBudget>,
    time: Res<Time<Fixed>>,
    pieces: Query<(), (With<FragmentOf>, Without<Broken>, Without<Fading>)>,
    mut commands: Commands,
) {
    while let Some((_, entity)) = heap.dust.pop_front_if(|(at, _)| *at <= time.elapsed()) {
        commands.entity(entity).try_despawn();
    }
    let long = budget.step_time.is_some_and(|most| heap.step_time > most);
    if heap.pieces.len() <= budget.pieces && !long {
        return;
    }
    heap.pieces.retain(|&entity| pieces.contains(entity));
    let count = heap.pieces.len();
    let too_long = if long { count.div_ceil(SHARE) } else { 0 };
    let surplus = count.saturating_sub(budget.pieces).max(too_long);
    for entity in heap.pieces.drain(..surplus) {
        let_go(&mut commands, entity, time.elapsed());
    }
}

/// Shrinks pieces that go, until they are gone.
pub(crate) fn fade(
    mut fading: Query<(Entity, &Fading, &mut Transform)>,
    budget: Res<DebrisBudget>,
    time: Res<Time<Fixed>>,
    mut commands: Commands,
) {
    for (entity, Fading(since), mut place) in &mut fading {
        let age = time.elapsed().saturating_sub(*since);
        if age >= budget.fade_time {
            commands.entity(entity).try_despawn();
        } else {
            let left = 1.0 - age.as_secs_f32() / budget.fade_time.as_secs_f32();
            place.scale = Vec3::splat(left);
        }
    }
}

/// Lets a piece go.
pub(crate) fn let_go(commands: &mut Commands, piece: Entity, now: Duration) {
    commands.entity(piece).try_insert(Fading(now));
}
