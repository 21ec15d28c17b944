//! Marks of cracks in glass, laid on the vertices of drawn crack faces.

use std::collections::HashMap;

use frangible::Asset;
use frangible::ImpactReport;
use frangible::glam::{IVec3, Vec3};
use frangible::internals::CrackMark;
use frangible_recording::RecordedMesh;

use crate::meshes::BodySurfaces;

/// Mean edge of tetrahedra over the cube root of their volume.
const EDGE: f64 = 2.04;

/// A mark is taken from cuts no farther away than this, in edges.
const REACH: f32 = 1.5;

/// Cosine of the largest angle between a face and the crack that it is taken for.
const ALONG: f32 = 0.5;

/// The marks of the cracks of a body, by place.
#[derive(Debug, Default)]
pub(crate) struct Marks {
    list: Vec<CrackMark>,
    /// Mean edge of the fracture mesh, m.
    edge: f32,
    /// Numbers of the marks in each cell of a grid. Looked up only, never iterated.
    cells: HashMap<IVec3, Vec<u32>>,
}

impl Marks {
    /// The marks of an impact on a body of this asset, besides those that it has already; `moved`: from their frame to the body's, m.
    pub(crate) fn of(report: &ImpactReport, asset: &Asset, before: Option<(&Self, Vec3)>) -> Self {
        let root = asset.root();
        let count = root.fracture().tets.len().max(1);
        let mut marks = Self {
            edge: (EDGE * (root.mass().volume / count as f64).cbrt()) as f32,
            ..Self::default()
        };
        if let Some((known, moved)) = before {
            let moved = known.list.iter().map(|mark| CrackMark {
                place: mark.place + moved,
                start: mark.start + moved,
                ..*mark
            });
            marks.list.extend(moved);
        }
        marks.list.extend(&report.marks);
        for (number, mark) in (0..).zip(&marks.list) {
            let cell = marks.cell(mark.place);
            marks.cells.entry(cell).or_default().push(number);
        }
        marks
    }

    /// Returns true if there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    fn cell(&self, at: Vec3) -> IVec3 {
        (at / (REACH * self.edge)).floor().as_ivec3()
    }

    /// Marks the crack faces of a mesh whose origin is here in the body frame, m.
    pub(crate) fn lay_on(&self, mesh: &mut RecordedMesh, origin: Vec3, surfaces: &BodySurfaces) {
        if self.is_empty() {
            return;
        }
        let mut rows = vec![[0.0; 4]; mesh.positions.len()];
        let is_crack = |surface| surface == surfaces.inner || surface == surfaces.crack;
        for part in mesh.parts.iter().filter(|part| is_crack(part.surface)) {
            for &vertex in &part.indices {
                let (row, v) = (&mut rows[vertex as usize], vertex as usize);
                if *row == [0.0; 4] {
                    *row = self.row(mesh.positions[v] + origin, mesh.normals[v]);
                }
            }
        }
        mesh.marks = rows;
    }

    /// Row of a vertex of a crack face, as [`RecordedMesh::marks`] has it.
    fn row(&self, at: Vec3, normal: Vec3) -> [f32; 4] {
        let middle = self.cell(at);
        let around = (0..27).map(|k| middle + IVec3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
        let near: Vec<&CrackMark> = around
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
            .map(|&number| &self.list[number as usize])
            .filter(|mark| mark.normal.dot(normal).abs() > ALONG)
            .filter(|mark| mark.place.distance(at) < REACH * self.edge)
            .collect();
        let nearest = near.iter().copied().min_by(|a, b| {
            let [a, b] = [a, b].map(|mark| mark.place.distance_squared(at));
            a.total_cmp(&b)
        });
        let Some(nearest) = nearest else {
            return [0.0; 4];
        };
        let (mut sum, mut weights) = (0.0, 0.0);
        for mark in near.iter().filter(|mark| mark.start == nearest.start) {
            let weight = 1.0 / (mark.place.distance_squared(at) + 0.1 * self.edge * self.edge);
            sum += weight / mark.mirror;
            weights += weight;
        }
        let way = at - nearest.start;
        [way.x, way.y, way.z, sum / weights]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Marks of a crack across z from the origin, of which the mirror is 2 mm.
    fn marks() -> Marks {
        let mark = |k: i32| CrackMark {
            place: Vec3::new(1e-3 * k as f32, 0.0, 0.0),
            normal: Vec3::Z,
            start: Vec3::ZERO,
            mirror: 2e-3,
        };
        let mut marks = Marks {
            list: (0..20).map(mark).collect(),
            edge: 1e-3,
            ..Marks::default()
        };
        for (number, mark) in (0..).zip(&marks.list) {
            let cell = marks.cell(mark.place);
            marks.cells.entry(cell).or_default().push(number);
        }
        marks
    }

    #[test]
    fn a_place_on_a_crack_knows_the_way_and_the_mirror() {
        let [x, y, z, inverse] = marks().row(Vec3::new(7.3e-3, 2e-4, 0.0), Vec3::NEG_Z);
        assert_eq!([x, y, z], [7.3e-3, 2e-4, 0.0]);
        assert!((inverse - 500.0).abs() < 0.1, "{inverse}");
    }

    #[test]
    fn faces_across_a_crack_and_far_from_it_know_nothing() {
        let marks = marks();
        assert_eq!(marks.row(Vec3::new(7e-3, 0.0, 0.0), Vec3::X), [0.0; 4]);
        assert_eq!(marks.row(Vec3::new(0.0, 9e-3, 0.0), Vec3::Z), [0.0; 4]);
    }
}
