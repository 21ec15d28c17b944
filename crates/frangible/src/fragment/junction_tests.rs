//! Ends of cracks against the plain flood, tetrahedron by tetrahedron from every node.

use std::collections::BTreeMap;

use glam::Vec3;

use super::junction::{Ends, end_cracks};
use super::tests::block;
use crate::asset::Asset;
use crate::crack::CrackSystem;
use crate::mesh::{EDGES, NO_NEIGHBOUR, Rows};
use crate::piece::Portion;
use crate::rng::{Purpose, stream, uniform};
use crate::state::{BodyState, Cuts, OldCrack, OldCut};
use crate::{Breakable, FractureConfig};

/// [`end_cracks`], the plain way.
fn end_plainly(system: &CrackSystem, cuts: &mut Cuts) {
    let mesh = &system.asset.fracture;
    let tets_of_node = Rows::inverse(mesh.positions.len(), &mesh.tets);
    for (id, crack) in (0..).zip(&system.cracks) {
        for junction in &crack.junctions {
            let (last, own) = (&crack.elements[junction.from as usize], junction.own);
            let nodes = mesh.tets[last.tet as usize];
            let centre = mesh.centroid(last.tet as usize);
            let ahead = |v: u32| (mesh.positions[v as usize] - centre).dot(last.direction);
            let each = nodes.iter().zip(&last.values);
            let level = each.map(|(&v, s)| s - ahead(v)).sum::<f32>() / 4.0;
            let mut values: BTreeMap<u32, f32> = nodes.iter().copied().zip(last.values).collect();
            let mut queue = nodes.to_vec();
            let mut next = 0;
            while let Some(&v) = queue.get(next) {
                next += 1;
                for &n in tets_of_node.of(v) {
                    let by = system.fractured_by[n as usize];
                    if by == u32::MAX || n == last.tet || (by == id && !own) {
                        continue;
                    }
                    let corners = mesh.tets[n as usize];
                    for w in corners {
                        values.entry(w).or_insert_with(|| level + ahead(w));
                    }
                    let mut reached = corners.map(|w| w == v);
                    for _ in 0..4 {
                        for [i, j] in EDGES {
                            let cut = cuts.get(corners[i], corners[j]);
                            if !cut.is_some_and(|cut| cut.crack != id || own) {
                                let either = reached[i] || reached[j];
                                (reached[i], reached[j]) = (either, either);
                            }
                        }
                    }
                    for [i, j] in EDGES {
                        let (a, b) = (corners[i], corners[j]);
                        let whole = reached[i] && reached[j] && cuts.get(a, b).is_none();
                        if whole && cuts.cut(a, b, values[&a], values[&b], id) {
                            for end in [a, b] {
                                let gap = mesh.positions[end as usize].distance(centre);
                                if gap < 2.5 * system.edge && !queue.contains(&end) {
                                    queue.push(end);
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Wavy discs one after another, each ending where it meets an earlier one, and, as if it had met itself, in places of its own.
fn cracked(asset: &Asset, seed: u64) -> BodyState {
    let mesh = &asset.fracture;
    let mut rng = stream(seed, Purpose::CrackDirection, 0);
    let mut by = vec![u32::MAX; mesh.tets.len()];
    let mut cracks = Vec::new();
    for id in 0..5 {
        let mut random = || Vec3::from_array(std::array::from_fn(|_| uniform(&mut rng) as f32));
        let (centre, normal) = (0.06 * random(), (random() - 0.5).normalize());
        let radius = 0.02 + 0.04 * random().x;
        let s = |p: Vec3| (p - centre).dot(normal) + 0.002 * (700.0 * p.x).sin();
        let mut crack = OldCrack {
            settled: 0,
            start: 0,
            origin: centre,
            normal,
            cuts: Vec::new(),
            junctions: Vec::new(),
        };
        for tet in 0..mesh.tets.len() as u32 {
            let values = mesh.corners(tet as usize).map(s);
            let below = values.iter().filter(|s| **s < 0.0).count();
            let near = mesh.centroid(tet as usize).distance(centre) < radius;
            if near && below % 4 != 0 && by[tet as usize] == u32::MAX {
                by[tet as usize] = id;
                // A little off the disc, so that parts of one crack disagree.
                let direction = (normal + 0.3 * (random() - 0.5)).normalize();
                crack.cuts.push(OldCut {
                    tet,
                    values,
                    direction,
                });
            }
        }
        for (from, cut) in (0..).zip(&crack.cuts) {
            let others = mesh.neighbours[cut.tet as usize].into_iter();
            let met = others.filter(|&n| n != NO_NEIGHBOUR && by[n as usize] < id);
            crack.junctions.extend(met.map(|_| (from, false)));
            if from % 7 == 3 {
                crack.junctions.push((from, true));
            }
        }
        if let Some(first) = crack.cuts.first() {
            crack.start = first.tet;
            cracks.push(crack);
        }
    }
    BodyState { cracks }
}

#[test]
fn cracks_end_where_the_plain_flood_ends_them() {
    let asset = block(6);
    let kind = Breakable::of_sound(asset.clone().into());
    let config = FractureConfig::default();
    let (mut added, mut repeated) = (0, 0);
    for seed in 0..12 {
        let mut body = kind.body(1);
        body.set_state(cracked(&asset, seed)).unwrap();
        let system = CrackSystem::new(&body, &config, 0.0);
        let index = &body.prepared.index;
        let fractured = || {
            let (mut cuts, mut known) = Cuts::settled(&system, index);
            cuts.follow(&system, index, &mut known);
            (cuts, known)
        };
        let ((mut cuts, mut known), (mut expected, _)) = (fractured(), fractured());
        let before = cuts.list().len();
        end_cracks(&system, index, &mut cuts, &mut known, &mut Ends::default());
        end_plainly(&system, &mut expected);
        assert_eq!(cuts.list(), expected.list());
        assert_eq!(known.cut_by, index.cut_by(cuts.list()));
        added += cuts.list().len() - before;
        let pairs = system.cracks.iter().flat_map(|c| c.junctions.windows(2));
        repeated += pairs
            .filter(|w| (w[0].from, w[0].own) == (w[1].from, w[1].own))
            .count();
    }
    assert!(added > 100 && repeated > 10, "{added}, {repeated}");
}

#[test]
fn a_cracked_body_as_a_portion_has_the_cuts_that_its_configuration_asks_for() {
    let asset = block(6);
    let kind = Breakable::of_sound(asset.clone().into());
    let (ours, paper) = (FractureConfig::default(), FractureConfig::as_in_the_paper());
    let (mut of_ours, mut of_paper) = (0, 0);
    for seed in 0..12 {
        let mut body = kind.body(1);
        body.set_state(cracked(&asset, seed)).unwrap();
        let cuts = |config| Portion::of_cracked(&body, config).unwrap().cuts().len();
        of_ours += cuts(&ours);
        of_paper += cuts(&paper);
    }
    // The paper's cracks stop at the face of what they meet, so they cut fewer edges.
    assert!(0 < of_paper && of_paper < of_ours, "{of_paper}, {of_ours}");
    let broken = FractureConfig {
        crumb_share: f64::NAN,
        ..ours
    };
    assert!(Portion::of_cracked(&kind.body(1), &broken).is_err());
}
