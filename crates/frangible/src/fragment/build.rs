//! Fragments: closed surfaces, masses, shares of the convex cells `[G12 §6.3]`.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::cuts::Cuts;
use super::label::Labels;
use super::partition::{Interface, Point, face_parts, interfaces};
use super::render::{Part, Parts, Share};
use crate::asset::Asset;
use crate::body::Prepared;
use crate::crack::{CrackSystem, crossing_polygon};
use crate::mesh::{MassProperties, TriMesh, smooth_normals};
use crate::outcome::Fragment;

/// Points of the partition in f64, body frame, numbered in order of first use; mesh nodes come first.
struct PointTable<'a> {
    system: &'a CrackSystem<'a>,
    cuts: &'a Cuts,
    positions: Vec<DVec3>,
    /// Looked up only, never iterated.
    numbers: HashMap<Point, u32>,
}

impl PointTable<'_> {
    fn number(&mut self, point: Point) -> u32 {
        if let Point::Node(v) = point {
            return v;
        }
        if let Some(&number) = self.numbers.get(&point) {
            return number;
        }
        let position = self.position(point);
        let number = self.positions.len() as u32;
        self.positions.push(position);
        self.numbers.insert(point, number);
        number
    }

    fn position(&self, point: Point) -> DVec3 {
        match point {
            Point::Node(v) => self.positions[v as usize],
            Point::Edge(a, b) => {
                // An edge between two labels is always cut; the middle stands in for an uncut one all the same.
                let at = self.cuts.get(a, b).map_or(0.5, |cut| cut.at);
                self.positions[a as usize].lerp(self.positions[b as usize], at)
            }
            Point::Face(a, b, c) => {
                let cut = |a, b| self.position(Point::Edge(a, b));
                (cut(a, b) + cut(b, c) + cut(a, c)) / 3.0
            }
            Point::Centre(e) => {
                let nodes = self.system.asset.fracture.tets[e as usize];
                let (mut sum, mut count) = (DVec3::ZERO, 0.0);
                for [i, j] in crate::mesh::EDGES {
                    let (a, b) = (nodes[i].min(nodes[j]), nodes[i].max(nodes[j]));
                    if self.cuts.get(a, b).is_some() {
                        sum += self.position(Point::Edge(a, b));
                        count += 1.0;
                    }
                }
                sum / count
            }
        }
    }
}

/// One fragment under construction, in numbers of the point table.
#[derive(Clone, Default)]
struct Draft {
    outer: Vec<[u32; 3]>,
    outer_normals: Vec<[Vec3; 3]>,
    inner: Vec<[u32; 3]>,
    cracks: Vec<[Vec3; 3]>,
    shares: Vec<(u32, u32)>,
    supported: bool,
}

/// Builds all fragments, largest first.
pub(crate) fn build(system: &CrackSystem, labels: &Labels, prepared: &Prepared) -> Vec<Fragment> {
    let asset = system.asset;
    let mesh = &asset.fracture;
    let mut table = PointTable {
        system,
        cuts: &labels.cuts,
        positions: mesh.positions.iter().map(|p| p.as_dvec3()).collect(),
        numbers: HashMap::new(),
    };
    let mut drafts = vec![Draft::default(); labels.count];
    let label = |v: u32| labels.of_node[v as usize];

    for (e, tet) in mesh.tets.iter().enumerate() {
        let l = tet.map(label);
        let cell = asset.cell_of_tet[e];
        interfaces(
            e as u32,
            tet,
            &l,
            |Interface {
                 inside,
                 outside,
                 points,
             }| {
                let [a, b, c] = points.map(|p| table.number(p));
                drafts[inside as usize].inner.push([a, b, c]);
                drafts[outside as usize].inner.push([a, c, b]);
                for side in [inside, outside] {
                    drafts[side as usize]
                        .shares
                        .extend([(cell, a), (cell, b), (cell, c)]);
                }
            },
        );
        for (&v, &l) in tet.iter().zip(&l) {
            drafts[l as usize].shares.push((cell, v));
        }
    }
    let mut parts = Parts::default();
    for (triangle, normals) in asset.surface.triangles.iter().zip(&asset.surface.normals) {
        parts.begin();
        face_parts(triangle, &triangle.map(label), |l, points| {
            let draft = &mut drafts[l as usize];
            let numbers = points.map(|p| table.number(p));
            draft.outer.push(numbers);
            if prepared.render.is_some() {
                let corners = numbers.map(|v| table.positions[v as usize]);
                parts.push(Part { corners, label: l });
            }
            draft
                .outer_normals
                .push(points.map(|p| interpolated_normal(p, triangle, normals, &labels.cuts)));
        });
    }
    for &v in &asset.supported {
        drafts[label(v) as usize].supported = true;
    }
    partial_cracks(system, labels, &mut drafts);
    let density = asset.material.density;
    let mut local = vec![u32::MAX; table.positions.len()];
    let drawn = drawn(asset, prepared, &drafts, &table.positions, &parts);
    let faces: Vec<_> = match drawn {
        Some(_) => drafts.iter().map(|draft| draft.inner.clone()).collect(),
        None => Vec::new(),
    };
    let mut fragments: Vec<Fragment> = drafts
        .into_iter()
        .map(|draft| finish(draft, &table.positions, &mut local, density))
        .collect();
    if let (Some(drawn), Some(surface), Some(index)) = (drawn, &asset.render, &prepared.render) {
        let mut local = vec![u32::MAX; surface.positions.len()];
        for ((fragment, faces), share) in fragments.iter_mut().zip(&faces).zip(&drawn.shares) {
            let normals = &fragment.mesh.normals[fragment.mesh.outer_triangles..];
            let place = |v: u32| drawn.positions[v as usize];
            let faces = faces
                .iter()
                .zip(normals)
                .map(|(face, n)| [0, 1, 2].map(|k| (place(face[k]), n[k])))
                .collect();
            let centre = fragment.mass.centre;
            fragment.render = Some(index.assemble(surface, share, &faces, centre, &mut local));
        }
    }
    // Stable: equal volumes stay in the order of their labels.
    fragments.sort_by(|a, b| b.mass.volume.total_cmp(&a.mass.volume));
    fragments
}

/// The render surface divided, and the points of the partition drawn to it.
struct Drawn {
    shares: Vec<Share>,
    positions: Vec<DVec3>,
}

fn drawn(
    asset: &Asset,
    prepared: &Prepared,
    drafts: &[Draft],
    positions: &[DVec3],
    parts: &Parts,
) -> Option<Drawn> {
    let (index, surface) = (prepared.render.as_ref()?, asset.render.as_ref()?);
    let reach = prepared.edge;
    let nodes = asset.fracture.positions.len();
    let mut moved = positions.to_vec();
    // Rims of crack faces: what they share with the boundary.
    let mut rim: Vec<u32> = drafts
        .iter()
        .flat_map(|draft| draft.outer.iter().flatten().copied())
        .filter(|&v| v as usize >= nodes)
        .collect();
    rim.sort_unstable();
    rim.dedup();
    for v in rim {
        moved[v as usize] = index.drawn_to(positions[v as usize], reach);
    }
    Some(Drawn {
        shares: index.shares(surface, &prepared.surface, parts, drafts.len(), reach),
        positions: moved,
    })
}

/// Cracks inside a piece: fractured tetrahedra whose four nodes stayed together.
fn partial_cracks(system: &CrackSystem, labels: &Labels, drafts: &mut [Draft]) {
    let mesh = &system.asset.fracture;
    for crack in &system.cracks {
        for cut in &crack.elements {
            let nodes = mesh.tets[cut.tet as usize];
            let l = nodes.map(|v| labels.of_node[v as usize]);
            if l.iter().any(|&x| x != l[0]) {
                continue;
            }
            let (p, corners) = crossing_polygon(&mesh.corners(cut.tet as usize), &cut.values);
            for k in 2..corners {
                drafts[l[0] as usize].cracks.push([p[0], p[k - 1], p[k]]);
            }
        }
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

fn finish(draft: Draft, positions: &[DVec3], local: &mut [u32], density: f64) -> Fragment {
    let outer_triangles = draft.outer.len();
    let mut triangles = draft.outer;
    triangles.extend_from_slice(&draft.inner);
    let corner = |v: u32| positions[v as usize];
    let mass = MassProperties::of_tetrahedra(
        density,
        triangles
            .iter()
            .map(|&[a, b, c]| [DVec3::ZERO, corner(a), corner(b), corner(c)]),
    );
    let in_fragment = |v: u32| (positions[v as usize] - mass.centre).as_vec3();

    // Number the vertices in order of first use.
    let mut used = Vec::new();
    for v in triangles.iter_mut().flatten() {
        if local[*v as usize] == u32::MAX {
            local[*v as usize] = used.len() as u32;
            used.push(*v);
        }
        *v = local[*v as usize];
    }
    for &v in &used {
        local[v as usize] = u32::MAX;
    }
    let vertices: Vec<Vec3> = used.iter().map(|&v| in_fragment(v)).collect();
    let mut normals = draft.outer_normals;
    normals.extend(smooth_normals(&vertices, &triangles[outer_triangles..]));
    let centre = mass.centre.as_vec3();
    let cracks = draft
        .cracks
        .into_iter()
        .map(|t| t.map(|p| p - centre))
        .collect();

    let mut shares = draft.shares;
    shares.sort_unstable();
    shares.dedup();
    let cell_shares = shares
        .chunk_by(|x, y| x.0 == y.0)
        .map(|group| {
            (
                group[0].0,
                group.iter().map(|&(_, v)| in_fragment(v)).collect(),
            )
        })
        .collect();
    Fragment {
        mesh: TriMesh {
            positions: vertices,
            triangles,
            normals,
            outer_triangles,
            cracks,
        },
        render: None,
        mass,
        cell_shares,
        supported: draft.supported,
    }
}
