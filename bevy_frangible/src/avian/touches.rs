//! Points at which two bodies are about to touch.

use avian3d::prelude::*;
use bevy::prelude::*;

/// Contact points nearer than this are one contact, m, if their normals have a cosine above the second number.
const ONE_PLACE: f32 = 5e-4;
const ONE_DIRECTION: f32 = 0.9;

/// A point at which two bodies are about to touch.
pub(super) struct FirstTouch {
    /// Points of contact from the centre of mass of the body that is asked, and of the other one, m, world axes.
    pub(super) anchors: [Vec3; 2],
    /// Direction of the impulse on the body that is asked.
    pub(super) normal: Vec3,
    /// Speed of approach, m/s.
    pub(super) approach: f32,
    /// Distance still to go, m.
    pub(super) gap: f32,
}

/// Points at which two bodies first touch in the coming step of `dt` s. Avian lists all points that might come near, on every part of a compound
/// collider. Those that touch later than the first belong to another time, and those at one place count as one contact.
pub(super) fn first_touches(
    pair: &ContactPair,
    flipped: bool,
    dt: f32,
    impact_speed: f32,
) -> Vec<FirstTouch> {
    let mut touches: Vec<FirstTouch> = Vec::new();
    for manifold in &pair.manifolds {
        let normal = if flipped {
            manifold.normal
        } else {
            -manifold.normal
        };
        let fast = manifold.points.iter().filter(|p| {
            let approach = -p.normal_speed;
            approach > impact_speed && approach * dt + p.penetration >= 0.0
        });
        touches.extend(fast.map(|p| FirstTouch {
            anchors: match flipped {
                false => [p.anchor1, p.anchor2],
                true => [p.anchor2, p.anchor1],
            },
            normal,
            approach: -p.normal_speed,
            gap: (-p.penetration).max(0.0),
        }));
    }
    let first = touches.iter().map(|t| t.gap / t.approach);
    let first = first.fold(f32::INFINITY, f32::min);
    touches.retain(|t| t.gap - t.approach * first <= ONE_PLACE);
    let mut merged: Vec<FirstTouch> = Vec::new();
    for touch in touches {
        let same = merged.iter().any(|m| {
            m.anchors[0].distance(touch.anchors[0]) <= ONE_PLACE
                && m.normal.dot(touch.normal) > ONE_DIRECTION
        });
        if !same {
            merged.push(touch);
        }
    }
    merged
}
