//! The worst angle around a vertex, for a place it might move to.

use frangible_geometry::Rows;
use glam::DVec3;

use crate::quality::dihedral_cosines;
use crate::tets::TetBody;

/// Badness of a tetrahedron: the cosine of the smallest dihedral angle, or of 180° minus the largest, whichever is worse.
/// Lies in −1..=1; smaller is better.
pub(crate) fn badness(x: [DVec3; 4]) -> f64 {
    let (smallest, largest) = dihedral_cosines(x);
    smallest.max(-largest)
}

/// Badness of all tetrahedra around `v` when it is moved to `place`; stops early once it exceeds `limit`.
pub(crate) fn badness_around(
    body: &TetBody,
    around: &Rows,
    v: u32,
    place: DVec3,
    limit: f64,
) -> f64 {
    let mut worst = -1.0_f64;
    for &e in around.of(v) {
        let tet = body.tets[e as usize];
        let corners = tet.map(|u| {
            if u == v {
                place
            } else {
                body.positions[u as usize]
            }
        });
        worst = worst.max(badness(corners));
        if worst >= limit {
            break;
        }
    }
    worst
}

/// Cosine of the smallest dihedral angle alone, around `v` moved to `place`.
pub(crate) fn sharpest_around(body: &TetBody, around: &Rows, v: u32, place: DVec3) -> f64 {
    around
        .of(v)
        .iter()
        .map(|&e| {
            let tet = body.tets[e as usize];
            dihedral_cosines(tet.map(|u| {
                if u == v {
                    place
                } else {
                    body.positions[u as usize]
                }
            }))
            .0
        })
        .fold(-1.0, f64::max)
}
