//! Division of crack faces at the middles of their edges.

use glam::Vec3;
use noise_functions::{Noise, Simplex};

use super::FineFaces;
use crate::render::RenderMesh;

/// Roughness exponent of fracture surfaces (Hurst exponent).
const HURST: f32 = 0.8;

/// Standard deviation of the height of an edge's middle over that of the height difference of its ends, for a self-affine profile:
/// √((1 − 2^(2H−2)) / 2^(2H)).
const MIDDLE: f32 = 0.283;

/// Largest standard deviation of a displacement as a share of its edge; more could fold the faces.
const MOST: f32 = 0.15;

/// Standard deviation of the noise, whose values lie between −1 and 1.
const NOISE_DEVIATION: f32 = 0.434;

/// Most times that an edge is halved.
const MOST_LEVELS: i32 = 8;

/// An edge between two places.
#[derive(Clone, Copy)]
struct Edge {
    ends: [u32; 2],
    kind: EdgeKind,
}

#[derive(Clone, Copy)]
enum EdgeKind {
    /// Within the outer surface, or halved already.
    Whole,
    /// Within crack faces.
    Inner,
    /// Between the outer surface, whose unit normal there this is, and a crack face.
    Rim(Vec3),
}

/// A triangle.
#[derive(Clone, Copy)]
pub(super) struct Face {
    /// Numbers of its places.
    pub(super) corners: [u32; 3],
    /// Numbers of its vertices, on the outer surface.
    pub(super) vertices: [u32; 3],
    /// Number of the triangle that was divided.
    pub(super) source: u32,
    /// Edge k runs from corner k to the next.
    edges: [u32; 3],
    is_outer: bool,
}

/// The triangles of a mesh with their edges.
pub(super) struct Faces {
    pub(super) places: Vec<Vec3>,
    /// The vertices of the undivided mesh, and those added to its outer surface.
    pub(super) vertices: RenderMesh,
    /// Those of the outer surface come first.
    faces: Vec<Face>,
    edges: Vec<Edge>,
    /// Number of times that the edges were halved.
    level: i32,
}

/// Middle of an edge, and the two halves, the first at the edge's first end.
#[derive(Clone, Copy)]
struct Half {
    middle: u32,
    parts: [u32; 2],
}

impl Half {
    /// An edge that is not halved.
    const NONE: Self = Self {
        middle: u32::MAX,
        parts: [u32::MAX; 2],
    };
}

/// A halved edge of a face: the middle, its vertex, and the halves in the order in which the face goes round.
struct Cut {
    middle: u32,
    vertex: u32,
    before: u32,
    after: u32,
}

impl Faces {
    pub(super) fn new(mesh: &RenderMesh, places: Vec<Vec3>, place_of: &[u32]) -> Self {
        let faces = (0..).zip(&mesh.triangles).map(|(source, &vertices)| Face {
            corners: vertices.map(|v| place_of[v as usize]),
            vertices,
            source,
            edges: [0; 3],
            is_outer: (source as usize) < mesh.outer_triangles,
        });
        let mut faces: Vec<Face> = faces.collect();
        let side = |(i, face): (usize, &Face)| {
            let [a, b, c] = face.corners;
            let sides = [(a, b), (b, c), (c, a)].map(|(a, b)| [a.min(b), a.max(b)]);
            [0, 1, 2].map(|k| (sides[k], 3 * i + k))
        };
        let mut sides: Vec<_> = faces.iter().enumerate().flat_map(side).collect();
        sides.sort_unstable();
        let mut edges: Vec<Edge> = Vec::new();
        for around in sides.chunk_by(|a, b| a.0 == b.0) {
            for &(_, side) in around {
                faces[side / 3].edges[side % 3] = edges.len() as u32;
            }
            let is_outer = |&&(_, side): &&(_, usize)| faces[side / 3].is_outer;
            let kind = match around.iter().find(is_outer) {
                None => EdgeKind::Inner,
                Some(_) if around.iter().all(|side| is_outer(&side)) => EdgeKind::Whole,
                Some(&(_, side)) => {
                    let [a, b] = [side % 3, (side + 1) % 3]
                        .map(|k| mesh.normals[faces[side / 3].vertices[k] as usize]);
                    EdgeKind::Rim((a + b).normalize_or(a))
                }
            };
            edges.push(Edge {
                ends: around[0].0,
                kind,
            });
        }
        Self {
            places,
            vertices: mesh.clone(),
            faces,
            edges,
            level: 0,
        }
    }

    /// The triangles of the outer surface and those of crack faces.
    pub(super) fn split(&self) -> (&[Face], &[Face]) {
        let outer = self.faces.partition_point(|face| face.is_outer);
        self.faces.split_at(outer)
    }

    /// Halves every edge of a crack face that is too long. Returns true if more may be.
    pub(super) fn halve(&mut self, fine: &FineFaces, origin: Vec3) -> bool {
        let count = self.edges.len();
        let mut halves = vec![Half::NONE; count];
        for (number, half) in halves.iter_mut().enumerate() {
            let Edge { ends, kind } = self.edges[number];
            let [a, b] = ends.map(|end| self.places[end as usize]);
            let length = a.distance(b);
            if matches!(kind, EdgeKind::Whole) || length <= fine.edge {
                continue;
            }
            let middle = 0.5 * (a + b);
            let mut push = displacement(fine, middle + origin, length, self.level);
            if let EdgeKind::Rim(normal) = kind {
                push = push.reject_from_normalized(normal);
            }
            let place = self.places.len() as u32;
            self.places.push(middle + push);
            let parts = ends.map(|end| self.edge([end, place], kind));
            *half = Half {
                middle: place,
                parts,
            };
            self.edges[number].kind = EdgeKind::Whole;
        }
        let is_done = self.edges.len() == count;
        if !is_done {
            let faces = std::mem::take(&mut self.faces);
            self.faces.reserve(3 * faces.len());
            for face in faces {
                self.divide(&face, &halves);
            }
            self.level += 1;
        }
        !is_done && self.level < MOST_LEVELS
    }

    /// Divides a face by those of its edges that are halved.
    fn divide(&mut self, face: &Face, halves: &[Half]) {
        let is_halved = |k: &usize| halves[face.edges[*k] as usize].middle != u32::MAX;
        let count = (0..3).filter(is_halved).count();
        // The corners and edges from the halved edge on if one is, else from behind the whole edge.
        let first = match count {
            1 => (0..3).find(is_halved),
            2 => (0..3).find(|k| !is_halved(k)).map(|k| (k + 1) % 3),
            _ => Some(0),
        };
        let first = first.unwrap_or(0);
        let from = |k: usize| (first + k) % 3;
        let corners = [0, 1, 2].map(|k| (face.corners[from(k)], face.vertices[from(k)]));
        let [_, bc, ca] = [0, 1, 2].map(|k| face.edges[from(k)]);
        let [a, b, c] = corners;
        match count {
            0 => self.faces.push(*face),
            1 => {
                let m = self.cut(face, from(0), halves);
                let mc = self.within(face, m.middle, c.0);
                let at_m = (m.middle, m.vertex);
                self.push(face, [a, at_m, c], [m.before, mc, ca]);
                self.push(face, [at_m, b, c], [m.after, bc, mc]);
            }
            2 => {
                let [m, n] = [0, 1].map(|k| self.cut(face, from(k), halves));
                let mn = self.within(face, m.middle, n.middle);
                let [at_m, at_n] = [&m, &n].map(|cut| (cut.middle, cut.vertex));
                self.push(face, [at_m, b, at_n], [m.after, n.before, mn]);
                let [pa, pm, pn, pc] = [a, at_m, at_n, c].map(|p| self.places[p.0 as usize]);
                if pa.distance_squared(pn) < pm.distance_squared(pc) {
                    let an = self.within(face, a.0, n.middle);
                    self.push(face, [a, at_m, at_n], [m.before, mn, an]);
                    self.push(face, [a, at_n, c], [an, n.after, ca]);
                } else {
                    let mc = self.within(face, m.middle, c.0);
                    self.push(face, [a, at_m, c], [m.before, mc, ca]);
                    self.push(face, [at_m, at_n, c], [mn, n.after, mc]);
                }
            }
            _ => {
                let [m, n, o] = [0, 1, 2].map(|k| self.cut(face, k, halves));
                let [at_m, at_n, at_o] = [&m, &n, &o].map(|cut| (cut.middle, cut.vertex));
                let mn = self.within(face, m.middle, n.middle);
                let no = self.within(face, n.middle, o.middle);
                let om = self.within(face, o.middle, m.middle);
                self.push(face, [a, at_m, at_o], [m.before, om, o.after]);
                self.push(face, [at_m, b, at_n], [m.after, n.before, mn]);
                self.push(face, [at_o, at_n, c], [no, n.after, o.before]);
                self.push(face, [at_m, at_n, at_o], [mn, no, om]);
            }
        }
    }

    /// A halved edge of a face.
    fn cut(&mut self, face: &Face, k: usize, halves: &[Half]) -> Cut {
        let edge = face.edges[k] as usize;
        let Half {
            middle,
            parts: [first, second],
        } = halves[edge];
        let is_along = self.edges[edge].ends[0] == face.corners[k];
        let (before, after) = if is_along {
            (first, second)
        } else {
            (second, first)
        };
        let vertex = match face.is_outer {
            true => self.vertex(middle, face.vertices[k], face.vertices[(k + 1) % 3]),
            false => 0,
        };
        Cut {
            middle,
            vertex,
            before,
            after,
        }
    }

    /// A vertex of the outer surface at a place between two others.
    fn vertex(&mut self, place: u32, a: u32, b: u32) -> u32 {
        fn mean<const N: usize>(of: &mut Vec<[f32; N]>, a: usize, b: usize) {
            if !of.is_empty() {
                of.push(std::array::from_fn(|i| 0.5 * (of[a][i] + of[b][i])));
            }
        }
        let (a, b) = (a as usize, b as usize);
        let all = &mut self.vertices;
        all.positions.push(self.places[place as usize]);
        let normal = all.normals[a];
        all.normals
            .push((normal + all.normals[b]).normalize_or(normal));
        mean(&mut all.uvs, a, b);
        all.more_uvs.iter_mut().for_each(|uvs| mean(uvs, a, b));
        mean(&mut all.colors, a, b);
        all.positions.len() as u32 - 1
    }

    /// A new edge within a face.
    fn within(&mut self, face: &Face, a: u32, b: u32) -> u32 {
        let kind = match face.is_outer {
            true => EdgeKind::Whole,
            false => EdgeKind::Inner,
        };
        self.edge([a, b], kind)
    }

    fn edge(&mut self, ends: [u32; 2], kind: EdgeKind) -> u32 {
        self.edges.push(Edge { ends, kind });
        self.edges.len() as u32 - 1
    }

    /// A part of a face. Its corners are places and vertices.
    fn push(&mut self, face: &Face, corners: [(u32, u32); 3], edges: [u32; 3]) {
        self.faces.push(Face {
            corners: corners.map(|corner| corner.0),
            vertices: corners.map(|corner| corner.1),
            edges,
            ..*face
        });
    }
}

/// Standard deviation of the displacement of the middle of an edge of this length, m, along each axis.
pub(super) fn middle_deviation(fine: &FineFaces, length: f32) -> f32 {
    let share = libm::powf((length / fine.wavelength).min(1.0), HURST);
    (MIDDLE * fine.amplitude * share).min(MOST * length)
}

/// Displacement of the middle of an edge of this length, m, at a place of the unbroken body.
fn displacement(fine: &FineFaces, place: Vec3, length: f32, level: i32) -> Vec3 {
    // Middles of neighbouring edges lie half an edge apart: there the noise is another one.
    let cell = 0.5 * fine.mesh_edge * libm::exp2f(-level as f32);
    let at = (place / cell).to_array();
    let noise = [0, 1, 2].map(|axis| Simplex.seed(3 * level + axis).sample3(at));
    Vec3::from(noise) * (middle_deviation(fine, length) / NOISE_DEVIATION)
}
