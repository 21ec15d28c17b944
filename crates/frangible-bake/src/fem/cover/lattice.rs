//! Body-centred cubic lattice: corners and centres of cubes, filled by congruent tetrahedra.
//!
//! Each tetrahedron spans the centres of two adjacent cubes and one edge of the face between them; there are
//! twelve per cube. Its faces lie in the planes x ± y, y ± z, z ± x = integer (in units of the cube side), so
//! that cutting a body along those planes divides it among the cells.

use frangible::glam::DVec3;

use crate::fem::quadratic::MID_EDGES;
use crate::mesh::barycentric_gradients;

/// One tetrahedron of the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Cell {
    /// Cube below the face whose edge belongs to the cell.
    cube: [i32; 3],
    /// 4 × axis across the face + 2 × number (0 or 1) of the axis in the face + number of the side.
    kind: u8,
}

/// A point of the lattice in quarters of a cube side: corners, centres and midpoints are whole.
pub(crate) type Quarters = [i32; 3];

/// Normals of the planes n · x = whole number that bound the cells, x in cube sides.
pub(crate) const PLANES: [DVec3; 6] = [
    DVec3::new(1.0, 1.0, 0.0),
    DVec3::new(1.0, -1.0, 0.0),
    DVec3::new(0.0, 1.0, 1.0),
    DVec3::new(0.0, 1.0, -1.0),
    DVec3::new(1.0, 0.0, 1.0),
    DVec3::new(-1.0, 0.0, 1.0),
];

/// Volume of a cell, in cubes.
pub(crate) const CELL_VOLUME: f64 = 1.0 / 12.0;

impl Cell {
    /// The cell that holds a point, given in cube sides.
    pub(crate) fn at(x: DVec3) -> Self {
        let low = x.floor();
        let d = (x - low - DVec3::splat(0.5)).to_array();
        // Nearest face of the cube, then nearest edge of that face.
        let across = (0..3).fold(0, |k, i| if d[i].abs() > d[k].abs() { i } else { k });
        let (first, second) = ((across + 1) % 3, (across + 2) % 3);
        let later = d[second].abs() > d[first].abs();
        let side = d[if later { second } else { first }] >= 0.0;
        let mut cube = low.to_array().map(|c| c as i32);
        if d[across] < 0.0 {
            cube[across] -= 1;
        }
        Self {
            cube,
            kind: 4 * across as u8 + 2 * u8::from(later) + u8::from(side),
        }
    }

    /// A number for counting: different for any two cells less than a million cubes apart.
    pub(crate) fn key(self) -> u64 {
        let low = |c: i32| u64::from(c as u32 & 0xF_FFFF);
        let [x, y, z] = self.cube;
        low(x) << 44 | low(y) << 24 | low(z) << 4 | u64::from(self.kind)
    }

    /// The four corners, right-handed.
    pub(crate) fn corners(self) -> [Quarters; 4] {
        let across = usize::from(self.kind / 4);
        let nearest = (across + 1 + usize::from(self.kind / 2 % 2)) % 3;
        let along = 3 - across - nearest;
        let far = self.kind % 2 == 1;
        let base = self.cube.map(|c| 4 * c);
        let lower = base.map(|c| c + 2);
        let mut upper = lower;
        upper[across] += 4;
        let mut start = base;
        start[across] += 4;
        start[nearest] += if far { 4 } else { 0 };
        let mut end = start;
        end[along] += 4;
        // One orientation for each parity of (across, nearest, along) and side.
        if (nearest == (across + 1) % 3) == far {
            [lower, upper, start, end]
        } else {
            [lower, upper, end, start]
        }
    }

    /// The ten nodes of the quadratic element: corners, then mid-edges.
    pub(crate) fn nodes(self) -> [Quarters; 10] {
        let corners = self.corners();
        std::array::from_fn(|a| {
            if a < 4 {
                corners[a]
            } else {
                let [i, j] = MID_EDGES[a - 4];
                std::array::from_fn(|k| (corners[i][k] + corners[j][k]) / 2)
            }
        })
    }

    /// Barycentric coordinates as functions of the place.
    pub(crate) fn frame(self) -> Frame {
        let corners = self.corners().map(in_sides);
        Frame {
            first: corners[0],
            gradients: barycentric_gradients(corners),
        }
    }
}

/// Barycentric coordinates of a cell, lengths in cube sides.
pub(crate) struct Frame {
    first: DVec3,
    gradients: [DVec3; 4],
}

impl Frame {
    /// Barycentric coordinates of a point; negative outside.
    pub(crate) fn barycentric(&self, x: DVec3) -> [f64; 4] {
        let from_first = x - self.first;
        let l = self.gradients.map(|g| g.dot(from_first));
        [1.0 - l[1] - l[2] - l[3], l[1], l[2], l[3]]
    }
}

/// A lattice point in cube sides.
pub(crate) fn in_sides(q: Quarters) -> DVec3 {
    DVec3::from_array(q.map(|c| 0.25 * f64::from(c)))
}

/// Position and size of the lattice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lattice {
    /// Corner of cube 0, m.
    pub(crate) origin: DVec3,
    /// Side of a cube, m.
    pub(crate) side: f64,
}

impl Lattice {
    /// A lattice whose planes keep off the faces of a body that starts at `low`, m.
    pub(crate) fn new(low: DVec3, side: f64) -> Self {
        // Irrational: powers of the inverse of 1.2207…, root of x⁴ = x + 1, spread most evenly in three dimensions.
        let shift = DVec3::new(
            0.819_172_513_396_164_4,
            0.671_043_606_703_789_3,
            0.549_700_477_901_970_3,
        );
        Self {
            origin: low - side * shift,
            side,
        }
    }

    /// A point in cube sides.
    pub(crate) fn in_sides(&self, p: DVec3) -> DVec3 {
        (p - self.origin) / self.side
    }

    /// A lattice point in metres.
    pub(crate) fn position(&self, q: Quarters) -> DVec3 {
        self.origin + self.side * in_sides(q)
    }
}

#[cfg(test)]
mod tests {
    use super::{CELL_VOLUME, Cell, PLANES, in_sides};
    use crate::mesh::tet_volume;
    use crate::random;
    use frangible::glam::DVec3;

    #[test]
    fn every_point_lies_in_its_cell_between_its_planes() {
        for i in 0..20_000 {
            let x = DVec3::from_array([0, 1, 2].map(|k| 3.0 * random::symmetric(5, 3 * i + k)));
            let cell = Cell::at(x);
            let corners = cell.corners().map(in_sides);
            assert!((tet_volume(corners) - CELL_VOLUME).abs() < 1e-15);
            let l = cell.frame().barycentric(x);
            assert!(l.iter().all(|&l| l > -1e-12), "{x}: {l:?}");
            let back: DVec3 = (0..4).map(|k| l[k] * corners[k]).sum();
            assert!(back.distance(x) < 1e-13);
            for normal in PLANES {
                let level = normal.dot(x).floor();
                for corner in corners {
                    assert!((level..=level + 1.0).contains(&normal.dot(corner)));
                }
            }
        }
    }
}
