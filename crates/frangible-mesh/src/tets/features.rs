//! Sharp edges and corners: vertices of the surface move onto them, where the angles allow it.
//!
//! A boundary edge whose ends see surfaces of different direction cuts a sharp edge off. The place of the sharp edge
//! follows from the tangent planes around the vertex [Kobbelt et al. 2001, "Feature sensitive surface extraction"]:
//! it is where they meet, in the least-squares sense.

use frangible_geometry::Rows;
use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::solid::{Solid, SurfacePoint};
use crate::tets::Draft;
use crate::tets::adjacency::boundary;
use crate::tets::improve::relocate;
use crate::tets::local::sharpest_around;

/// Surfaces that differ in direction by more than this, degrees, meet in a sharp edge.
const CREASE: f64 = 35.0;
/// A vertex moves at most this share of a cell.
const REACH: f64 = 0.75;
/// The share of a cell that a corner may move, which fewer vertices are near.
const CORNER_REACH: f64 = 1.0;
/// A tangent plane counts from surface points at most this share of a cell away.
const NEAR: f64 = 0.5;
/// Directions in which the planes agree this little, relative to the most decided one, are left alone.
const DECIDED: f64 = 0.08;

/// Numbers of edges that cut off sharp features, before and after snapping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Features {
    /// Boundary edges that cut off a sharp edge or corner before anything moved.
    pub sharp: usize,
    /// Boundary edges that still do after snapping.
    pub not_snapped: usize,
}

/// Moves vertices onto sharp features where no dihedral angle falls below `angle`, degrees, and marks them in `snapped`:
/// they stay there from now on.
pub(crate) fn snap(
    draft: &mut Draft,
    snapped: &mut [bool],
    solid: &dyn Solid,
    cell: f64,
    angle: f64,
) -> Features {
    let faces: Vec<[u32; 3]> = boundary(&draft.body.tets)
        .into_iter()
        .map(|f| f.0)
        .collect();
    let mut shape = Shape::new(draft, solid, &faces, cell);
    let features = Features {
        sharp: shape.straddling(snapped).len(),
        not_snapped: 0,
    };
    if features.sharp == 0 {
        return features;
    }
    let around = Rows::inverse(draft.body.positions.len(), &draft.body.tets);
    let limit = angle.to_radians().cos();
    let mut refused = vec![0_u32; snapped.len()];
    // Each round moves the vertex nearest to its feature first; a move settles all straddling edges at that vertex.
    loop {
        let mut vertices: Vec<u32> = shape
            .straddling(snapped)
            .into_iter()
            .flat_map(|(a, b)| [a, b])
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut candidates: Vec<Candidate> = vertices
            .into_iter()
            .flat_map(|v| shape.candidates(draft, solid, v, refused[v as usize]))
            .collect();
        // Corners first, then the nearest.
        candidates.sort_unstable_by(|x, y| {
            y.rank
                .cmp(&x.rank)
                .then(x.distance.total_cmp(&y.distance))
                .then(x.vertex.cmp(&y.vertex))
                .then(x.choice.cmp(&y.choice))
        });
        let mut moved = false;
        let mut taken = vec![false; snapped.len()];
        for c in candidates {
            // Neighbours of a vertex moved in this round are looked at afresh in the next.
            if snapped[c.vertex as usize] || taken[c.vertex as usize] {
                continue;
            }
            if make_room(draft, solid, &around, snapped, &c, cell, limit) {
                snapped[c.vertex as usize] = true;
                moved = true;
                shape.around.of(c.vertex).iter().for_each(|&f| {
                    shape.faces[f as usize]
                        .iter()
                        .for_each(|&u| taken[u as usize] = true);
                });
            } else {
                refused[c.vertex as usize] |= 1 << c.choice;
            }
        }
        if !moved {
            break;
        }
        shape.refresh(draft, solid);
    }
    Features {
        not_snapped: shape.straddling(snapped).len(),
        ..features
    }
}

struct Candidate {
    vertex: u32,
    place: DVec3,
    distance: f64,
    /// 2 on an edge, 3 at a corner.
    rank: usize,
    /// Index among the vertex's candidates.
    choice: usize,
}

/// The boundary with the surface's tangent planes.
struct Shape {
    faces: Vec<[u32; 3]>,
    around: Rows,
    edges: Vec<(u32, u32)>,
    /// Tangent plane next to each face's centroid.
    planes: Vec<SurfacePoint>,
    /// Tangent plane next to each boundary vertex.
    at_vertex: Vec<DVec3>,
    on_boundary: Vec<bool>,
    /// Positions of the vertices when the planes were found, m.
    seen: Vec<DVec3>,
    cell: f64,
}

impl Shape {
    fn new(draft: &Draft, solid: &dyn Solid, faces: &[[u32; 3]], cell: f64) -> Self {
        let mut edges: Vec<(u32, u32)> = faces
            .iter()
            .flat_map(|f| {
                [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])].map(|(a, b)| (a.min(b), a.max(b)))
            })
            .collect();
        edges.sort_unstable();
        edges.dedup();
        let vertices = draft.body.positions.len();
        let mut on_boundary = vec![false; vertices];
        faces
            .iter()
            .flatten()
            .for_each(|&v| on_boundary[v as usize] = true);
        let mut shape = Self {
            faces: faces.to_vec(),
            around: Rows::inverse(vertices, faces),
            edges,
            planes: Vec::new(),
            at_vertex: Vec::new(),
            on_boundary,
            seen: Vec::new(),
            cell,
        };
        shape.refresh(draft, solid);
        shape
    }

    /// Updates the tangent planes next to vertices that have moved since the last time.
    fn refresh(&mut self, draft: &Draft, solid: &dyn Solid) {
        let (x, cell) = (&draft.body.positions, self.cell);
        let first = self.seen.is_empty();
        let (seen, faces) = (&self.seen, &self.faces);
        let moved = |v: u32| first || seen[v as usize] != x[v as usize];
        let stale: Vec<bool> = faces.iter().map(|f| f.iter().any(|&v| moved(v))).collect();
        self.planes.resize(
            faces.len(),
            SurfacePoint {
                position: DVec3::ZERO,
                normal: DVec3::ZERO,
            },
        );
        let of_face = |f: &[u32; 3]| {
            let [a, b, c] = f.map(|v| x[v as usize]);
            let middle = (a + b + c) / 3.0;
            let near = solid.closest(middle);
            // Across a hole there is no surface to look at.
            if near.position.distance(middle) < NEAR * cell {
                near
            } else {
                SurfacePoint {
                    position: middle,
                    normal: (b - a).cross(c - a).normalize_or_zero(),
                }
            }
        };
        self.planes
            .par_iter_mut()
            .zip(faces)
            .zip(&stale)
            .filter(|(_, stale)| **stale)
            .for_each(|((plane, f), _)| *plane = of_face(f));
        let planes = &self.planes;
        let (around, on_boundary) = (&self.around, &self.on_boundary);
        self.at_vertex.resize(x.len(), DVec3::ZERO);
        self.at_vertex
            .par_iter_mut()
            .enumerate()
            .filter(|(v, _)| {
                // Its own place, or a plane that it may look at.
                let near = || around.of(*v as u32).iter().any(|&f| stale[f as usize]);
                on_boundary[*v] && near()
            })
            .for_each(|(v, normal)| {
                let near = solid.closest(x[v]);
                *normal = if near.position.distance(x[v]) < NEAR * cell {
                    near.normal
                } else {
                    around
                        .of(v as u32)
                        .iter()
                        .map(|&f| planes[f as usize].normal)
                        .sum::<DVec3>()
                        .normalize_or_zero()
                };
            });
        self.seen.clone_from(x);
    }

    /// Boundary edges that cut a feature off: both ends unsnapped, their surfaces of different direction.
    fn straddling(&self, snapped: &[bool]) -> Vec<(u32, u32)> {
        let crease = CREASE.to_radians().cos();
        let free = |v: u32| !snapped[v as usize];
        self.edges
            .iter()
            .copied()
            .filter(|&(a, b)| free(a) && free(b))
            .filter(|&(a, b)| self.at_vertex[a as usize].dot(self.at_vertex[b as usize]) < crease)
            .collect()
    }

    /// Positions of vertex `v` on the features next to it: the corner of all planes it sees, and the edges of each two;
    /// without the choices that were `refused`.
    fn candidates(&self, draft: &Draft, solid: &dyn Solid, v: u32, refused: u32) -> Vec<Candidate> {
        let here = draft.body.positions[v as usize];
        let planes = self.planes_around(draft, v);
        let mut choices = vec![planes.clone()];
        if planes.len() > 2 {
            for i in 0..planes.len().min(5) {
                choices.extend((0..i).map(|j| vec![planes[i], planes[j]]));
            }
        }
        let on_feature = |(choice, planes): (usize, &Vec<SurfacePoint>)| {
            if refused >> choice & 1 == 1 {
                return None;
            }
            let (place, rank) = meet(planes, here);
            let distance = place.distance(here);
            if rank < 2 || distance > if rank == 3 { CORNER_REACH } else { REACH } * self.cell {
                return None;
            }
            // Rounded edges and false guesses: the place has to lie on the surface.
            let near = solid.foot(place, 0.06 * self.cell);
            near.is_some().then_some(Candidate {
                vertex: v,
                place,
                distance,
                rank,
                choice,
            })
        };
        choices.iter().enumerate().filter_map(on_feature).collect()
    }

    /// Tangent planes next to vertex `v`, one per direction: or the larger of two sides would outvote the other.
    fn planes_around(&self, draft: &Draft, v: u32) -> Vec<SurfacePoint> {
        let here = draft.body.positions[v as usize];
        // Two rings of faces: next to a corner the first ring often sees two of the three sides only.
        let mut faces: Vec<u32> = self
            .around
            .of(v)
            .iter()
            .flat_map(|&f| self.faces[f as usize])
            .flat_map(|u| self.around.of(u).iter().copied())
            .collect();
        faces.sort_unstable();
        faces.dedup();
        let mut planes: Vec<SurfacePoint> =
            faces.iter().map(|&f| self.planes[f as usize]).collect();
        for &f in self.around.of(v) {
            planes.extend(self.faces[f as usize].iter().map(|&u| SurfacePoint {
                position: draft.body.positions[u as usize],
                normal: self.at_vertex[u as usize],
            }));
        }
        let crease = CREASE.to_radians().cos();
        let mut distinct: Vec<SurfacePoint> = Vec::new();
        for p in planes {
            let d = |q: &SurfacePoint| q.position.distance_squared(here);
            match distinct
                .iter_mut()
                .find(|q| q.normal.dot(p.normal) > crease)
            {
                Some(q) if d(&p) < d(q) => *q = p,
                Some(_) => {}
                None => distinct.push(p),
            }
        }
        distinct
    }
}

/// Point nearest to `here` where the planes meet, in the least-squares sense, and the number of directions decided.
fn meet(planes: &[SurfacePoint], here: DVec3) -> (DVec3, usize) {
    let (mut matrix, mut rest) = (DMat3::ZERO, DVec3::ZERO);
    for p in planes {
        let n = p.normal;
        matrix += DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        rest += n * n.dot(p.position - here);
    }
    let (values, vectors) = symmetric_eigen(matrix);
    let largest = values.iter().copied().fold(0.0, f64::max);
    let (mut shift, mut rank) = (DVec3::ZERO, 0);
    for (value, vector) in values.iter().zip(vectors) {
        if *value > DECIDED * largest {
            shift += vector * (vector.dot(rest) / value);
            rank += 1;
        }
    }
    (here + shift, rank)
}

/// Eigenvalues and vectors of a symmetric matrix by Jacobi rotations.
fn symmetric_eigen(mut a: DMat3) -> ([f64; 3], [DVec3; 3]) {
    let mut v = DMat3::IDENTITY;
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = a.col(q)[p];
            if off.abs() < 1e-15 {
                continue;
            }
            let theta = 0.5 * (a.col(q)[q] - a.col(p)[p]) / off;
            let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
            let c = 1.0 / t.hypot(1.0);
            let s = t * c;
            let mut r = DMat3::IDENTITY;
            r.col_mut(p)[p] = c;
            r.col_mut(q)[q] = c;
            r.col_mut(q)[p] = s;
            r.col_mut(p)[q] = -s;
            a = r.transpose() * a * r;
            v *= r;
        }
    }
    (
        [a.x_axis.x, a.y_axis.y, a.z_axis.z],
        [v.x_axis, v.y_axis, v.z_axis],
    )
}

/// Moves the candidate's vertex onto its feature; where that flattens a tetrahedron, its free neighbours make room.
/// Undone when an angle stays below the limit (a cosine).
fn make_room(
    draft: &mut Draft,
    solid: &dyn Solid,
    around: &Rows,
    snapped: &[bool],
    c: &Candidate,
    cell: f64,
    limit: f64,
) -> bool {
    let v = c.vertex;
    let before = draft.body.positions[v as usize];
    let fits = |draft: &Draft, u: u32| {
        sharpest_around(&draft.body, around, u, draft.body.positions[u as usize]) < limit
    };
    draft.body.positions[v as usize] = c.place;
    if fits(draft, v) {
        return true;
    }
    let mut near: Vec<u32> = around
        .of(v)
        .iter()
        .flat_map(|&e| draft.body.tets[e as usize])
        .collect();
    near.sort_unstable();
    near.dedup();
    near.retain(|&u| u != v && !snapped[u as usize]);
    let places: Vec<DVec3> = near
        .iter()
        .map(|&u| draft.body.positions[u as usize])
        .collect();
    for step in [0.2, 0.1, 0.05] {
        for &u in &near {
            relocate(draft, solid, around, u, step * cell);
        }
    }
    let all_fit = near.iter().chain([&v]).all(|&u| fits(draft, u));
    if !all_fit {
        draft.body.positions[v as usize] = before;
        near.iter()
            .zip(places)
            .for_each(|(&u, place)| draft.body.positions[u as usize] = place);
    }
    all_fit
}
