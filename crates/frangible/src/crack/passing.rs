//! Cracks in a bent wall pass each other (beyond the paper).
//!
//! Bending stretches a wall on one of its faces and presses it together on the other. A crack that opens from one face therefore leaves the
//! other face whole for a while, and a crack that opens from there runs through behind it: in a pane that was hit hard the arms of the star,
//! which open from the far face, run on through the rings, which open from the face that was hit. Where both open from one face, the one that
//! comes later ends, as everywhere else.
//!
//! A tetrahedron has one crack. So the arm ends where it meets the ring, and a new crack goes on from the other side of it in the same direction; it
//! grows back to the ring as well, which closes the gap.

use glam::Vec3;

use super::branching::{APART, Fork, nearest, nearest_start};
use super::felt::SAME_FACE;
use super::field::StressField;
use super::single::{ElementCut, Front};
use super::system::CrackSystem;

/// Returns the fork at which a crack goes on past one that it has met, if that one opens from the other face of the wall. `from`: its last cut.
pub(super) fn passes(
    system: &CrackSystem,
    field: &StressField,
    front: &Front,
    from: &ElementCut,
) -> Option<Fork> {
    if system.config.is_paper() || from.opens == Vec3::ZERO {
        return None;
    }
    let place = system.centroids[front.tet as usize];
    let apart = APART * system.edge;
    let thickness = field.wall(from.tet as usize)?.thickness();
    // Fronts of the crack meet the other one all through the wall; one of them goes on.
    if nearest_start(&system.cracks[front.crack as usize], place).0 < apart.max(thickness) {
        return None;
    }
    let other = system.fractured_by[front.tet as usize];
    let other = system.cracks.get(other as usize)?;
    let mut cuts = other.elements.iter().rev();
    let met = cuts.find(|cut| cut.tet == front.tet)?;
    if met.opens.dot(from.opens) > -SAME_FACE {
        return None;
    }
    let ahead = place - system.centroids[from.tet as usize];
    let along = from.direction.cross(from.opens).try_normalize()?;
    let along = along * ahead.dot(along).signum();
    Some(Fork {
        place,
        start: nearest(system, front.tet, place + apart * along)?,
        normal: from.direction,
    })
}
