//! The inside of a contact as pictures: the strained body, its cracks, its weak points, the blow.

use std::sync::Arc;

use frangible::Asset;
use frangible::glam::Vec3;
use frangible::internals::stress::largest_eigenvalue;
use frangible_bake::mode_field::{
    ModeField, mode_on_fracture_mesh, motion_on_analysis_mesh, motion_on_fracture_mesh,
};
use frangible_recording::{Pose, SurfaceMaterial};
use frangible_scenes::{Thing, surface_cuts};

use crate::analysis::Analysis;
use crate::blow::Blow;
use crate::command::Subject;
use crate::mesher::{apart, numbered};
use crate::picture::{Batch, BatchLooks, Dot, Line, Picture};

/// Deformations are drawn so large at first that the largest displacement is this share of the body.
const TELLING: f32 = 0.06;

/// Width of the lines that cracks make on the surface, as a share of the body's reach.
const RIBBON: f32 = 0.008;

/// Their colour, linear, with opacity.
const CUT: [f32; 4] = [0.004, 0.004, 0.005, 1.0];

/// Colours, linear.
const ARROW: [f32; 3] = [0.9, 0.12, 0.05];
const WEAK: [f32; 3] = [0.05, 0.2, 0.75];
const START: [f32; 3] = [0.95, 0.35, 0.0];
const CHOSEN: [f32; 3] = [1.0, 0.55, 0.0];

fn out(pose: Pose, point: Vec3) -> Vec3 {
    pose.rotation.normalize() * point + pose.translation
}

/// Distance of a body's farthest point from its centre of mass, m.
pub(crate) fn reach(asset: &Asset) -> f32 {
    let positions = asset.fracture().positions.iter();
    positions.map(|p| p.length()).fold(1e-6, f32::max)
}

/// An exaggeration in round numbers that shows the deformation at this moment well.
pub(crate) fn telling_exaggeration(analysis: &Analysis, share: f64) -> f64 {
    let field = motion_on_analysis_mesh(&analysis.asset, analysis.amplitudes(share));
    let largest = field.largest_displacement();
    if largest <= 0.0 {
        return 1.0;
    }
    let wanted = f64::from(TELLING * reach(&analysis.asset) / largest);
    10_f64.powf(wanted.log10().floor()).max(1.0)
}

/// The body at a moment of the contact, moved as its modes are and coloured by the largest principal tension that cracks feel on its
/// surface, from 0 to the second number, Pa; with lines where cracks have cut the surface by then.
pub(crate) fn strained(
    analysis: &Analysis,
    pose: Pose,
    share: f64,
    exaggeration: f64,
) -> (Vec<Batch>, f64) {
    let asset = &analysis.asset;
    let field = motion_on_fracture_mesh(asset, analysis.amplitudes(share));
    let largest = analysis.course.peak_tension.max(1.0);
    // Tensions jump from triangle to triangle: their means at the nodes show no blotches.
    let mut tensions = vec![(0.0_f32, 0.0_f32); asset.fracture().positions.len()];
    for (triangle, stress) in analysis.surface_stress(share) {
        for &node in &asset.surface().triangles[triangle as usize] {
            let (sum, count) = &mut tensions[node as usize];
            *sum += largest_eigenvalue(&stress);
            *count += 1.0;
        }
    }
    let batch = surface(asset, &field, exaggeration as f32, pose, |node| {
        let (sum, count) = tensions[node];
        sum / count.max(1.0) / largest as f32
    });
    let place = |node: u32| {
        let node = node as usize;
        let moved = exaggeration as f32 * field.displacements[node];
        out(pose, asset.fracture().positions[node] + moved)
    };
    let mut batches = vec![batch];
    batches.extend(cuts(analysis, share, place));
    (batches, largest)
}

/// Dark ribbons where cracks have cut the surface by a moment of the contact. `place`: where a node of the fracture mesh is drawn, m.
fn cuts(analysis: &Analysis, share: f64, place: impl Fn(u32) -> Vec3) -> Option<Batch> {
    let now = analysis.course.time(share);
    let reached = analysis.cut.partition_point(|cut| cut.time <= now);
    let cuts = surface_cuts(&analysis.asset, &analysis.cut[..reached], place);
    let half = 0.5 * RIBBON * reach(&analysis.asset);
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for cut in &cuts {
        let [a, b] = cut.ends;
        let along = (b - a).normalize_or_zero();
        let (side, up) = (half * along.cross(cut.normal), half * cut.normal);
        // As much longer at both ends as it is wide, so that ribbons meet without gaps.
        let (a, b) = (a + up - half * along, b + up + half * along);
        for corner in [a - side, b - side, b + side, a - side, b + side, a + side] {
            positions.push(corner);
            normals.push(cut.normal);
        }
    }
    (!positions.is_empty()).then(|| Batch {
        looks: BatchLooks::Surface(SurfaceMaterial {
            name: "cut".into(),
            base_color: CUT,
            roughness: 1.0,
            double_sided: true,
            ..SurfaceMaterial::default()
        }),
        faces: Arc::new(numbered(positions.len())),
        positions,
        normals,
        values: Vec::new(),
        stamp: 0,
    })
}

/// A vibration mode, one swing over shares of 0..=1, coloured by tension; the second number is the largest stress at the
/// drawn amplitude, Pa.
pub(crate) fn mode(analysis: &Analysis, pose: Pose, mode: usize, share: f64) -> (Batch, f64) {
    let asset = &analysis.asset;
    let field = mode_on_fracture_mesh(asset, mode);
    let [amplitude, swing] = amplitude_and_swing(asset, &field, share);
    let stress = |node: usize| {
        let [low, high] = ends(&field, node);
        // Half a period later pressure is tension.
        if swing < 0.0 { -low } else { high }
    };
    let tensions = (0..field.stresses.len()).map(|node| {
        let [low, high] = ends(&field, node);
        high.max(-low)
    });
    let largest = tensions.fold(f32::MIN_POSITIVE, f32::max);
    let batch = surface(asset, &field, amplitude * swing, pose, |node| {
        swing.abs() * stress(node) / largest
    });
    (batch, f64::from(largest * amplitude))
}

/// Amplitude at which a mode is drawn, m·√kg, and the share of it that is reached at this moment.
fn amplitude_and_swing(asset: &Asset, field: &ModeField, share: f64) -> [f32; 2] {
    let largest = field.largest_displacement().max(f32::MIN_POSITIVE);
    let swing = (std::f64::consts::TAU * share).sin() as f32;
    [TELLING * reach(asset) / largest, swing]
}

/// Modal amplitude of a mode as it is drawn, m·√kg.
pub(crate) fn mode_amplitude(asset: &Asset, mode: usize, share: f64) -> f32 {
    let field = mode_on_fracture_mesh(asset, mode);
    let [amplitude, swing] = amplitude_and_swing(asset, &field, share);
    amplitude * swing
}

/// Smallest and largest principal stress.
fn ends(field: &ModeField, node: usize) -> [f32; 2] {
    let stress = field.stresses[node];
    let mut turned = stress;
    turned.diagonal = turned.diagonal.map(|s| -s);
    turned.off = turned.off.map(|s| -s);
    [-largest_eigenvalue(&turned), largest_eigenvalue(&stress)]
}

/// The outer surface, displaced, with a value of 0..=1 at each node.
fn surface(
    asset: &Asset,
    field: &ModeField,
    factor: f32,
    pose: Pose,
    value: impl Fn(usize) -> f32,
) -> Batch {
    let triangles = &asset.surface().triangles;
    let rotation = pose.rotation.normalize();
    let mut batch = Batch {
        looks: BatchLooks::Values,
        positions: Vec::with_capacity(3 * triangles.len()),
        normals: Vec::with_capacity(3 * triangles.len()),
        values: Vec::with_capacity(3 * triangles.len()),
        faces: Arc::new(numbered(3 * triangles.len())),
        stamp: 0,
    };
    for (triangle, normals) in triangles.iter().zip(&asset.surface().normals) {
        for (&node, &normal) in triangle.iter().zip(normals) {
            let node = node as usize;
            let at = asset.fracture().positions[node] + factor * field.displacements[node];
            batch.positions.push(out(pose, at));
            batch.normals.push(rotation * normal);
            batch.values.push(value(node).clamp(0.0, 1.0));
        }
    }
    batch
}

/// The body as a ghost, and its cracks up to a moment of the contact, coloured by time.
pub(crate) fn cracks(analysis: &Analysis, pose: Pose, share: f64) -> Vec<Batch> {
    let still = ModeField {
        displacements: vec![Vec3::ZERO; analysis.asset.fracture().positions.len()],
        stresses: Vec::new(),
    };
    let mut ghost = surface(&analysis.asset, &still, 0.0, pose, |_| 0.0);
    ghost.values.clear();
    ghost.looks = BatchLooks::Surface(SurfaceMaterial {
        name: "ghost".into(),
        base_color: [0.7, 0.75, 0.8, 0.16],
        roughness: 0.4,
        double_sided: true,
        ..SurfaceMaterial::default()
    });
    let mut colored = Batch {
        looks: BatchLooks::Values,
        positions: Vec::new(),
        normals: Vec::new(),
        values: Vec::new(),
        faces: Arc::default(),
        stamp: 0,
    };
    let now = analysis.course.moment(Subject::Cracks, share);
    let rotation = pose.rotation.normalize();
    for crack in &analysis.cracks {
        for &([a, b, c], time) in crack.triangles.iter().filter(|(_, time)| *time <= now) {
            // The share of all that came before: most cracks run in the first microseconds.
            let before = analysis.cut.partition_point(|cut| cut.time < time);
            let value = before as f32 / analysis.cut.len().max(1) as f32;
            let normal = (b - a).cross(c - a).normalize_or(Vec3::Y);
            for corner in [a, b, c] {
                colored.positions.push(out(pose, corner));
                colored.normals.push(rotation * normal);
                colored.values.push(value);
            }
        }
    }
    colored.faces = Arc::new(numbered(colored.positions.len()));
    let mut batches = vec![ghost];
    if !colored.positions.is_empty() {
        batches.insert(0, colored);
    }
    batches
}

/// Arrows along the impulses on the body, the longest half as long as the body reaches.
pub(crate) fn impulse(blow: &Blow, picture: &mut Picture) {
    let largest = blow.contacts.iter().map(|c| c.whole_impulse().length());
    let largest = largest.fold(f32::MIN_POSITIVE, f32::max);
    let longest = 0.6 * reach(blow.body.asset());
    for contact in &blow.contacts {
        let push = contact.whole_impulse() / largest * longest;
        let tip = out(blow.pose, contact.point);
        let tail = out(blow.pose, contact.point - push);
        picture.dots.push(Dot {
            at: tip,
            color: ARROW,
            size: 7.0,
        });
        let along = tip - tail;
        let side = along.cross(Vec3::Y).try_normalize().unwrap_or(Vec3::X);
        let side = 0.12 * along.length() * side;
        let barb = tip - 0.25 * along;
        for ends in [[tail, tip], [barb + side, tip], [barb - side, tip]] {
            picture.lines.push(Line {
                ends,
                color: ARROW,
                width: 3.0,
            });
        }
    }
}

pub(crate) fn weak_points(analysis: &Analysis, pose: Pose, picture: &mut Picture) {
    picture
        .dots
        .extend(analysis.weak_points.iter().map(|&at| Dot {
            at: out(pose, at),
            color: WEAK,
            size: 2.0,
        }));
}

pub(crate) fn starts(analysis: &Analysis, pose: Pose, picture: &mut Picture) {
    picture.dots.extend(analysis.cracks.iter().map(|crack| Dot {
        at: out(pose, crack.start),
        color: START,
        size: 7.0,
    }));
}

/// The edges of the box around a thing.
pub(crate) fn outline(thing: &Thing, pose: Pose, explode: f32, picture: &mut Picture) {
    let pose = apart(thing, pose, explode);
    let positions = &thing.mesh.positions;
    let low = positions.iter().fold(Vec3::INFINITY, |l, &p| l.min(p));
    let high = positions.iter().fold(Vec3::NEG_INFINITY, |h, &p| h.max(p));
    let corner = |i: usize| {
        let pick = |axis: usize| {
            if i >> axis & 1 == 0 {
                low[axis]
            } else {
                high[axis]
            }
        };
        out(pose, Vec3::new(pick(0), pick(1), pick(2)))
    };
    for i in 0..8 {
        for axis in 0..3 {
            let j = i | 1 << axis;
            if j != i {
                picture.lines.push(Line {
                    ends: [corner(i), corner(j)],
                    color: CHOSEN,
                    width: 2.0,
                });
            }
        }
    }
}
