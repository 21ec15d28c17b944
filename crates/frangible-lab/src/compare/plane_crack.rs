//! A crack along the faces of tetrahedra: as near to a plane as they allow.

use std::collections::VecDeque;

use frangible::Body;
use frangible::glam::Vec3;
use frangible::internals::TetMesh;
use frangible::internals::mesh::NO_NEIGHBOUR;
use frangible::internals::stress::{share_beside, share_left};

use super::moment::Moment;

/// Local nodes of the face opposite node `k`, counter-clockwise seen from outside.
pub(crate) const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// A face is closed.
const CLOSED: u32 = u32::MAX;

/// A crack that has run.
pub(crate) struct PlaneCrack {
    pub(crate) normal: Vec3,
    /// Middles of its tetrahedra, m.
    sites: Vec<Vec3>,
    /// Largest distance of a site from the start, m.
    extent: f32,
}

impl PlaneCrack {
    /// Share of the tension across it that it leaves at a point, for this β of [`share_beside`].
    pub(crate) fn share_left(&self, p: Vec3, beta: f32) -> f32 {
        let to_sites = self.sites.iter().map(|&site| site - p);
        let nearest = to_sites.min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        nearest.map_or(1.0, |to| {
            share_left(to, self.normal, |y| share_beside(y, self.extent, beta))
        })
    }
}

/// The faces of a mesh, closed or open, and the energy spent on opening them.
pub(crate) struct Faces<'a> {
    body: &'a Body,
    mesh: &'a TetMesh,
    /// Crack that opened each face of each tetrahedron.
    opened_by: Vec<[u32; 4]>,
    /// Round in which each tetrahedron was met last.
    met: Vec<u32>,
    round: u32,
    /// Energy that all cracks together may spend, J.
    budget: f64,
    /// Σ A G_c, J.
    pub(crate) spent: f64,
    /// One side, m².
    pub(crate) area: f64,
}

impl<'a> Faces<'a> {
    /// Starts with all faces closed. `budget`: energy that all cracks together may spend, J.
    pub(crate) fn new(body: &'a Body, budget: f64) -> Self {
        let mesh: &TetMesh = body.asset().fracture();
        Self {
            body,
            mesh,
            opened_by: vec![[CLOSED; 4]; mesh.tets.len()],
            met: vec![0; mesh.tets.len()],
            round: 0,
            budget,
            spent: 0.0,
            area: 0.0,
        }
    }

    /// Returns true if a face is open.
    pub(crate) fn is_open(&self, tet: u32, face: usize) -> bool {
        self.opened_by[tet as usize][face] != CLOSED
    }

    /// Returns true if a tetrahedron has an open face.
    pub(crate) fn is_touched(&self, tet: u32) -> bool {
        self.opened_by[tet as usize] != [CLOSED; 4]
    }

    /// Lets a crack run from a tetrahedron, breadth first through those that its plane crosses, over faces that no other crack has
    /// opened. Where the middles of two neighbours lie on different sides of the plane their face opens. A tetrahedron's faces
    /// open if they can be paid: E_f + A G_c < E_s + A γ η `[G12 §5.2.3]`, and from the budget. None if nothing opened.
    pub(crate) fn run(
        &mut self,
        start: u32,
        normal: Vec3,
        moment: &mut Moment<'_>,
    ) -> Option<PlaneCrack> {
        let mesh = self.mesh;
        let origin = mesh.centroid(start as usize);
        let above = |tet: u32| (mesh.centroid(tet as usize) - origin).dot(normal) >= 0.0;
        let depth = self.body.asset().material().energy_depth;
        self.round += 1;
        let id = self.round;
        let (mut spent, mut available) = (0.0, 0.0);
        let mut sites = Vec::new();
        self.met[start as usize] = id;
        let mut front = VecDeque::from([start]);
        while let Some(tet) = front.pop_front() {
            let own = above(tet);
            let (mut opening, mut area) = ([false; 4], 0.0);
            for k in 0..4 {
                let other = mesh.neighbours[tet as usize][k];
                if other != NO_NEIGHBOUR && !self.is_open(tet, k) && above(other) != own {
                    opening[k] = true;
                    area += face_area(mesh, tet, k);
                }
            }
            if area > 0.0 {
                let cost = area * self.body.toughness(tet);
                let gain = area * depth * f64::from(moment.inside(tet).energy_density);
                let paid = spent + cost < available + gain && self.spent + cost <= self.budget;
                if !paid {
                    continue;
                }
                spent += cost;
                available += gain;
                self.spent += cost;
                self.area += area;
                sites.push(mesh.centroid(tet as usize));
                self.open(tet, opening, id);
            }
            for (k, &other) in mesh.neighbours[tet as usize].iter().enumerate() {
                let by = self.opened_by[tet as usize][k];
                let passable = other != NO_NEIGHBOUR && (by == CLOSED || by == id);
                if passable
                    && self.met[other as usize] != id
                    && crosses(mesh, other, origin, normal)
                {
                    self.met[other as usize] = id;
                    front.push_back(other);
                }
            }
        }
        let extent = sites
            .iter()
            .map(|site| site.distance(origin))
            .reduce(f32::max)?;
        Some(PlaneCrack {
            normal,
            sites,
            extent,
        })
    }

    /// Opens faces of a tetrahedron, from both sides.
    fn open(&mut self, tet: u32, opening: [bool; 4], by: u32) {
        for (k, _) in opening.iter().enumerate().filter(|(_, opens)| **opens) {
            let other = self.mesh.neighbours[tet as usize][k];
            self.opened_by[tet as usize][k] = by;
            let back = self.mesh.neighbours[other as usize]
                .iter()
                .position(|&e| e == tet);
            if let Some(back) = back {
                self.opened_by[other as usize][back] = by;
            }
        }
    }
}

/// Returns true if a plane has nodes of a tetrahedron on both sides. A node on the plane counts as above.
fn crosses(mesh: &TetMesh, tet: u32, origin: Vec3, normal: Vec3) -> bool {
    let above = mesh
        .corners(tet as usize)
        .map(|x| (x - origin).dot(normal) >= 0.0);
    above != [above[0]; 4]
}

/// Corners of a face, counter-clockwise seen from outside the tetrahedron.
pub(crate) fn face(mesh: &TetMesh, tet: u32, face: usize) -> [u32; 3] {
    FACES[face].map(|i| mesh.tets[tet as usize][i])
}

/// Area of a face, m².
pub(crate) fn face_area(mesh: &TetMesh, tet: u32, k: usize) -> f64 {
    let [a, b, c] = face(mesh, tet, k).map(|v| mesh.positions[v as usize].as_dvec3());
    0.5 * (b - a).cross(c - a).length()
}
