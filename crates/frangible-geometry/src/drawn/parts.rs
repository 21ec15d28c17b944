//! Parts of the fracture mesh's boundary, each of one fragment.

use glam::DVec3;

use crate::{TriangleTree, closest_on_triangle};

/// A triangle of the boundary with one label.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Corners, m, body frame.
    pub corners: [DVec3; 3],
    /// Label of the fragment that it belongs to.
    pub label: u32,
}

impl Part {
    /// Its sides, from each corner to the next.
    fn sides(&self) -> [[DVec3; 2]; 3] {
        let [a, b, c] = self.corners;
        [[a, b], [b, c], [c, a]]
    }
}

/// Borders between parts of two labels within boundary triangles. The triangle across a side has the same labels along it, so no border lies
/// between two triangles.
#[derive(Debug, Default)]
pub(super) struct Cracks {
    list: Vec<[DVec3; 2]>,
    /// End of the cracks of each boundary triangle in the list.
    end: Vec<u32>,
}

impl Cracks {
    /// The cracks within a boundary triangle.
    pub(super) fn of(&self, triangle: u32) -> &[[DVec3; 2]] {
        let t = triangle as usize;
        let first = t.checked_sub(1).map_or(0, |before| self.end[before]);
        &self.list[first as usize..self.end[t] as usize]
    }
}

/// Label of a boundary triangle that has several.
pub(super) const MIXED: u32 = u32::MAX;

/// The parts of all boundary triangles, triangle by triangle.
#[derive(Clone, Debug, Default)]
pub struct Parts {
    list: Vec<Part>,
    /// Number of parts before those of each triangle, begun so far.
    first: Vec<u32>,
    /// Points of the partition on the boundary, in any order and repeated.
    pub rim: Vec<u32>,
}

impl Parts {
    /// Begins the next boundary triangle.
    pub fn begin(&mut self) {
        self.first.push(self.list.len() as u32);
    }

    /// Adds a part to it.
    pub fn push(&mut self, part: Part) {
        self.list.push(part);
    }

    /// Parts of a boundary triangle.
    pub(super) fn of(&self, triangle: u32) -> &[Part] {
        let t = triangle as usize;
        let end = self
            .first
            .get(t + 1)
            .map_or(self.list.len(), |&e| e as usize);
        &self.list[self.first[t] as usize..end]
    }

    /// The label of each boundary triangle, [`MIXED`] where it has several.
    pub(super) fn labels(&self) -> Vec<u32> {
        let label = |t| match self.of(t) {
            [first, others @ ..] if others.iter().all(|p| p.label == first.label) => first.label,
            _ => MIXED,
        };
        (0..self.first.len() as u32).map(label).collect()
    }

    /// The borders between parts of two labels within each boundary triangle.
    pub(super) fn cracks(&self) -> Cracks {
        let mut cracks = Cracks::default();
        for t in 0..self.first.len() as u32 {
            let parts = self.of(t);
            for (i, part) in parts.iter().enumerate() {
                // Each is seen from both of its sides.
                let others = parts[..i].iter().filter(|other| other.label != part.label);
                for [from, to] in part.sides() {
                    let mut others = others.clone();
                    if others.any(|other| other.sides().contains(&[to, from])) {
                        cracks.list.push([from, to]);
                    }
                }
            }
            cracks.end.push(cracks.list.len() as u32);
        }
        cracks
    }

    /// Label of the part of this triangle that is closest to the point.
    pub(super) fn label_near(&self, triangle: u32, point: DVec3) -> u32 {
        let parts = self.of(triangle);
        let gap = |part: &Part| {
            let w = closest_on_triangle(part.corners, point);
            let [a, b, c] = part.corners;
            (a * w[0] + b * w[1] + c * w[2]).distance_squared(point)
        };
        match parts {
            [first, others @ ..] if others.iter().all(|p| p.label == first.label) => first.label,
            _ => parts
                .iter()
                .map(|part| (gap(part), part.label))
                .min_by(|x, y| x.0.total_cmp(&y.0))
                .map_or(0, |best| best.1),
        }
    }

    /// Label of the boundary where it is closest to the point.
    pub(super) fn label_at(&self, boundary: &TriangleTree, point: DVec3) -> u32 {
        let near = boundary.closest(point.as_vec3());
        self.label_near(near.triangle, near.position.as_dvec3())
    }
}
