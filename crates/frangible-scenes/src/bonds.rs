//! Mortar between bodies whose faces touch.

use frangible::glam::Vec3;
use frangible_rapier::{BreakableWorld, Mortar};

use crate::error::SceneError;
use crate::launch::vector;
use crate::stage::Placed;

/// Faces this near are bonded, m: a joint of mortar, which the bodies leave free.
const JOINT: f32 = 0.012;

/// Smallest face that is bonded, m².
const LEAST_AREA: f32 = 1e-5;

/// Bonds all bodies whose bounding boxes face each other within a joint's width; strength in Pa.
pub(crate) fn bond(
    world: &mut BreakableWorld,
    bodies: &[Placed<'_>],
    strength: f64,
) -> Result<(), SceneError> {
    let boxes: Vec<[Vec3; 2]> = bodies.iter().map(|body| body.bounds).collect();
    for (i, one) in boxes.iter().enumerate() {
        for (j, two) in boxes.iter().enumerate().skip(i + 1) {
            let Some((centre, axis, area)) = face(one, two) else {
                continue;
            };
            let ahead = two[0][axis] + two[1][axis] >= one[0][axis] + one[1][axis];
            let across = if ahead {
                Vec3::AXES[axis]
            } else {
                -Vec3::AXES[axis]
            };
            let mortar = Mortar {
                centre: vector(centre),
                normal: vector(across),
                area,
                strength: strength as f32,
            };
            world.insert_mortar(bodies[i].handle, bodies[j].handle, mortar)?;
        }
    }
    Ok(())
}

/// Middle, axis and area of the face that two boxes share, if they do.
fn face(one: &[Vec3; 2], two: &[Vec3; 2]) -> Option<(Vec3, usize, f32)> {
    let (low, high) = (one[0].max(two[0]), one[1].min(two[1]));
    let overlap = high - low;
    // Along one axis there is a gap, or a touch; along the others the boxes overlap.
    let axis = (0..3).find(|&k| overlap[k] <= 1e-4 && overlap[k] >= -JOINT)?;
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let area = overlap[u].max(0.0) * overlap[v].max(0.0);
    (area >= LEAST_AREA).then(|| (0.5 * (low + high), axis, area))
}
