//! Tetrahedral solid of a piece, from which its modes are computed.
//!
//! In cracked bodies, cut tetrahedra are represented by their parts. Two parts are connected if they share a node of the face between
//! them, and the lattice has a copy of its cell on each side of a crack.

use glam::DVec3;

use super::Portion;
use crate::fragment::{Point, PointTable, face_parts, interfaces};
use crate::mesh::{EDGES, FACES, NO_NEIGHBOUR};
use crate::state::Cuts;

/// Tetrahedra that fill a piece. Tetrahedra cut by cracks are split into parts, and parts on opposite sides of a crack are not
/// connected.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    /// Positions of the nodes, in the frame of the fracture mesh, m: [`Portion::nodes`], then points on the cracks.
    pub positions: Vec<DVec3>,
    /// Right-handed tetrahedra: [`Portion::tets`], then the parts of cut ones.
    pub tets: Vec<[u32; 4]>,
    /// Pairs of tetrahedra connected over a face or a part of one.
    pub joined: Vec<[u32; 2]>,
}

/// Volume below which a part of a tetrahedron is left out, as a share of it.
const SLIVER: f64 = 1e-9;

/// A part of a cut tetrahedron: corners of its own, a bit each, and tetrahedra that fill it, with the face they lie at.
struct Part {
    tet: u32,
    corners: u8,
    filling: Vec<(u32, Option<u8>)>,
}

impl Portion {
    /// Returns the tetrahedra that fill the portion.
    #[must_use]
    pub fn solid(&self) -> Solid {
        let mesh = &self.root.fracture;
        let place = |v: u32| self.nodes().binary_search(&v).ok().map(|i| i as u32);
        let mut solid = Solid::default();
        let nodes = self.nodes().iter();
        solid.positions = nodes
            .map(|&v| mesh.positions[v as usize].as_dvec3())
            .collect();
        for &e in self.tets() {
            let own = mesh.tets[e as usize].map(|v| place(v).unwrap_or(0));
            solid.tets.push(own);
        }
        let parts = self.parts(&mut solid);
        self.join(&parts, &mut solid);
        solid
    }

    /// Fills the cut tetrahedra, by rising number.
    fn parts(&self, solid: &mut Solid) -> Vec<Part> {
        let mesh = &self.root.fracture;
        let cuts = Cuts::of_list(self.cuts(), mesh.positions.len());
        let mut table = PointTable::new(mesh, &cuts, Some(self));
        let mut cut: Vec<u32> = self
            .cracked()
            .iter()
            .chain(self.divided())
            .copied()
            .collect();
        cut.sort_unstable();
        let mut parts = Vec::new();
        for e in cut {
            let nodes = mesh.tets[e as usize];
            let own = nodes.map(|v| self.has_node(v));
            let labels = labels(&nodes, &own, &cuts);
            let mut faces: Vec<(u32, [Point; 3], Option<u8>)> = Vec::new();
            interfaces(e, &nodes, &labels, |i| {
                let [a, b, c] = i.points;
                faces.push((i.inside, [a, b, c], None));
                faces.push((i.outside, [a, c, b], None));
            });
            for (k, face) in (0..).zip(FACES) {
                let (n, l) = (face.map(|i| nodes[i]), face.map(|i| labels[i]));
                face_parts(&n, &l, |label, points| faces.push((label, points, Some(k))));
            }
            for first in 0..4 {
                let of_part = |k: usize| own[k] && labels[k] == labels[first];
                if !own[first] || (0..first).any(of_part) {
                    continue;
                }
                let bits = (0..4).filter(|&k| of_part(k));
                let mut part = Part {
                    tet: e,
                    corners: bits.fold(0, |bits, k| bits | 1 << k),
                    filling: Vec::new(),
                };
                let faces = faces.iter().filter(|f| f.0 == labels[first]);
                // Corners: nodes of its own, and points on the cracks.
                let (mut corners, mut known) = (Vec::new(), Vec::new());
                let mut corner = |point: Point| {
                    let number = table.number(point);
                    let place = known.iter().position(|&n| n == number);
                    place.unwrap_or_else(|| {
                        known.push(number);
                        let node = self.nodes().binary_search(&number).ok();
                        let node = node.filter(|_| matches!(point, Point::Node(_)));
                        let position = table.place(number);
                        corners.push(node.map_or_else(
                            || {
                                solid.positions.push(position);
                                solid.positions.len() as u32 - 1
                            },
                            |node| node as u32,
                        ));
                        corners.len() - 1
                    })
                };
                let faces: Vec<([usize; 3], Option<u8>)> = faces
                    .map(|(_, points, k)| (points.map(&mut corner), *k))
                    .collect();
                fill(solid, &mut part, &corners, &faces, mesh.volume(e as usize));
                parts.push(part);
            }
        }
        parts
    }

    /// Joins parts that hang together: two parts that share a node of the face between them.
    fn join(&self, parts: &[Part], solid: &mut Solid) {
        let mesh = &self.root.fracture;
        let filling = |e: u32, side: usize| {
            // What of tetrahedron e touches its face `side`: corners, and tetrahedra of the solid.
            let first = parts.partition_point(|p| p.tet < e);
            let own = parts[first..].iter().take_while(move |p| p.tet == e);
            own.map(move |p| {
                let at = p.filling.iter().filter(move |f| f.1 == Some(side as u8));
                (p.corners, at.map(|f| f.0).collect::<Vec<u32>>())
            })
            .collect::<Vec<_>>()
        };
        let whole = |e: u32| self.tets().binary_search(&e).ok().map(|i| i as u32);
        let touching = |e: u32, side: usize| match whole(e) {
            Some(place) => vec![(0b1111, vec![place])],
            None => filling(e, side),
        };
        for part in parts {
            for (i, a) in part.filling.iter().enumerate() {
                for b in &part.filling[..i] {
                    solid.joined.push([b.0, a.0]);
                }
            }
        }
        let cut = parts.chunk_by(|a, b| a.tet == b.tet).map(|p| p[0].tet);
        let all: Vec<u32> = self.tets().iter().copied().chain(cut).collect();
        for e in all {
            for (side, &n) in mesh.neighbours[e as usize].iter().enumerate() {
                if n == NO_NEIGHBOUR || n < e {
                    continue;
                }
                let back = mesh.neighbours[n as usize].iter().position(|&m| m == e);
                let (Some(back), tet, other) = (back, mesh.tets[e as usize], mesh.tets[n as usize])
                else {
                    continue;
                };
                let there = touching(n, back);
                for (corners, here) in touching(e, side) {
                    for (corners_there, there) in &there {
                        let shared = (0..4).filter(|&k| k != side && corners >> k & 1 == 1);
                        let mut shared =
                            shared.filter_map(|k| other.iter().position(|&v| v == tet[k]));
                        if shared.any(|k| corners_there >> k & 1 == 1) {
                            let pairs = here
                                .iter()
                                .flat_map(|&a| there.iter().map(move |&b| [a, b]));
                            solid.joined.extend(pairs);
                        }
                    }
                }
            }
        }
    }
}

/// Labels of a tetrahedron's corners: one for each set of its own that uncut edges join, and for each set of the others.
fn labels(nodes: &[u32; 4], own: &[bool; 4], cuts: &Cuts) -> [u32; 4] {
    let mut labels = [0, 1, 2, 3];
    for _ in 0..3 {
        for [i, j] in EDGES {
            if own[i] == own[j] && cuts.get(nodes[i], nodes[j]).is_none() {
                let low = labels[i].min(labels[j]);
                (labels[i], labels[j]) = (low, low);
            }
        }
    }
    labels
}

/// Fills a part with tetrahedra from the middle of its corners (nodes of the solid) to its faces (places among them).
fn fill(
    solid: &mut Solid,
    part: &mut Part,
    corners: &[u32],
    faces: &[([usize; 3], Option<u8>)],
    whole: f64,
) {
    let at = |v: u32| solid.positions[v as usize];
    let middle = corners.iter().map(|&v| at(v)).sum::<DVec3>() / corners.len().max(1) as f64;
    let apex = solid.positions.len() as u32;
    solid.positions.push(middle);
    for &(face, side) in faces {
        let nodes = face.map(|i| corners[i]);
        let [a, b, c] = nodes.map(|v| solid.positions[v as usize] - middle);
        // The parts are star-shaped but for rounding and warped quads.
        if a.cross(b).dot(c) / 6.0 <= SLIVER * whole {
            continue;
        }
        part.filling.push((solid.tets.len() as u32, side));
        solid.tets.push([apex, nodes[0], nodes[1], nodes[2]]);
    }
}
