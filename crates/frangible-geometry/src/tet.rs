//! Linear tetrahedra with face adjacency.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

/// Marks a face on the outside in [`TetMesh::neighbours`].
pub const NO_NEIGHBOUR: u32 = u32::MAX;

/// A tetrahedral mesh; every tetrahedron has positive volume.
#[derive(Clone, Debug, Default)]
pub struct TetMesh {
    /// Node positions, m.
    pub positions: Vec<Vec3>,
    /// Node indices of each tetrahedron, right-handed: det(x1−x0, x2−x0, x3−x0) > 0.
    pub tets: Vec<[u32; 4]>,
    /// Neighbour across the face opposite each of the four nodes, or [`NO_NEIGHBOUR`].
    pub neighbours: Vec<[u32; 4]>,
}

/// Local nodes of the face opposite node `k`, counter-clockwise seen from outside.
pub const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Distance beyond a face up to which a point still counts as inside, relative to its distance from a corner.
const ROUNDING: f32 = 1e-5;

/// Most tetrahedra that the search for a point passes.
const MOST_STEPS: usize = 256;

/// Local end nodes of the six edges.
pub const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];

impl TetMesh {
    /// Builds the face adjacency. Tetrahedra must be right-handed and share whole faces.
    #[must_use]
    pub fn new(positions: Vec<Vec3>, tets: Vec<[u32; 4]>) -> Self {
        let mut open: HashMap<[u32; 3], (u32, usize)> = HashMap::with_capacity(2 * tets.len());
        let mut neighbours = vec![[NO_NEIGHBOUR; 4]; tets.len()];
        for (e, tet) in tets.iter().enumerate() {
            for (k, face) in FACES.iter().enumerate() {
                let mut key = face.map(|i| tet[i]);
                key.sort_unstable();
                // Look-ups only: the order of the map never shows.
                if let Some((other, other_face)) = open.remove(&key) {
                    neighbours[e][k] = other;
                    neighbours[other as usize][other_face] = e as u32;
                } else {
                    open.insert(key, (e as u32, k));
                }
            }
        }
        Self {
            positions,
            tets,
            neighbours,
        }
    }

    /// Returns the corner positions of tetrahedron `e`, m.
    #[must_use]
    #[inline]
    pub fn corners(&self, e: usize) -> [Vec3; 4] {
        self.tets[e].map(|v| self.positions[v as usize])
    }

    /// Returns the centroid of tetrahedron `e`, m.
    #[must_use]
    #[inline]
    pub fn centroid(&self, e: usize) -> Vec3 {
        self.corners(e).iter().sum::<Vec3>() * 0.25
    }

    /// Returns the volume of tetrahedron `e`, m³.
    #[must_use]
    pub fn volume(&self, e: usize) -> f64 {
        let [a, b, c, d]: [DVec3; 4] = self.corners(e).map(Vec3::as_dvec3);
        (b - a).cross(c - a).dot(d - a) / 6.0
    }

    /// Returns the tetrahedron that contains a point, by walking towards it from tetrahedron `start`; `None` if the walk leaves the mesh.
    #[must_use]
    pub fn locate(&self, start: u32, point: Vec3) -> Option<u32> {
        let mut e = start;
        for _ in 0..MOST_STEPS {
            let x = self.corners(e as usize);
            let beyond = |k: usize| {
                let [a, b, c] = FACES[k].map(|i| x[i]);
                (b - a).cross(c - a).normalize_or_zero().dot(point - a)
            };
            let (farthest, distance) = (0..4)
                .map(|k| (k, beyond(k)))
                .fold((0, f32::NEG_INFINITY), |a, b| if b.1 > a.1 { b } else { a });
            if distance <= ROUNDING * point.distance(x[0]) {
                return Some(e);
            }
            e = match self.neighbours[e as usize][farthest] {
                NO_NEIGHBOUR => return None,
                next => next,
            };
        }
        None
    }

    /// Returns the total volume, m³.
    #[must_use]
    pub fn total_volume(&self) -> f64 {
        (0..self.tets.len()).map(|e| self.volume(e)).sum()
    }

    /// Returns the faces without a neighbour: node indices (counter-clockwise seen from outside) and the tetrahedron of each.
    #[must_use]
    pub fn boundary(&self) -> Vec<([u32; 3], u32)> {
        let mut faces = Vec::new();
        for (e, (tet, neighbours)) in self.tets.iter().zip(&self.neighbours).enumerate() {
            for k in 0..4 {
                if neighbours[k] == NO_NEIGHBOUR {
                    faces.push((FACES[k].map(|i| tet[i]), e as u32));
                }
            }
        }
        faces
    }

    /// Returns the mean edge length, m.
    #[must_use]
    pub fn mean_edge(&self) -> f32 {
        let mut sum = 0.0_f64;
        for e in 0..self.tets.len() {
            let x = self.corners(e);
            sum += EDGES
                .iter()
                .map(|&[i, j]| f64::from(x[i].distance(x[j])))
                .sum::<f64>();
        }
        (sum / (6 * self.tets.len().max(1)) as f64) as f32
    }

    /// Returns the length of the longest edge, m.
    #[must_use]
    pub fn longest_edge(&self) -> f32 {
        let tets = (0..self.tets.len()).map(|e| self.corners(e));
        tets.flat_map(|x| EDGES.map(|[i, j]| x[i].distance_squared(x[j])))
            .fold(0.0, f32::max)
            .sqrt()
    }
}
