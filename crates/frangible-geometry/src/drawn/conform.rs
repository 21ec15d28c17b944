//! Polygons that tile a surface get the same corners along their common sides.
//!
//! Each triangle of the surface is divided by itself ([`super::overlay`]): along a side of two triangles the one may have a corner where
//! the other has none, and within a triangle a polygon may have one in the middle of another's side. Here each polygon takes in the corners
//! that lie on its sides, and corners at one place get one number.

use glam::{DVec2, DVec3};

use super::edges::Edges;
use super::{Cut, RenderSurface};

/// Corners no farther apart than this are one; the sides of a triangle are of length 1.
const SAME: f64 = 1e-9;

/// A corner no farther than this from a side of a polygon lies on it.
const ON: f64 = 4e-9;

/// Numbers of the corners, and where they are.
pub(super) struct Corners<'a> {
    surface: &'a RenderSurface,
    edges: &'a Edges,
    /// Corners on edges of the surface: the edge, and how far along it (0 to 1). Sorted; their numbers follow those of the vertices.
    on_edges: Vec<(u32, f64)>,
    /// Place in that list of the first corner on each edge or after it, and its end.
    first_on: Vec<u32>,
    /// Places of the corners within triangles, m; their numbers come last.
    within: Vec<DVec3>,
}

/// The number of a corner, and its barycentric coordinates: the weights of the second and the third vertex.
pub(super) type Corner = (u32, DVec2);

impl<'a> Corners<'a> {
    /// Finds the corners that all divided triangles have on the edges of the surface.
    pub(super) fn new(surface: &'a RenderSurface, edges: &'a Edges, cuts: &[Cut]) -> Self {
        let mut on_edges = Vec::new();
        for (t, _, polygon) in cuts {
            for &p in polygon {
                if let Place::Side(k, along) = place(p)
                    && let Some((edge, forward)) = edges.of_side(surface, 3 * t + k as u32)
                {
                    on_edges.push((edge, if forward { along } else { 1.0 - along }));
                }
            }
        }
        on_edges.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        on_edges.dedup_by(|b, a| a.0 == b.0 && b.1 - a.1 <= SAME);
        let mut first_on = vec![0; edges.count() + 1];
        for on in &on_edges {
            first_on[on.0 as usize + 1] += 1;
        }
        let mut before = 0;
        for count in &mut first_on {
            before += *count;
            *count = before;
        }
        Self {
            surface,
            edges,
            on_edges,
            first_on,
            within: Vec::new(),
        }
    }

    /// The edges of the surface.
    pub(super) fn edges(&self) -> &Edges {
        self.edges
    }

    /// Position of a corner, m, body frame.
    pub(super) fn place(&self, number: u32) -> DVec3 {
        let vertices = self.surface.positions.len();
        let number = number as usize;
        if let Some(p) = self.surface.positions.get(number) {
            return p.as_dvec3();
        }
        match self.on_edges.get(number - vertices) {
            Some(&(edge, along)) => {
                let ends = self.edges.ends(edge);
                let [from, to] = ends.map(|v| self.surface.positions[v as usize].as_dvec3());
                from.lerp(to, along)
            }
            None => self.within[number - vertices - self.on_edges.len()],
        }
    }

    /// Triangles with a corner between the ends of a side.
    pub(super) fn bordering(&self) -> impl Iterator<Item = u32> {
        let edges = self.on_edges.chunk_by(|a, b| a.0 == b.0);
        edges.flat_map(|on| self.edges.triangles_at(on[0].0))
    }

    /// Returns true if a side of a part of triangle t, between these corners, lies on the border of a hole.
    pub(super) fn is_on_hole(&self, t: u32, ends: [u32; 2]) -> bool {
        (0..3).any(|k| {
            let Some((edge, _)) = self.edges.of_side(self.surface, 3 * t + k) else {
                return false;
            };
            self.edges.is_open(edge) && ends.iter().all(|&corner| self.is_on(edge, corner))
        })
    }

    fn is_on(&self, edge: u32, corner: u32) -> bool {
        let after_vertices = (corner as usize).checked_sub(self.surface.positions.len());
        match after_vertices {
            None => self.edges.ends(edge).contains(&corner),
            Some(i) => self.on_edges.get(i).is_some_and(|on| on.0 == edge),
        }
    }

    /// The corners along a side of a triangle, from its first end on, without its second end: what a triangle that is not divided takes in.
    pub(super) fn along(&self, t: u32, k: usize) -> impl Iterator<Item = Corner> {
        const ENDS: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let (from, to) = (ENDS[k], ENDS[(k + 1) % 3]);
        let vertex = self.surface.triangles[t as usize][k] as usize;
        let first = (self.edges.welded[vertex], from);
        let on_side = self.on_side(3 * t + k as u32);
        let between = on_side.map(move |(number, along)| (number, from.lerp(to, along)));
        std::iter::once(first).chain(between)
    }

    /// Numbers of the corners on a side, and how far along it they lie, rising.
    fn on_side(&self, side: u32) -> impl Iterator<Item = (u32, f64)> {
        let of_side = self.edges.of_side(self.surface, side);
        let forward = of_side.is_some_and(|(_, forward)| forward);
        let [first, end] = match of_side {
            Some((edge, _)) => [0, 1].map(|k| self.first_on[edge as usize + k] as usize),
            None => [0, 0],
        };
        let vertices = self.surface.positions.len();
        (first..end).map(move |i| {
            let i = if forward { i } else { first + end - 1 - i };
            let along = self.on_edges[i].1;
            let along = if forward { along } else { 1.0 - along };
            ((vertices + i) as u32, along)
        })
    }

    /// Gives the parts of a divided triangle their numbered corners, one after the other; parts that are nothing but a line get none.
    pub(super) fn conform(
        &mut self,
        parts: &[Cut],
        room: &mut Room,
        mut found: impl FnMut(&Cut, &[Corner]),
    ) {
        let Some(&(t, ..)) = parts.first() else {
            return;
        };
        let Room {
            inside,
            known,
            on,
            corners,
        } = room;
        known.clear();
        for k in 0..3 {
            known.extend(self.along(t, k));
        }
        inside.clear();
        for &p in parts.iter().flat_map(|part| &part.2) {
            if matches!(place(p), Place::Within) {
                inside.push(p);
            }
        }
        inside.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let triangle = self.surface.triangles[t as usize];
        let [a, b, c] = triangle.map(|v| self.surface.positions[v as usize].as_dvec3());
        let first = known.len();
        for &p in inside.iter() {
            let before = known[first..].iter().rev();
            let mut near = before.take_while(|q| p.x - q.1.x <= SAME);
            if !near.any(|q| (p.y - q.1.y).abs() <= SAME) {
                let number = self.surface.positions.len() + self.on_edges.len() + self.within.len();
                known.push((number as u32, p));
                self.within.push(a + (b - a) * p.x + (c - a) * p.y);
            }
        }
        known.sort_by(|a, b| a.1.x.total_cmp(&b.1.x));
        for part in parts {
            number(&part.2, known, on, corners);
            if !corners.is_empty() {
                found(part, corners);
            }
        }
    }
}

/// Room that the numbering of one triangle after the other uses.
#[derive(Debug, Default)]
pub(super) struct Room {
    inside: Vec<DVec2>,
    known: Vec<Corner>,
    on: Vec<(f64, Corner)>,
    corners: Vec<Corner>,
}

/// Finds the corners of a polygon and those on its sides, in order, no two the same after each other. `known`: all of the triangle's, by x.
fn number(
    polygon: &[DVec2],
    known: &[Corner],
    on: &mut Vec<(f64, Corner)>,
    corners: &mut Vec<Corner>,
) {
    corners.clear();
    for (i, &from) in polygon.iter().enumerate() {
        let side = polygon[(i + 1) % polygon.len()] - from;
        let length = side.length();
        let direction = side / length;
        let (low, high) = (side.x.min(0.0) + from.x - ON, side.x.max(0.0) + from.x + ON);
        let near = &known[known.partition_point(|q| q.1.x < low)..];
        on.clear();
        for &(number, q) in near.iter().take_while(|q| q.1.x <= high) {
            let (along, beside) = (direction.dot(q - from), direction.perp_dot(q - from));
            if beside.abs() <= ON && (-ON..=length + ON).contains(&along) {
                on.push((along, (number, q)));
            }
        }
        on.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.0.cmp(&b.1.0)));
        corners.extend(on.iter().map(|&(_, corner)| corner));
    }
    corners.dedup_by_key(|corner| corner.0);
    while corners.len() > 1 && corners[0].0 == corners[corners.len() - 1].0 {
        corners.pop();
    }
    if corners.len() < 3 {
        corners.clear();
    }
}

/// Place of a point in a triangle.
enum Place {
    Vertex,
    /// On the side from this corner to the next, at this share of its length.
    Side(usize, f64),
    Within,
}

fn place(p: DVec2) -> Place {
    let weights = [1.0 - p.x - p.y, p.x, p.y];
    if weights.iter().any(|w| *w > 1.0 - SAME) {
        return Place::Vertex;
    }
    match (0..3).find(|&k| weights[(k + 2) % 3] < SAME) {
        Some(k) => Place::Side(k, weights[(k + 1) % 3]),
        None => Place::Within,
    }
}
