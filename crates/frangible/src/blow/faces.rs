//! Faces of pieces that press on each other when they close: at the four corners of their common outline.

use glam::{DMat3, DVec3};

use super::groups::Groups;
use super::parted::{SIX, outer, wrench};
use crate::body::Body;
use crate::mesh::FACES;

/// Least flatness of faces that press: length of their vector area over their area. It is 1 for a flat face, 1/2 for a crater that is half a ball,
/// and 0 for the side of a plug that nothing holds along its axis.
const FLAT: f64 = 0.25;

/// Corner of the common outline of two groups' faces, at which they press on each other when they close.
#[derive(Clone, Debug)]
pub(super) struct Corner {
    /// For both sides, number of the first of six unknowns, and the gap per unit of each of these. The reference has none.
    sides: [Option<(usize, [f64; SIX])>; 2],
    /// Stiffness of its spring, N/m.
    pub(super) stiffness: f64,
    /// Face, as its two groups, and number of the corner in it.
    of: ([u32; 2], usize),
}

impl Corner {
    /// Returns true if `other` is the same corner of the same face, with the same stiffness.
    pub(super) fn is(&self, other: &Self) -> bool {
        self.of == other.of && self.stiffness.to_bits() == other.stiffness.to_bits()
    }

    fn sides(&self) -> impl Iterator<Item = &(usize, [f64; SIX])> {
        self.sides.iter().flatten()
    }

    /// Gap for these unknowns, m.
    #[inline(always)]
    pub(super) fn gap(&self, unknowns: &[f64]) -> f64 {
        let of_side = |(first, row): &(usize, [f64; SIX])| {
            let own = unknowns[*first..first + SIX].iter().zip(row);
            own.map(|(c, g)| c * g).sum::<f64>()
        };
        self.sides().map(of_side).sum()
    }

    /// Adds the push of a force that opens the gap, N, on each unknown.
    #[inline(always)]
    pub(super) fn push(&self, force: f64, unknowns: &mut [f64]) {
        for (first, row) in self.sides() {
            let own = unknowns[*first..first + SIX].iter_mut().zip(row);
            own.for_each(|(b, g)| *b += force * g);
        }
    }
}

/// The face between two groups: vector area from the first to the second, area, and moments of the area.
struct Face {
    between: [u32; 2],
    across: DVec3,
    area: f64,
    first: DVec3,
    second: DMat3,
}

/// Corners of all faces between groups that can press. `mixed`: the tetrahedra that have nodes of several groups.
pub(super) fn corners(
    body: &Body,
    groups: &Groups,
    centres: &[DVec3],
    mixed: &[u32],
) -> Vec<Corner> {
    let material = &body.asset.material;
    let nu = material.poisson_ratio;
    let modulus = material.youngs_modulus / (1.0 - nu * nu);
    let mut corners = Vec::new();
    for face in faces(body, groups, mixed) {
        let across = face.across.length();
        if across < FLAT * face.area {
            continue;
        }
        let normal = face.across / across;
        let centre = face.first / face.area;
        let spread = face.second * (1.0 / face.area) - outer(centre);
        for (k, at) in outline(normal, centre, spread).into_iter().enumerate() {
            let side = |sign: f64, group: u32| {
                let g = (group as usize).checked_sub(1)?;
                Some((SIX * g, wrench(sign * normal, at - centres[g])))
            };
            let [first, second] = face.between;
            corners.push(Corner {
                of: (face.between, k),
                sides: [side(-1.0, first), side(1.0, second)],
                // The compliance of an edge of the outline is some 4/(E' × its length), and it has two corners.
                stiffness: modulus * face.area.sqrt() / 8.0,
            });
        }
    }
    corners
}

/// The four corners of the rectangle that has these second moments.
fn outline(normal: DVec3, centre: DVec3, spread: DMat3) -> [DVec3; 4] {
    let (e, f) = normal.any_orthonormal_pair();
    let (a, b, c) = (e.dot(spread * e), e.dot(spread * f), f.dot(spread * f));
    let turn = 0.5 * libm::atan2(2.0 * b, a - c);
    let (sin, cos) = libm::sincos(turn);
    let half = |axis: DVec3| axis * (3.0 * axis.dot(spread * axis)).max(0.0).sqrt();
    let (u, v) = (half(cos * e + sin * f), half(cos * f - sin * e));
    [u + v, u - v, v - u, -u - v].map(|d| centre + d)
}

/// The faces between groups. Let χ be 1 at the nodes of a group and 0 at others: then volume × ∇χ of a tetrahedron is the area with which the
/// group's side passes through it.
fn faces(body: &Body, groups: &Groups, mixed: &[u32]) -> Vec<Face> {
    let mesh = &body.asset.fracture;
    let mut faces: Vec<Face> = Vec::new();
    for tet in mixed.iter().map(|&tet| tet as usize) {
        let of = mesh.tets[tet].map(|v| groups.of_node[v as usize]);
        let corners = mesh.tets[tet].map(|v| mesh.positions[v as usize].as_dvec3());
        let gradients = FACES.map(|face| {
            let [a, b, c] = face.map(|i| corners[i]);
            (b - a).cross(c - a) / -6.0
        });
        let side = |group: u32| -> DVec3 {
            (0..4)
                .filter(|&n| of[n] == group)
                .map(|n| gradients[n])
                .sum()
        };
        let at = body.prepared.centroids[tet].as_dvec3();
        for i in 0..4 {
            for j in 0..4 {
                let first = !of[..i].contains(&of[i]) && !of[..j].contains(&of[j]);
                if of[i] < of[j] && first {
                    let across = 0.5 * (side(of[j]) - side(of[i]));
                    grow(&mut faces, [of[i], of[j]], across, at);
                }
            }
        }
    }
    faces
}

/// Adds a part to the face between two groups.
fn grow(faces: &mut Vec<Face>, between: [u32; 2], across: DVec3, at: DVec3) {
    let known = faces.iter().position(|face| face.between == between);
    let place = known.unwrap_or_else(|| {
        faces.push(Face {
            between,
            across: DVec3::ZERO,
            area: 0.0,
            first: DVec3::ZERO,
            second: DMat3::ZERO,
        });
        faces.len() - 1
    });
    let (face, area) = (&mut faces[place], across.length());
    face.across += across;
    face.area += area;
    face.first += area * at;
    face.second += outer(at) * area;
}
