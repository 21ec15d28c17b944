//! The sound of pieces that touch each other, other bodies, and the floor.

use std::f64::consts::PI;
use std::sync::Arc;

use frangible::Material;
use frangible_recording::RecordedTouch;
use glam::Vec3;

use super::cast::Cast;
use super::nodes::Nodes;
use super::{dice, place};
use crate::body::SoundBody;
use crate::error::SoundError;
use crate::pulse::SoundPulse;
use crate::strike::{Strike, first_push};
use crate::synth::Synth;

/// A touch so soon after a blow on the same node, s, is that blow: a step of the physics in which pieces may break.
const SAME: f64 = 1.5 / 240.0;

/// Radius of curvature where pieces touch, as a share of the radius of a ball of their mass: shards touch with their edges. The duration goes with
/// its fifth root, so that a factor of ten changes it by 1.6.
const EDGE: f64 = 0.2;

/// Longest push that makes a sound, s.
const LONGEST: f64 = 0.02;

/// One side of a touch: a node that is ready to sound, and the push on it.
pub(super) struct Side {
    pub(super) id: usize,
    body: Arc<SoundBody>,
    pub(super) push: Vec<f32>,
    /// Position at which the push acts, m, and its direction, in the node's frame.
    point: Vec3,
    pub(super) direction: Vec3,
}

/// Lets a touch be heard on both its sides.
///
/// The engine's impulse is all that a touch gives in the end, also what one piece only passes on to the next. A body that rings gives way at
/// once, so that the first push is that of the two coming together ([`first_push`]): it alone rings, and the rest comes more slowly, as long
/// as the body swings. Returns the number of dice that met something.
pub(super) fn touches(
    synth: &mut Synth,
    nodes: &mut Nodes,
    cast: &dyn Cast,
    (floor, blows): (Option<&Material>, &[(usize, f64)]),
    touch: &RecordedTouch,
) -> Result<u64, SoundError> {
    let (first, second) = touch.nodes;
    if dice::are(cast, [Some(first), second].into_iter().flatten()) {
        return dice::lands(synth, nodes, cast, floor, touch);
    }
    let struck = blows.iter().any(|&(node, time)| {
        let same = node == first || Some(node) == second;
        same && (touch.time - time).abs() < SAME
    });
    if struck || touch.impulse <= 0.0 {
        return Ok(0);
    }
    let own = [Some(first), second]
        .map(|node| node.map(|n| (cast.sounding(n).mass(), cast.sounding(n).material())));
    let mut sides = Vec::new();
    for (node, sign) in [(Some(first), 1.0), (second, -1.0)] {
        if let Some(node) = node {
            sides.push(side(synth, nodes, cast, node, touch, sign)?);
        }
    }
    let yields: f64 = sides
        .iter()
        .map(|side| side.body.yields(side.point, side.direction))
        .sum();
    let pushed: Vec<(&SoundBody, &[f32])> = (sides.iter())
        .map(|side| (&*side.body, side.push.as_slice()))
        .collect();
    let takes = |mass: f64| hertz(mass, touch.speed, own, floor);
    let (first, duration) = first_push(touch.speed, yields, &pushed, takes);
    let impulse = first.min(touch.impulse);
    let sharp = Arc::new(SoundPulse::half_sine(impulse, duration));
    let lowest = sides
        .iter()
        .filter_map(|side| side.body.modes.first())
        .map(|mode| mode.frequency)
        .fold(f64::INFINITY, f64::min);
    let swing = (0.5 / lowest).clamp(duration, LONGEST);
    let rest = Arc::new(SoundPulse::half_sine(touch.impulse - impulse, swing));
    for side in sides {
        let strike = |pulse: &Arc<SoundPulse>, push| Strike {
            pulse: Arc::clone(pulse),
            push,
            direction: side.direction,
        };
        synth.strike(touch.time, side.id, strike(&sharp, side.push))?;
        synth.strike(touch.time, side.id, strike(&rest, Vec::new()))?;
    }
    if second.is_none() {
        synth.thump(touch.time, place(touch.point), sharp)?;
        synth.thump(touch.time, place(touch.point), rest)?;
    }
    Ok(0)
}

/// A node that feels a touch, pushed along its normal or against it.
pub(super) fn side(
    synth: &mut Synth,
    nodes: &mut Nodes,
    cast: &dyn Cast,
    node: usize,
    touch: &RecordedTouch,
    sign: f32,
) -> Result<Side, SoundError> {
    let (id, body) = nodes.ready(synth, cast, node, touch.time)?;
    let pose = cast.pose(node, touch.time);
    let back = pose.rotation.normalize().inverse();
    let (point, direction) = (
        back * (touch.point - pose.translation),
        back * (touch.normal * sign),
    );
    Ok(Side {
        id,
        body,
        push: nodes.push(node, point, direction),
        point,
        direction,
    })
}

/// Hertz's duration, s, of a collision of a mass, kg, at a speed, m/s, of two bodies, or of one with the floor: 2.87 (m²/(E*² R v))^{1/5}.
pub(super) fn hertz(
    mass: f64,
    speed: f64,
    bodies: [Option<(f64, &Material)>; 2],
    floor: Option<&Material>,
) -> f64 {
    let (mut curvature, mut give) = (0.0, 0.0);
    for body in bodies {
        match body {
            Some((mass, material)) => {
                let ball = (3.0 * mass / (4.0 * PI * material.density)).cbrt();
                curvature += 1.0 / (EDGE * ball);
                give += 1.0 / material.contact_modulus();
            }
            None => give += floor.map_or(0.0, |floor| 1.0 / floor.contact_modulus()),
        }
    }
    let stiff = mass * mass * give * give * curvature / speed.max(1e-3);
    (2.87 * stiff.powf(0.2)).clamp(5e-6, LONGEST)
}
