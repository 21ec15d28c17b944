//! The stored shapes: boxes whose plan narrows to one end, or whose thickness does.

use frangible::glam::DVec3;
use frangible_bake::BodyMesh;

/// A box of three side lengths, tapered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ProxyShape {
    /// Side lengths, longest first.
    pub(crate) sides: DVec3,
    /// Share of the second side that is gone at the far end of the first: 0 a rectangle, near 1 a triangle.
    pub(crate) narrows: f64,
    /// Share of the third side that is gone there: a wedge.
    pub(crate) thins: f64,
}

/// The six tetrahedra of a cube: paths from its lowest corner to its highest, as corners' bits.
const PATHS: [[usize; 4]; 6] = [
    [0, 1, 3, 7],
    [0, 3, 2, 7],
    [0, 2, 6, 7],
    [0, 6, 4, 7],
    [0, 4, 5, 7],
    [0, 5, 1, 7],
];

impl ProxyShape {
    /// Cells along each side: five along the longest, in proportion along the others, and at least one.
    pub(crate) fn cells(&self) -> [usize; 3] {
        let unit = self.sides.x / 5.0;
        self.sides
            .to_array()
            .map(|side| (side / unit).round().clamp(1.0, 5.0) as usize)
    }

    /// A place from coordinates of 0 to 1 along the sides.
    pub(crate) fn place(&self, c: DVec3) -> DVec3 {
        let across = DVec3::new(1.0, 1.0 - self.narrows * c.x, 1.0 - self.thins * c.x);
        (c - DVec3::new(0.0, 0.5, 0.5)) * self.sides * across
    }

    /// Coordinates of a place, moved to 0 … 1 where it lies outside.
    pub(crate) fn coordinates(&self, p: DVec3) -> DVec3 {
        let x = (p.x / self.sides.x).clamp(0.0, 1.0);
        let across = |taper: f64| 1.0 - taper * x;
        DVec3::new(
            x,
            (p.y / (self.sides.y * across(self.narrows)) + 0.5).clamp(0.0, 1.0),
            (p.z / (self.sides.z * across(self.thins)) + 0.5).clamp(0.0, 1.0),
        )
    }

    /// Tetrahedra, six to a cell, cell after cell, the last side fastest.
    pub(crate) fn mesh(&self) -> BodyMesh {
        let n = self.cells();
        let corners = n.map(|n| n + 1);
        let number = |i: [usize; 3]| ((i[0] * corners[1] + i[1]) * corners[2] + i[2]) as u32;
        let mut mesh = BodyMesh {
            cells: 1,
            ..BodyMesh::default()
        };
        for i in 0..corners[0] * corners[1] * corners[2] {
            let at = [
                i / (corners[1] * corners[2]),
                i / corners[2] % corners[1],
                i % corners[2],
            ];
            let c = DVec3::from_array([0, 1, 2].map(|k| at[k] as f64 / n[k] as f64));
            mesh.positions.push(self.place(c));
        }
        for cell in 0..n[0] * n[1] * n[2] {
            let at = [cell / (n[1] * n[2]), cell / n[2] % n[1], cell % n[2]];
            for path in PATHS {
                let corner = |bits: usize| number([0, 1, 2].map(|k| at[k] + (bits >> k & 1)));
                mesh.tets.push(path.map(corner));
                mesh.cell_of_tet.push(0);
            }
        }
        mesh
    }
}
