//! Unmodified tetrahedra from files.

use glam::DVec3;

/// Linear or quadratic tetrahedra with their groups, unmodified, possibly inverted, disconnected or duplicate.
/// [`mend_tets`](crate::mend_tets) makes a body from them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TetInput {
    /// Node positions, in the file's unit.
    pub positions: Vec<DVec3>,
    /// Corners of each tetrahedron.
    pub tets: Vec<[u32; 4]>,
    /// Mid-edge nodes of the edges 01, 12, 02, 03, 13, 23 of each tetrahedron; `None` for linear elements.
    pub mid_edges: Option<Vec<[u32; 6]>>,
    /// Number of each tetrahedron in the file, for messages.
    pub numbers: Vec<u64>,
    /// Corners of the triangles that belong to a group.
    pub faces: Vec<[u32; 3]>,
    /// Named parts: faces first, then tetrahedra, by number.
    pub groups: Vec<TetGroup>,
}

/// A named part of a mesh: a physical group, a region, a marker.
#[derive(Clone, Debug, PartialEq)]
pub struct TetGroup {
    /// Name in the file; “surface 3” or “volume 3” if it only has a number.
    pub name: String,
    /// 2: its members are faces; 3: tetrahedra.
    pub dimension: u8,
    /// Indices of its members, ascending.
    pub members: Vec<u32>,
}

impl TetInput {
    /// Lowest and highest corner of the bounding box of all tetrahedra, in the file's unit.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        let everything = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let corners = self.tets.iter().flatten();
        corners.fold(everything, |[low, high], &v| {
            let p = self.positions[v as usize];
            [low.min(p), high.max(p)]
        })
    }
}
