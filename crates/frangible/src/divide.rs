//! A body divided by labels of its nodes: pieces whose borders come from elsewhere than from cracks, such as the cells of a
//! Voronoi diagram.
//!
//! The partition is the one that cracks get `[G12 §6.3]`: nodes of one label that hang together are a piece, an edge between two
//! labels is cut at a place of the caller's, tetrahedra are parted exactly through these places. So the pieces tile the body,
//! and stand beside those of an impact as their equals. Where a cell holds no node of the fracture mesh it leaves no piece.

use crate::body::Body;
use crate::error::InputError;
use crate::fragment::{
    self, Built, Cuts, Interface, Labels, PointTable, build_cracked, divided_tets, interfaces,
    of_cuts,
};
use crate::outcome::Fragment;

/// A body with a label for each of its nodes, and cut edges between them.
#[derive(Debug)]
pub struct Division<'a> {
    body: &'a Body,
    labels: Labels,
}

/// What parts two labels within a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Border {
    /// The lower label and the higher.
    pub between: [u32; 2],
    /// The fracture tetrahedron.
    pub tet: u32,
    /// One side of it, m².
    pub area: f64,
}

impl<'a> Division<'a> {
    /// With a label for each node of the fracture mesh. `at` gives the place where an edge between two labels is cut, from
    /// its lower node (0) to its higher (1); cuts stay 0.02 away from the ends, so that no triangle has zero area.
    ///
    /// Cracks that the body has already are left out of account.
    ///
    /// # Errors
    /// Not one label per node, a place that is no number, or a piece of a broken body.
    pub fn new(
        body: &'a Body,
        label_of_node: Vec<u32>,
        at: impl Fn(u32, u32) -> f64,
    ) -> Result<Self, InputError> {
        let asset = &*body.asset;
        if asset.portion.is_some() {
            return Err(InputError::Labels(
                "it is a piece of a broken one; divide the body as it was baked".into(),
            ));
        }
        let nodes = asset.fracture.positions.len();
        if label_of_node.len() != nodes {
            return Err(InputError::Labels(format!(
                "there are {} labels for the {nodes} nodes of its fracture mesh; give one for each",
                label_of_node.len()
            )));
        }
        let mut cuts = Cuts::none(nodes);
        for low in 0..nodes as u32 {
            for &high in body.prepared.index.neighbours(low) {
                if high < low || label_of_node[low as usize] == label_of_node[high as usize] {
                    continue;
                }
                let place = at(low, high);
                if place.is_nan() {
                    return Err(InputError::Labels(format!(
                        "the place of its cut between the nodes {low} and {high} is no number"
                    )));
                }
                cuts.cut_at([low, high], place);
            }
        }
        Ok(Self {
            body,
            labels: labels(label_of_node, cuts),
        })
    }

    /// Label of each node.
    #[must_use]
    pub fn labels(&self) -> &[u32] {
        &self.labels.of_node
    }

    /// What parts the labels, tetrahedra rising.
    #[must_use]
    pub fn borders(&self) -> Vec<Border> {
        borders(self.body, &self.labels)
    }

    /// With other labels in place of these: labels that get the same one are no longer parted. Where two labels were one there is
    /// no cut, so they cannot be parted in this way.
    #[must_use]
    pub fn relabelled(self, new: impl Fn(u32) -> u32) -> Self {
        let of_node: Vec<u32> = self.labels.of_node.iter().map(|&l| new(l)).collect();
        let parts = |ends: [u32; 2]| of_node[ends[0] as usize] != of_node[ends[1] as usize];
        let kept = self.labels.cuts.list().iter().copied();
        let kept: Vec<_> = kept.filter(|cut| parts(cut.ends)).collect();
        let cuts = Cuts::of_list(&kept, of_node.len());
        Self {
            labels: labels(of_node, cuts),
            ..self
        }
    }

    /// The pieces, largest first, and what parts them, `between` being places in that list. Parts of a label that do not hang
    /// together are pieces of their own; what is smaller than `crumb_share` of the body's volume
    /// ([`FractureConfig::crumb_share`](crate::FractureConfig::crumb_share)) stays with a neighbour.
    #[must_use]
    pub fn pieces(self, crumb_share: f64) -> (Vec<Fragment>, Vec<Border>) {
        let (asset, prepared) = (&*self.body.asset, &*self.body.prepared);
        let (tets, index) = (&asset.fracture.tets, &prepared.index);
        let labels = of_cuts(self.labels.cuts, tets, index, None, crumb_share);
        let Built {
            mut fragments,
            undrawn,
            traces,
            ..
        } = build_cracked(asset, &[], &labels, prepared);
        if let (Some(surface), Some(undrawn)) = (&asset.render, undrawn) {
            fragment::draw(surface, &asset.fracture, prepared, &mut fragments, undrawn);
        }
        let mut place = vec![0; labels.count];
        for (i, trace) in (0..).zip(&traces) {
            place[trace.label as usize] = i;
        }
        let mut borders = borders(self.body, &labels);
        for border in &mut borders {
            let [a, b] = border.between.map(|label| place[label as usize]);
            border.between = [a.min(b), a.max(b)];
        }
        (fragments, borders)
    }
}

fn labels(of_node: Vec<u32>, cuts: Cuts) -> Labels {
    Labels {
        count: of_node.iter().max().map_or(0, |&l| l as usize + 1),
        of_node,
        cuts,
    }
}

/// What parts these labels.
fn borders(body: &Body, labels: &Labels) -> Vec<Border> {
    let (asset, prepared) = (&*body.asset, &*body.prepared);
    let mesh = &asset.fracture;
    let mut table = PointTable::new(mesh, &labels.cuts, None);
    let mut borders: Vec<Border> = Vec::new();
    for tet in divided_tets(&mesh.tets, &prepared.index, labels) {
        let nodes = &mesh.tets[tet as usize];
        let own = nodes.map(|v| labels.of_node[v as usize]);
        let first = borders.len();
        interfaces(tet, nodes, &own, |face: Interface| {
            let [a, b, c] = face.points.map(|p| {
                let number = table.number(p);
                table.place(number)
            });
            let area = 0.5 * (b - a).cross(c - a).length();
            let (low, high) = (face.inside.min(face.outside), face.inside.max(face.outside));
            let between = [low, high];
            match borders[first..].iter_mut().find(|b| b.between == between) {
                Some(border) => border.area += area,
                None => borders.push(Border { between, tet, area }),
            }
        });
    }
    borders
}
