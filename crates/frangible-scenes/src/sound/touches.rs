//! The sound of pieces that touch each other, what lies about, and the floor.

use std::f64::consts::PI;
use std::sync::Arc;

use frangible::Material;
use frangible_export::RecordedTouch;
use frangible_sound::{Pulse, SoundError, Strike, Synth};

use super::nodes::Nodes;
use super::place;
use crate::recorder::Sounding;
use crate::result::Run;

/// A touch so soon after a blow on the same node, s, is that blow: a step of the physics in which pieces may break.
const SAME: f64 = 1.5 / 240.0;

/// Radius of curvature where pieces touch, as a share of the radius of a ball of their mass: shards touch with their edges. The duration goes with
/// its fifth root, so that a factor of ten changes it by 1.6.
const EDGE: f64 = 0.2;

/// Lets a touch be heard by both that touch.
pub(super) fn touches(
    synth: &mut Synth,
    nodes: &mut Nodes<'_>,
    run: &Run,
    floor: Option<&Material>,
    touch: &RecordedTouch,
) -> Result<(), SoundError> {
    let (first, second) = touch.nodes;
    let recording = &run.recording;
    let struck = recording.blows.iter().any(|blow| {
        let same = blow.node == first || Some(blow.node) == second;
        same && (touch.time - blow.time).abs() < SAME
    });
    if struck || touch.impulse <= 0.0 {
        return Ok(());
    }
    let own = [Some(first), second].map(|node| node.map(|n| (mass(run, n), nodes.material(n))));
    let duration = hertz(touch.impulse, own, floor);
    let pulse = Arc::new(Pulse::half_sine(touch.impulse, duration));
    for (node, sign) in [(Some(first), 1.0), (second, -1.0)] {
        let Some(node) = node else {
            synth.thump(touch.time, place(touch.point), Arc::clone(&pulse))?;
            continue;
        };
        let id = nodes.ready(synth, node, touch.time)?;
        let pose = nodes.pose(node, touch.time);
        let back = pose.rotation.normalize().inverse();
        let (point, direction) = (
            back * (touch.point - pose.translation),
            back * (touch.normal * sign),
        );
        let strike = Strike {
            pulse: Arc::clone(&pulse),
            push: nodes.push(node, point, direction),
            direction,
        };
        synth.strike(touch.time, id, strike)?;
    }
    Ok(())
}

/// Mass of a node, kg.
fn mass(run: &Run, node: usize) -> f64 {
    match &run.soundings[node] {
        Sounding::Modes(body) => body.asset().mass.mass,
        Sounding::Piece(_, mass) | Sounding::Ball(_, _, mass) => *mass,
    }
}

/// Hertz' duration of a collision with an impulse, N·s, of two bodies, or of one with the floor, s: 2.87 (m²/(E*² R v))^{1/5}, with the
/// speed that gives the impulse when nothing bounces.
fn hertz(impulse: f64, bodies: [Option<(f64, &Material)>; 2], floor: Option<&Material>) -> f64 {
    let (mut weight, mut curvature, mut give) = (0.0, 0.0, 0.0);
    for body in bodies {
        match body {
            Some((mass, material)) => {
                weight += 1.0 / mass;
                let ball = (3.0 * mass / (4.0 * PI * material.density)).cbrt();
                curvature += 1.0 / (EDGE * ball);
                give += 1.0 / material.contact_modulus();
            }
            None => give += floor.map_or(0.0, |floor| 1.0 / floor.contact_modulus()),
        }
    }
    let mass = 1.0 / weight;
    let speed = (impulse / mass).max(1e-3);
    let stiff = mass * mass * give * give * curvature / speed;
    // What lasts longer makes no sound.
    (2.87 * stiff.powf(0.2)).clamp(5e-6, 0.02)
}
