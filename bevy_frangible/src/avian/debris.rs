//! Pieces that rest, pieces that go, and the time of steps with them.

use std::collections::BTreeMap;
use std::time::Duration;

use avian3d::prelude::*;
use bevy::platform::time::Instant;
use bevy::prelude::*;

use crate::debris::{Fading, Heap, let_go};
use crate::{AtRest, BreakableBody, Broken, DebrisBudget, FragmentOf};

/// Steps over which their time is averaged.
const STEPS: u32 = 32;

/// Time at which a piece fell asleep, in the time of the fixed steps.
#[derive(Component)]
pub(super) struct AsleepSince(Duration);

/// Time at which the step began.
#[derive(Resource)]
pub(super) struct Began(Instant);

impl Default for Began {
    fn default() -> Self {
        Self(Instant::now())
    }
}

pub(super) fn start_clock(mut began: ResMut<Began>) {
    began.0 = Instant::now();
}

pub(super) fn stop_clock(began: Res<Began>, mut heap: ResMut<Heap>) {
    let mean = heap.step_time;
    heap.step_time = mean - mean / STEPS + began.0.elapsed() / STEPS;
}

/// Notes the time since which pieces sleep, and treats those that have slept for long as the budget says.
pub(super) fn rest(
    pieces: Query<
        (
            Entity,
            &FragmentOf,
            &RigidBody,
            Has<Sleeping>,
            Option<&AsleepSince>,
        ),
        (With<FragmentOf>, Without<Broken>, Without<Fading>),
    >,
    budget: Res<DebrisBudget>,
    time: Res<Time<Fixed>>,
    mut commands: Commands,
) {
    if budget.at_rest == AtRest::Sleep {
        return;
    }
    let now = time.elapsed();
    let mut merge: BTreeMap<Entity, Vec<Entity>> = BTreeMap::new();
    for (entity, of, kind, asleep, since) in &pieces {
        match (asleep && kind.is_dynamic(), since) {
            (true, None) => {
                commands.entity(entity).try_insert(AsleepSince(now));
            }
            (false, Some(_)) => {
                commands.entity(entity).try_remove::<AsleepSince>();
            }
            (true, Some(since)) if now.saturating_sub(since.0) >= budget.rest_time => {
                match budget.at_rest {
                    AtRest::Sleep => {}
                    AtRest::Freeze => {
                        commands.entity(entity).try_insert(RigidBody::Static);
                    }
                    AtRest::Merge => merge.entry(of.0).or_default().push(entity),
                    AtRest::Go => let_go(&mut commands, entity, now),
                }
            }
            _ => {}
        }
    }
    for (parent, pieces) in merge {
        commands.queue(move |world: &mut World| super::merge::merge(world, parent, &pieces));
    }
}

/// A piece that goes is no body any more.
pub(super) fn leave(fading: On<Add, Fading>, mut commands: Commands) {
    commands
        .entity(fading.entity)
        .try_remove::<(BreakableBody, Collider, RigidBody)>();
}
