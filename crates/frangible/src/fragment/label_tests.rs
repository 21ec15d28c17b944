//! Labels against a plain union-find over all nodes and edges.

use glam::Vec3;
use rand_chacha::rand_core::Rng;

use super::components::Components;
use super::label::Labels;
use super::tests::block;
use super::volumes::Volumes;
use crate::asset::Asset;
use crate::body::MeshIndex;
use crate::crack::Known;
use crate::mesh::DisjointSets;
use crate::mesh::{EDGES, TetMesh};
use crate::rng::{Purpose, stream, uniform};
use crate::state::Cuts;

/// [`Labels::follow`], the plain way.
fn plain(cuts: &Cuts, tets: &[[u32; 4]], volumes: &[u64], crumb_share: f64) -> (Vec<u32>, usize) {
    let nodes = volumes.len();
    let mut sets = DisjointSets::new(nodes);
    for tet in tets {
        for [i, j] in EDGES {
            if cuts.get(tet[i], tet[j]).is_none() {
                sets.join(tet[i], tet[j]);
            }
        }
    }
    let mut root: Vec<u32> = (0..nodes as u32).map(|v| sets.find(v)).collect();
    let limit = crumb_share * volumes.iter().sum::<u64>() as f64;
    let volume_of = |root: &[u32]| {
        let mut volume = vec![0; nodes];
        for (v, &r) in root.iter().enumerate() {
            volume[r as usize] += volumes[v];
        }
        volume
    };
    for _ in 0..16 {
        let volume = volume_of(&root);
        let mut contacts = Vec::new();
        for tet in tets {
            for [i, j] in EDGES {
                let (a, b) = (root[tet[i] as usize], root[tet[j] as usize]);
                for (a, b) in [(a, b), (b, a)] {
                    if a != b && (volume[a as usize] as f64) < limit {
                        contacts.push((a, b));
                    }
                }
            }
        }
        contacts.sort_unstable();
        let mut best: Vec<(u32, u32, usize)> = Vec::new();
        for group in contacts.chunk_by(|x, y| x == y) {
            let (a, b) = group[0];
            match best.iter_mut().find(|known| known.0 == a) {
                None => best.push((a, b, group.len())),
                Some(known) if group.len() > known.2 => *known = (a, b, group.len()),
                Some(_) => {}
            }
        }
        best.iter().for_each(|&(a, b, _)| {
            sets.join(a, b);
        });
        root = root.iter().map(|&r| sets.find(r)).collect();
    }
    let volume = volume_of(&root);
    let mut order: Vec<u32> = (0..nodes as u32)
        .filter(|&v| root[v as usize] == v)
        .collect();
    order.sort_by_key(|&r| (std::cmp::Reverse(volume[r as usize]), r));
    let label = |r: &u32| order.iter().position(|o| o == r).unwrap() as u32;
    (root.iter().map(label).collect(), order.len())
}

fn labelled(cuts: Cuts, tets: &[[u32; 4]], index: &MeshIndex, crumb_share: f64) -> Labels {
    let known = Known {
        cut_by: index.cut_by(cuts.list()),
        ..Known::default()
    };
    let mut labels = Labels::new(cuts, known);
    labels.follow(tets, index, None, crumb_share);
    labels
}

/// Number of pieces, and whether crumbs were absorbed, for several sizes of crumbs.
fn compare(asset: &Asset, cuts: impl Fn() -> Cuts) -> (usize, bool) {
    let index = MeshIndex::new(asset);
    // Small patches too: a small body has few that no cut touches.
    let small = [3, 6].map(|most| MeshIndex::new(asset).with_patches(most));
    let tets = &asset.fracture.tets;
    let counts = [0.0, 2e-4, 0.01, 0.2].map(|share| {
        let (of_node, count) = plain(&cuts(), tets, &index.volumes, share);
        let found: Labels = labelled(cuts(), tets, &index, share);
        for index in &small {
            let same = labelled(cuts(), tets, index, share);
            assert_eq!((&same.of_node, same.count), (&found.of_node, found.count));
        }
        assert_eq!(found.count, count);
        assert_eq!(found.of_node, of_node);
        count
    });
    (counts[0], counts[3] < counts[0])
}

/// Cuts every edge for which `is_cut` says so.
fn cut_where(mesh: &TetMesh, mut is_cut: impl FnMut(u32, u32) -> bool) -> Cuts {
    let mut cuts = Cuts::none(mesh.positions.len());
    for tet in &mesh.tets {
        for [i, j] in EDGES {
            let (low, high) = (tet[i].min(tet[j]), tet[i].max(tet[j]));
            if cuts.get(low, high).is_none() && is_cut(low, high) {
                cuts.cut(low, high, -1.0, 1.0, 0);
            }
        }
    }
    cuts
}

#[test]
fn labels_of_arbitrary_cuts_are_those_of_a_plain_union_find() {
    let (mut pieces, mut absorbed) = (0, 0);
    for (round, share) in [0.02, 0.3, 0.6, 0.75, 0.85, 0.95].into_iter().enumerate() {
        let asset = block(5);
        let cuts = || {
            let mut rng = stream(round as u64, Purpose::CrackDirection, 0);
            cut_where(&asset.fracture, |_, _| uniform(&mut rng) < share)
        };
        let (count, joined) = compare(&asset, cuts);
        pieces += count;
        absorbed += usize::from(joined);
    }
    assert!(pieces > 100 && absorbed > 2, "{pieces}, {absorbed}");
}

/// Returns true if the edge crosses one of these discs.
fn crosses(mesh: &TetMesh, discs: &[(Vec3, Vec3, f32)], low: u32, high: u32) -> bool {
    let [a, b] = [low, high].map(|v| mesh.positions[v as usize]);
    discs.iter().any(|&(centre, normal, radius)| {
        ((a - centre).dot(normal) < 0.0) != ((b - centre).dot(normal) < 0.0)
            && a.midpoint(b).distance(centre) < radius
    })
}

#[test]
fn labels_of_flat_cracks_are_those_of_a_plain_union_find() {
    let (mut held, mut parted) = (0, 0);
    for seed in 0..40_u32 {
        let asset = block(6);
        let mut rng = stream(seed.into(), Purpose::CrackDirection, 1);
        let count = 1 + rng.next_u32() % 6;
        let mut random = || Vec3::from_array(std::array::from_fn(|_| uniform(&mut rng) as f32));
        let discs: Vec<_> = (0..count)
            .map(|_| (0.06 * random(), random() - 0.5, 0.09 * random().x))
            .collect();
        let mesh = &asset.fracture;
        let cuts = || cut_where(mesh, |low, high| crosses(mesh, &discs, low, high));
        let (pieces, _) = compare(&asset, cuts);
        held += usize::from(pieces == 1);
        parted += usize::from(pieces > 1);
    }
    assert!(held > 5 && parted > 5, "{held} held, {parted} parted");
}

#[test]
fn parts_that_no_edge_joins_are_pieces_whether_cracks_touch_them_or_not() {
    let mut asset = block(3);
    let mesh = &asset.fracture;
    let nodes = mesh.positions.len() as u32;
    let (mut positions, mut tets) = (mesh.positions.clone(), mesh.tets.clone());
    positions.extend(mesh.positions.iter().map(|p| p + 1.0));
    tets.extend(mesh.tets.iter().map(|t| t.map(|v| v + nodes)));
    asset.cell_of_tet = vec![0; tets.len()];
    asset.fracture = TetMesh::new(positions, tets).into();
    let mesh = &asset.fracture;
    assert_eq!(compare(&asset, || Cuts::none(mesh.positions.len())).0, 2);
    let corner = (Vec3::ZERO, Vec3::ONE, 0.012);
    let cuts = || cut_where(mesh, |low, high| crosses(mesh, &[corner], low, high));
    assert_eq!(compare(&asset, cuts).0, 2);
    let middle = (Vec3::splat(0.015), Vec3::X, 1.0);
    let cuts = || cut_where(mesh, |low, high| crosses(mesh, &[middle], low, high));
    assert_eq!(compare(&asset, cuts).0, 3);
}

#[test]
fn labels_that_follow_cuts_look_by_look_are_those_of_all_cuts_at_once() {
    let (mut looks, mut same) = (0, 0);
    for seed in 0..30_u32 {
        let asset = block(6);
        let mesh = &asset.fracture;
        let index = MeshIndex::new(&asset).with_patches(6);
        let mut rng = stream(seed.into(), Purpose::CrackDirection, 2);
        let mut random = || Vec3::from_array(std::array::from_fn(|_| uniform(&mut rng) as f32));
        let cracks: Vec<(Vec3, Vec3)> = (0..3).map(|_| (0.06 * random(), random() - 0.5)).collect();
        let empty = Cuts::none(mesh.positions.len());
        let mut followed = labelled(empty, &mesh.tets, &index, 0.01);
        // Cracks grow, some until they part the block.
        for look in 1..8 {
            let radius = 0.015 * look as f32;
            let discs: Vec<_> = (cracks.iter())
                .map(|&(centre, normal)| (centre, normal, radius))
                .collect();
            let cuts = cut_where(mesh, |low, high| crosses(mesh, &discs, low, high));
            for cut in cuts.list() {
                let [low, high] = cut.ends;
                if followed.cuts.get(low, high).is_none() {
                    followed.cuts.cut(low, high, -1.0, 1.0, 0);
                }
            }
            followed.known.cut_by = index.cut_by(followed.cuts.list());
            let before = followed.of_node.clone();
            followed.follow(&mesh.tets, &index, None, 0.01);
            let (of_node, count) = plain(&cuts, &mesh.tets, &index.volumes, 0.01);
            assert_eq!((&followed.of_node, followed.count), (&of_node, count));
            looks += 1;
            same += usize::from(followed.of_node == before);
        }
    }
    assert!(same > 30 && same < looks - 30, "{same} of {looks}");
}

#[test]
fn a_crack_costs_what_it_crosses_not_what_the_body_has() {
    // Across an edge of the block, and between two that part what it cuts off from the rest of the edge.
    let slant = (Vec3::new(0.01, 0.01, 0.05), Vec3::new(1.0, 1.0, 0.0), 0.025);
    let long = (slant.0, slant.1, 0.08);
    let level = |z| (Vec3::new(0.0, 0.0, z), Vec3::Z, 0.05);
    for (parts, discs) in [
        (false, vec![slant]),
        (true, vec![long, level(0.025), level(0.075)]),
    ] {
        let costs = [10, 20].map(|n| {
            let asset = block(n);
            let mesh = &asset.fracture;
            let cuts = cut_where(mesh, |low, high| crosses(mesh, &discs, low, high));
            let index = MeshIndex::new(&asset);
            let mut components = Components::default();
            let cut_by = index.cut_by(cuts.list());
            assert_eq!(components.follow(&cuts, &cut_by, &index, None), parts);
            assert_eq!(components.list().len() > 1, parts);
            components.cost()
        });
        // Some 200 nodes lie beside the cuts; the others are those around them.
        assert!(costs[1] < 450 && costs[1] * 3 < costs[0] * 4, "{costs:?}");
    }
}

#[test]
fn pieces_are_free_that_are_small_and_do_not_move_on_their_own() {
    let asset = block(8);
    let mesh = &asset.fracture;
    let index = MeshIndex::new(&asset);
    let top = mesh.positions.iter().fold(Vec3::MIN, |m, p| m.max(*p));
    // Slices of 0.6, 0.3 and 0.1 of the height.
    let slice = |v: u32| match mesh.positions[v as usize].y / top.y {
        y if y < 0.6 => 0,
        y if y < 0.9 => 1,
        _ => 2,
    };
    let cuts = cut_where(mesh, |a, b| slice(a) != slice(b));
    let labels = labelled(cuts, &mesh.tets, &index, 0.0);
    assert_eq!(labels.count, 3);
    let volumes = Volumes::of(&labels, &index);
    assert_eq!(volumes.free(&[false; 3]), [false, true, true]);
    assert_eq!(volumes.free(&[false, false, true]), [false, true, false]);
    assert_eq!(volumes.free(&[true, true, false]), [false, false, true]);
}

#[test]
fn edges_are_numbered_by_their_lower_node_and_then_by_their_higher() {
    let asset = block(4);
    let index = MeshIndex::new(&asset);
    let nodes = 0..asset.fracture.positions.len() as u32;
    let from = |v: u32| index.around(v).map(move |(w, edge)| ([v, w], edge));
    let around: Vec<([u32; 2], u32)> = nodes.flat_map(from).collect();
    assert!(around.is_sorted_by_key(|(ends, _)| *ends));
    let from_low = around.iter().filter(|([v, w], _)| v < w);
    let edges: Vec<[u32; 2]> = from_low.map(|(ends, _)| *ends).collect();
    assert!(edges.is_sorted() && edges.len() == index.edges.count());
    assert_eq!(around.len(), 2 * edges.len());
    for &([v, w], edge) in &around {
        assert_eq!(index.edge(v.min(w), v.max(w)), Some(edge));
    }
    for (number, [low, high]) in (0..).zip(&edges) {
        assert_eq!(index.edge(*low, *high), Some(number));
    }
    let mut met = vec![false; edges.len()];
    for (tet, corners) in (0..).zip(&asset.fracture.tets) {
        for (number, [i, j]) in index.edges.of_tet(tet).into_iter().zip(EDGES) {
            let (a, b) = (corners[i], corners[j]);
            assert_eq!(edges[number as usize], [a.min(b), a.max(b)]);
            met[number as usize] = true;
        }
    }
    assert!(met.iter().all(|met| *met));
    assert_eq!(index.edge(0, 0), None);
}
