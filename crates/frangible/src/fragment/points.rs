//! The points of a partition, numbered.

use glam::DVec3;

use super::partition::Point;
use crate::asset::{FixedPoints, Portion};
use crate::mesh::{ByNode, EDGES, TetMesh};
use crate::state::Cuts;

/// Points of the partition in f64, body frame, numbered in order of first use; mesh nodes come first.
pub(crate) struct PointTable<'a> {
    mesh: &'a TetMesh,
    cuts: &'a Cuts,
    /// The portion, where a piece is cut whose points may not move.
    portion: Option<&'a Portion>,
    /// All points that are no mesh nodes.
    points: Vec<Point>,
    /// Places of the points, m.
    positions: Vec<DVec3>,
    /// Number of each cut edge's point, 0 for none yet; a mesh node's number is never asked for.
    of_cut: Vec<u32>,
    /// Faces and uncut edges, by their lowest node and the others.
    others: ByNode<[u32; 2]>,
    /// Numbers of these faces and edges.
    of_other: Vec<u32>,
    /// The latest centre: its tetrahedron is the only one that asks for it.
    centre: (u32, u32),
}

impl<'a> PointTable<'a> {
    pub(crate) fn new(mesh: &'a TetMesh, cuts: &'a Cuts, portion: Option<&'a Portion>) -> Self {
        Self {
            mesh,
            cuts,
            portion,
            points: Vec::new(),
            positions: Vec::new(),
            of_cut: vec![0; cuts.list().len()],
            others: ByNode::new(mesh.positions.len()),
            of_other: Vec::new(),
            centre: (u32::MAX, 0),
        }
    }

    /// Number of points, mesh nodes included.
    pub(super) fn len(&self) -> usize {
        self.mesh.positions.len() + self.positions.len()
    }

    /// Returns true if a number is that of a mesh node.
    pub(super) fn is_node(&self, number: u32) -> bool {
        (number as usize) < self.mesh.positions.len()
    }

    /// Position of a point, m, given its number.
    pub(crate) fn place(&self, number: u32) -> DVec3 {
        let v = number as usize;
        match self.mesh.positions.get(v) {
            Some(node) => node.as_dvec3(),
            None => self.positions[v - self.mesh.positions.len()],
        }
    }

    /// A mesh node that a point lies beside, of the label given.
    pub(super) fn anchor(&self, number: u32, label_of: impl Fn(u32) -> u32, label: u32) -> u32 {
        let first = self.mesh.positions.len() as u32;
        let beside = match number.checked_sub(first) {
            None => [number; 4],
            Some(place) => match self.points[place as usize] {
                Point::Node(v) => [v; 4],
                Point::Edge(a, b) => [a, b, b, b],
                Point::Face(a, b, c) => [a, b, c, c],
                Point::Centre(e) => self.mesh.tets[e as usize],
            },
        };
        let own = beside.into_iter().find(|&v| label_of(v) == label);
        own.unwrap_or(beside[0])
    }

    /// Points on faces and in tetrahedra, which later breaks of the pieces must leave in place.
    pub(super) fn fixed(&self) -> FixedPoints {
        let mut fixed = FixedPoints::default();
        for (point, &position) in self.points.iter().zip(&self.positions) {
            match *point {
                Point::Face(a, b, c) => fixed.faces.push(([a, b, c], position)),
                Point::Centre(e) => fixed.centres.push((e, position)),
                Point::Node(_) | Point::Edge(..) => {}
            }
        }
        fixed.sorted()
    }

    /// Positions of the points that are no mesh nodes, m.
    pub(super) fn into_positions(self) -> Vec<DVec3> {
        self.positions
    }

    /// Number of a point.
    pub(crate) fn number(&mut self, point: Point) -> u32 {
        match point {
            Point::Node(v) => v,
            Point::Edge(a, b) => match self.cuts.place(a, b) {
                Some(place) => {
                    let mut number = self.of_cut[place as usize];
                    if number == 0 {
                        number = self.add(point);
                        self.of_cut[place as usize] = number;
                    }
                    number
                }
                None => self.other(point, a, [b, b]),
            },
            Point::Face(a, b, c) => self.other(point, a, [b, c]),
            Point::Centre(e) => {
                if self.centre.0 != e {
                    self.centre = (e, self.add(point));
                }
                self.centre.1
            }
        }
    }

    fn other(&mut self, point: Point, lowest: u32, rest: [u32; 2]) -> u32 {
        if let Some(place) = self.others.find(lowest, rest) {
            return self.of_other[place as usize];
        }
        let number = self.add(point);
        self.others.add(lowest, rest);
        self.of_other.push(number);
        number
    }

    fn add(&mut self, point: Point) -> u32 {
        let number = self.len() as u32;
        let position = self.position(point);
        self.points.push(point);
        self.positions.push(position);
        number
    }

    fn position(&self, point: Point) -> DVec3 {
        match point {
            Point::Node(v) => self.place(v),
            Point::Edge(a, b) => {
                // An edge between two labels is always cut; the middle stands in for an uncut one all the same.
                let at = self.cuts.get(a, b).map_or(0.5, |cut| cut.at);
                self.place(a).lerp(self.place(b), at)
            }
            Point::Face(a, b, c) => {
                if let Some(fixed) = self.portion.and_then(|p| p.fixed().face([a, b, c])) {
                    return fixed;
                }
                let cut = |a, b| self.position(Point::Edge(a, b));
                match [a, b, c].map(|v| self.is_foreign(v)) {
                    // On the segment that has been the piece's edge so far.
                    [true, false, false] => (cut(a, b) + cut(a, c)) / 2.0,
                    [false, true, false] => (cut(a, b) + cut(b, c)) / 2.0,
                    [false, false, true] => (cut(a, c) + cut(b, c)) / 2.0,
                    _ => (cut(a, b) + cut(b, c) + cut(a, c)) / 3.0,
                }
            }
            Point::Centre(e) => {
                if let Some(fixed) = self.portion.and_then(|p| p.fixed().centre(e)) {
                    return fixed;
                }
                let nodes = self.mesh.tets[e as usize];
                let foreign = nodes.map(|v| self.is_foreign(v));
                let border = foreign.contains(&true);
                if let Some(middle) = self.middle_of_quad(&nodes, &foreign) {
                    return middle;
                }
                let (mut sum, mut count) = (DVec3::ZERO, 0.0);
                for [i, j] in EDGES {
                    let (a, b) = (nodes[i].min(nodes[j]), nodes[i].max(nodes[j]));
                    // On the face that has been the piece's so far.
                    if border && foreign[i] == foreign[j] {
                        continue;
                    }
                    if self.cuts.get(a, b).is_some() {
                        sum += self.position(Point::Edge(a, b));
                        count += 1.0;
                    }
                }
                sum / count
            }
        }
    }

    /// For a tetrahedron with two nodes of its own and two of a neighbour, the middle of the diagonal along which the quad
    /// between them has been split so far, so that what is fanned from there is the same two triangles.
    fn middle_of_quad(&self, nodes: &[u32; 4], foreign: &[bool; 4]) -> Option<DVec3> {
        let pair = |side: bool| {
            let mut of_side = (0..4).filter(|&k| foreign[k] == side).map(|k| nodes[k]);
            match (of_side.next(), of_side.next(), of_side.next()) {
                (Some(a), Some(b), None) => Some([a, b]),
                _ => None,
            }
        };
        let ([a, b], [c, d]) = (pair(false)?, pair(true)?);
        let edge = |v: u32, w: u32| Point::Edge(v.min(w), v.max(w));
        let diagonals = [[edge(a, c), edge(b, d)], [edge(a, d), edge(b, c)]];
        let split = diagonals
            .into_iter()
            .min_by_key(|ends| ends[0].min(ends[1]));
        split.map(|ends| ends.map(|end| self.position(end)).iter().sum::<DVec3>() / 2.0)
    }

    /// Returns true if a node belongs to another piece.
    fn is_foreign(&self, node: u32) -> bool {
        self.portion.is_some_and(|p| !p.has_node(node))
    }
}
