//! Labels: fragments are the connected components of nodes over uncut edges `[G12 §6.1-6.2]`.

use super::cuts::Cuts;
use super::junction::{NodeTets, end_cracks};
use crate::crack::CrackSystem;
use crate::mesh::{EDGES, TetMesh};

/// A fragment number for every node.
pub(crate) struct Labels {
    /// Fragment of each node, 0 the largest.
    pub(crate) of_node: Vec<u32>,
    /// Number of fragments.
    pub(crate) count: usize,
    /// Cut edges; an edge between two fragments is always one of them.
    pub(crate) cuts: Cuts,
}

/// Cuts, flood fill, crumbs: components smaller than `crumb_share` of the volume join the neighbour they share most with.
pub(crate) fn label(system: &CrackSystem, crumb_share: f64) -> Labels {
    let mesh = &system.asset.fracture;
    let mut cuts = Cuts::of_fractured_elements(system);
    if system.config.ends_inside {
        let tets_of_node = NodeTets::new(mesh.positions.len(), &mesh.tets);
        end_cracks(system, &mut cuts, &tets_of_node);
    }
    let mut sets = DisjointSets::new(mesh.positions.len());
    for tet in &mesh.tets {
        for [i, j] in EDGES {
            if cuts.get(tet[i], tet[j]).is_none() {
                sets.join(tet[i], tet[j]);
            }
        }
    }
    let (of_node, count) = number(&absorb_crumbs(mesh, &mut sets, crumb_share), mesh);
    Labels {
        of_node,
        count,
        cuts,
    }
}

/// Component root of every node after crumbs have joined a neighbour.
fn absorb_crumbs(mesh: &TetMesh, sets: &mut DisjointSets, crumb_share: f64) -> Vec<u32> {
    let nodes = mesh.positions.len();
    let mut root: Vec<u32> = (0..nodes as u32).map(|v| sets.find(v)).collect();
    let volumes = lumped_volumes(mesh);
    let limit = crumb_share * volumes.iter().sum::<f64>();
    // Each pass joins every crumb to its best neighbour; a crumb among crumbs needs several.
    for _ in 0..16 {
        let mut volume = vec![0.0; nodes];
        for (v, &r) in root.iter().enumerate() {
            volume[r as usize] += volumes[v];
        }
        let crumb = |r: u32| volume[r as usize] < limit;
        let mut contacts: Vec<(u32, u32)> = Vec::new();
        for tet in &mesh.tets {
            for [i, j] in EDGES {
                let (a, b) = (root[tet[i] as usize], root[tet[j] as usize]);
                if a != b {
                    if crumb(a) {
                        contacts.push((a, b));
                    }
                    if crumb(b) {
                        contacts.push((b, a));
                    }
                }
            }
        }
        if contacts.is_empty() {
            break;
        }
        contacts.sort_unstable();
        let mut best: Option<(u32, u32, usize)> = None;
        let mut joins = Vec::new();
        for group in contacts.chunk_by(|x, y| x == y) {
            let (a, b) = group[0];
            if best.is_some_and(|(c, ..)| c != a) {
                joins.extend(best.take());
            }
            if best.is_none_or(|(_, _, n)| group.len() > n) {
                best = Some((a, b, group.len()));
            }
        }
        joins.extend(best);
        for (a, b, _) in joins {
            sets.join(a, b);
        }
        for r in &mut root {
            *r = sets.find(*r);
        }
    }
    root
}

/// Numbers the components by falling volume, then by lowest node.
fn number(root: &[u32], mesh: &TetMesh) -> (Vec<u32>, usize) {
    let volumes = lumped_volumes(mesh);
    let mut component = vec![(0.0_f64, u32::MAX); root.len()];
    for (v, &r) in root.iter().enumerate() {
        let c = &mut component[r as usize];
        c.0 += volumes[v];
        c.1 = c.1.min(v as u32);
    }
    let mut order: Vec<u32> = (0..root.len() as u32)
        .filter(|&r| component[r as usize].1 != u32::MAX)
        .collect();
    order.sort_by(|&a, &b| {
        let (x, y) = (component[a as usize], component[b as usize]);
        y.0.total_cmp(&x.0).then(x.1.cmp(&y.1))
    });
    let mut label = vec![0; root.len()];
    for (i, &r) in order.iter().enumerate() {
        label[r as usize] = i as u32;
    }
    (
        root.iter().map(|&r| label[r as usize]).collect(),
        order.len(),
    )
}

/// A quarter of each tetrahedron's volume to each of its nodes, m³.
fn lumped_volumes(mesh: &TetMesh) -> Vec<f64> {
    let mut volumes = vec![0.0; mesh.positions.len()];
    for (e, tet) in mesh.tets.iter().enumerate() {
        let quarter = mesh.volume(e) / 4.0;
        for &v in tet {
            volumes[v as usize] += quarter;
        }
    }
    volumes
}

/// Union-find with path halving; the lower number becomes the root.
struct DisjointSets {
    parent: Vec<u32>,
}

impl DisjointSets {
    fn new(count: usize) -> Self {
        Self {
            parent: (0..count as u32).collect(),
        }
    }

    fn find(&mut self, mut v: u32) -> u32 {
        while self.parent[v as usize] != v {
            let above = self.parent[self.parent[v as usize] as usize];
            self.parent[v as usize] = above;
            v = above;
        }
        v
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}
