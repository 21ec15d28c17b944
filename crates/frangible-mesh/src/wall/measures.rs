//! Measures of surfaces, and parts of them.

use glam::DVec3;

use super::columns::RimLine;
use super::remesh::{CREASE, NONE, edges_of};
use crate::surface::Surface;

/// Whether every edge has two triangles: repair may have dropped triangles without area that closed a gap.
pub(super) fn is_closed(surface: &Surface) -> bool {
    let edges = edges_of(&surface.triangles);
    edges.iter().all(|edge| edge.sides[1].0 != NONE)
}

/// Volume inside a closed surface, m³.
pub(super) fn enclosed_volume(surface: &Surface) -> f64 {
    let [low, high] = surface.bounds();
    let middle = 0.5 * (low + high);
    let six: f64 = (0..surface.triangles.len())
        .map(|t| {
            let [a, b, c] = surface.corners(t).map(|p| p - middle);
            a.dot(b.cross(c))
        })
        .sum();
    six.abs() / 6.0
}

/// Area of a surface, m².
pub(super) fn area(surface: &Surface) -> f64 {
    (0..surface.triangles.len())
        .map(|t| {
            let [a, b, c] = surface.corners(t);
            0.5 * (b - a).cross(c - a).length()
        })
        .sum()
}

/// Some triangles as a surface of their own, and the former index of each vertex.
pub(super) fn compacted(surface: &Surface, triangles: &[u32]) -> (Surface, Vec<u32>) {
    let mut used: Vec<u32> = triangles
        .iter()
        .flat_map(|&t| surface.triangles[t as usize])
        .collect();
    used.sort_unstable();
    used.dedup();
    let place = |v: u32| used.partition_point(|&w| w < v) as u32;
    let part = Surface {
        positions: used
            .iter()
            .map(|&v| surface.positions[v as usize])
            .collect(),
        triangles: triangles
            .iter()
            .map(|&t| surface.triangles[t as usize].map(place))
            .collect(),
    };
    (part, used)
}

/// Cosine between the normals of the triangles at each inner edge, and the edge; a sharp edge of one triangle has −1.
fn folds(surface: &Surface) -> impl Iterator<Item = ([u32; 2], f64)> {
    let normals: Vec<DVec3> = (0..surface.triangles.len())
        .map(|t| {
            let [a, b, c] = surface.corners(t);
            (b - a).cross(c - a).normalize_or_zero()
        })
        .collect();
    edges_of(&surface.triangles).into_iter().map(move |edge| {
        let [t, u] = edge.sides.map(|s| s.0);
        let cosine = if u == NONE {
            -1.0
        } else {
            normals[t as usize].dot(normals[u as usize])
        };
        (edge.ends, cosine)
    })
}

/// Sharp edges in the order in which the remesher counts them.
pub(super) fn sharp_edges(surface: &Surface) -> Vec<[u32; 2]> {
    let cosine = CREASE.to_radians().cos();
    folds(surface)
        .filter(|(_, fold)| *fold < cosine)
        .map(|(ends, _)| ends)
        .collect()
}

/// Mean curvature by area, 1/m, sharp edges left out.
pub(super) fn bending(surface: &Surface) -> f64 {
    let cosine = CREASE.to_radians().cos();
    let turned: f64 = folds(surface)
        .filter(|(_, fold)| *fold >= cosine)
        .map(|([a, b], fold)| {
            let length = surface.positions[a as usize].distance(surface.positions[b as usize]);
            length * fold.clamp(-1.0, 1.0).acos()
        })
        .sum();
    turned / area(surface)
}

/// Edges of the other face at a rim, with the corners of the rim.
pub(super) fn rim_line(surface: &Surface, edges: &[[u32; 2]]) -> RimLine {
    let at = |v: u32| surface.positions[v as usize];
    let mut met: Vec<(u32, u32)> = edges.iter().flat_map(|&[a, b]| [(a, b), (b, a)]).collect();
    met.sort_unstable();
    let cosine = CREASE.to_radians().cos();
    let turns = |same: &&[(u32, u32)]| {
        let away = |k: usize| (at(same[k].1) - at(same[k].0)).normalize_or_zero();
        same.len() == 2 && -away(0).dot(away(1)) < cosine
    };
    RimLine {
        segments: edges.iter().map(|ends| ends.map(at)).collect(),
        corners: met
            .chunk_by(|a, b| a.0 == b.0)
            .filter(turns)
            .map(|same| at(same[0].0))
            .collect(),
    }
}
