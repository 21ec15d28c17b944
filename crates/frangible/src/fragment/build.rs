//! Fragments: closed surfaces, masses, shares of the convex cells `[G12 §6.3]`.

use super::draft::{Draft, inner_faces, nodes, outer_faces, partial_cracks};
use super::finish::Finisher;
use super::label::Labels;
use super::points::PointTable;
use super::render::{Parts, Undrawn};
use crate::body::Prepared;
use crate::crack::CrackSystem;
use crate::outcome::Fragment;

/// Builds all fragments, largest first; not drawn yet, where there is something to draw.
pub(crate) fn build(
    system: &CrackSystem,
    labels: &Labels,
    prepared: &Prepared,
) -> (Vec<Fragment>, Option<Undrawn>) {
    let asset = system.asset;
    let mut table = PointTable::new(&asset.fracture, &labels.cuts);
    let mut drafts = vec![Draft::default(); labels.count];
    inner_faces(asset, &prepared.index, labels, &mut table, &mut drafts);
    let mut parts = prepared.render.as_ref().map(|_| Parts::default());
    outer_faces(asset, labels, &mut table, &mut drafts, parts.as_mut());
    nodes(asset, &prepared.index, labels, &mut drafts);
    partial_cracks(system, labels, &mut drafts);
    let faces: Vec<_> = match parts {
        Some(_) => drafts.iter().map(|draft| draft.inner.clone()).collect(),
        None => Vec::new(),
    };
    let mut finisher = Finisher::new(&table, asset.material.density);
    let finished = drafts.into_iter().map(|draft| finisher.finish(draft));
    let mut fragments: Vec<(u32, Fragment)> = (0..).zip(finished).collect();
    // Stable: equal volumes stay in the order of their labels.
    fragments.sort_by(|a, b| b.1.mass.volume.total_cmp(&a.1.mass.volume));
    let (order, fragments): (Vec<u32>, _) = fragments.into_iter().unzip();
    let undrawn = parts.map(|parts| Undrawn {
        parts,
        labels: order,
        faces,
        points: table.into_positions(),
    });
    (fragments, undrawn)
}
