//! Adjacency of a fracture mesh: made once, so that a crack costs only as much as it crosses.
//!
//! It takes about 66 bytes per tetrahedron.

use super::edges::{Edges, higher};
use super::patches::{MOST, Patches};
use crate::asset::Asset;
use crate::mesh::{Rows, TetMesh};
use crate::state::EdgeCut;

/// The body's volume in the unit of [`MeshIndex::volumes`].
const WHOLE: f64 = (1_u64 << 60) as f64;

/// Adjacency, edges, patches and volumes of a fracture mesh, which every break needs.
#[derive(Debug)]
pub(crate) struct MeshIndex {
    /// Tetrahedra around each node.
    pub(crate) tets: Rows,
    /// Nodes joined to each node by an edge.
    pub(crate) neighbours: Rows,
    /// The edges, numbered.
    pub(crate) edges: Edges,
    /// The nodes in patches.
    pub(crate) patches: Patches,
    /// Volume of each node: a quarter of each of its tetrahedra. Whole numbers, of which 2⁶⁰ make about the body: their
    /// sums are exact, so a part's volume is also the whole's less that of the other parts.
    pub(crate) volumes: Vec<u64>,
    /// Sum of all nodes' volumes.
    pub(crate) whole: u64,
    /// Lowest node of each connected part of the mesh; one for a sound body.
    pub(crate) first_nodes: Vec<u32>,
    /// Nodes of each convex cell's tetrahedra.
    pub(crate) nodes_of_cell: Rows,
    /// Sum of the tetrahedra's volumes, m³.
    pub(crate) total_volume: f64,
}

impl MeshIndex {
    pub(crate) fn new(asset: &Asset) -> Self {
        let mesh = &asset.fracture;
        let nodes = mesh.positions.len();
        let tets = Rows::inverse(nodes, &mesh.tets);
        let neighbours = neighbours(mesh, &tets);
        let of_tets: Vec<f64> = (0..mesh.tets.len()).map(|e| mesh.volume(e)).collect();
        let total_volume = of_tets.iter().sum();
        let volumes = volumes(mesh, &of_tets, total_volume);
        Self {
            whole: volumes.iter().sum(),
            volumes,
            first_nodes: first_nodes(&neighbours),
            nodes_of_cell: nodes_of_cell(asset),
            patches: Patches::new(&neighbours, MOST),
            edges: Edges::new(&mesh.tets, &tets, &neighbours),
            tets,
            neighbours,
            total_volume,
        }
    }

    /// This index, with patches of so many nodes at most.
    #[cfg(test)]
    pub(crate) fn with_patches(self, most: usize) -> Self {
        Self {
            patches: Patches::new(&self.neighbours, most),
            ..self
        }
    }

    /// Nodes joined to a node by an edge, rising.
    pub(crate) fn neighbours(&self, node: u32) -> &[u32] {
        self.neighbours.of(node)
    }

    /// Nodes joined to a node by an edge, rising, each with the number of the edge.
    #[inline]
    pub(crate) fn around(&self, node: u32) -> impl Iterator<Item = (u32, u32)> {
        let nodes = self.neighbours.of(node).iter().copied();
        nodes.zip(self.edges.around(node).iter().copied())
    }

    /// Number of the edge between two nodes, the lower one first; none where no edge joins them.
    pub(crate) fn edge(&self, low: u32, high: u32) -> Option<u32> {
        let place = higher(&self.neighbours, low).binary_search(&high).ok()?;
        Some(self.edges.first(low) + place as u32)
    }

    /// The crack that has made each of these cuts, or [`EdgeCut::WHOLE`], by the numbers of the edges.
    pub(crate) fn cut_by(&self, cuts: &[EdgeCut]) -> Vec<u32> {
        let mut cut_by = vec![EdgeCut::WHOLE; self.edges.count()];
        for cut in cuts {
            let [low, high] = cut.ends;
            if let Some(edge) = self.edge(low, high) {
                cut_by[edge as usize] = cut.crack;
            }
        }
        cut_by
    }

    /// Volume of some nodes, in whole numbers of which 2⁶⁰ make about the body.
    pub(crate) fn volume_of(&self, nodes: &[u32]) -> u64 {
        nodes.iter().map(|&v| self.volumes[v as usize]).sum()
    }

    /// Number of nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.volumes.len()
    }
}

/// Filter that passes each number of a list once; what was seen in one list does not count for the next.
struct Once {
    seen: Vec<u32>,
    list: u32,
}

impl Once {
    fn new(count: usize) -> Self {
        Self {
            seen: vec![0; count],
            list: 0,
        }
    }

    fn begin(&mut self) {
        self.list += 1;
    }

    fn is_new(&mut self, number: u32) -> bool {
        std::mem::replace(&mut self.seen[number as usize], self.list) != self.list
    }
}

fn neighbours(mesh: &TetMesh, tets: &Rows) -> Rows {
    let nodes = mesh.positions.len();
    let (mut rows, mut row, mut once) = (Rows::default(), Vec::new(), Once::new(nodes));
    for v in 0..nodes as u32 {
        once.begin();
        once.is_new(v);
        row.clear();
        let around = tets.of(v).iter().flat_map(|&e| mesh.tets[e as usize]);
        row.extend(around.filter(|&w| once.is_new(w)));
        rows.push(&mut row);
    }
    rows.shrunk()
}

fn nodes_of_cell(asset: &Asset) -> Rows {
    let cells: Vec<[u32; 1]> = asset.cell_of_tet.iter().map(|&c| [c]).collect();
    let tets_of_cell = Rows::inverse(asset.cells.len(), &cells);
    let mut once = Once::new(asset.fracture.positions.len());
    let (mut rows, mut row) = (Rows::default(), Vec::new());
    for cell in 0..asset.cells.len() as u32 {
        once.begin();
        row.clear();
        let tets = tets_of_cell.of(cell).iter();
        let nodes = tets.flat_map(|&e| asset.fracture.tets[e as usize]);
        row.extend(nodes.filter(|&v| once.is_new(v)));
        rows.push(&mut row);
    }
    rows.shrunk()
}

fn volumes(mesh: &TetMesh, of_tets: &[f64], total: f64) -> Vec<u64> {
    let mut volumes = vec![0; mesh.positions.len()];
    for (tet, volume) in mesh.tets.iter().zip(of_tets) {
        let quarter = (volume / total * (WHOLE / 4.0)).round() as u64;
        for &v in tet {
            volumes[v as usize] += quarter;
        }
    }
    volumes
}

fn first_nodes(neighbours: &Rows) -> Vec<u32> {
    let mut seen = vec![false; neighbours.count()];
    let (mut first, mut waiting) = (Vec::new(), Vec::new());
    for v in 0..neighbours.count() as u32 {
        if seen[v as usize] {
            continue;
        }
        first.push(v);
        seen[v as usize] = true;
        waiting.push(v);
        while let Some(v) = waiting.pop() {
            for &w in neighbours.of(v) {
                if !std::mem::replace(&mut seen[w as usize], true) {
                    waiting.push(w);
                }
            }
        }
    }
    first
}
