//! Cut mesh edges: the place of each cut, and the crack that made it `[G12 §6.3]`.

use crate::mesh::ByNode;

/// Cut points stay this far (in edge lengths) from the nodes, so that no triangle has zero area.
const CUT_MARGIN: f64 = 0.02;

/// A cut edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EdgeCut {
    /// Lower node and higher.
    pub(crate) ends: [u32; 2],
    /// Place along the edge, from its lower node (0) to its higher (1).
    pub(crate) at: f64,
    /// Crack that cut it first, or [`FORGOTTEN`](EdgeCut::FORGOTTEN).
    pub(crate) crack: u32,
}

impl EdgeCut {
    /// Mark in place of a crack: one that the piece does not remember.
    pub(crate) const FORGOTTEN: u32 = u32::MAX - 1;
    /// Mark in place of a crack: the edge is whole.
    pub(crate) const WHOLE: u32 = u32::MAX;
}

/// All cut edges.
#[derive(Debug)]
pub(crate) struct Cuts {
    /// Places in the list, by the lower end and the higher.
    places: ByNode<u32>,
    /// Cut edges in the order they were cut.
    list: Vec<EdgeCut>,
    touched: Vec<bool>,
    nodes: Vec<u32>,
}

impl Cuts {
    /// No cut edge.
    pub(crate) fn none(node_count: usize) -> Self {
        Self {
            places: ByNode::new(node_count),
            list: Vec::new(),
            touched: vec![false; node_count],
            nodes: Vec::new(),
        }
    }

    /// Cuts the edge when the crack's values have opposite signs at its ends (zero counts as positive). True when they have.
    #[cfg(test)]
    pub(crate) fn cut(&mut self, a: u32, b: u32, value_a: f32, value_b: f32, crack: u32) -> bool {
        if (value_a < 0.0) == (value_b < 0.0) {
            return false;
        }
        if self.place(a.min(b), a.max(b)).is_none() {
            self.cut_whole(a, b, value_a, value_b, crack);
        }
        true
    }

    /// Cuts an edge that is whole, where the crack's values have opposite signs at its ends.
    pub(crate) fn cut_whole(&mut self, a: u32, b: u32, value_a: f32, value_b: f32, crack: u32) {
        let (low, high, s, t) = if a < b {
            (a, b, value_a, value_b)
        } else {
            (b, a, value_b, value_a)
        };
        let (s, t) = (f64::from(s), f64::from(t));
        let at = (s / (s - t)).clamp(CUT_MARGIN, 1.0 - CUT_MARGIN);
        let ends = [low, high];
        self.add(EdgeCut { ends, at, crack });
    }

    /// Cuts of edges, each of another, its lower node first, at these places along them.
    pub(crate) fn at_places(list: &[([u32; 2], f64)], node_count: usize) -> Self {
        let mut cuts = Self::none(node_count);
        for &(ends, at) in list {
            let at = at.clamp(CUT_MARGIN, 1.0 - CUT_MARGIN);
            cuts.add(EdgeCut { ends, at, crack: 0 });
        }
        cuts
    }

    /// Adds the cut of an edge that has none.
    fn add(&mut self, cut: EdgeCut) {
        let [low, high] = cut.ends;
        self.places.add(low, high);
        self.list.push(cut);
        for end in cut.ends {
            if !std::mem::replace(&mut self.touched[end as usize], true) {
                self.nodes.push(end);
            }
        }
    }

    /// These cuts of edges, each of another.
    pub(crate) fn of_list(list: &[EdgeCut], node_count: usize) -> Self {
        let mut cuts = Self::none(node_count);
        list.iter().for_each(|&cut| cuts.add(cut));
        cuts
    }

    /// The cut of an edge, if any.
    pub(crate) fn get(&self, a: u32, b: u32) -> Option<EdgeCut> {
        Some(self.list[self.place(a.min(b), a.max(b))? as usize])
    }

    /// Place in [`Cuts::list`] of the cut of an edge, its lower node first.
    pub(crate) fn place(&self, low: u32, high: u32) -> Option<u32> {
        if !(self.touched[low as usize] && self.touched[high as usize]) {
            return None;
        }
        self.places.find(low, high)
    }

    /// The cut edges in the order they were cut.
    pub(crate) fn list(&self) -> &[EdgeCut] {
        &self.list
    }

    /// Nodes with a cut edge, in the order they got one.
    pub(crate) fn nodes(&self) -> &[u32] {
        &self.nodes
    }
}
