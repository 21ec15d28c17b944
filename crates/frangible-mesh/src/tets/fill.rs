//! Gives a body the volume of its solid.
//!
//! The surface's triangles are chords of it: on a ball they lie inside, and the body is 0.3 to 3 % too light. Its nodes are moved along their
//! normals in proportion to how far they stand out from their neighbours, by one factor for all, until the volume is right. Flat faces and
//! sharp edges stay where they are, hollow ones move into the body.

use glam::DVec3;

use crate::quality::{dihedral_range, volume};
use crate::tets::{Draft, TetBody};

/// Largest move, as a share of how far a node stands out; a chord of a circle needs a sixth to a third.
const MOST: f64 = 1.0;

/// Angle between a face and the normal of its node up to which the surface there is smooth, and from which it is sharp, rad. An edge that
/// the lattice cut off is no curve, and its nodes must not stand out to make up for it.
const SMOOTH: f64 = 20.0 * std::f64::consts::PI / 180.0;
const SHARP: f64 = 40.0 * std::f64::consts::PI / 180.0;

/// Times that nodes of tetrahedra which would become too flat are held back.
const ROUNDS: usize = 4;

/// Steps to the factor: the volume is almost linear in it.
const STEPS: usize = 6;

/// Share of the volume that may be off in the end.
const NEAR: f64 = 1e-9;

/// Moves surface nodes that are not `fixed` until the volume is `wanted`, m³; returns true if it is. No dihedral angle falls below `angle`,
/// degrees; where that cannot be had, nothing moves.
pub(crate) fn fill(draft: &mut Draft, fixed: &[bool], wanted: f64, angle: f64) -> bool {
    let mut moves = standing_out(&draft.body, fixed);
    let start = draft.body.positions.clone();
    for _ in 0..ROUNDS {
        let found = reach(&mut draft.body, &start, &moves, wanted);
        if !found {
            break;
        }
        let body = &draft.body;
        let flat = (0..body.tets.len()).filter(|&e| dihedral_range(body.corners(e)).0 < angle);
        let flat: Vec<usize> = flat.collect();
        if flat.is_empty() {
            return true;
        }
        for v in flat.into_iter().flat_map(|e| draft.body.tets[e]) {
            moves[v as usize] = DVec3::ZERO;
        }
    }
    draft.body.positions = start;
    false
}

/// For each node how far it stands out from its neighbours on the surface, along its normal, m; less where the surface is nearly sharp.
fn standing_out(body: &TetBody, fixed: &[bool]) -> Vec<DVec3> {
    let count = body.positions.len();
    let mut normal = vec![DVec3::ZERO; count];
    let mut sum = vec![DVec3::ZERO; count];
    let mut number = vec![0.0; count];
    let faces = body.boundary();
    let area = |face: [u32; 3]| {
        let [a, b, c] = face.map(|v| body.positions[v as usize]);
        (b - a).cross(c - a)
    };
    for &(face, _) in &faces {
        let corners = face.map(|v| body.positions[v as usize]);
        for k in 0..3 {
            let v = face[k] as usize;
            normal[v] += area(face);
            // Each neighbour comes with two of the triangles.
            sum[v] += corners[(k + 1) % 3] + corners[(k + 2) % 3];
            number[v] += 2.0;
        }
    }
    let mut smooth = vec![1.0_f64; count];
    for &(face, _) in &faces {
        let own = area(face);
        for v in face.map(|v| v as usize) {
            let share = (own.angle_between(normal[v]) - SMOOTH) / (SHARP - SMOOTH);
            smooth[v] = smooth[v].min(1.0 - share);
        }
    }
    (0..count)
        .map(|v| {
            if fixed[v] || number[v] == 0.0 {
                return DVec3::ZERO;
            }
            let normal = normal[v].normalize_or_zero();
            let out = (body.positions[v] - sum[v] / number[v]).dot(normal);
            smooth[v].max(0.0) * out * normal
        })
        .collect()
}

/// Moves the nodes by the factor that gives the volume; returns true if there is one.
fn reach(body: &mut TetBody, start: &[DVec3], moves: &[DVec3], wanted: f64) -> bool {
    let mut with = |factor: f64| {
        for (p, (from, by)) in body.positions.iter_mut().zip(start.iter().zip(moves)) {
            *p = *from + factor * *by;
        }
        let volumes = (0..body.tets.len()).map(|e| volume(body.corners(e)));
        volumes.sum::<f64>() - wanted
    };
    let (mut before, mut at_before) = (0.0, with(0.0));
    if at_before.abs() <= NEAR * wanted {
        return true;
    }
    let mut factor = 0.2;
    for _ in 0..STEPS {
        let off = with(factor);
        if off.abs() <= NEAR * wanted {
            return true;
        }
        let next = factor - off * (factor - before) / (off - at_before);
        if next.is_nan() || next.abs() > MOST {
            return false;
        }
        (before, at_before) = (factor, off);
        factor = next;
    }
    with(factor).abs() <= NEAR * wanted
}
