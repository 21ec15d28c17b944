//! Regions of space that a surface bounds, found from how its triangles meet.
//!
//! Each triangle has two sides. Two sides see the same region where nothing lies between them around an edge, so that the windings of the
//! file do not matter, and a face between two layers has a layer on each of its sides.

use std::ops::Range;

use frangible_geometry::DisjointSets;
use glam::DVec3;
use rayon::slice::ParallelSliceMut as _;

use crate::repair::Welded;
use crate::repair::duplicates::is_even;
use crate::repair::edges::{Edges, Side};

/// A region is bounded if its volume is above this share of its area^1.5; flatter ones are folds of a sheet.
const LEAST_VOLUME: f64 = 1e-7;

/// Stands for the outside.
pub(super) const NONE: u32 = u32::MAX;

/// A face: all triangles on the same three vertices.
#[derive(Clone, Debug)]
pub(super) struct Face {
    /// Its vertices, as the first of its triangles has them.
    pub(super) vertices: [u32; 3],
    /// Where its triangles stand in [`Regions::copies`].
    pub(super) copies: Range<u32>,
    /// True if it was drawn from both sides, as two bodies that touch have it.
    pub(super) is_double: bool,
    /// The closed regions in front of it and behind it, or [`NONE`].
    pub(super) sides: [u32; 2],
}

impl Face {
    /// The regions that it bounds.
    pub(super) fn regions(&self) -> impl Iterator<Item = u32> {
        let [front, back] = self.sides;
        let differ = front != back;
        self.sides
            .into_iter()
            .filter(move |&region| differ && region != NONE)
    }
}

/// The faces of a mesh and the closed regions that they bound.
pub(super) struct Regions {
    pub(super) faces: Vec<Face>,
    /// Triangles of the faces, as numbers in the welded mesh, and whether each is wound like the first of its face.
    pub(super) copies: Vec<(u32, bool)>,
    /// Volume of each closed region, in the cube of the mesh's unit.
    pub(super) volumes: Vec<f64>,
    /// Area of the faces of each region.
    pub(super) areas: Vec<f64>,
    /// True for each region whose faces look outwards in the file.
    pub(super) is_outward: Vec<bool>,
}

impl Regions {
    pub(super) fn new(mesh: &Welded) -> Self {
        let (mut faces, copies) = faces(&mesh.triangles);
        let region = sides(mesh, &faces);
        // The middle of the mesh keeps the digits of volumes far from the origin.
        let middle = middle(&mesh.positions);
        let mut volumes = vec![0.0; 2 * faces.len()];
        let mut areas = vec![0.0; 2 * faces.len()];
        for (f, face) in faces.iter().enumerate() {
            let [front, back] = [region[2 * f], region[2 * f + 1]].map(|r| r as usize);
            let [a, b, c] = face.vertices.map(|v| mesh.positions[v as usize] - middle);
            let volume = a.dot(b.cross(c)) / 6.0;
            let area = 0.5 * (b - a).cross(c - a).length();
            volumes[back] += volume;
            volumes[front] -= volume;
            areas[back] += area;
            areas[front] += area;
        }
        let mut number = vec![NONE; region.len()];
        let mut kept = Self {
            faces: Vec::new(),
            copies,
            volumes: Vec::new(),
            areas: Vec::new(),
            is_outward: Vec::new(),
        };
        // In the order of the file, so that parts stand in it as their author put them.
        for &root in &region {
            let root = root as usize;
            if number[root] == NONE && volumes[root] > LEAST_VOLUME * areas[root].powf(1.5) {
                number[root] = kept.volumes.len() as u32;
                kept.volumes.push(volumes[root]);
                kept.areas.push(areas[root]);
            }
        }
        for (f, face) in faces.iter_mut().enumerate() {
            face.sides = [2 * f, 2 * f + 1].map(|side| number[region[side] as usize]);
        }
        kept.faces = faces;
        kept.is_outward = kept.outward(mesh);
        kept
    }

    /// Number of closed regions.
    pub(super) fn count(&self) -> usize {
        self.volumes.len()
    }

    /// The winding of most of each region's area, faces that it shares left out.
    fn outward(&self, mesh: &Welded) -> Vec<bool> {
        let mut votes = vec![0.0; self.count()];
        for face in self.faces.iter().filter(|face| !face.is_double) {
            let [a, b, c] = face.vertices.map(|v| mesh.positions[v as usize]);
            let area = (b - a).cross(c - a).length();
            match face.sides {
                [NONE, NONE] => {}
                [NONE, back] => votes[back as usize] += area,
                [front, NONE] => votes[front as usize] -= area,
                _ => {}
            }
        }
        votes.into_iter().map(|vote| vote >= 0.0).collect()
    }
}

fn middle(positions: &[DVec3]) -> DVec3 {
    let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = positions
        .iter()
        .fold(nothing, |(l, h), &p| (l.min(p), h.max(p)));
    0.5 * low + 0.5 * high
}

/// Triangles by their vertices, in the order of the first of each.
fn faces(triangles: &[[u32; 3]]) -> (Vec<Face>, Vec<(u32, bool)>) {
    let mut order: Vec<([u32; 3], u32)> = (0..)
        .zip(triangles)
        .map(|(i, &t)| {
            let mut sorted = t;
            sorted.sort_unstable();
            (sorted, i)
        })
        .collect();
    order.par_sort_unstable();
    let mut faces = Vec::with_capacity(order.len());
    let mut copies = Vec::with_capacity(order.len());
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        let vertices = triangles[same[0].1 as usize];
        let first = copies.len() as u32;
        let alike = |i: u32| is_even(triangles[i as usize]) == is_even(vertices);
        copies.extend(same.iter().map(|&(_, i)| (i, alike(i))));
        faces.push(Face {
            vertices,
            copies: first..copies.len() as u32,
            is_double: copies[first as usize..].iter().any(|copy| !copy.1),
            sides: [NONE; 2],
        });
    }
    faces.par_sort_unstable_by_key(|face| copies[face.copies.start as usize].0);
    (faces, copies)
}

/// For the front and the back of each face a number of the region there.
fn sides(mesh: &Welded, faces: &[Face]) -> Vec<u32> {
    let triangles: Vec<[u32; 3]> = faces.iter().map(|face| face.vertices).collect();
    let edges = Edges::new(mesh.positions.len(), &triangles);
    let mut regions = DisjointSets::new(2 * faces.len());
    let mut around: Vec<(f64, Side)> = Vec::new();
    for (near, group) in edges.groups() {
        around.clear();
        around.extend(group.iter().map(|&side| (0.0, side)));
        if group.len() > 2 {
            sort_around(mesh, &triangles, near, &mut around);
        }
        for (i, &(_, one)) in around.iter().enumerate() {
            let (_, next) = around[(i + 1) % around.len()];
            // Seen along the edge, the front of a triangle that runs with it looks on, that of another back.
            let ahead = 2 * one.triangle() + usize::from(!one.is_forward());
            let behind = 2 * next.triangle() + usize::from(next.is_forward());
            regions.join(ahead as u32, behind as u32);
        }
    }
    (0..2 * faces.len() as u32)
        .map(|side| regions.find(side))
        .collect()
}

/// Sorts the triangles of an edge by their angle about it.
fn sort_around(mesh: &Welded, triangles: &[[u32; 3]], near: u32, around: &mut [(f64, Side)]) {
    let Some(&(_, first)) = around.first() else {
        return;
    };
    let from = mesh.positions[near as usize];
    let along = (mesh.positions[first.far() as usize] - from).normalize_or_zero();
    let across = along.any_orthonormal_vector();
    let up = along.cross(across);
    for (angle, side) in around.iter_mut() {
        let third = triangles[side.triangle()]
            .into_iter()
            .find(|&v| v != near && v != side.far());
        let away = mesh.positions[third.unwrap_or(near) as usize] - from;
        *angle = away.dot(up).atan2(away.dot(across));
    }
    around.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
}
