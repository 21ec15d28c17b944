//! Extrusion of a triangulated sheet to tetrahedra: prisms through layers, three tetrahedra each.

use frangible::glam::DVec3;

use crate::error::BakeError;
use crate::mesh::BodyMesh;
use crate::random;
use crate::sheet::Sheet;

/// Extrudes every triangle through `layers` prisms.
///
/// `position` maps (sheet vertex, layer 0..=layers) to metres, `cell` maps (triangle, centroid of the
/// prism) to a cell number. Each prism is cut by the rank of its three columns, lowest first, so that
/// neighbours agree on the diagonal of the face between them; with a seed the ranks are shuffled,
/// and the diagonals show no pattern.
pub(crate) fn extrude(
    sheet: &Sheet,
    layers: usize,
    seed: Option<u64>,
    position: &dyn Fn(usize, usize) -> DVec3,
    cell: &dyn Fn(usize, DVec3) -> u32,
) -> Result<BodyMesh, BakeError> {
    let columns = sheet.coords.len();
    let mut mesh = BodyMesh::default();
    for v in 0..columns {
        mesh.positions
            .extend((0..=layers).map(|layer| position(v, layer)));
    }
    let node = |v: u32, layer: usize| v * (layers as u32 + 1) + layer as u32;
    let rank = |v: u32| (seed.map_or(0, |s| random::bits(s, u64::from(v))), v);
    for (t, triangle) in sheet.triangles.iter().enumerate() {
        let mut columns = *triangle;
        columns.sort_unstable_by_key(|&v| rank(v));
        let [a, b, c] = columns;
        for layer in 0..layers {
            let low = [a, b, c].map(|v| node(v, layer));
            let top = [a, b, c].map(|v| node(v, layer + 1));
            let centroid = low
                .iter()
                .chain(&top)
                .map(|&v| mesh.positions[v as usize])
                .sum::<DVec3>()
                / 6.0;
            mesh.tets.extend([
                [low[0], low[1], low[2], top[2]],
                [low[0], low[1], top[1], top[2]],
                [low[0], top[0], top[1], top[2]],
            ]);
            mesh.cell_of_tet.extend([cell(t, centroid); 3]);
        }
    }
    mesh.finish()
}
