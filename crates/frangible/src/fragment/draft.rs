//! Fragments in numbers of the point table: the triangles and points of each.

use glam::Vec3;

use super::label::Labels;
use super::partition::{Interface, Point, face_parts, interfaces};
use super::points::PointTable;
use crate::asset::Asset;
use crate::body::MeshIndex;
use crate::crack::Crack;
use crate::mesh::{Part, Parts, TetMesh};
use crate::state::{Cuts, crossing_polygon};

/// One fragment under construction, in numbers of the point table.
#[derive(Clone, Default)]
pub(super) struct Draft {
    pub(super) outer: Vec<[u32; 3]>,
    /// Triangle of the body's surface that each of them lies on.
    pub(super) outer_of: Vec<u32>,
    pub(super) outer_normals: Vec<[Vec3; 3]>,
    pub(super) inner: Vec<[u32; 3]>,
    /// Tetrahedron in which each of them lies.
    pub(super) inner_of: Vec<u32>,
    /// Label on the other side of each of them.
    pub(super) inner_to: Vec<u32>,
    pub(super) cracks: Vec<[Vec3; 3]>,
    /// Convex cells and the mesh nodes in them, ascending.
    pub(super) cell_nodes: Vec<(u32, u32)>,
    /// Convex cells (upper half) and points of the partition in them, in any order and repeated.
    pub(super) cell_points: Vec<u64>,
    pub(super) supported: bool,
}

/// Crack faces: the faces that part the labels inside the tetrahedra.
pub(super) fn inner_faces(
    asset: &Asset,
    index: &MeshIndex,
    labels: &Labels,
    table: &mut PointTable,
    drafts: &mut [Draft],
) {
    for e in divided_tets(&asset.fracture.tets, index, labels) {
        let tet = &asset.fracture.tets[e as usize];
        let cell = asset.cell_of_tet[e as usize];
        interfaces(
            e,
            tet,
            &tet.map(|v| labels.of_node[v as usize]),
            |Interface {
                 inside,
                 outside,
                 points,
             }| {
                // Neighbours of a piece have none.
                if inside.min(outside) as usize >= drafts.len() {
                    return;
                }
                let [a, b, c] = points.map(|p| table.number(p));
                for (side, other, face) in
                    [(inside, outside, [a, b, c]), (outside, inside, [a, c, b])]
                {
                    if let Some(draft) = drafts.get_mut(side as usize) {
                        draft.inner.push(face);
                        draft.inner_of.push(e);
                        draft.inner_to.push(other);
                        let points = face.map(|p| u64::from(cell) << 32 | u64::from(p));
                        draft.cell_points.extend(points);
                    }
                }
            },
        );
    }
}

/// Tetrahedra whose nodes have several labels, ascending: those around the cut edges between two labels.
pub(super) fn divided_tets(
    tets: &[[u32; 4]],
    index: &MeshIndex,
    labels: &Labels,
) -> impl Iterator<Item = u32> + use<> {
    let label = |v: u32| labels.of_node[v as usize];
    let labels_count = labels.count;
    let mut done = vec![false; labels.of_node.len()];
    let mut divided = vec![0_u64; tets.len().div_ceil(64)];
    for cut in labels.cuts.list() {
        let [low, high] = cut.ends;
        if label(low) == label(high) || std::mem::replace(&mut done[low as usize], true) {
            continue;
        }
        for &e in index.tets.of(low) {
            let labels = tets[e as usize].map(label);
            let own = labels.iter().any(|&l| (l as usize) < labels_count);
            if own && labels.iter().any(|&l| l != label(low)) {
                divided[e as usize / 64] |= 1 << (e % 64);
            }
        }
    }
    (0..).zip(divided).flat_map(|(i, mut word)| {
        std::iter::from_fn(move || {
            let bit = word.trailing_zeros();
            word &= word.wrapping_sub(1);
            (bit < 64).then_some(64 * i + bit)
        })
    })
}

/// The outer surface divided among the labels; also as `parts`, if asked for.
pub(super) fn outer_faces(
    asset: &Asset,
    labels: &Labels,
    table: &mut PointTable,
    drafts: &mut [Draft],
    mut parts: Option<&mut Parts>,
) {
    let label = |v: u32| labels.of_node[v as usize];
    let surface = &asset.surface;
    let others = drafts.len() as u32;
    for (t, (triangle, normals)) in (0..).zip(surface.triangles.iter().zip(&surface.normals)) {
        if let Some(parts) = &mut parts {
            parts.begin();
        }
        let l = triangle.map(label);
        // Nearly all belong to one piece, and need no points between nodes.
        let foreign = l.iter().all(|&l| l >= others).then_some(others);
        let one = (l[0] == l[1] && l[1] == l[2]).then_some(l[0]);
        if let Some(label) = foreign.or(one) {
            if let Some(draft) = drafts.get_mut(label as usize) {
                draft.outer.push(*triangle);
                draft.outer_of.push(t);
                let unit = normals.map(|n| n.normalize_or(normals[0]));
                draft.outer_normals.push(unit);
            }
            if let Some(parts) = &mut parts {
                let corners = triangle.map(|v| asset.fracture.positions[v as usize].as_dvec3());
                parts.push(Part { corners, label });
            }
            continue;
        }
        face_parts(triangle, &l, |l, points| {
            let numbers = points.map(|p| table.number(p));
            let draft = drafts.get_mut(l as usize);
            if let Some(parts) = &mut parts {
                let corners = numbers.map(|v| table.place(v));
                let label = l.min(others);
                parts.push(Part { corners, label });
                if draft.is_some() {
                    let on_rim = numbers.into_iter().filter(|&v| !table.is_node(v));
                    parts.rim.extend(on_rim);
                }
            }
            if let Some(draft) = draft {
                draft.outer.push(numbers);
                draft.outer_of.push(t);
                let normal = |p| interpolated_normal(p, triangle, normals, &labels.cuts);
                draft.outer_normals.push(points.map(normal));
            }
        });
    }
}

/// Normal of the body's surface at a point of one of its triangles.
fn interpolated_normal(point: Point, nodes: &[u32; 3], normals: &[Vec3; 3], cuts: &Cuts) -> Vec3 {
    let at = |v: u32| {
        nodes
            .iter()
            .position(|&n| n == v)
            .map_or(normals[0], |i| normals[i])
    };
    let edge = |a: u32, b: u32| {
        let t = cuts.get(a, b).map_or(0.5, |cut| cut.at) as f32;
        at(a) * (1.0 - t) + at(b) * t
    };
    let sum = match point {
        Point::Node(v) => at(v),
        Point::Edge(a, b) => edge(a, b),
        Point::Face(a, b, c) => edge(a, b) + edge(b, c) + edge(a, c),
        Point::Centre(_) => normals.iter().sum(),
    };
    sum.normalize_or(normals[0])
}

/// Gives each draft its mesh nodes of the convex cells, and notes which are supported.
pub(super) fn nodes(asset: &Asset, index: &MeshIndex, labels: &Labels, drafts: &mut [Draft]) {
    let label = |v: u32| labels.of_node[v as usize] as usize;
    for cell in 0..index.nodes_of_cell.count() as u32 {
        for &v in index.nodes_of_cell.of(cell) {
            if let Some(draft) = drafts.get_mut(label(v)) {
                draft.cell_nodes.push((cell, v));
            }
        }
    }
    for &v in &asset.supported {
        if let Some(draft) = drafts.get_mut(label(v)) {
            draft.supported = true;
        }
    }
}

/// Cracks inside a piece: fractured tetrahedra whose four nodes stayed together.
pub(super) fn partial_cracks(
    mesh: &TetMesh,
    cracks: &[Crack],
    labels: &Labels,
    drafts: &mut [Draft],
) {
    for crack in cracks {
        for cut in &crack.elements {
            let nodes = mesh.tets[cut.tet as usize];
            let l = nodes.map(|v| labels.of_node[v as usize]);
            if l.iter().any(|&x| x != l[0]) || l[0] as usize >= drafts.len() {
                continue;
            }
            let (p, corners) = crossing_polygon(&mesh.corners(cut.tet as usize), &cut.values);
            for k in 2..corners {
                drafts[l[0] as usize].cracks.push([p[0], p[k - 1], p[k]]);
            }
        }
    }
}
