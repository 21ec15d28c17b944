//! Pieces that are sets of whole tetrahedra.

use std::collections::{BTreeMap, BTreeSet};

use frangible::glam::{DVec3, Vec3};
use frangible::internals::mesh::NO_NEIGHBOUR;
use frangible::internals::{MassProperties, TetMesh};
use frangible::{Body, Fragment, TriMesh};

use super::plane_crack::{Faces, face, face_area};

/// Tetrahedra that are connected over closed faces, largest first. A piece smaller than `crumb_share` of the body's volume stays with the neighbour
/// it shares most area with, as in ours.
pub(crate) fn face_pieces(body: &Body, faces: &Faces<'_>, crumb_share: f64) -> Vec<Fragment> {
    let mesh: &TetMesh = body.asset().fracture();
    let (mut piece_of, mut volumes) = components(mesh, faces);
    absorb_crumbs(mesh, &mut piece_of, &mut volumes, crumb_share);
    let mut order: Vec<usize> = (0..volumes.len()).filter(|&p| volumes[p] > 0.0).collect();
    order.sort_by(|&a, &b| volumes[b].total_cmp(&volumes[a]).then(a.cmp(&b)));
    let mut place = vec![0; volumes.len()];
    for (i, &p) in order.iter().enumerate() {
        place[p] = i as u32;
    }
    let mut tets_of = vec![Vec::new(); order.len()];
    for (tet, &p) in (0..).zip(&piece_of) {
        tets_of[place[p as usize] as usize].push(tet);
    }
    let builder = Builder {
        body,
        mesh,
        faces,
        piece_of: &piece_of,
        place: &place,
        outer_of: outer_triangles(body),
    };
    tets_of.iter().map(|tets| builder.fragment(tets)).collect()
}

/// Component of each tetrahedron, by rising lowest tetrahedron, and their volumes, m³.
fn components(mesh: &TetMesh, faces: &Faces<'_>) -> (Vec<u32>, Vec<f64>) {
    const NONE: u32 = u32::MAX;
    let mut of_tet = vec![NONE; mesh.tets.len()];
    let mut volumes = Vec::new();
    let mut waiting = Vec::new();
    for first in 0..mesh.tets.len() as u32 {
        if of_tet[first as usize] != NONE {
            continue;
        }
        let component = volumes.len() as u32;
        let mut volume = 0.0;
        of_tet[first as usize] = component;
        waiting.push(first);
        while let Some(tet) = waiting.pop() {
            volume += mesh.volume(tet as usize);
            for (k, &other) in mesh.neighbours[tet as usize].iter().enumerate() {
                let joined = other != NO_NEIGHBOUR && !faces.is_open(tet, k);
                if joined && of_tet[other as usize] == NONE {
                    of_tet[other as usize] = component;
                    waiting.push(other);
                }
            }
        }
        volumes.push(volume);
    }
    (of_tet, volumes)
}

/// Joins the smallest crumb to its best neighbour until there is none.
fn absorb_crumbs(mesh: &TetMesh, of_tet: &mut [u32], volumes: &mut [f64], share: f64) {
    let limit = share * volumes.iter().sum::<f64>();
    let mut shared = shared_areas(mesh, of_tet);
    loop {
        let crumbs = (0..volumes.len()).filter(|&p| volumes[p] > 0.0 && volumes[p] < limit);
        let smallest = crumbs.min_by(|&a, &b| volumes[a].total_cmp(&volumes[b]));
        let Some(crumb) = smallest else { break };
        let neighbours = std::mem::take(&mut shared[crumb]);
        let best = neighbours
            .iter()
            .max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(a.0)));
        let Some((&best, _)) = best else { break };
        volumes[best as usize] += std::mem::take(&mut volumes[crumb]);
        of_tet
            .iter_mut()
            .filter(|p| **p == crumb as u32)
            .for_each(|p| *p = best);
        for (other, area) in neighbours {
            shared[other as usize].remove(&(crumb as u32));
            if other != best {
                *shared[other as usize].entry(best).or_default() += area;
                *shared[best as usize].entry(other).or_default() += area;
            }
        }
    }
}

/// Neighbours of each component, with the area that they share with it, m².
fn shared_areas(mesh: &TetMesh, of_tet: &[u32]) -> Vec<BTreeMap<u32, f64>> {
    let count = of_tet.iter().max().map_or(0, |&most| most as usize + 1);
    let mut shared = vec![BTreeMap::new(); count];
    for tet in 0..mesh.tets.len() as u32 {
        for (k, &other) in mesh.neighbours[tet as usize].iter().enumerate() {
            if other == NO_NEIGHBOUR {
                continue;
            }
            let (a, b) = (of_tet[tet as usize], of_tet[other as usize]);
            if a != b {
                *shared[a as usize].entry(b).or_default() += face_area(mesh, tet, k);
            }
        }
    }
    shared
}

/// Triangles of the outer surface behind which each tetrahedron lies.
fn outer_triangles(body: &Body) -> Vec<Vec<u32>> {
    let asset = body.asset();
    let mut of_tet = vec![Vec::new(); asset.fracture().tets.len()];
    for (triangle, &tet) in (0..).zip(&asset.surface().tets) {
        of_tet[tet as usize].push(triangle);
    }
    of_tet
}

/// Makes fragments of lists of tetrahedra.
struct Builder<'a> {
    body: &'a Body,
    mesh: &'a TetMesh,
    faces: &'a Faces<'a>,
    piece_of: &'a [u32],
    /// Number of the fragment of each piece.
    place: &'a [u32],
    outer_of: Vec<Vec<u32>>,
}

impl Builder<'_> {
    fn fragment(&self, tets: &[u32]) -> Fragment {
        let asset = self.body.asset();
        let corners = |tet: &u32| self.mesh.corners(*tet as usize).map(Vec3::as_dvec3);
        let mass =
            MassProperties::of_tetrahedra(asset.material().density, tets.iter().map(corners));
        let place = |node: u32| self.in_fragment(node, mass.centre);
        let mut triangles = Vec::new();
        let mut normals = Vec::new();
        for outer in tets.iter().flat_map(|&tet| &self.outer_of[tet as usize]) {
            triangles.push(asset.surface().triangles[*outer as usize]);
            normals.push(asset.surface().normals[*outer as usize]);
        }
        let outer_triangles = triangles.len();
        let (mut cracks, mut neighbours) = (Vec::new(), Vec::new());
        for &tet in tets {
            for k in 0..4 {
                let other = self.mesh.neighbours[tet as usize][k];
                if other == NO_NEIGHBOUR {
                    continue;
                }
                let triangle = face(self.mesh, tet, k);
                let [a, b, c] = triangle.map(place);
                if self.piece_of[other as usize] != self.piece_of[tet as usize] {
                    let flat = (b - a).cross(c - a).normalize_or(Vec3::Y);
                    triangles.push(triangle);
                    normals.push([flat; 3]);
                    neighbours.push(self.place[self.piece_of[other as usize] as usize]);
                } else if tet < other && self.faces.is_open(tet, k) {
                    cracks.push([a, b, c]);
                }
            }
        }
        let used = numbered(&mut triangles);
        let nodes: BTreeSet<u32> = tets
            .iter()
            .flat_map(|&tet| self.mesh.tets[tet as usize])
            .collect();
        Fragment {
            mesh: TriMesh {
                positions: used.into_iter().map(place).collect(),
                triangles,
                normals,
                outer_triangles,
                cracks,
            },
            neighbours,
            render: None,
            mass,
            cell_shares: self.cell_shares(tets, mass.centre),
            supported: asset.supported().iter().any(|node| nodes.contains(node)),
            velocity: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
        }
    }

    fn in_fragment(&self, node: u32, centre: DVec3) -> Vec3 {
        (self.mesh.positions[node as usize].as_dvec3() - centre).as_vec3()
    }

    /// Nodes of its tetrahedra by convex cell.
    fn cell_shares(&self, tets: &[u32], centre: DVec3) -> Vec<(u32, Vec<Vec3>)> {
        let mut cells: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
        for &tet in tets {
            let cell = self.body.asset().cell_of_tet()[tet as usize];
            cells
                .entry(cell)
                .or_default()
                .extend(self.mesh.tets[tet as usize]);
        }
        let share =
            |nodes: BTreeSet<u32>| nodes.iter().map(|&v| self.in_fragment(v, centre)).collect();
        cells
            .into_iter()
            .map(|(cell, nodes)| (cell, share(nodes)))
            .collect()
    }
}

/// Numbers the nodes of triangles in order of first use; returns the node of each number.
fn numbered(triangles: &mut [[u32; 3]]) -> Vec<u32> {
    let mut number_of = BTreeMap::new();
    let mut used = Vec::new();
    for node in triangles.iter_mut().flatten() {
        let number = *number_of.entry(*node).or_insert_with(|| {
            used.push(*node);
            used.len() as u32 - 1
        });
        *node = number;
    }
    used
}
