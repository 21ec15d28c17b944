//! Rest: a piece that stays in its place may sleep.
//!
//! Avian lets a body sleep that is slower than a threshold in every step of half a second, with all that it touches. A jagged piece stands on corners that
//! take turns, so that single steps exceed any threshold while the piece goes nowhere, and a piece of some millimetres turns fast by next to nothing. One
//! such piece keeps a whole heap awake. Here a piece that touches something and of which no point went farther than [`DRIFT`] within [`TIME`] may sleep. In
//! a heap of hundreds some piece always creeps, pushed by the rounding of its contacts: one that has not been faster than [`MOVES`] for seconds may creep
//! farther, up to [`PATIENCE`] times as far.

use avian3d::prelude::*;
use bevy::prelude::*;

use crate::{Broken, FragmentOf};

/// Time that a piece has to stay in its place before it may sleep, s.
const TIME: f32 = 0.4;

/// Distance within which it stays, m.
const DRIFT: f32 = 3e-3;

/// A piece that leaves its place with a mean speed above this moves, and one below creeps, m/s.
const MOVES: f32 = 0.1;

/// Time for which a piece may touch nothing, s: one that rocks hops. One that falls is 5 mm away by then, and on its way.
const HOP: f32 = 0.03;

/// Time for which a piece that was woken stays awake, s: one that nothing carries any longer is on its way by then.
const WOKEN: f32 = 0.1;

/// Multiple of the drift that a piece may have in the end, after one second of creeping for each one.
const PATIENCE: f32 = 6.0;

/// Thresholds of a piece that stays, m/s at a length unit of one and rad/s: more than corners that take turns.
const LENIENT: SleepThreshold = SleepThreshold {
    linear: 1.0,
    angular: 1e3,
};

/// Place that a piece has kept of late.
#[derive(Component, Clone, Copy, Debug, Default)]
pub(super) struct Place {
    at: Vec3,
    turn: Quat,
    since: f32,
    /// Time since it moved, and since it touched anything, s.
    calm: f32,
    apart: f32,
    /// The piece's own thresholds while it has the lenient ones.
    own: Option<SleepThreshold>,
}

impl Place {
    /// The longest way that a point of the piece may have gone since it came to this place, m. `reach`: its farthest point from its centre, m.
    fn way(&self, at: Vec3, turn: Quat, reach: f32) -> f32 {
        let half_sine = (turn * self.turn.inverse()).xyz().length();
        let way = (at - self.at).length();
        way + 2.0 * half_sine * reach
    }
}

/// Lets pieces sleep that stay in their place.
pub(super) fn settle(
    mut pieces: Query<
        (
            Entity,
            &RigidBody,
            (&Position, &Rotation, &Collider, Has<Sleeping>),
            &mut Place,
            (&mut SleepThreshold, &mut SleepTimer),
        ),
        (With<FragmentOf>, Without<Broken>),
    >,
    (contacts, to_sleep): (Res<ContactGraph>, Res<TimeToSleep>),
    time: Res<Time<Fixed>>,
) {
    let dt = time.timestep().as_secs_f32();
    for (entity, kind, (at, turn, collider, asleep), mut place, (mut threshold, mut timer)) in
        &mut pieces
    {
        // A piece that may not sleep says so by a negative threshold.
        if !kind.is_dynamic() || threshold.linear < 0.0 || threshold.angular < 0.0 {
            continue;
        }
        if asleep {
            place.since = place.since.min(TIME - WOKEN);
            continue;
        }
        let bounds = collider.shape_scaled().compute_local_bounding_sphere();
        let reach = Vec3::from_array(bounds.center.to_array()).length() + bounds.radius;
        let touches = || {
            contacts
                .contact_pairs_with(entity)
                .any(ContactPair::is_touching)
        };
        let way = place.way(at.0, turn.0, reach);
        place.apart = if touches() { 0.0 } else { place.apart + dt };
        if way > DRIFT * (1.0 + place.calm).min(PATIENCE) || place.apart > HOP {
            if way > MOVES * (place.since + dt) {
                place.calm = 0.0;
            }
            place.calm += dt;
            if let Some(own) = place.own.take() {
                *threshold = own;
            }
            (place.at, place.turn, place.since) = (at.0, turn.0, 0.0);
            continue;
        }
        (place.since, place.calm) = (place.since + dt, place.calm + dt);
        if place.since < TIME {
            continue;
        }
        if place.own.is_none() {
            place.own = Some(*threshold);
            *threshold = LENIENT;
        }
        timer.0 = timer.0.max(to_sleep.0);
    }
}
