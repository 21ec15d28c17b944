//! Takes the lattice out of the mesh: cracks start and end at elements, so a lattice would show in them.

use frangible_geometry::Rows;
use glam::DVec3;

use crate::random::symmetric;
use crate::solid::Solid;
use crate::tets::Draft;
use crate::tets::local::badness_around;

/// Largest move, as a share of the cell.
const AMOUNT: f64 = 0.22;
/// A move must not leave an angle below this, degrees, nor make one worse that is below it already.
const ANGLE: f64 = 16.0;

/// Moves every vertex that is not `fixed` by up to a fifth of a cell, those of the surface along it.
pub(crate) fn jitter(draft: &mut Draft, fixed: &[bool], solid: &dyn Solid, cell: f64, seed: u64) {
    let around = Rows::inverse(draft.body.positions.len(), &draft.body.tets);
    let limit = ANGLE.to_radians().cos();
    for v in (0..draft.body.positions.len() as u32).filter(|&v| !fixed[v as usize]) {
        let here = draft.body.positions[v as usize];
        let random = DVec3::from_array(std::array::from_fn(|k| {
            symmetric(seed, 3 * u64::from(v) + k as u64)
        }));
        let now = badness_around(&draft.body, &around, v, here, f64::INFINITY);
        for scale in [1.0, 0.5] {
            let mut place = here + scale * AMOUNT * cell * random;
            if draft.on_surface[v as usize] {
                let Some(near) = solid.foot(place, 0.5 * cell) else {
                    continue;
                };
                place = near;
            }
            let then = badness_around(&draft.body, &around, v, place, f64::INFINITY);
            if then < limit.max(now) {
                draft.body.positions[v as usize] = place;
                break;
            }
        }
    }
}
