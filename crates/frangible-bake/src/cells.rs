//! Convex cells of the body, from which the colliders of the body and of its fragments are made.

use frangible::glam::Vec3;
use frangible::internals::TetMesh;
use frangible::internals::asset::ConvexCell;

/// Directions in which a cell keeps its farthest node.
const DIRECTIONS: usize = 64;

/// Points of each cell: its nodes that lie farthest in some of 64 evenly spread directions.
pub(crate) fn convex_cells(mesh: &TetMesh, cell_of_tet: &[u32], cells: usize) -> Vec<ConvexCell> {
    let mut members: Vec<(u32, u32)> = mesh
        .tets
        .iter()
        .zip(cell_of_tet)
        .flat_map(|(tet, &cell)| tet.map(|v| (cell, v)))
        .collect();
    members.sort_unstable();
    members.dedup();
    let directions = spread_directions();
    (0..cells as u32)
        .map(|cell| {
            let range =
                members.partition_point(|m| m.0 < cell)..members.partition_point(|m| m.0 <= cell);
            let nodes = &members[range];
            let position = |m: &(u32, u32)| mesh.positions[m.1 as usize];
            let mut extreme: Vec<u32> = directions
                .iter()
                .filter_map(|&d| {
                    nodes
                        .iter()
                        .max_by(|a, b| position(a).dot(d).total_cmp(&position(b).dot(d)))
                })
                .map(|m| m.1)
                .collect();
            extreme.sort_unstable();
            extreme.dedup();
            ConvexCell {
                points: extreme
                    .into_iter()
                    .map(|v| mesh.positions[v as usize])
                    .collect(),
            }
        })
        .collect()
}

/// The eight octant diagonals, so that the corners of boxes are always kept, and a Fibonacci spiral.
fn spread_directions() -> Vec<Vec3> {
    let golden = std::f32::consts::PI * (3.0 - 5.0_f32.sqrt());
    let octants = (0..8_u8).map(|k| {
        let sign = |bit: u8| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        Vec3::new(sign(0), sign(1), sign(2))
    });
    let spiral = (0..DIRECTIONS - 8).map(|i| {
        let z = 1.0 - (2 * i + 1) as f32 / (DIRECTIONS - 8) as f32;
        let (r, turn) = ((1.0 - z * z).sqrt(), golden * i as f32);
        Vec3::new(r * turn.cos(), r * turn.sin(), z)
    });
    octants.chain(spiral).collect()
}
