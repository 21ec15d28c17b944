//! Free surfaces: the places of flaws, and the stress beside them (beyond the paper).
//!
//! Brittle bodies break from flaws of their surface, and in bending the stress is largest there. The paper tests stress at
//! the centre of an element, which in a wall of one layer of tetrahedra lies at a quarter of the thickness or less from its
//! middle: there a bent wall has at most half the stress of its surface.
//! - A *flaw*: the weak point of a tetrahedron with free outer faces lies on the largest of them: of flaws spread over the
//!   surface it holds the most. The body's seed draws its place on the face ([`Places`](super::Places)).
//! - At a free surface the traction σ·n is exactly zero ([`Elasticity::free_state`](super::Elasticity::free_state)); the
//!   modes of a mesh meet that only on average.
//! - Inside a thin [wall](super::Wall) no traction acts across it either.
//!
//! Faces that something holds are not free.

use glam::Vec3;

use super::place::Places;
use super::wall::{Wall, Walls};
use crate::asset::{AnalysisMesh, Asset, EmbeddedPoint, Portion};
use crate::mesh::{NO_NEIGHBOUR, TetMesh};

/// No flaw.
const NONE: u32 = u32::MAX;

/// Cosine below which the normals of two faces count as opposite: walls taper, and bend from face to face.
pub(super) const OPPOSITE: f32 = -0.8;

/// Barycentric coordinates this little below zero still count as inside: the rounding of f32 ten body lengths off.
const INSIDE: f32 = -1e-4;

/// Largest number of elements that the search for a point passes; the face of a tetrahedron is next to its centre.
const MOST_STEPS: usize = 64;

/// The place of a flaw on the free surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flaw {
    /// Number of the surface triangle.
    pub triangle: u32,
    /// Its corners: nodes of the fracture mesh.
    pub corners: [u32; 3],
    /// Its centroid, seen by the analysis mesh. The rest of it is seen by the same element.
    pub point: EmbeddedPoint,
    /// Its outward unit normal.
    pub normal: Vec3,
}

/// Flaws and walls of a body, which follow from its surface and supports.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    /// Place in `flaws` of each fracture tetrahedron's, or [`NONE`].
    flaw_of_tet: Vec<u32>,
    flaws: Vec<Flaw>,
    walls: Walls,
}

impl Skin {
    /// Finds the flaws and the walls of an asset.
    #[must_use]
    pub fn of(asset: &Asset) -> Self {
        let free = FreeFaces::of(asset);
        let search = Search::new(&asset.analysis);
        let positions = asset.surface_positions();
        let mut flaw_of_tet = vec![NONE; asset.fracture.tets.len()];
        let (mut flaws, mut places) = (Vec::new(), Vec::new());
        let centres = free.largest.iter().zip(&asset.embedding.tets);
        for (tet, (&triangle, centre)) in centres.enumerate() {
            if triangle == NONE {
                continue;
            }
            flaw_of_tet[tet] = flaws.len() as u32;
            let nodes = asset.surface.triangles[triangle as usize];
            let corners = nodes.map(|v| positions[v as usize]);
            let place = (corners[0] + corners[1] + corners[2]) / 3.0;
            places.push(place);
            flaws.push(Flaw {
                triangle,
                corners: nodes,
                point: search.embed(place, centre.element),
                normal: free.normals[triangle as usize],
            });
        }
        Self {
            walls: Walls::new(&asset.analysis, &search.neighbours, &flaws, &places),
            flaw_of_tet,
            flaws,
        }
    }

    /// Finds the skin of a piece: the flaws that its body had, where it still has them, and walls of its own.
    pub(crate) fn of_piece(asset: &Asset, portion: &Portion, root: &Self) -> Self {
        let search = Search::new(&asset.analysis);
        let mut flaw_of_tet = vec![NONE; portion.tets().len()];
        let (mut flaws, mut places) = (Vec::new(), Vec::new());
        let mesh = &asset.root().fracture;
        for (place, &tet) in portion.tets().iter().enumerate() {
            let Some(flaw) = root.flaw(tet as usize) else {
                continue;
            };
            let corners = flaw.corners.map(|v| mesh.positions[v as usize]);
            let at = (corners[0] + corners[1] + corners[2]) / 3.0;
            flaw_of_tet[place] = flaws.len() as u32;
            places.push(at);
            flaws.push(Flaw {
                triangle: portion.surface_triangle(flaw.triangle).unwrap_or(NONE),
                corners: flaw.corners,
                point: search.embed(at, asset.embedding.tets[place].element),
                normal: flaw.normal,
            });
        }
        Self {
            walls: Walls::new(&asset.analysis, &search.neighbours, &flaws, &places),
            flaw_of_tet,
            flaws,
        }
    }

    /// The flaw of the fracture tetrahedron at a [place](Asset::place), if it has a free outer face.
    #[must_use]
    pub fn flaw(&self, place: usize) -> Option<&Flaw> {
        self.flaws.get(self.flaw_of_tet[place] as usize)
    }

    /// The point of a flaw's face at these weights of its corners, m, frame of the fracture mesh, and as the analysis mesh sees it.
    #[inline(always)]
    pub(crate) fn on_face(asset: &Asset, flaw: &Flaw, weights: [f32; 3]) -> (Vec3, EmbeddedPoint) {
        let corners = flaw.corners.map(|v| asset.fracture.positions[v as usize]);
        let at = |w: [f32; 3]| corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2];
        let (place, centre) = (at(weights), at(Places::MIDDLE));
        let gradients = &asset.analysis.barycentric_gradients[flaw.point.element as usize];
        (place, flaw.point.moved(gradients, place - centre))
    }

    /// The place of a weak point beside a film, m, and the direction from its ply to the film: of a fracture tetrahedron of a laminated wall without a
    /// face of its own. The modes see it at its middle. `ply`: its wall.
    pub(super) fn beside_film(
        &self,
        asset: &Asset,
        tet: usize,
        ply: &Wall,
    ) -> Option<(Vec3, Vec3)> {
        asset.material.laminate.as_ref()?;
        let place = asset.place(tet);
        if self.flaw(place).is_some() {
            return None;
        }
        let wall = self.walls.of_element[asset.embedding.tets[place].element as usize]?;
        let middle = asset.root().fracture.centroid(tet);
        // Of the faces of the ply the one deeper in the wall.
        let depth = |up: f32| {
            let [front, back] = wall.distances(middle + up * ply.normal);
            front.abs().min(back.abs())
        };
        let [front, back] = ply.distances(middle);
        let up = if depth(front) > depth(back) {
            front
        } else {
            back
        };
        let across = up * ply.normal;
        Some((middle + across, across.try_normalize()?))
    }

    /// The wall that a fracture tetrahedron of this asset is part of, if any; of a laminated wall the ply, with its share of the films. Its normal is that of the tetrahedron's own
    /// face, where that is one of the wall's.
    #[must_use]
    pub fn wall(&self, asset: &Asset, tet: usize) -> Option<Wall> {
        let place = asset.place(tet);
        let wall = self.walls.of_element[asset.embedding.tets[place].element as usize]?;
        let own = self.flaw(place).map(|flaw| flaw.normal);
        let along = own.filter(|n| n.dot(wall.normal).abs() > -OPPOSITE);
        let wall = along.map_or(wall, |n| Wall {
            normal: n * n.dot(wall.normal).signum(),
            ..wall
        });
        Some(match &asset.material.laminate {
            Some(laminate) => wall.ply(laminate.plies, asset.root().fracture.centroid(tet)),
            None => wall,
        })
    }
}

/// The free part of the outer surface.
struct FreeFaces {
    /// Outward unit normal of each surface triangle; zero where it is held.
    normals: Vec<Vec3>,
    /// Largest free triangle of each tetrahedron, or [`NONE`].
    largest: Vec<u32>,
}

impl FreeFaces {
    fn of(asset: &Asset) -> Self {
        let positions = &asset.fracture.positions;
        let triangles = &asset.surface.triangles;
        let mut held = vec![false; positions.len()];
        asset
            .supported
            .iter()
            .for_each(|&v| held[v as usize] = true);
        let mut largest = vec![NONE; asset.fracture.tets.len()];
        let mut areas = vec![0.0_f32; largest.len()];
        let mut normals = vec![Vec3::ZERO; triangles.len()];
        for (t, (triangle, &tet)) in triangles.iter().zip(&asset.surface.tets).enumerate() {
            if triangle.iter().all(|&v| held[v as usize]) {
                continue;
            }
            let [a, b, c] = triangle.map(|v| positions[v as usize]);
            let across = (b - a).cross(c - a);
            let Some(normal) = across.try_normalize() else {
                continue;
            };
            normals[t] = normal;
            let area = across.length();
            if area > areas[tet as usize] {
                areas[tet as usize] = area;
                largest[tet as usize] = t as u32;
            }
        }
        Self { normals, largest }
    }
}

/// Finds points in the analysis mesh by walking from element to element.
pub(crate) struct Search<'a> {
    mesh: &'a AnalysisMesh,
    /// Across the face opposite each corner.
    neighbours: Vec<[u32; 4]>,
}

impl<'a> Search<'a> {
    pub(crate) fn new(mesh: &'a AnalysisMesh) -> Self {
        let corners = mesh.elements.iter().map(|e| [e[0], e[1], e[2], e[3]]);
        // Only the adjacency is wanted, and it needs no positions.
        let neighbours = TetMesh::new(Vec::new(), corners.collect()).neighbours;
        Self { mesh, neighbours }
    }

    /// The point in the element that holds it, found from `start`; a point outside is moved onto the face it lies beyond.
    pub(crate) fn embed(&self, p: Vec3, start: u32) -> EmbeddedPoint {
        let mut element = start;
        for _ in 0..MOST_STEPS {
            let l = self.barycentric(element, p);
            let beyond = (0..4)
                .filter(|&k| l[k] < INSIDE && self.neighbours[element as usize][k] != NO_NEIGHBOUR)
                .min_by(|&a, &b| l[a].total_cmp(&l[b]));
            match beyond {
                Some(k) => element = self.neighbours[element as usize][k],
                None => break,
            }
        }
        self.onto(element, p)
    }

    fn barycentric(&self, element: u32, p: Vec3) -> [f32; 4] {
        let element = element as usize;
        let first = self.mesh.nodes[self.mesh.elements[element][0] as usize];
        let g = &self.mesh.barycentric_gradients[element];
        let [y, z, w] = [1, 2, 3].map(|k| g[k].dot(p - first));
        [1.0 - y - z - w, y, z, w]
    }

    fn onto(&self, element: u32, p: Vec3) -> EmbeddedPoint {
        let g = &self.mesh.barycentric_gradients[element as usize];
        let mut l = self.barycentric(element, p);
        let mut offset = Vec3::ZERO;
        for _ in 0..3 {
            let Some(k) = (0..4)
                .filter(|&k| l[k] < INSIDE)
                .min_by(|&a, &b| l[a].total_cmp(&l[b]))
            else {
                break;
            };
            let back = g[k] * (l[k] / g[k].length_squared());
            offset += back;
            for j in 0..4 {
                l[j] = if j == k { 0.0 } else { l[j] - g[j].dot(back) };
            }
        }
        EmbeddedPoint {
            element,
            barycentric: l,
            offset,
        }
    }
}
