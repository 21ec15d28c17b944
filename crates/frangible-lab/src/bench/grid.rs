//! Slabs of grid cells, five tetrahedra each: among regular meshes the one whose nodes and tetrahedra both come near those of
//! the paper's slabs.

use frangible::glam::DVec3;
use frangible_mesh::TetBody;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Largest displacement of an inner node, in cells: a lattice would show in the cracks.
const DISORDER: f64 = 0.15;

/// Corners (bit 0: x, bit 1: y, bit 2: z) of the tetrahedra of a cell; of every other cell the mirrored ones, so that the
/// diagonals of a face shared by two cells are the same.
const EVEN: [[usize; 4]; 5] = [
    [0, 3, 5, 6],
    [1, 0, 3, 5],
    [2, 0, 3, 6],
    [4, 0, 5, 6],
    [7, 3, 5, 6],
];
const ODD: [[usize; 4]; 5] = [
    [1, 2, 4, 7],
    [0, 1, 2, 4],
    [3, 1, 2, 7],
    [5, 1, 4, 7],
    [6, 2, 4, 7],
];

/// A box of this size, m, in so many cells along each axis.
pub(crate) fn slab(size: [f64; 3], cells: [usize; 3]) -> TetBody {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut random = || f64::from(rng.next_u32()) / f64::from(u32::MAX) * 2.0 - 1.0;
    let step: [f64; 3] = std::array::from_fn(|a| size[a] / cells[a] as f64);
    let mut body = TetBody::default();
    for k in 0..=cells[2] {
        for j in 0..=cells[1] {
            for i in 0..=cells[0] {
                let at = [i, j, k];
                body.positions
                    .push(DVec3::from_array(std::array::from_fn(|a| {
                        // A node on a side stays on it.
                        let free = at[a] > 0 && at[a] < cells[a];
                        let shift = DISORDER * random();
                        (at[a] as f64 + if free { shift } else { 0.0 }) * step[a]
                    })));
            }
        }
    }
    let node =
        |i: usize, j: usize, k: usize| ((k * (cells[1] + 1) + j) * (cells[0] + 1) + i) as u32;
    for k in 0..cells[2] {
        for j in 0..cells[1] {
            for i in 0..cells[0] {
                let corner = |c: usize| node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
                let rule = if (i + j + k) % 2 == 0 { EVEN } else { ODD };
                body.tets
                    .extend(rule.map(|t| right_handed(t.map(corner), &body.positions)));
            }
        }
    }
    body
}

fn right_handed(mut tet: [u32; 4], positions: &[DVec3]) -> [u32; 4] {
    let [a, b, c, d] = tet.map(|v| positions[v as usize]);
    if (b - a).cross(c - a).dot(d - a) < 0.0 {
        tet.swap(2, 3);
    }
    tet
}

#[cfg(test)]
mod tests {
    use super::slab;

    #[test]
    fn a_slab_fills_its_box_and_hangs_together() {
        let body = slab([0.1, 0.2, 0.03], [4, 7, 2]);
        assert_eq!(
            (body.positions.len(), body.tets.len()),
            (5 * 8 * 3, 5 * 4 * 7 * 2)
        );
        assert!((body.volume() / (0.1 * 0.2 * 0.03) - 1.0).abs() < 1e-12);
        // Two triangles per cell face outside and none between cells: the diagonals agree.
        assert_eq!(body.boundary().len(), 2 * 2 * (4 * 7 + 4 * 2 + 7 * 2));
    }
}
