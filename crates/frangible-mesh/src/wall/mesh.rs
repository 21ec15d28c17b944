//! The mesh of a wall: triangles with two places for each vertex.

use glam::DVec3;

/// Triangles along a wall and its two faces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WallMesh {
    /// Two places for each vertex, m: on the back, and on the face to which the triangles are wound.
    pub columns: Vec<[DVec3; 2]>,
    /// Vertex indices of each triangle, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Vertices that lie on no edge of the wall and may move along it.
    pub free: Vec<bool>,
    /// Smallest angle of a triangle, degrees.
    pub smallest_angle: f64,
}

impl WallMesh {
    /// Volume between the two faces, m³.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.triangles
            .iter()
            .map(|&t| {
                // Cut by rank, so that neighbours agree on the diagonals between them.
                let mut columns = t;
                columns.sort_unstable();
                let cut = prism_tets(columns.map(|v| self.columns[v as usize]));
                cut.iter().sum::<f64>().abs() / 6.0
            })
            .sum()
    }

    /// Whether all tetrahedra of all prisms are the right way round, however they are cut.
    pub(super) fn is_sound(&self) -> bool {
        let of = |t: &[u32; 3]| least_tet(t.map(|v| self.columns[v as usize]));
        self.triangles.iter().all(|t| of(t) > 0.0)
    }
}

/// Six times the volume of the smallest tetrahedron of a prism, whichever way it is cut, m³; negative if it is inside out.
pub(super) fn least_tet([x, y, z]: [[DVec3; 2]; 3]) -> f64 {
    let cuts = [[x, y, z], [y, z, x], [z, x, y]];
    cuts.into_iter()
        .flat_map(|[x, y, z]| {
            // Two columns exchanged, the prism is turned inside out, and so are all that it is cut into.
            let turned = prism_tets([x, z, y]).map(|six| -six);
            prism_tets([x, y, z]).into_iter().chain(turned)
        })
        .fold(f64::INFINITY, f64::min)
}

/// Six times the volumes of the three tetrahedra of a prism.
fn prism_tets([[a, d], [b, e], [c, f]]: [[DVec3; 2]; 3]) -> [f64; 3] {
    let six = |p: DVec3, q: DVec3, r: DVec3, s: DVec3| (q - p).cross(r - p).dot(s - p);
    [six(a, b, c, f), six(a, b, f, e), six(a, e, f, d)]
}
