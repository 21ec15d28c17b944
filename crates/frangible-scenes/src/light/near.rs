//! Distances between a mesh and its simplification, kept below a limit collapse by collapse.

use frangible::glam::{DVec3, Vec3};
use frangible::internals::mesh::{TriangleTree, closest_on_triangle};

use super::topology::Topology;

/// Share of the limit that rounding may take.
const ROUNDING: f64 = 1e-4;

/// The full mesh: a search tree, and its corners and middles of triangles, each in the care of a face of the light mesh that is near it.
pub(super) struct Full {
    tree: TriangleTree,
    samples: Vec<DVec3>,
    of_face: Vec<Vec<u32>>,
    /// Limit, squared.
    most: f64,
}

impl Full {
    pub(super) fn new(topology: &Topology, most: f64) -> Self {
        let triangles: Vec<[u32; 3]> = topology.faces.iter().map(|face| face.places).collect();
        let corner = |v: u32| topology.places[v as usize].as_dvec3();
        let mut full = Self {
            tree: TriangleTree::new(&topology.places, &triangles),
            samples: Vec::new(),
            of_face: vec![Vec::new(); triangles.len()],
            most: (most * (1.0 - ROUNDING)).powi(2),
        };
        for (face, triangle) in triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(corner);
            full.give(face, (a + b + c) / 3.0);
        }
        for (place, faces) in topology.around.iter().enumerate() {
            if let Some(&face) = faces.first() {
                full.give(face as usize, corner(place as u32));
            }
        }
        full
    }

    fn give(&mut self, face: usize, sample: DVec3) {
        self.of_face[face].push(self.samples.len() as u32);
        self.samples.push(sample);
    }

    /// Returns true if a point is near the full mesh.
    pub(super) fn is_near(&self, point: DVec3) -> bool {
        let found = self.tree.closest(point.as_vec3());
        found.position.as_dvec3().distance_squared(point) <= self.most
    }

    /// Shares out what is in the care of some faces, and of those that are gone, among the former as they lie now. `None` if one is too far from all.
    pub(super) fn shared_out(
        &self,
        gone: &[u32],
        faces: &[(u32, [DVec3; 3])],
    ) -> Option<Vec<Vec<u32>>> {
        let mut shares = vec![Vec::new(); faces.len()];
        let of = |face: u32| self.of_face[face as usize].iter().copied();
        let own = faces.iter().enumerate();
        // Most stay in the care of their face.
        let kept = own.flat_map(|(k, &(face, _))| of(face).map(move |sample| (k, sample)));
        let homeless = gone.iter().flat_map(|&face| of(face).map(|s| (0, s)));
        for (first, sample) in homeless.chain(kept) {
            let point = self.samples[sample as usize];
            let away = |k: usize| {
                let [a, b, c] = faces[k].1;
                let [u, v, w] = closest_on_triangle([a, b, c], point);
                (a * u + b * v + c * w).distance_squared(point)
            };
            let (mut nearest, mut least) = (first, away(first));
            for k in 0..faces.len() {
                let distance = away(k);
                if distance < least {
                    (nearest, least) = (k, distance);
                }
            }
            if least > self.most {
                return None;
            }
            shares[nearest].push(sample);
        }
        Some(shares)
    }

    /// Puts shares into the care of these faces.
    pub(super) fn take(
        &mut self,
        gone: &[u32],
        faces: &[(u32, [DVec3; 3])],
        shares: Vec<Vec<u32>>,
    ) {
        for &face in gone {
            self.of_face[face as usize].clear();
        }
        for (&(face, _), share) in faces.iter().zip(shares) {
            self.of_face[face as usize] = share;
        }
    }

    /// Largest distance of a mesh from the full one, and back, at the corners and middles of the triangles of each, m.
    pub(super) fn distance(&self, positions: &[Vec3], triangles: &[[u32; 3]]) -> f32 {
        if triangles.is_empty() || self.samples.is_empty() {
            return f32::INFINITY;
        }
        let tree = TriangleTree::new(positions, triangles);
        let away = |tree: &TriangleTree, p: Vec3| tree.closest(p).position.distance(p);
        let samples = self.samples.iter().map(|p| away(&tree, p.as_vec3()));
        let own = triangles.iter().flat_map(|t| {
            let [a, b, c] = t.map(|v| positions[v as usize]);
            [a, b, c, (a + b + c) / 3.0]
        });
        samples
            .chain(own.map(|p| away(&self.tree, p)))
            .fold(0.0, f32::max)
    }
}
