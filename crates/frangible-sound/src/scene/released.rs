//! The vibration that a body has when it breaks, which goes on in its pieces.
//!
//! Each place of a piece keeps the velocity that it had in the body. What of it is no motion as a whole swings on in the modes of the piece, so
//! that the pieces get a part of the body's kinetic energy and no more. The bending that the pieces let go of as they part is left out: the faces of
//! their cracks still press and rub on each other then, which takes most of it.

use std::sync::Arc;

use frangible_recording::RecordedBlow;
use glam::{DMat3, DVec3, Vec3};

use super::cast::Cast;
use super::nodes::{Nodes, carried};
use crate::body::Body;
use crate::error::SoundError;
use crate::pulse::{Drive, Pulse};
use crate::strike::{CRACK_SPEED, Strike, pole};
use crate::synth::Synth;

/// Places on a piece at which its motion is taken.
const PLACES: usize = 32;

/// Shortest time in which a piece comes loose, s.
const SHORTEST: f64 = 5e-6;

/// Velocities of the modes of a body, √(2 J), some seconds after pulses began, which act with these modal forces per newton, 1/√kg.
pub(super) fn velocities(body: &Body, pulses: &[(Arc<Pulse>, Vec<f32>)], after: f64) -> Vec<f32> {
    let one = |(i, mode): (usize, &crate::body::Mode)| {
        let pole = pole(mode.frequency, mode.loss)?;
        let given = pulses.iter().map(|(pulse, push)| {
            // One step from before the pulse to now.
            let before = pulse.time_step.max(after);
            let all = Drive::new(pulse, pole, 2.0 * before, after).step();
            all.re * push.get(i).map_or(0.0, |&push| f64::from(push))
        });
        Some(given.sum::<f64>() as f32)
    };
    let modes = body.modes.iter().enumerate();
    modes.map(|mode| one(mode).unwrap_or(0.0)).collect()
}

/// Lets the pieces of a blow swing on from the time when the last of them came loose, s after the blow began. `moving`: velocities of the modes of
/// the body at that time.
pub(super) fn released(
    synth: &mut Synth,
    nodes: &mut Nodes,
    cast: &dyn Cast,
    blow: &RecordedBlow,
    moving: &[f32],
    apart: f64,
) -> Result<(), SoundError> {
    let speed = CRACK_SPEED * cast.sounding(blow.node).material().rayleigh_speed();
    let parent = cast.pose(blow.node, blow.time);
    for piece in blow.pieces.clone() {
        let (id, body) = nodes.ready(synth, cast, piece, blow.time)?;
        let places = places(cast, piece);
        if body.modes.is_empty() || places.is_empty() {
            continue;
        }
        let pose = cast.pose(piece, blow.time);
        let turn = pose.rotation.normalize().inverse() * parent.rotation.normalize();
        let motion = places.iter().map(|&place| {
            let at = carried(place, &pose, &parent);
            (turn * nodes.motion(blow.node, at, moving)).as_dvec3()
        });
        let mut motion: Vec<DVec3> = motion.collect();
        take_rigid_motion(&places, &mut motion);
        let mut push = vec![0.0_f32; body.modes.len()];
        for (&place, motion) in places.iter().zip(&motion) {
            for (sum, mode) in (push.iter_mut()).zip(nodes.push(piece, place, motion.as_vec3())) {
                *sum += mode;
            }
        }
        // Each place stands for as much of the mass.
        let mass = (body.mass / places.len() as f64) as f32;
        push.iter_mut().for_each(|velocity| *velocity *= mass);
        let duration = (2.0 * body.sphere.radius / speed).max(SHORTEST);
        let strike = Strike {
            pulse: Arc::new(Pulse::half_sine(1.0, duration)),
            push,
            direction: Vec3::ZERO,
        };
        synth.strike(blow.time + apart, id, strike)?;
    }
    Ok(())
}

/// Places on the surface of a piece in its frame, each of which stands for as much of its area.
fn places(cast: &dyn Cast, piece: usize) -> Vec<Vec3> {
    let vertices = cast.vertices(piece);
    let triangles = cast.triangles(piece);
    let corners = |triangle: &[u32; 3]| triangle.map(|corner| vertices[corner as usize]);
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = corners(triangle);
        f64::from((b - a).cross(c - a).length())
    };
    let each = triangles.iter().map(area).sum::<f64>() / PLACES as f64;
    let (mut places, mut sum) = (Vec::with_capacity(PLACES), 0.0);
    for triangle in &triangles {
        sum += area(triangle);
        while places.len() < PLACES && sum > (places.len() as f64 + 0.5) * each {
            let [a, b, c] = corners(triangle);
            places.push((a + b + c) / 3.0);
        }
    }
    places
}

/// Takes the motion of a rigid body that comes closest to a field from it.
fn take_rigid_motion(places: &[Vec3], field: &mut [DVec3]) {
    let count = places.len() as f64;
    let centre = places.iter().map(|place| place.as_dvec3()).sum::<DVec3>() / count;
    let mean = field.iter().sum::<DVec3>() / count;
    let arms = places.iter().map(|place| place.as_dvec3() - centre);
    let (mut inertia, mut turning) = (DMat3::ZERO, DVec3::ZERO);
    for (arm, motion) in arms.clone().zip(&*field) {
        let outer = DMat3::from_cols(arm * arm.x, arm * arm.y, arm * arm.z);
        inertia += DMat3::from_diagonal(DVec3::splat(arm.length_squared())) - outer;
        turning += arm.cross(*motion);
    }
    let trace = inertia.x_axis.x + inertia.y_axis.y + inertia.z_axis.z;
    // Places on one line do not turn about it, and those in one point do not turn.
    inertia += DMat3::from_diagonal(DVec3::splat(1e-9 * trace));
    let spin = if trace > 0.0 {
        inertia.inverse() * turning
    } else {
        DVec3::ZERO
    };
    for (motion, arm) in field.iter_mut().zip(arms) {
        *motion -= mean + spin.cross(arm);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rigid_motion_is_taken_whole_and_what_bends_stays() {
        let places: Vec<Vec3> = (0..32)
            .map(|i| Vec3::new(0.01 * (i % 8) as f32, 0.01 * (i / 8) as f32, 0.0))
            .collect();
        let rigid = |place: &Vec3| {
            DVec3::new(1.0, -2.0, 0.5) + DVec3::new(3.0, 20.0, -7.0).cross(place.as_dvec3())
        };
        let mut field: Vec<DVec3> = places.iter().map(rigid).collect();
        take_rigid_motion(&places, &mut field);
        assert!(field.iter().all(|motion| motion.length() < 1e-6));
        // A saddle has no part of a rigid motion.
        let saddle = |place: &Vec3| {
            let [x, y] = [place.x - 0.035, place.y - 0.015].map(f64::from);
            DVec3::new(0.0, 0.0, 1e4 * x * y)
        };
        let bent: Vec<DVec3> = places.iter().map(saddle).collect();
        let mut field: Vec<DVec3> = (places.iter().zip(&bent))
            .map(|(place, bent)| rigid(place) + *bent)
            .collect();
        take_rigid_motion(&places, &mut field);
        let off = field.iter().zip(&bent).map(|(a, b)| (*a - *b).length());
        assert!(off.fold(0.0, f64::max) < 1e-5);
    }

    #[test]
    fn places_on_a_line_or_in_one_point_give_no_nonsense() {
        for places in [
            [Vec3::ZERO, Vec3::X, 2.0 * Vec3::X],
            [Vec3::ONE, Vec3::ONE, Vec3::ONE],
        ] {
            let mut field = [DVec3::Y, DVec3::Z, DVec3::X];
            take_rigid_motion(&places, &mut field);
            assert!(field.iter().all(|motion| motion.is_finite()), "{field:?}");
        }
    }
}
