//! The partition of a body among arbitrary labels.

use std::collections::HashMap;

use glam::Vec3;
use rand_chacha::rand_core::Rng;

use super::build::build;
use super::label::Labels;
use crate::asset::{AnalysisMesh, Asset, ConvexCell, EmbeddedPoint, Embedding, OuterSurface};
use crate::crack::{CrackSystem, Known};
use crate::mesh::{EDGES, MassProperties, TetMesh};
use crate::modal::ModalBasis;
use crate::rng::{Purpose, stream, uniform};
use crate::state::Cuts;
use crate::{Breakable, FractureConfig, Fragment, Material};

/// A block of n³ jittered cubes, six tetrahedra each, without modes.
pub(super) fn block(n: usize) -> Asset {
    let mut rng = stream(7, Purpose::WeakPoints, 0);
    let index = |i: usize, j: usize, k: usize| ((i * (n + 1) + j) * (n + 1) + k) as u32;
    let mut positions = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            for k in 0..=n {
                let mut jitter = |at: usize| {
                    let inside = at > 0 && at < n;
                    at as f32
                        + if inside {
                            0.4 * (uniform(&mut rng) as f32 - 0.5)
                        } else {
                            0.0
                        }
                };
                positions.push(Vec3::new(jitter(i), jitter(j), jitter(k)) * 0.01);
            }
        }
    }
    let mut tets = Vec::new();
    for i in 0..n {
        for j in 0..n {
            for k in 0..n {
                for path in [
                    [0, 1, 2],
                    [0, 2, 1],
                    [1, 0, 2],
                    [1, 2, 0],
                    [2, 0, 1],
                    [2, 1, 0],
                ] {
                    let mut c = [i, j, k];
                    let mut tet = vec![index(c[0], c[1], c[2])];
                    for axis in path {
                        c[axis] += 1;
                        tet.push(index(c[0], c[1], c[2]));
                    }
                    let mut tet: [u32; 4] = [tet[0], tet[1], tet[2], tet[3]];
                    let x = tet.map(|v| positions[v as usize]);
                    if (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) < 0.0 {
                        tet.swap(2, 3);
                    }
                    tets.push(tet);
                }
            }
        }
    }
    let fracture = TetMesh::new(positions, tets);
    let boundary = fracture.boundary();
    let surface = OuterSurface {
        normals: vec![[Vec3::Y; 3]; boundary.len()],
        curvature_radius: vec![f32::INFINITY; boundary.len()],
        tets: boundary.iter().map(|b| b.1).collect(),
        triangles: boundary.into_iter().map(|b| b.0).collect(),
        ..OuterSurface::default()
    };
    let mass = MassProperties::of_tetrahedra(
        1.0,
        (0..fracture.tets.len()).map(|e| fracture.corners(e).map(Vec3::as_dvec3)),
    );
    let middle = EmbeddedPoint {
        element: 0,
        barycentric: [0.25; 4],
        offset: Vec3::ZERO,
    };
    Asset {
        name: "block".into(),
        material: Material::preset("glass").unwrap(),
        cell_of_tet: vec![0; fracture.tets.len()],
        embedding: Embedding {
            tets: vec![middle; fracture.tets.len()],
            nodes: Vec::new(),
        },
        fracture: fracture.into(),
        surface,
        analysis: one_element(),
        modes: ModalBasis::default(),
        mass,
        cells: vec![ConvexCell::default()],
        bounds: Default::default(),
        supported: Vec::new(),
        render: None,
        portion: None,
    }
}

/// A single element around the block.
fn one_element() -> AnalysisMesh {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    let middles = EDGES.map(|[i, j]| 0.5 * (corners[i] + corners[j]));
    AnalysisMesh {
        nodes: corners.into_iter().chain(middles).collect(),
        elements: vec![[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]],
        barycentric_gradients: vec![[-Vec3::ONE, Vec3::X, Vec3::Y, Vec3::Z]],
    }
}

#[test]
fn fragments_of_arbitrary_labels_tile_the_body_and_are_closed() {
    let asset = block(6);
    let nodes = asset.fracture.positions.len();
    let config = FractureConfig::default();
    let body = Breakable::of_sound(asset.clone().into()).body(1);
    let system = CrackSystem::new(&body, &config, 0.0);
    for (round, count) in [2_u32, 3, 4, 9].into_iter().enumerate() {
        let mut rng = stream(round as u64, Purpose::CrackDirection, count);
        // Any labels at all, so that every case of two, three and four labels occurs many times.
        let of_node: Vec<u32> = (0..nodes).map(|_| rng.next_u32() % count).collect();
        let mut cuts = Cuts::none(nodes);
        for tet in &asset.fracture.tets {
            for [i, j] in EDGES {
                if of_node[tet[i] as usize] != of_node[tet[j] as usize] {
                    let at = 0.1 + 0.8 * uniform(&mut rng) as f32;
                    cuts.cut(tet[i], tet[j], -at, 1.0 - at, 0);
                }
            }
        }
        let labels = Labels {
            of_node,
            count: count as usize,
            ..Labels::new(cuts, Known::default())
        };
        let fragments = build(&system, &labels, &body.prepared).fragments;
        assert_eq!(fragments.len(), count as usize);
        let volume: f64 = fragments.iter().map(|f| f.mass.volume).sum();
        let whole = asset.fracture.total_volume();
        assert!(
            (volume / whole - 1.0).abs() < 1e-9,
            "{count} labels: {volume} of {whole}"
        );
        let emitted: f64 = fragments.iter().map(|f| f.mesh.volume()).sum();
        assert!(
            (emitted / whole - 1.0).abs() < 1e-6,
            "{count} labels, f32: {emitted} of {whole}"
        );
        for fragment in &fragments {
            assert!(fragment.mass.volume > 0.0);
            assert!(
                balanced(&fragment.mesh.triangles),
                "{count} labels: an open surface"
            );
            assert!(fragment.mesh.normals.len() == fragment.mesh.triangles.len());
        }
        assert_opposite_faces(&fragments);
        let first: glam::DVec3 = fragments.iter().map(|f| f.mass.centre * f.mass.mass).sum();
        let density = asset.material.density;
        assert!((first / (whole * density) - asset.mass.centre).length() < 1e-12);
    }
}

#[test]
fn the_fragment_that_holds_a_supported_node_is_supported() {
    let mut asset = block(3);
    // Cut amid the edges between x ≤ 1/3 and the rest.
    let left = |asset: &Asset, v: u32| asset.fracture.positions[v as usize].x < 0.5;
    let nodes = asset.fracture.positions.len() as u32;
    let mut cuts = Cuts::none(nodes as usize);
    for tet in &asset.fracture.tets {
        for [i, j] in EDGES {
            if left(&asset, tet[i]) != left(&asset, tet[j]) {
                let side = |v| if left(&asset, v) { -0.5 } else { 0.5 };
                cuts.cut(tet[i], tet[j], side(tet[i]), side(tet[j]), 0);
            }
        }
    }
    let of_node: Vec<u32> = (0..nodes).map(|v| u32::from(left(&asset, v))).collect();
    let labels = Labels {
        of_node,
        count: 2,
        ..Labels::new(cuts, Known::default())
    };
    for node in 0..nodes {
        asset.supported = vec![node];
        let config = FractureConfig::default();
        let body = Breakable::of_sound(asset.clone().into()).body(1);
        let fragments = build(
            &CrackSystem::new(&body, &config, 0.0),
            &labels,
            &body.prepared,
        )
        .fragments;
        let place = asset.fracture.positions[node as usize];
        assert!(fragments.iter().any(|f| f.supported));
        for fragment in fragments {
            let holds = fragment.mesh.positions.iter().any(|p| {
                let corner = p.as_dvec3() + fragment.mass.centre;
                corner.distance(place.as_dvec3()) < 1e-6
            });
            let inner = place.x > 0.0 && place.x < 1.0;
            assert!(
                fragment.supported == holds || inner && !holds,
                "node {node}"
            );
        }
    }
}

/// Asserts that two fragments have the same crack faces towards each other, turned round.
fn assert_opposite_faces(fragments: &[Fragment]) {
    let towards = |own: usize, other: usize| {
        let mesh = &fragments[own].mesh;
        let faces = mesh.triangles[mesh.outer_triangles..].iter();
        let pairs = faces.zip(&fragments[own].neighbours);
        let own_faces = pairs.filter(|(_, n)| **n == other as u32);
        own_faces.fold((0, glam::DVec3::ZERO), |(count, sum), (face, _)| {
            let [a, b, c] = face.map(|v| mesh.positions[v as usize].as_dvec3());
            (count + 1, sum + (b - a).cross(c - a))
        })
    };
    for (own, fragment) in fragments.iter().enumerate() {
        let inner = fragment.mesh.triangles.len() - fragment.mesh.outer_triangles;
        assert_eq!(fragment.neighbours.len(), inner);
        let all: usize = (0..fragments.len())
            .map(|other| towards(own, other).0)
            .sum();
        assert_eq!(all, inner, "a neighbour that is no fragment");
        assert_eq!(towards(own, own).0, 0);
        for other in 0..own {
            let ((here, sum), (there, turned)) = (towards(own, other), towards(other, own));
            assert_eq!(here, there, "{own} and {other}");
            assert!((sum + turned).length() < 1e-5, "{sum} and {turned}");
        }
    }
}

/// Every directed edge occurs as often as its opposite. (Random labels make pieces that touch themselves along
/// an edge; pieces from cracks are tested for more in the invariants of whole breaks.)
fn balanced(triangles: &[[u32; 3]]) -> bool {
    let mut count: HashMap<(u32, u32), i32> = HashMap::new();
    for &[a, b, c] in triangles {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            *count.entry((p.min(q), p.max(q))).or_default() += if p < q { 1 } else { -1 };
        }
    }
    count.values().all(|&n| n == 0)
}
