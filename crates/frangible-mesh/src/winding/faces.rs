//! Search over loose triangles: what a segment meets, and what is nearest.

use glam::DVec3;

use super::nearest;
use super::segment;
use super::tree::{self, Tree};

/// Triangles with their numbers, in a search tree.
pub(crate) struct FaceTree {
    tree: Tree,
}

impl FaceTree {
    pub(crate) fn new(triangles: &[(u32, [DVec3; 3])]) -> Self {
        Self {
            tree: tree::build(triangles),
        }
    }

    /// Numbers of the triangles that a segment meets.
    pub(crate) fn met(&self, from: DVec3, to: DVec3) -> impl Iterator<Item = u32> {
        segment::hits(&self.tree, from, to)
            .into_iter()
            .map(|hit| hit.face)
    }

    /// The closest place no farther than `within`.
    pub(crate) fn nearest(&self, p: DVec3, within: f64) -> Option<DVec3> {
        let (_, corners) = nearest::nearest(&self.tree, p, within)?;
        Some(nearest::closest_on_triangle(corners, p))
    }
}
