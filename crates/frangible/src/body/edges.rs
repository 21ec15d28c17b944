//! The edges of a mesh, numbered, so that data about edges can lie in a list.

use crate::mesh::{EDGES, Rows};

/// Numbers of edges, by their lower nodes, and then by their higher ones.
#[derive(Debug)]
pub(crate) struct Edges {
    /// For each node the number of the first edge whose lower node it is, and at the end the count of all edges.
    first: Vec<u32>,
    /// Numbers of the edges of each tetrahedron.
    of_tet: Vec<[u32; 6]>,
    /// Numbers of the edges of each node, by their other nodes.
    of_node: Rows,
}

impl Edges {
    /// Numbers the edges of these tetrahedra. `around`: those around each node. `neighbours`: nodes joined to each node, rising.
    pub(super) fn new(tets: &[[u32; 4]], around: &Rows, neighbours: &Rows) -> Self {
        let nodes = neighbours.count();
        let mut first = Vec::with_capacity(nodes + 1);
        let mut of_tet = vec![[0; 6]; tets.len()];
        // Number of the edge from the node at hand to each higher one.
        let mut number_to = vec![0; nodes];
        let mut count = 0;
        for low in 0..nodes as u32 {
            first.push(count);
            for &high in higher(neighbours, low) {
                number_to[high as usize] = count;
                count += 1;
            }
            for &tet in around.of(low) {
                let corners = tets[tet as usize];
                for (number, [i, j]) in of_tet[tet as usize].iter_mut().zip(EDGES) {
                    if corners[i].min(corners[j]) == low {
                        *number = number_to[corners[i].max(corners[j]) as usize];
                    }
                }
            }
        }
        first.push(count);
        let of_node = of_nodes(&first, neighbours);
        Self {
            first,
            of_tet,
            of_node,
        }
    }

    /// Number of edges.
    pub(crate) fn count(&self) -> usize {
        self.first.last().map_or(0, |&count| count as usize)
    }

    /// Numbers of the edges of a tetrahedron.
    #[inline]
    pub(crate) fn of_tet(&self, tet: u32) -> [u32; 6] {
        self.of_tet[tet as usize]
    }

    /// Numbers of the edges of a node, by their other nodes, rising.
    #[inline]
    pub(super) fn around(&self, node: u32) -> &[u32] {
        self.of_node.of(node)
    }

    /// Number of the first edge whose lower node is this one; the others follow, by their higher nodes.
    #[inline]
    pub(super) fn first(&self, low: u32) -> u32 {
        self.first[low as usize]
    }
}

/// Numbers of the edges of each node: those from lower nodes, which rise with these, then its own.
fn of_nodes(first: &[u32], neighbours: &Rows) -> Rows {
    let nodes = neighbours.count() as u32;
    let (mut rows, mut row) = (Rows::default(), Vec::new());
    // Next edge of each lower node: its higher nodes come in order.
    let mut next = first.to_vec();
    for v in 0..nodes {
        row.clear();
        for &w in neighbours.of(v).iter().take_while(|&&w| w < v) {
            row.push(next[w as usize]);
            next[w as usize] += 1;
        }
        row.extend(first[v as usize]..first[v as usize + 1]);
        rows.push(&mut row);
    }
    rows.shrunk()
}

/// The nodes joined to a node that have higher numbers, rising.
pub(super) fn higher(neighbours: &Rows, node: u32) -> &[u32] {
    let all = neighbours.of(node);
    &all[all.partition_point(|&w| w < node)..]
}
