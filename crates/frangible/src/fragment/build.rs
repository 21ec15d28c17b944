//! Fragments: closed surfaces, masses, shares of the convex cells `[G12 §6.3]`.

use glam::DVec3;

use super::draft::{Draft, inner_faces, nodes, outer_faces, partial_cracks};
use super::finish::Finisher;
use super::label::Labels;
use super::points::PointTable;
use super::render::{Parts, Share};
use crate::asset::Asset;
use crate::body::Prepared;
use crate::crack::CrackSystem;
use crate::outcome::Fragment;

/// Builds all fragments, largest first.
pub(crate) fn build(system: &CrackSystem, labels: &Labels, prepared: &Prepared) -> Vec<Fragment> {
    let asset = system.asset;
    let mut table = PointTable::new(&asset.fracture, &labels.cuts);
    let mut drafts = vec![Draft::default(); labels.count];
    inner_faces(asset, &prepared.index, labels, &mut table, &mut drafts);
    let mut parts = prepared.render.as_ref().map(|_| Parts::default());
    outer_faces(asset, labels, &mut table, &mut drafts, parts.as_mut());
    nodes(asset, &prepared.index, labels, &mut drafts);
    partial_cracks(system, labels, &mut drafts);
    let drawn = parts.and_then(|parts| drawn(asset, prepared, &drafts, &table, &parts));
    let faces: Vec<_> = match drawn {
        Some(_) => drafts.iter().map(|draft| draft.inner.clone()).collect(),
        None => Vec::new(),
    };
    let mut finisher = Finisher::new(&table, asset.material.density);
    let mut fragments: Vec<Fragment> = drafts
        .into_iter()
        .map(|draft| finisher.finish(draft))
        .collect();
    if let (Some(drawn), Some(surface), Some(index)) = (drawn, &asset.render, &prepared.render) {
        let mut local = vec![u32::MAX; surface.positions.len()];
        for ((fragment, faces), share) in fragments.iter_mut().zip(&faces).zip(&drawn.shares) {
            let normals = &fragment.mesh.normals[fragment.mesh.outer_triangles..];
            let place = |v: u32| drawn.positions[v as usize - asset.fracture.positions.len()];
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
    table: &PointTable,
    parts: &Parts,
) -> Option<Drawn> {
    let (index, surface) = (prepared.render.as_ref()?, asset.render.as_ref()?);
    let reach = prepared.edge;
    let nodes = asset.fracture.positions.len();
    let mut moved: Vec<DVec3> = (nodes..table.len())
        .map(|v| table.place(v as u32))
        .collect();
    // Rims of crack faces: what they share with the boundary.
    let mut rim: Vec<u32> = drafts
        .iter()
        .flat_map(|draft| draft.outer.iter().flatten().copied())
        .filter(|&v| v as usize >= nodes)
        .collect();
    rim.sort_unstable();
    rim.dedup();
    for v in rim {
        let place = &mut moved[v as usize - nodes];
        *place = index.drawn_to(*place, reach);
    }
    Some(Drawn {
        shares: index.shares(surface, &prepared.surface, parts, drafts.len(), reach),
        positions: moved,
    })
}
