//! The partition by cuts that come from elsewhere than from cracks: with it `frangible_lab::compare` makes other methods' pieces.

use super::build::{Built, build_cracked};
use super::draft::divided_tets;
use super::draw::draw;
use super::label::Labels;
use super::partition::{Interface, interfaces};
use super::points::PointTable;
use crate::body::Body;
use crate::crack::Known;
use crate::fragment::Fragment;
use crate::mesh::Threads;
use crate::state::Cuts;

/// An edge of the fracture mesh, its lower node first, and the place where it is cut, from there (0) to the other node (1).
pub type CutEdge = ([u32; 2], f64);

/// The pieces that cut edges leave of a body as it was baked, largest first, each with the label that its nodes have; and the
/// label of every node. Crumbs stay with a neighbour, as everywhere.
#[must_use]
pub fn pieces_of_cuts(
    body: &Body,
    cuts: &[CutEdge],
    crumb_share: f64,
) -> (Vec<(u32, Fragment)>, Vec<u32>) {
    let (asset, prepared) = (&*body.asset, &*body.prepared);
    let mesh = &asset.fracture;
    let cuts = Cuts::at_places(cuts, mesh.positions.len());
    let known = Known {
        cut_by: prepared.index.cut_by(cuts.list()),
        ..Known::default()
    };
    let mut labels = Labels::new(cuts, known);
    labels.follow(&mesh.tets, &prepared.index, None, crumb_share);
    let Built {
        mut fragments,
        undrawn,
        traces,
        ..
    } = build_cracked(asset, &[], &labels, prepared, &Threads::default());
    if let (Some(surface), Some(undrawn)) = (&asset.render, undrawn) {
        draw(
            surface,
            prepared,
            &mut fragments,
            undrawn,
            &Threads::default(),
        );
    }
    let labelled = traces.iter().map(|t| t.label).zip(fragments).collect();
    (labelled, labels.of_node)
}

/// Interfaces between the labels of a body's nodes, tetrahedra rising: the lower label and the higher, the tetrahedron, and the area of one
/// side of the interface in it, m². `cuts`: all edges between two labels.
#[must_use]
pub fn interfaces_of_labels(
    body: &Body,
    of_node: Vec<u32>,
    cuts: &[CutEdge],
) -> Vec<([u32; 2], u32, f64)> {
    let mesh = &body.asset.fracture;
    let mut labels = Labels::new(Cuts::at_places(cuts, of_node.len()), Known::default());
    labels.count = of_node.iter().max().map_or(0, |&l| l as usize + 1);
    labels.of_node = of_node;
    let mut table = PointTable::new(mesh, &labels.cuts, None);
    let mut found: Vec<([u32; 2], u32, f64)> = Vec::new();
    for tet in divided_tets(&mesh.tets, &body.prepared.index, &labels) {
        let nodes = &mesh.tets[tet as usize];
        let own = nodes.map(|v| labels.of_node[v as usize]);
        let first = found.len();
        interfaces(tet, nodes, &own, |face: Interface| {
            let [a, b, c] = face.points.map(|p| {
                let number = table.number(p);
                table.place(number)
            });
            let area = 0.5 * (b - a).cross(c - a).length();
            let (low, high) = (face.inside.min(face.outside), face.inside.max(face.outside));
            let between = [low, high];
            match found[first..].iter_mut().find(|f| f.0 == between) {
                Some(known) => known.2 += area,
                None => found.push((between, tet, area)),
            }
        });
    }
    found
}
