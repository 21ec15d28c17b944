//! The points of a partition, numbered.

use glam::DVec3;

use super::by_node::ByNode;
use super::cuts::Cuts;
use super::partition::Point;
use crate::mesh::{EDGES, TetMesh};

/// Points of the partition in f64, body frame, numbered in order of first use; mesh nodes come first.
pub(super) struct PointTable<'a> {
    mesh: &'a TetMesh,
    cuts: &'a Cuts,
    /// Of all that are no mesh nodes.
    positions: Vec<DVec3>,
    /// Number of each cut edge's point, 0 for none yet; a mesh node's number is never asked for.
    of_cut: Vec<u32>,
    /// Faces and uncut edges, by their lowest node and the others …
    others: ByNode<[u32; 2]>,
    /// … and their numbers.
    of_other: Vec<u32>,
    /// The latest centre: its tetrahedron is the only one that asks for it.
    centre: (u32, u32),
}

impl<'a> PointTable<'a> {
    pub(super) fn new(mesh: &'a TetMesh, cuts: &'a Cuts) -> Self {
        Self {
            mesh,
            cuts,
            positions: Vec::new(),
            of_cut: vec![0; cuts.list().len()],
            others: ByNode::new(mesh.positions.len()),
            of_other: Vec::new(),
            centre: (u32::MAX, 0),
        }
    }

    /// How many there are, mesh nodes included.
    pub(super) fn len(&self) -> usize {
        self.mesh.positions.len() + self.positions.len()
    }

    /// Whether a number is that of a mesh node.
    pub(super) fn is_node(&self, number: u32) -> bool {
        (number as usize) < self.mesh.positions.len()
    }

    /// Where a point is, m, given its number.
    pub(super) fn place(&self, number: u32) -> DVec3 {
        let v = number as usize;
        match self.mesh.positions.get(v) {
            Some(node) => node.as_dvec3(),
            None => self.positions[v - self.mesh.positions.len()],
        }
    }

    /// Where the points are that are no mesh nodes, m.
    pub(super) fn into_positions(self) -> Vec<DVec3> {
        self.positions
    }

    /// Number of a point.
    pub(super) fn number(&mut self, point: Point) -> u32 {
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
                let cut = |a, b| self.position(Point::Edge(a, b));
                (cut(a, b) + cut(b, c) + cut(a, c)) / 3.0
            }
            Point::Centre(e) => {
                let nodes = self.mesh.tets[e as usize];
                let (mut sum, mut count) = (DVec3::ZERO, 0.0);
                for [i, j] in EDGES {
                    let (a, b) = (nodes[i].min(nodes[j]), nodes[i].max(nodes[j]));
                    if self.cuts.get(a, b).is_some() {
                        sum += self.position(Point::Edge(a, b));
                        count += 1.0;
                    }
                }
                sum / count
            }
        }
    }
}
