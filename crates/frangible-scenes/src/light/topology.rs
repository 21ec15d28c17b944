//! Places, and the triangles between them.

use std::collections::HashMap;

use frangible::glam::Vec3;
use frangible::internals::RenderMesh;

/// Wedge of all corners of crack faces. Their attributes, and those of [`MADE`] corners, are made anew.
pub(super) const INNER: u32 = u32::MAX;

/// Wedge of all corners of an outer surface that no one drew, but the mesher made.
pub(super) const MADE: u32 = INNER - 1;

/// Attributes of corners that differ by less than this are one.
const ALIKE: f32 = 1e-3;

/// A corner of the outer surface: all triangles of its material around a place that agree in its attributes.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Wedge {
    /// A vertex with its attributes.
    pub(super) vertex: u32,
    pub(super) material: Option<u32>,
}

#[derive(Clone, Copy)]
pub(super) struct Face {
    pub(super) places: [u32; 3],
    pub(super) wedges: [u32; 3],
    /// Number in the full mesh.
    pub(super) source: u32,
    pub(super) is_left: bool,
}

#[derive(Clone, Default)]
pub(super) struct Topology {
    pub(super) places: Vec<Vec3>,
    pub(super) faces: Vec<Face>,
    pub(super) wedges: Vec<Wedge>,
    /// Faces around each place.
    pub(super) around: Vec<Vec<u32>>,
    /// True for places that stay.
    pub(super) stays: Vec<bool>,
}

impl Topology {
    /// `is_drawn`: the outer surface is its author's.
    pub(super) fn of(mesh: &RenderMesh, is_drawn: bool) -> Self {
        let mut topology = Self::default();
        // Looked up only, never iterated.
        let mut known = HashMap::new();
        let place_of: Vec<u32> = mesh
            .positions
            .iter()
            .map(|&position| {
                let bits = position.to_array().map(|x| (x + 0.0).to_bits());
                *known.entry(bits).or_insert_with(|| {
                    topology.places.push(position);
                    topology.places.len() as u32 - 1
                })
            })
            .collect();
        let count = topology.places.len();
        topology.around = vec![Vec::new(); count];
        let mut wedges_at: Vec<Vec<u32>> = vec![Vec::new(); count];
        for (source, triangle) in (0_u32..).zip(&mesh.triangles) {
            let places = triangle.map(|v| place_of[v as usize]);
            // Without area or extent: nothing is seen of it, and its neighbours meet without it.
            if places[0] == places[1] || places[1] == places[2] || places[2] == places[0] {
                continue;
            }
            let material = mesh.material_of_triangle.get(source as usize).copied();
            let is_outer = (source as usize) < mesh.outer_triangles;
            let wedges = if is_outer && is_drawn {
                [0, 1, 2].map(|k| {
                    let wedge = Wedge {
                        vertex: triangle[k],
                        material,
                    };
                    topology.wedge(mesh, wedge, &mut wedges_at[places[k] as usize])
                })
            } else {
                [if is_outer { MADE } else { INNER }; 3]
            };
            let number = topology.faces.len() as u32;
            for place in places {
                topology.around[place as usize].push(number);
            }
            topology.faces.push(Face {
                places,
                wedges,
                source,
                is_left: true,
            });
        }
        topology.stays = topology.staying();
        topology
    }

    /// Number of a wedge at a place, that of a like one if there is any.
    fn wedge(&mut self, mesh: &RenderMesh, wedge: Wedge, here: &mut Vec<u32>) -> u32 {
        let is_alike = |&&known: &&u32| {
            let known = self.wedges[known as usize];
            known.material == wedge.material && are_alike(mesh, known.vertex, wedge.vertex)
        };
        if let Some(&known) = here.iter().find(is_alike) {
            return known;
        }
        let number = self.wedges.len() as u32;
        self.wedges.push(wedge);
        here.push(number);
        number
    }

    /// Returns true for a place of the outer surface alone, if its author drew it.
    pub(super) fn is_authored(&self, place: u32) -> bool {
        let mut faces = self.around[place as usize].iter();
        faces.all(|&face| self.faces[face as usize].wedges[0] < MADE)
    }

    /// Returns true for a place of crack faces alone, or of a surface that no one drew.
    pub(super) fn is_free(&self, place: u32) -> bool {
        let mut faces = self.around[place as usize].iter();
        let kind = |face: u32| self.faces[face as usize].wedges[0];
        let first = faces.next().map(|&face| kind(face));
        !self.stays[place as usize]
            && first.is_some_and(|first| first >= MADE && faces.all(|&face| kind(face) == first))
    }

    /// Places at sides that do not have two faces.
    fn staying(&self) -> Vec<bool> {
        let mut stays = vec![false; self.places.len()];
        let mut sides: Vec<[u32; 2]> = Vec::with_capacity(3 * self.faces.len());
        for face in &self.faces {
            let [a, b, c] = face.places;
            sides.extend([[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)]));
        }
        sides.sort_unstable();
        for same in sides.chunk_by(|a, b| a == b).filter(|same| same.len() != 2) {
            for place in same[0] {
                stays[place as usize] = true;
            }
        }
        stays
    }
}

fn are_alike(mesh: &RenderMesh, a: u32, b: u32) -> bool {
    a == b || is_between(mesh, a, [b; 3], [1.0, 0.0, 0.0])
}

/// Returns true if the attributes of a vertex are the weighted means of those of others, about.
pub(super) fn is_between(mesh: &RenderMesh, own: u32, of: [u32; 3], weights: [f32; 3]) -> bool {
    let (own, of) = (own as usize, of.map(|v| v as usize));
    let is_mean = |own: f32, of: [f32; 3]| {
        let mean = of[0] * weights[0] + of[1] * weights[1] + of[2] * weights[2];
        (own - mean).abs() <= ALIKE * (1.0 + own.abs())
    };
    fn all_means<const N: usize>(
        rows: &[[f32; N]],
        own: usize,
        of: [usize; 3],
        is_mean: impl Fn(f32, [f32; 3]) -> bool,
    ) -> bool {
        rows.is_empty() || (0..N).all(|k| is_mean(rows[own][k], of.map(|v| rows[v][k])))
    }
    let normals = of.map(|v| mesh.normals[v]);
    let normal = normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2];
    normal.normalize_or_zero().distance(mesh.normals[own]) <= 10.0 * ALIKE
        && all_means(&mesh.uvs, own, of, is_mean)
        && all_means(&mesh.colors, own, of, is_mean)
        && (mesh.more_uvs.iter()).all(|uvs| all_means(uvs, own, of, is_mean))
}
