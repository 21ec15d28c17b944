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
use super::touching::drawn_share;
use crate::body::SoundBody;
use crate::error::SoundError;
use crate::pulse::{Drive, SoundPulse};
use crate::strike::{CRACK_SPEED, Strike, pole};
use crate::synth::Synth;

/// Places on a piece at which its motion is taken.
const PLACES: usize = 64;

/// Shortest time in which a piece comes loose, s.
const SHORTEST: f64 = 5e-6;

/// Velocities of the modes of a body, √(2 J), some seconds after pulses began, which act with these modal forces per newton, 1/√kg.
pub(super) fn velocities(
    body: &SoundBody,
    pulses: &[(Arc<SoundPulse>, Vec<f32>)],
    after: f64,
) -> Vec<f32> {
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
    for piece in blow.pieces.clone() {
        let (id, body) = nodes.ready(synth, cast, piece, blow.time)?;
        let kept = kept(nodes, cast, blow, (piece, &body), moving);
        let square: f64 = kept.iter().map(|&v| f64::from(v).powi(2)).sum();
        // As large as the momentum of a mass that has this energy, by which strikes are chosen where there are too many.
        let impulse = (body.mass * square).sqrt();
        if !(impulse > 0.0 && impulse.is_finite()) {
            continue;
        }
        let push = kept.iter().map(|&v| (f64::from(v) / impulse) as f32);
        let duration = (2.0 * body.sphere.radius / speed).max(SHORTEST);
        let strike = Strike {
            pulse: Arc::new(SoundPulse::half_sine(impulse, duration)),
            push: push.collect(),
            direction: Vec3::ZERO,
        };
        synth.strike(blow.time + apart, id, strike)?;
    }
    Ok(())
}

/// Velocities that the modes of a piece keep of those of the body, √(2 J).
fn kept(
    nodes: &Nodes,
    cast: &dyn Cast,
    blow: &RecordedBlow,
    (piece, body): (usize, &SoundBody),
    moving: &[f32],
) -> Vec<f32> {
    let mut kept = vec![0.0_f32; body.modes.len()];
    let places = places(cast, piece);
    let [parent, pose] = [blow.node, piece].map(|node| cast.pose(node, blow.time));
    let turn = pose.rotation.normalize().inverse() * parent.rotation.normalize();
    let motion = places.iter().map(|&place| {
        let at = carried(place, &pose, &parent);
        (turn * nodes.motion(blow.node, at, moving)).as_dvec3()
    });
    let mut motion: Vec<DVec3> = motion.collect();
    take_rigid_motion(&places, &mut motion);
    // Each place stands for as much of the mass.
    let mass = (body.mass / places.len().max(1) as f64) as f32;
    for (&place, motion) in places.iter().zip(&motion) {
        let push = nodes.push(piece, place, motion.as_vec3());
        for (sum, push) in kept.iter_mut().zip(push) {
            *sum += mass * push;
        }
    }
    // The modes of a plate of its size are not quite those of a piece: they get no more energy than there is.
    let there: f64 = motion.iter().map(|v| v.length_squared()).sum();
    let there = mass * there as f32;
    let found: f32 = kept.iter().map(|v| v * v).sum();
    if found > there {
        let share = (there / found).sqrt();
        kept.iter_mut().for_each(|v| *v *= share);
    }
    kept
}

/// Places on the surface of a piece in its frame, each of which stands for as much of its area. They are drawn, lest they fall into step with the
/// rows of a mesh.
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
        let drawn = |place: usize| place as f64 + drawn_share([piece as u64, place as u64, 0]);
        while places.len() < PLACES && sum > drawn(places.len()) * each {
            let [a, b, c] = corners(triangle);
            places.push((a + b + c) / 3.0);
        }
    }
    places
}

/// Takes the motion of a rigid body that comes closest to a field from it.
fn take_rigid_motion(places: &[Vec3], field: &mut [DVec3]) {
    let count = places.len().max(1) as f64;
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
    use frangible::{Breakable, Material};
    use frangible_bake::{BakeSpec, Shape, bake};
    use frangible_recording::Pose;

    use super::*;
    use crate::config::SynthConfig;
    use crate::listener::Listener;
    use crate::scene::cast::Sounding;

    /// A plate of glass of 240 × 100 × 4 mm, node 0, and its halves, nodes 1 and 2.
    struct Plates {
        soundings: Vec<Sounding>,
        vertices: Vec<Vec3>,
    }

    const LONG: f32 = 0.24;

    impl Cast for Plates {
        fn name(&self, _: usize) -> &str {
            "plate"
        }
        fn sounding(&self, node: usize) -> &Sounding {
            &self.soundings[node]
        }
        fn vertices(&self, _: usize) -> &[Vec3] {
            &self.vertices
        }
        fn triangles(&self, _: usize) -> Vec<[u32; 3]> {
            // Both faces, in even cells of the grid of the vertices.
            let cell = |i: u32, j: u32| {
                let a = i * 17 + j;
                [[a, a + 1, a + 17], [a + 1, a + 18, a + 17]]
            };
            let faces = (0..16).flat_map(|i| (0..16).flat_map(move |j| cell(i, j)));
            let both = faces.flat_map(|[a, b, c]| [[a, b, c], [a + 289, c + 289, b + 289]]);
            both.collect()
        }
        fn balls(&self, _: f64) -> Vec<usize> {
            Vec::new()
        }
        fn pose(&self, node: usize, _: f64) -> Pose {
            let x = [0.0, -0.25, 0.25][node] * LONG;
            Pose {
                translation: Vec3::new(x, 0.0, 0.0),
                ..Pose::default()
            }
        }
        fn floor(&self) -> Option<f32> {
            None
        }
    }

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

    #[test]
    fn halves_keep_a_part_of_the_energy_and_nothing_of_a_rigid_motion() {
        let glass = Material::preset("glass").expect("known");
        let spec = BakeSpec {
            modes: 12,
            followed: Some(12),
            ..BakeSpec::new("plate", Shape::plate(0.24, 0.1, 0.004), glass.clone())
        };
        let asset = bake(&spec).expect("a bake");
        let body = Breakable::uniform(Arc::new(asset)).expect("a kind").body(1);
        let mass = body.asset().mass().mass;
        let half = Sounding::Piece(glass, 0.5 * mass);
        let grid = |z: f32| {
            let at = |k: usize, side: f32| side * (k as f32 / 16.0 - 0.5);
            (0..17).flat_map(move |i| {
                (0..17).map(move |j| Vec3::new(at(i, 0.5 * LONG), at(j, 0.1), z))
            })
        };
        let cast = Plates {
            soundings: vec![Sounding::Modes(body), half.clone(), half],
            vertices: grid(-0.002).chain(grid(0.002)).collect(),
        };
        let listener = Listener::at(DVec3::Z, DVec3::ZERO);
        let mut synth = Synth::new(SynthConfig::new(listener)).expect("a configuration");
        let mut nodes = Nodes::default();
        let blow = RecordedBlow {
            pieces: 1..3,
            ..RecordedBlow::default()
        };
        let bodies = [0, 1, 2].map(|node| {
            let ready = nodes.ready(&mut synth, &cast, node, 0.0);
            ready.expect("ready").1
        });
        let (mut all, mut of_first) = (0.0, 0.0);
        for mode in 0..bodies[0].modes.len() {
            let mut moving = vec![0.0; bodies[0].modes.len()];
            moving[mode] = 1.0;
            let kept = [1, 2].map(|piece| {
                let kept = kept(&nodes, &cast, &blow, (piece, &bodies[piece]), &moving);
                kept.iter().map(|v| v * v).sum::<f32>()
            });
            println!("{:.0} Hz: {kept:?}", bodies[0].modes[mode].frequency);
            // Both halves are alike, and together have no more than there was, but for the places that were drawn.
            assert!((kept[0] - kept[1]).abs() < 0.15, "{kept:?}");
            assert!(kept[0] + kept[1] < 1.15, "{kept:?}");
            all += kept[0] + kept[1];
            of_first += if mode == 0 { kept[0] + kept[1] } else { 0.0 };
        }
        // Halves of the plate's longest wave mostly turn; of shorter ones they keep much.
        let mean = all / bodies[0].modes.len() as f32;
        assert!(
            (0.2..1.0).contains(&mean) && of_first < 0.3,
            "{mean} {of_first}"
        );
    }

    #[test]
    fn a_blow_that_is_over_leaves_the_velocity_of_a_free_swing() {
        let glass = Material::preset("glass").expect("known");
        let plate = crate::plate::PlateMaterial {
            youngs_modulus: glass.youngs_modulus,
            poisson_ratio: glass.poisson_ratio,
            density: glass.density,
            damping: crate::damping::AudibleDamping::default(),
        };
        let sides = [0.1, 0.08, 0.003];
        let made = crate::plate::Plate::new("plate", sides, glam::DQuat::IDENTITY, &plate);
        let (shape, body) = made.expect("a plate");
        let push = shape.push(Vec3::new(0.05, 0.04, 0.0), Vec3::Z);
        let pulses = [(Arc::new(SoundPulse::half_sine(0.1, 1e-6)), push.clone())];
        let mode = &body.modes[0];
        let swing = std::f64::consts::TAU * mode.frequency;
        for after in [1e-6, 1.3e-4, 7e-4] {
            let found = f64::from(velocities(&body, &pulses, after)[0]);
            let decay = (-0.5 * mode.loss * after).exp();
            let wanted = 0.1 * f64::from(push[0]) * decay * (swing * after).cos();
            let off = (found - wanted).abs() / (0.1 * f64::from(push[0]).abs());
            assert!(off < 0.01, "{found} of {wanted}");
        }
        assert!(velocities(&body, &[], 1.0).iter().all(|&v| v == 0.0));
    }
}
