//! Edges and neighbours of the triangles of the author's surface.

use std::collections::HashMap;

use glam::DVec3;

use super::RenderSurface;

/// Edge of a side of a triangle that has no area, and so bounds nothing.
const NO_EDGE: u32 = u32::MAX;

/// Stands for the neighbour across a side, unless exactly one triangle has the same edge the other way.
pub(super) const NO_TRIANGLE: u32 = u32::MAX;

/// The edges of a surface. Side 3t + k leads from corner k of triangle t to the next; all sides between two places are one edge.
#[derive(Debug)]
pub(super) struct Edges {
    /// For each vertex, the first vertex at the same place.
    pub(super) welded: Vec<u32>,
    /// The edge of each side.
    of_side: Vec<u32>,
    list: Vec<Edge>,
    /// Sides by edge.
    sides: Vec<u32>,
    /// The triangle across each side of a triangle, or [`NO_TRIANGLE`].
    across: Vec<[u32; 3]>,
    /// True if no edge is open.
    pub(super) are_closed: bool,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    /// Welded vertices, rising.
    ends: [u32; 2],
    /// Index of the first of its sides in the list of all.
    first: u32,
    count: u32,
    /// True if more sides run the one way than the other: the edge is the border of a hole.
    is_open: bool,
}

impl Edges {
    /// Finds the edges of a surface; none where the triangles face inwards, or enclose nothing.
    pub(super) fn new(surface: &RenderSurface) -> Option<Self> {
        let welded = surface.welded();
        let middle = surface
            .positions
            .iter()
            .map(|p| p.as_dvec3())
            .sum::<DVec3>()
            / surface.positions.len().max(1) as f64;
        let mut of_side = vec![NO_EDGE; 3 * surface.triangles.len()];
        let mut list: Vec<Edge> = Vec::new();
        let mut excess = Vec::new();
        // Looked up only, never iterated.
        let mut number = HashMap::new();
        let mut six_volumes = 0.0;
        for (t, triangle) in surface.triangles.iter().enumerate() {
            let corners = triangle.map(|v| welded[v as usize]);
            let [a, b, c] = corners;
            if a == b || b == c || c == a {
                continue;
            }
            let [x, y, z] = corners.map(|v| surface.positions[v as usize].as_dvec3() - middle);
            six_volumes += x.dot(y.cross(z));
            for k in 0..3 {
                let (from, to) = (corners[k], corners[(k + 1) % 3]);
                let ends = [from.min(to), from.max(to)];
                let edge = *number.entry(ends).or_insert(list.len());
                if edge == list.len() {
                    excess.push(0);
                    list.push(Edge {
                        ends,
                        first: 0,
                        count: 0,
                        is_open: false,
                    });
                }
                list[edge].count += 1;
                excess[edge] += if from < to { 1 } else { -1 };
                of_side[3 * t + k] = edge as u32;
            }
        }
        let mut first = 0;
        for (edge, excess) in list.iter_mut().zip(excess) {
            (edge.first, edge.is_open) = (first, excess != 0);
            first += edge.count;
        }
        let mut sides = vec![0; first as usize];
        let mut next: Vec<u32> = list.iter().map(|edge| edge.first).collect();
        for (side, &edge) in (0..).zip(&of_side) {
            if edge != NO_EDGE {
                let place = &mut next[edge as usize];
                sides[*place as usize] = side;
                *place += 1;
            }
        }
        let across = |side: u32| match of_side[side as usize] {
            NO_EDGE => NO_TRIANGLE,
            edge => match list[edge as usize] {
                Edge {
                    first,
                    count: 2,
                    is_open: false,
                    ..
                } => {
                    let both = [first, first + 1].map(|i| sides[i as usize]);
                    both[usize::from(both[0] == side)] / 3
                }
                _ => NO_TRIANGLE,
            },
        };
        let triangles = 0..surface.triangles.len() as u32;
        let across = triangles
            .map(|t| [0, 1, 2].map(|k| across(3 * t + k)))
            .collect();
        let are_closed = list.iter().all(|edge| !edge.is_open);
        (six_volumes > 0.0).then_some(Self {
            welded,
            of_side,
            list,
            sides,
            across,
            are_closed,
        })
    }

    pub(super) fn count(&self) -> usize {
        self.list.len()
    }

    /// The edge of a side, unless its triangle has no area, and whether the side runs from the edge's first end to the second.
    pub(super) fn of_side(&self, surface: &RenderSurface, side: u32) -> Option<(u32, bool)> {
        let edge = self.of_side[side as usize];
        let triangle = surface.triangles[side as usize / 3];
        let from = self.welded[triangle[side as usize % 3] as usize];
        (edge != NO_EDGE).then(|| (edge, from == self.list[edge as usize].ends[0]))
    }

    /// Welded vertices at the ends of an edge.
    pub(super) fn ends(&self, edge: u32) -> [u32; 2] {
        self.list[edge as usize].ends
    }

    /// Returns true if an edge is the border of a hole.
    pub(super) fn is_open(&self, edge: u32) -> bool {
        self.list[edge as usize].is_open
    }

    /// The triangle across each side of a triangle, or [`NO_TRIANGLE`].
    pub(super) fn across(&self, triangle: u32) -> [u32; 3] {
        self.across[triangle as usize]
    }

    /// Triangles at an edge.
    pub(super) fn triangles_at(&self, edge: u32) -> impl Iterator<Item = u32> {
        let Edge { first, count, .. } = self.list[edge as usize];
        let sides = &self.sides[first as usize..(first + count) as usize];
        sides.iter().map(|side| side / 3)
    }
}
