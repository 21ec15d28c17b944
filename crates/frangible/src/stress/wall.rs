//! Walls: parts of a body thinner than the elements that carry its modes are long (beyond the paper).
//!
//! At both faces of a wall the traction σ·n is zero, and between them it is of second order in the thickness over the length
//! of the waves. One layer of elements does not resolve it: its σ·n is noise of the short waves, which also leaks into the stress along the
//! wall (λ tr E), and cracks that follow it lie flat in the wall. Without traction (plane stress) all that is left is the
//! stretching and bending of the wall.
//!
//! A rod has two faces opposite each other in every direction across it, so it is no wall: its stress is that of a solid, with no traction
//! at the surface.

use glam::Vec3;

use super::skin::{Flaw, OPPOSITE};
use crate::asset::AnalysisMesh;
use crate::mesh::NO_NEIGHBOUR;

/// Normals with a cosine above this are one direction.
const SAME: f32 = 0.95;

/// Cosine below which a face does not belong to a wall's two faces.
const ASKEW: f32 = 0.5;

/// A wall at one element of the analysis mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// Unit normal.
    pub normal: Vec3,
    /// A place on the face it points to, and one on the face behind, m.
    pub faces: [Vec3; 2],
}

impl Wall {
    /// Distance between the two faces, m.
    #[must_use]
    pub fn thickness(&self) -> f32 {
        (self.faces[0] - self.faces[1]).dot(self.normal).abs()
    }

    /// Distances of the two faces from a point within, along the normal, m: the second lies behind. Never farther than the wall is thick.
    #[must_use]
    pub fn distances(&self, p: Vec3) -> [f32; 2] {
        let thickness = self.thickness();
        self.faces
            .map(|face| (face - p).dot(self.normal).clamp(-thickness, thickness))
    }

    /// The ply that holds a point, of a wall of so many.
    pub(crate) fn ply(&self, plies: u32, p: Vec3) -> Self {
        let [front, back] = self.faces.map(|face| (face - p).dot(self.normal));
        let height = (front - back) / plies as f32;
        let last = plies.saturating_sub(1) as f32;
        let own = (-back / height).floor().clamp(0.0, last);
        let face = |k: f32| p + (back + k * height) * self.normal;
        Self {
            normal: self.normal,
            faces: [face(own + 1.0), face(own)],
        }
    }

    /// Returns true if a point lies between its faces, as planes.
    pub(crate) fn holds(&self, p: Vec3) -> bool {
        let [front, back] = self.faces.map(|face| (face - p).dot(self.normal));
        front >= 0.0 && back <= 0.0
    }

    /// Returns true if the faces of another wall lie between those of this one.
    fn is_crossed_by(&self, other: &Self) -> bool {
        let thickness = self.thickness();
        let depths = other.faces.map(|p| (self.faces[0] - p).dot(self.normal));
        depths.iter().all(|d| (0.0..=thickness).contains(d))
    }

    /// Direction of the wall's narrow edge, where a face of this unit normal belongs to that and not to one of the wall's two faces.
    #[must_use]
    pub fn edge(&self, face: Vec3) -> Option<Vec3> {
        if face.dot(self.normal).abs() < ASKEW {
            face.cross(self.normal).try_normalize()
        } else {
            None
        }
    }
}

/// Walls of a body.
#[derive(Clone, Debug, Default)]
pub(super) struct Walls {
    /// Wall of each analysis element, if it is part of one.
    pub(super) of_element: Vec<Option<Wall>>,
}

impl Walls {
    /// `neighbours`: across the faces of the analysis elements; `places`: positions of the flaws, m.
    pub(super) fn new(
        mesh: &AnalysisMesh,
        neighbours: &[[u32; 4]],
        flaws: &[Flaw],
        places: &[Vec3],
    ) -> Self {
        let count = mesh.elements.len();
        // Faces of the body in each element, one per direction.
        let mut faces: Vec<Vec<(Vec3, Vec3)>> = vec![Vec::new(); count];
        for (flaw, &place) in flaws.iter().zip(places) {
            let known = &mut faces[flaw.point.element as usize];
            if known.iter().all(|f| f.0.dot(flaw.normal) < SAME) {
                known.push((flaw.normal, place));
            }
        }
        let mut around: Vec<Vec<u32>> = vec![Vec::new(); mesh.nodes.len()];
        for (e, element) in mesh.elements.iter().enumerate() {
            if !faces[e].is_empty() {
                let corners = element[..4].iter();
                corners.for_each(|&v| around[v as usize].push(e as u32));
            }
        }
        let own: Vec<Option<Wall>> = (0..count)
            .map(|e| {
                let corners = &mesh.elements[e][..4];
                let length = longest(corners, &mesh.nodes);
                let near = || {
                    let elements = corners.iter().flat_map(|&v| &around[v as usize]);
                    elements.flat_map(|&e| &faces[e as usize])
                };
                let wall_from = |&(normal, place): &(Vec3, Vec3)| {
                    let opposite = near().find(|other| {
                        let thickness = (place - other.1).dot(normal);
                        other.0.dot(normal) < OPPOSITE && (0.0..length).contains(&thickness)
                    })?;
                    Some(Wall {
                        normal,
                        faces: [place, opposite.1],
                    })
                };
                let wall = faces[e].iter().find_map(wall_from)?;
                // Between the two faces of a rod lie two more.
                let edges = near().filter(|face| wall.edge(face.0).is_some());
                let mut across = edges.filter_map(wall_from);
                let rod = across.any(|other| wall.is_crossed_by(&other));
                (!rod).then_some(wall)
            })
            .collect();
        let between = |e: usize| {
            let sides = neighbours[e].map(|n| match n {
                NO_NEIGHBOUR => None,
                n => own[n as usize],
            });
            let sides = || sides.iter().flatten();
            // The first of its neighbours whose wall goes on behind this element.
            sides()
                .find(|a| sides().any(|b| a.normal.dot(b.normal) < OPPOSITE))
                .copied()
        };
        Self {
            of_element: (0..count).map(|e| own[e].or_else(|| between(e))).collect(),
        }
    }
}

fn longest(corners: &[u32], nodes: &[Vec3]) -> f32 {
    let at = |v: u32| nodes[v as usize];
    let pairs = corners
        .iter()
        .flat_map(|&a| corners.iter().map(move |&b| (a, b)));
    pairs
        .map(|(a, b)| at(a).distance(at(b)))
        .fold(0.0, f32::max)
}
