//! Moves vertices of bad tetrahedra to where their worst angle is better: interior ones freely, those of the surface
//! along it, those on sharp features not at all.

use frangible_geometry::Rows;
use glam::DVec3;

use crate::solid::Solid;
use crate::tets::Draft;
use crate::tets::local::{badness, badness_around};

/// Sweeps over the bad tetrahedra; later ones change nothing that can be seen.
const SWEEPS: usize = 6;

/// A third of the square root of three: the components of a unit diagonal.
const D: f64 = 0.577_350_269_189_625_8;

/// The axes, their opposites and the eight diagonals of a cube.
const DIRECTIONS: [DVec3; 14] = [
    DVec3::X,
    DVec3::NEG_X,
    DVec3::Y,
    DVec3::NEG_Y,
    DVec3::Z,
    DVec3::NEG_Z,
    DVec3::new(D, D, D),
    DVec3::new(-D, D, D),
    DVec3::new(D, -D, D),
    DVec3::new(-D, -D, D),
    DVec3::new(D, D, -D),
    DVec3::new(-D, D, -D),
    DVec3::new(D, -D, -D),
    DVec3::new(-D, -D, -D),
];

/// Works on tetrahedra with an angle below `angle` (or above 180° − `angle`), degrees; `cell` is the size of a step, m.
pub(crate) fn improve(draft: &mut Draft, fixed: &[bool], solid: &dyn Solid, cell: f64, angle: f64) {
    let limit = angle.to_radians().cos();
    let around = Rows::inverse(draft.body.positions.len(), &draft.body.tets);
    for sweep in 0..SWEEPS {
        let bad = (0..draft.body.tets.len()).filter(|&e| badness(draft.body.corners(e)) > limit);
        let mut vertices: Vec<u32> = bad.flat_map(|e| draft.body.tets[e]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut moved = false;
        for v in vertices.into_iter().filter(|&v| !fixed[v as usize]) {
            for scale in [0.25, 0.1, 0.04] {
                moved |= relocate(draft, solid, &around, v, scale * cell / (1 + sweep) as f64);
            }
        }
        if !moved {
            break;
        }
    }
}

/// Moves vertex `v` by `step`, m, in the direction that helps its worst tetrahedron most, if any does.
pub(crate) fn relocate(
    draft: &mut Draft,
    solid: &dyn Solid,
    around: &Rows,
    v: u32,
    step: f64,
) -> bool {
    let here = draft.body.positions[v as usize];
    let mut best = (
        badness_around(&draft.body, around, v, here, f64::INFINITY),
        here,
    );
    for d in DIRECTIONS {
        let mut place = here + step * d;
        if draft.on_surface[v as usize] {
            let Some(near) = solid.foot(place, step) else {
                continue;
            };
            place = near;
        }
        let b = badness_around(&draft.body, around, v, place, best.0);
        if b < best.0 - 1e-4 {
            best = (b, place);
        }
    }
    draft.body.positions[v as usize] = best.1;
    best.1 != here
}
