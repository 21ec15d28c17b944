//! Moves vertices of bad tetrahedra to where their worst angle is better: interior ones freely, those of the surface
//! along it, those on sharp features not at all.

use glam::DVec3;

use crate::solid::Solid;
use crate::tets::Draft;
use crate::tets::adjacency::Around;
use crate::tets::local::{badness, badness_around};

/// Sweeps over the bad tetrahedra; later ones change nothing that can be seen.
const SWEEPS: usize = 6;

/// The axes, their opposites and the eight diagonals of a cube.
fn directions() -> [DVec3; 14] {
    let mut all = [DVec3::ZERO; 14];
    for k in 0..3 {
        all[2 * k][k] = 1.0;
        all[2 * k + 1][k] = -1.0;
    }
    for c in 0..8 {
        let sign = |k: usize| if c >> k & 1 == 0 { 1.0 } else { -1.0 };
        all[6 + c] = DVec3::new(sign(0), sign(1), sign(2)) / 3.0_f64.sqrt();
    }
    all
}

/// Works on tetrahedra with an angle below `angle` (or above 180° − `angle`), degrees; `cell` is the size of a step, m.
pub(crate) fn improve(draft: &mut Draft, fixed: &[bool], solid: &dyn Solid, cell: f64, angle: f64) {
    let limit = angle.to_radians().cos();
    let around = Around::new(draft.body.positions.len(), &draft.body.tets);
    let directions = directions();
    for sweep in 0..SWEEPS {
        let bad = (0..draft.body.tets.len()).filter(|&e| badness(draft.body.corners(e)) > limit);
        let mut vertices: Vec<u32> = bad.flat_map(|e| draft.body.tets[e]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut moved = false;
        for v in vertices.into_iter().filter(|&v| !fixed[v as usize]) {
            let here = draft.body.positions[v as usize];
            let mut best = (
                badness_around(&draft.body, &around, v, here, f64::INFINITY),
                here,
            );
            for scale in [0.25, 0.1, 0.04] {
                let step = scale * cell / (1 + sweep) as f64;
                let from = best.1;
                for d in directions {
                    let mut place = from + step * d;
                    if draft.on_surface[v as usize] {
                        let near = solid.closest(place).position;
                        if near.distance(place) > step {
                            continue;
                        }
                        place = near;
                    }
                    let b = badness_around(&draft.body, &around, v, place, best.0);
                    if b < best.0 - 1e-4 {
                        best = (b, place);
                    }
                }
            }
            moved |= best.1 != here;
            draft.body.positions[v as usize] = best.1;
        }
        if !moved {
            break;
        }
    }
}
