//! Finds the two faces of a wall in a closed surface: two large parallel parts, and the rims that join them.
//!
//! A triangle belongs to a face if rays from it into the body meet the back of a nearly parallel triangle about as far away as the body is
//! thick on average. What is left are the rims. The body is a wall if its two largest faces hold nearly all parallel triangles, look at
//! each other, have nearly the same area, and every rim joins one edge of the first to one edge of the second.

use glam::DVec3;
use rayon::prelude::*;

use super::remesh::{Edge, NONE, edges_of};
use crate::surface::Surface;
use crate::winding::MeshSolid;

/// Cosine between the normals of the two faces of a wall, at most.
const OPPOSITE: f64 = -0.8;
/// Thicknesses of a wall, in its mean thickness.
const THICKNESSES: [f64; 2] = [0.3, 2.5];
/// Smallest area of a face, in squares of the thickness: a square of six and a half thicknesses.
const SLENDER: f64 = 42.0;
/// Largest area of all rims, as a share of one face: a strip three times as wide as it is thick has two thirds.
const RIMS: f64 = 0.7;
/// Largest area of the larger face, as a share of the smaller.
const ALIKE: f64 = 1.6;
/// Smallest share of a face's area that looks at the other.
const PAIRED: f64 = 0.93;
/// Cosine of the angle between neighbours beyond which they belong to different faces.
const FOLD: f64 = -0.2;
/// Triangles that are tried first, about, and the share of their area that must be parallel to another: a wall has at least 0.7.
const SAMPLE: usize = 2000;
const LIKELY: f64 = 0.45;
/// Rays start this far below the surface, in sizes of the body.
const SKIN: f64 = 1e-7;

/// The two faces of a wall.
pub(crate) struct Faces {
    /// The larger face and the smaller.
    pub(crate) triangles: [Vec<u32>; 2],
    /// Rim at each open edge of the larger face, by the edge's ends, rising.
    pub(crate) rim_of_edge: Vec<([u32; 2], u32)>,
    /// Edges of the smaller face at each rim.
    pub(crate) rims: Vec<Vec<[u32; 2]>>,
}

/// Which part a triangle belongs to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Face(usize),
    Rim(u32),
}

/// Finds the faces of a closed surface of this volume, m³; `None` if it is no wall.
pub(crate) fn find(surface: &Surface, solid: &MeshSolid, volume: f64) -> Option<Faces> {
    let areas: Vec<DVec3> = (0..surface.triangles.len())
        .map(|t| {
            let [a, b, c] = surface.corners(t);
            0.5 * (b - a).cross(c - a)
        })
        .collect();
    let total: f64 = areas.iter().map(|a| a.length()).sum();
    let typical = 2.0 * volume / total;
    let parallel = |t: &usize| face_behind(surface, solid, &areas, *t, typical).is_some();
    let sample = || (0..surface.triangles.len()).step_by(surface.triangles.len() / SAMPLE + 1);
    let sampled = |tested: &[usize]| -> f64 { tested.iter().map(|&t| areas[t].length()).sum() };
    let tested: Vec<usize> = sample().collect();
    let found: Vec<usize> = sample().filter(parallel).collect();
    if sampled(&found) < LIKELY * sampled(&tested) {
        return None;
    }
    let behind: Vec<Option<u32>> = (0..surface.triangles.len())
        .into_par_iter()
        .map(|t| face_behind(surface, solid, &areas, t, typical))
        .collect();
    let edges = edges_of(&surface.triangles);
    let joined = |edge: &Edge| {
        let [t, u] = edge.sides.map(|s| s.0 as usize);
        let cosine = areas[t]
            .normalize_or_zero()
            .dot(areas[u].normalize_or_zero());
        behind[t].is_some() && behind[u].is_some() && cosine > FOLD
    };
    let component = components(surface.triangles.len(), &edges, joined);
    let largest = two_largest(&component, &behind, &areas)?;
    let mut parts = rims_of(&component, largest, &edges);
    absorb(&mut parts, &edges);
    let area = |face: usize| -> f64 {
        let own = parts.iter().zip(&areas);
        own.filter(|(part, _)| **part == Part::Face(face))
            .map(|(_, a)| a.length())
            .sum()
    };
    let [first, second] = [area(0), area(1)];
    let rims = total - first - second;
    let [small, large] = [first.min(second), first.max(second)];
    let looks = |face: usize| -> f64 {
        let pairs = parts.iter().zip(&behind).zip(&areas);
        pairs
            .filter(|((part, behind), _)| {
                **part == Part::Face(face)
                    && behind.is_some_and(|b| parts[b as usize] == Part::Face(1 - face))
            })
            .map(|(_, a)| a.length())
            .sum()
    };
    let is_wall = small > SLENDER * typical * typical
        && rims < RIMS * small
        && large < ALIKE * small
        && looks(0) > PAIRED * first
        && looks(1) > PAIRED * second;
    if !is_wall {
        return None;
    }
    // Equal up to rounding, the first in the file is taken.
    let order = if second > first * (1.0 + 1e-9) {
        [1, 0]
    } else {
        [0, 1]
    };
    joined_by_rims(&parts, &edges, order)
}

/// The nearly parallel triangle at the other side of the wall from triangle `t`; `None` if most of four rays meet none.
fn face_behind(
    surface: &Surface,
    solid: &MeshSolid,
    areas: &[DVec3],
    t: usize,
    typical: f64,
) -> Option<u32> {
    let into = -areas[t].try_normalize()?;
    let [low, high] = surface.bounds();
    let size = (high - low).length();
    let corners = surface.corners(t);
    let rays = (0..4).map(|k| {
        let weights = [0, 1, 2].map(|i| match k {
            3 => 1.0 / 3.0,
            _ if i == k => 2.0 / 3.0,
            _ => 1.0 / 6.0,
        });
        let place: DVec3 = (0..3).map(|i| weights[i] * corners[i]).sum();
        let from = place + SKIN * size * into;
        let (at, face) = solid.first_exit(from, from + size * into)?;
        let [least, most] = THICKNESSES.map(|share| share * typical);
        let fits = (least..=most).contains(&(size * (at + SKIN)));
        let cosine = into.dot(areas[face as usize].normalize_or_zero());
        (fits && cosine > -OPPOSITE).then_some(face)
    });
    let found: Vec<u32> = rays.flatten().collect();
    (found.len() >= 3).then(|| found[found.len() - 1])
}

/// Number of the connected part of each triangle.
fn components(count: usize, edges: &[Edge], joined: impl Fn(&Edge) -> bool) -> Vec<u32> {
    let mut sets = frangible_geometry::DisjointSets::new(count);
    for edge in edges {
        if edge.sides[1].0 != NONE && joined(edge) {
            sets.join(edge.sides[0].0, edge.sides[1].0);
        }
    }
    (0..count as u32).map(|t| sets.find(t)).collect()
}

/// The two components of parallel triangles with the largest areas; the one of the earlier triangle first.
fn two_largest(component: &[u32], behind: &[Option<u32>], areas: &[DVec3]) -> Option<[u32; 2]> {
    let mut sizes = vec![0.0; component.len()];
    for t in (0..component.len()).filter(|&t| behind[t].is_some()) {
        sizes[component[t] as usize] += areas[t].length();
    }
    let mut order: Vec<u32> = (0..component.len() as u32)
        .filter(|&c| sizes[c as usize] > 0.0)
        .collect();
    order.sort_by(|&a, &b| {
        sizes[b as usize]
            .total_cmp(&sizes[a as usize])
            .then(a.cmp(&b))
    });
    match order[..] {
        [a, b, ..] => {
            let first = component.iter().find(|&&c| c == a || c == b)?;
            Some(if *first == a { [a, b] } else { [b, a] })
        }
        _ => None,
    }
}

/// Faces, and the connected parts of the rest.
fn rims_of(component: &[u32], largest: [u32; 2], edges: &[Edge]) -> Vec<Part> {
    let face = |t: u32| largest.iter().position(|&c| c == component[t as usize]);
    let rims = components(component.len(), edges, |edge| {
        edge.sides.iter().all(|s| face(s.0).is_none())
    });
    (0..component.len() as u32)
        .map(|t| face(t).map_or(Part::Rim(rims[t as usize]), Part::Face))
        .collect()
}

/// Rims that touch one face only are bumps of that face.
fn absorb(parts: &mut [Part], edges: &[Edge]) {
    let mut touches = vec![[false; 2]; parts.len()];
    for edge in edges {
        for [t, u] in [[0, 1], [1, 0]].map(|order| order.map(|i: usize| edge.sides[i].0)) {
            if let (Part::Rim(rim), Part::Face(face)) = (parts[t as usize], parts[u as usize]) {
                touches[rim as usize][face] = true;
            }
        }
    }
    for part in parts {
        if let Part::Rim(rim) = *part {
            match touches[rim as usize] {
                [true, false] => *part = Part::Face(0),
                [false, true] => *part = Part::Face(1),
                _ => {}
            }
        }
    }
}

/// The faces in the given order, if every rim joins one closed edge of each.
fn joined_by_rims(parts: &[Part], edges: &[Edge], order: [usize; 2]) -> Option<Faces> {
    let mut met: Vec<(u32, usize, [u32; 2])> = Vec::new();
    for edge in edges {
        let [t, u] = edge.sides.map(|s| parts[s.0 as usize]);
        match [t, u] {
            [Part::Face(a), Part::Face(b)] if a != b => return None,
            [Part::Rim(rim), Part::Face(face)] | [Part::Face(face), Part::Rim(rim)] => {
                met.push((rim, face, edge.ends));
            }
            _ => {}
        }
    }
    met.sort_unstable();
    let mut faces = Faces {
        triangles: order.map(|face| {
            let all = (0..).zip(parts);
            all.filter(|(_, part)| **part == Part::Face(face))
                .map(|(t, _)| t)
                .collect()
        }),
        rim_of_edge: Vec::new(),
        rims: Vec::new(),
    };
    for rim in met.chunk_by(|a, b| a.0 == b.0) {
        let number = faces.rims.len() as u32;
        let sides = order.map(|face| -> Vec<[u32; 2]> {
            let own = rim.iter().filter(|m| m.1 == face);
            own.map(|m| m.2).collect()
        });
        if !sides.iter().all(|side| is_one_loop(side)) {
            return None;
        }
        let [first, second] = sides;
        faces
            .rim_of_edge
            .extend(first.into_iter().map(|ends| (ends, number)));
        faces.rims.push(second);
    }
    faces.rim_of_edge.sort_unstable();
    Some(faces)
}

/// Whether edges form one closed loop.
fn is_one_loop(edges: &[[u32; 2]]) -> bool {
    let mut vertices: Vec<u32> = edges.iter().flatten().copied().collect();
    vertices.sort_unstable();
    let twice = vertices.chunk_by(|a, b| a == b).all(|same| same.len() == 2);
    vertices.dedup();
    let place = |v: u32| vertices.partition_point(|&w| w < v) as u32;
    let mut sets = frangible_geometry::DisjointSets::new(vertices.len());
    for edge in edges {
        sets.join(place(edge[0]), place(edge[1]));
    }
    let root = |i: u32, sets: &mut frangible_geometry::DisjointSets| sets.find(i);
    let first = (!vertices.is_empty()).then(|| root(0, &mut sets));
    twice
        && first.is_some()
        && (0..vertices.len() as u32).all(|i| Some(root(i, &mut sets)) == first)
}
