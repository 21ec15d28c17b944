//! The body-centred cubic lattice and its tetrahedra.
//!
//! Vertices are the corners and the centres of cubes of side a. Two centres across a common face and two neighbouring
//! corners of that face make a tetrahedron with two opposite edges of length a and four of length √3/2 a; its dihedral
//! angles are 60° and 90°.

use glam::DVec3;

use crate::error::TetError;
use crate::solid::Solid;
use crate::stuffing::grid::Grid;

/// Most lattice points that are looked at: their signs take a byte each.
const MOST_POINTS: f64 = 4e8;

/// The part of the lattice that matters: every tetrahedron with a vertex inside.
pub(crate) struct Lattice {
    /// Vertex positions, m.
    pub(crate) positions: Vec<DVec3>,
    /// For each vertex, true if it is a cube's centre; edges between two of a kind are the long ones.
    pub(crate) is_centre: Vec<bool>,
    pub(crate) inside: Vec<bool>,
    /// Right-handed.
    pub(crate) tets: Vec<[u32; 4]>,
}

impl Lattice {
    /// Lattice of cubes of side `cell`, m, over the bounds of the solid.
    pub(crate) fn new(solid: &dyn Solid, cell: f64) -> Result<Self, TetError> {
        let [corners, centres] = grids(solid, cell)?;
        let signs = [corners.inside(solid), centres.inside(solid)];
        Ok(Self::of_signs(&corners, &centres, &signs))
    }

    fn of_signs(corners: &Grid, centres: &Grid, signs: &[Vec<bool>; 2]) -> Self {
        let offset = corners.len();
        let inside = |v: usize| {
            if v < offset {
                signs[0][v]
            } else {
                signs[1][v - offset]
            }
        };
        let mut tets: Vec<[usize; 4]> = Vec::new();
        let n = centres.counts;
        for k in 0..n[2] {
            for j in 0..n[1] {
                for i in 0..n[0] {
                    for axis in 0..3 {
                        let here = [i, j, k];
                        let mut next = here;
                        next[axis] += 1;
                        if next[axis] == n[axis] {
                            continue;
                        }
                        let centre = [here, next].map(|c| offset + centres.index(c));
                        let face = face_corners(next, axis).map(|c| corners.index(c));
                        for e in 0..4 {
                            let tet = [centre[0], centre[1], face[e], face[(e + 1) % 4]];
                            if tet.iter().any(|&v| inside(v)) {
                                tets.push(tet);
                            }
                        }
                    }
                }
            }
        }
        let mut used: Vec<usize> = tets.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        let mut number = vec![u32::MAX; offset + centres.len()];
        for (new, &old) in used.iter().enumerate() {
            number[old] = new as u32;
        }
        let place = |v: usize| {
            let (grid, v) = if v < offset {
                (corners, v)
            } else {
                (centres, v - offset)
            };
            let n = grid.counts;
            grid.point([v % n[0], v / n[0] % n[1], v / n[0] / n[1]])
        };
        Self {
            positions: used.iter().map(|&v| place(v)).collect(),
            is_centre: used.iter().map(|&v| v >= offset).collect(),
            inside: used.iter().map(|&v| inside(v)).collect(),
            tets: tets.iter().map(|t| t.map(|v| number[v])).collect(),
        }
    }
}

/// Grids of the corners and of the centres, a cube of margin on every side.
fn grids(solid: &dyn Solid, cell: f64) -> Result<[Grid; 2], TetError> {
    let [low, high] = solid.bounds();
    let points = ((high - low) / cell + 4.0)
        .to_array()
        .iter()
        .product::<f64>()
        * 2.0;
    if points.is_nan() || points >= MOST_POINTS {
        return Err(TetError::TooFine {
            cell,
            points,
            limit: MOST_POINTS,
        });
    }
    let cubes = ((high - low) / cell)
        .to_array()
        .map(|n| n.ceil() as usize + 3);
    let extent = cell * DVec3::from_array(cubes.map(|n| n as f64));
    // Off the symmetric place, so that flat sides of symmetric bodies do not run through lattice points.
    let shift = cell * DVec3::new(0.131, 0.173, 0.211);
    let origin = 0.5 * (low + high) - 0.5 * extent + shift;
    Ok([
        Grid {
            origin,
            spacing: cell,
            counts: cubes.map(|n| n + 1),
        },
        Grid {
            origin: origin + 0.5 * cell,
            spacing: cell,
            counts: cubes,
        },
    ])
}

/// Corners of the low face of cube `next` across `axis`, cyclic, so that (centre below, centre above, corner, next corner)
/// is right-handed.
fn face_corners(next: [usize; 3], axis: usize) -> [[usize; 3]; 4] {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[du, dv]| {
        let mut corner = next;
        corner[u] += du;
        corner[v] += dv;
        corner
    })
}
