//! A triangulated sheet with its sharp lines, as the remesher edits it.

use glam::DVec3;

use super::lines::Lines;

/// No triangle, or no line.
pub(crate) const NONE: u32 = u32::MAX;

/// How freely a vertex may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Along the surface.
    Free,
    /// Along a sharp line or an edge of the sheet, from a place of this segment of [`Lines`].
    Line(u32),
    /// Not at all.
    Corner,
}

/// An edge along a sharp line: its ends, the lower first, and a segment of [`Lines`] that it replaces.
pub(crate) type Sharp = ([u32; 2], u32);

/// Triangles that the remesher changes. Every edge has at most two of them, wound alike.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sheet {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) kinds: Vec<Kind>,
    /// Sharp edges, rising.
    pub(crate) sharp: Vec<Sharp>,
}

/// An edge with its triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    /// The lower vertex first.
    pub(crate) ends: [u32; 2],
    /// The triangles at it, and which of their sides it is; the second is [`NONE`] at the end of the sheet.
    pub(crate) sides: [(u32, u8); 2],
}

impl Sheet {
    pub(crate) fn at(&self, v: u32) -> DVec3 {
        self.positions[v as usize]
    }

    pub(crate) fn kind(&self, v: u32) -> Kind {
        self.kinds[v as usize]
    }

    pub(crate) fn length(&self, ends: [u32; 2]) -> f64 {
        self.at(ends[0]).distance(self.at(ends[1]))
    }

    /// Twice the area of a triangle, along its normal, m².
    pub(crate) fn normal(&self, triangle: [u32; 3]) -> DVec3 {
        let [a, b, c] = triangle.map(|v| self.at(v));
        (b - a).cross(c - a)
    }

    /// The segment of a sharp edge, or `None` if the edge is not sharp.
    pub(crate) fn sharp_at(&self, a: u32, b: u32) -> Option<u32> {
        let ends = [a.min(b), a.max(b)];
        let place = self.sharp.partition_point(|s| s.0 < ends);
        self.sharp
            .get(place)
            .filter(|s| s.0 == ends)
            .map(|&(_, segment)| segment)
    }

    /// All edges, rising by their ends.
    pub(crate) fn edges(&self) -> Vec<Edge> {
        edges_of(&self.triangles)
    }

    /// Triangles around each vertex, rising.
    pub(crate) fn around(&self) -> frangible_geometry::Rows {
        frangible_geometry::Rows::inverse(self.positions.len(), &self.triangles)
    }

    /// Smallest angle of a triangle, degrees.
    pub(crate) fn smallest_angle(&self) -> f64 {
        self.triangles
            .iter()
            .map(|t| smallest_angle(t.map(|v| self.at(v))))
            .fold(180.0, f64::min)
    }

    /// Brings a moved vertex of a line back onto its line.
    pub(crate) fn onto_line(&mut self, v: u32, lines: &Lines) {
        if let Kind::Line(segment) = self.kind(v) {
            let (place, segment) = lines.closest(self.at(v), segment);
            self.positions[v as usize] = place;
            self.kinds[v as usize] = Kind::Line(segment);
        }
    }

    /// Drops vertices that no triangle uses.
    pub(crate) fn compact(&mut self) {
        let mut place = vec![NONE; self.positions.len()];
        for &v in self.triangles.iter().flatten() {
            place[v as usize] = 0;
        }
        let mut count = 0;
        for (v, slot) in place.iter_mut().enumerate() {
            if *slot == 0 {
                self.positions[count as usize] = self.positions[v];
                self.kinds[count as usize] = self.kinds[v];
                *slot = count;
                count += 1;
            }
        }
        self.positions.truncate(count as usize);
        self.kinds.truncate(count as usize);
        for v in self.triangles.iter_mut().flatten() {
            *v = place[*v as usize];
        }
        for (ends, _) in &mut self.sharp {
            *ends = ends.map(|v| place[v as usize]);
        }
        self.sharp.retain(|(ends, _)| !ends.contains(&NONE));
    }
}

/// All edges of triangles, rising by their ends; sides beyond the second are left out.
pub(crate) fn edges_of(triangles: &[[u32; 3]]) -> Vec<Edge> {
    let mut sides: Vec<([u32; 2], u32, u8)> = Vec::with_capacity(3 * triangles.len());
    for (t, triangle) in (0..).zip(triangles) {
        for k in 0..3_u8 {
            let (a, b) = (triangle[k as usize], triangle[(k as usize + 1) % 3]);
            sides.push(([a.min(b), a.max(b)], t, k));
        }
    }
    sides.sort_unstable();
    sides
        .chunk_by(|a, b| a.0 == b.0)
        .map(|same| Edge {
            ends: same[0].0,
            sides: [0, 1].map(|i| same.get(i).map_or((NONE, 0), |s| (s.1, s.2))),
        })
        .collect()
}

/// Smallest angle of a triangle, degrees.
pub(crate) fn smallest_angle(x: [DVec3; 3]) -> f64 {
    (0..3)
        .map(|k| (x[(k + 1) % 3] - x[k]).angle_between(x[(k + 2) % 3] - x[k]))
        .fold(f64::INFINITY, f64::min)
        .to_degrees()
}
