//! A body divided by labels of its nodes: pieces whose borders come from elsewhere than from cracks, such as the cells of a
//! Voronoi diagram.
//!
//! The partition is the one that cracks get `[G12 §6.3]`: nodes of one label that hang together are a piece, an edge between two
//! labels is cut at a place of the caller's, tetrahedra are parted exactly through these places. So the pieces tile the body,
//! and stand beside those of an impact as their equals. Where a cell holds no node of the fracture mesh it leaves no piece.

use frangible::internals::{CutEdge, interfaces_of_labels, pieces_of_cuts};
use frangible::{Body, Fragment};

use super::error::CompareError;

/// A body with a label for each of its nodes, and cut edges between them.
#[derive(Debug)]
pub struct Division<'a> {
    body: &'a Body,
    of_node: Vec<u32>,
    cuts: Vec<CutEdge>,
}

/// Cut between two labels within a tetrahedron.
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
    /// Divides a body with a label for each node of the fracture mesh. `at` gives the place where an edge between two labels is cut, from its lower
    /// node (0) to its higher (1); cuts stay 0.02 away from the ends, so that no triangle has zero area.
    ///
    /// Cracks that the body has already are left out of account.
    ///
    /// # Errors
    /// Not one label per node, a place that is no number, or a piece of a broken body.
    pub fn new(
        body: &'a Body,
        label_of_node: Vec<u32>,
        at: impl Fn(u32, u32) -> f64,
    ) -> Result<Self, CompareError> {
        let asset = body.asset();
        if asset.portion().is_some() {
            return Err(CompareError::Piece(asset.name().to_owned()));
        }
        let nodes = asset.fracture().positions.len();
        if label_of_node.len() != nodes {
            return Err(CompareError::Labels(format!(
                "there are {} labels for the {nodes} nodes of its fracture mesh; give one for each",
                label_of_node.len()
            )));
        }
        let mut parted: Vec<[u32; 2]> = Vec::new();
        for tet in &asset.fracture().tets {
            for i in 0..4 {
                for &b in &tet[i + 1..] {
                    let a = tet[i];
                    if label_of_node[a as usize] != label_of_node[b as usize] {
                        parted.push([a.min(b), a.max(b)]);
                    }
                }
            }
        }
        parted.sort_unstable();
        parted.dedup();
        let mut cuts = Vec::with_capacity(parted.len());
        for [low, high] in parted {
            let place = at(low, high);
            if place.is_nan() {
                return Err(CompareError::Labels(format!(
                    "the position of the cut between the nodes {low} and {high} is not a number"
                )));
            }
            cuts.push(([low, high], place));
        }
        Ok(Self {
            body,
            of_node: label_of_node,
            cuts,
        })
    }

    /// Label of each node.
    #[must_use]
    pub fn labels(&self) -> &[u32] {
        &self.of_node
    }

    /// Cuts between the labels, in ascending order of tetrahedra.
    #[must_use]
    pub fn borders(&self) -> Vec<Border> {
        borders(self.body, self.of_node.clone(), &self.cuts)
    }

    /// Replaces the labels. Labels that get the same one are no longer separated. Within a former label there is no cut, so it cannot be divided in
    /// this way.
    #[must_use]
    pub fn relabelled(mut self, new: impl Fn(u32) -> u32) -> Self {
        self.of_node.iter_mut().for_each(|l| *l = new(*l));
        let of_node = &self.of_node;
        self.cuts
            .retain(|([low, high], _)| of_node[*low as usize] != of_node[*high as usize]);
        self
    }

    /// The pieces, largest first, and the cuts between them, `between` being places in that list. Parts of a label that do not hang together are
    /// pieces of their own; one smaller than `crumb_share` of the body's volume
    /// ([`FractureConfig::crumb_share`](frangible::FractureConfig::crumb_share)) stays with a neighbour.
    #[must_use]
    pub fn pieces(self, crumb_share: f64) -> (Vec<Fragment>, Vec<Border>) {
        let (pieces, of_node) = pieces_of_cuts(self.body, &self.cuts, crumb_share);
        let mut place = vec![0; pieces.len()];
        for (i, (label, _)) in (0..).zip(&pieces) {
            place[*label as usize] = i;
        }
        let mut borders = borders(self.body, of_node, &self.cuts);
        for border in &mut borders {
            let [a, b] = border.between.map(|label| place[label as usize]);
            border.between = [a.min(b), a.max(b)];
        }
        (pieces.into_iter().map(|piece| piece.1).collect(), borders)
    }
}

fn borders(body: &Body, of_node: Vec<u32>, cuts: &[CutEdge]) -> Vec<Border> {
    let found = interfaces_of_labels(body, of_node, cuts).into_iter();
    let border = |(between, tet, area)| Border { between, tet, area };
    found.map(border).collect()
}
