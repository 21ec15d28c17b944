//! Fragments: closed surfaces, masses, shares of the convex cells `[G12 §6.3]`.

use super::draft::{Draft, inner_faces, nodes, outer_faces, partial_cracks};
use super::draw::Undrawn;
use super::finish::Finisher;
use super::label::Labels;
use super::points::PointTable;
use crate::asset::{Asset, FixedPoints, Trace};
use crate::body::Prepared;
use crate::crack::{Crack, CrackSystem};
use crate::fragment::Fragment;
use crate::mesh::{Division, Parts, Threads};

/// Number of triangles from which on the fragments are finished on several threads. With the gallery's drinking glass, which has fewer, two threads took
/// 44.2 ms for a break in place of 40.8.
const WORTH_THREADS: usize = 100_000;

/// Fragments, and the data about them that later steps need.
pub(crate) struct Built {
    /// Largest first.
    pub(crate) fragments: Vec<Fragment>,
    /// Data for drawing them, where there is something to draw.
    pub(crate) undrawn: Option<Undrawn>,
    /// Origin of each fragment in the body.
    pub(crate) traces: Vec<Trace>,
    /// Points that the pieces' later breaks keep.
    pub(crate) fixed: FixedPoints,
}

/// Builds all fragments. `prepared`: of the body as it was baked.
pub(crate) fn build(system: &CrackSystem, labels: &Labels, prepared: &Prepared) -> Built {
    let threads = &system.config.threads;
    build_cracked(system.asset, &system.cracks, labels, prepared, threads)
}

/// Builds all fragments of a body with these cracks.
pub(crate) fn build_cracked(
    body: &Asset,
    cracks: &[Crack],
    labels: &Labels,
    prepared: &Prepared,
    threads: &Threads,
) -> Built {
    let (asset, portion) = (body.root(), body.portion.as_deref());
    let mut table = PointTable::new(&asset.fracture, &labels.cuts, portion);
    let mut drafts = vec![Draft::default(); labels.count];
    inner_faces(asset, &prepared.index, labels, &mut table, &mut drafts);
    let mut parts = prepared.render.as_ref().map(|_| Parts::default());
    outer_faces(asset, labels, &mut table, &mut drafts, parts.as_mut());
    nodes(asset, &prepared.index, labels, &mut drafts);
    partial_cracks(&asset.fracture, cracks, labels, &mut drafts);
    let faces: Vec<_> = match parts {
        Some(_) => drafts.iter().map(|draft| draft.inner.clone()).collect(),
        None => Vec::new(),
    };
    let triangles = |draft: &Draft| draft.outer.len() + draft.inner.len();
    let alone = Threads::default();
    let threads = match drafts.iter().map(triangles).sum::<usize>() {
        few if few < WORTH_THREADS => &alone,
        _ => threads,
    };
    let numbered: Vec<(u32, Draft)> = (0..).zip(drafts).collect();
    let finisher = || Finisher::new(&table, asset.material.density);
    let mut finished: Vec<(Fragment, Trace)> =
        threads.map(numbered, finisher, |finisher, (label, draft)| {
            finisher.finish(draft, labels, label)
        });
    // Stable: equal volumes stay in the order of their labels.
    finished.sort_by(|a, b| b.0.mass.volume.total_cmp(&a.0.mass.volume));
    let (mut fragments, traces): (Vec<_>, Vec<Trace>) = finished.into_iter().unzip();
    let mut place = vec![Fragment::PARTED; labels.count];
    for (number, trace) in (0..).zip(&traces) {
        place[trace.label as usize] = number;
    }
    for label in fragments.iter_mut().flat_map(|f| &mut f.neighbours) {
        let own = place.get(*label as usize).copied();
        *label = own.unwrap_or(Fragment::PARTED);
    }
    let fixed = table.fixed();
    let undrawn = parts.map(|parts| Undrawn {
        labels: traces.iter().map(|trace| trace.label).collect(),
        division: Division {
            parts,
            nodes: asset.fracture.positions.len(),
            faces,
            points: table.into_positions(),
        },
    });
    Built {
        fragments,
        undrawn,
        traces,
        fixed,
    }
}
