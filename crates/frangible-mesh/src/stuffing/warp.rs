//! Cuts of the surface through lattice edges, and warping of lattice vertices onto it.

use glam::DVec3;
use rayon::prelude::*;

use crate::solid::Solid;
use crate::stuffing::lattice::Lattice;

/// A cut nearer to a vertex than this share of a long edge moves the vertex onto it [Labelle & Shewchuk 2007, Table 1].
const LONG: f64 = 0.24999;
/// The share for a short edge. These two give dihedral angles between 10.78° and 164.74°.
const SHORT: f64 = 0.41189;

/// Side of a lattice vertex after warping.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Inside,
    /// On the surface, moved there.
    On,
    Outside,
}

/// Lattice vertices warped, and the cuts that are left.
pub(crate) struct Warped {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) sides: Vec<Side>,
    /// Cut edges (lower vertex, higher vertex), rising.
    pub(crate) edges: Vec<(u32, u32)>,
    /// Position of the cut on each, m.
    pub(crate) cuts: Vec<DVec3>,
}

/// Finds the cuts and warps.
pub(crate) fn warp(solid: &dyn Solid, lattice: &Lattice) -> Warped {
    let edges = crossed_edges(lattice);
    let cuts: Vec<DVec3> = edges
        .par_iter()
        .map(|&(a, b)| {
            let (a, b) = (a as usize, b as usize);
            let (inner, outer) = if lattice.inside[a] { (a, b) } else { (b, a) };
            solid.crossing(lattice.positions[inner], lattice.positions[outer])
        })
        .collect();
    let around = Incidence::new(lattice.positions.len(), &edges);
    // How far each cut is from a vertex, as a share of the distance below which the vertex moves.
    let ratio = |v: u32, edge: u32| {
        let (a, b) = edges[edge as usize];
        let other = if a == v { b } else { a };
        let long = lattice.is_centre[a as usize] == lattice.is_centre[b as usize];
        let length = lattice.positions[v as usize].distance(lattice.positions[other as usize]);
        lattice.positions[v as usize].distance(cuts[edge as usize])
            / (length * if long { LONG } else { SHORT })
    };
    let nearest = |v: u32, alive: &[bool]| {
        around
            .of(v)
            .iter()
            .filter(|e| alive[**e as usize])
            .map(|&e| (ratio(v, e), e))
            .min_by(|x, y| x.0.total_cmp(&y.0))
    };
    let mut alive = vec![true; edges.len()];
    let mut order: Vec<(f64, u32)> = (0..lattice.positions.len() as u32)
        .filter_map(|v| nearest(v, &alive).map(|(r, _)| (r, v)))
        .filter(|x| x.0 < 1.0)
        .collect();
    // The nearest first: its move may leave the others in peace.
    order.sort_unstable_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    let mut positions = lattice.positions.clone();
    let mut sides: Vec<Side> = lattice
        .inside
        .iter()
        .map(|&inside| if inside { Side::Inside } else { Side::Outside })
        .collect();
    for (_, v) in order {
        if let Some((r, e)) = nearest(v, &alive)
            && r < 1.0
        {
            positions[v as usize] = cuts[e as usize];
            sides[v as usize] = Side::On;
            around.of(v).iter().for_each(|&e| alive[e as usize] = false);
        }
    }
    let left = || (0..edges.len()).filter(|&e| alive[e]);
    Warped {
        positions,
        sides,
        edges: left().map(|e| edges[e]).collect(),
        cuts: left().map(|e| cuts[e]).collect(),
    }
}

/// Edges with one end inside, sorted.
fn crossed_edges(lattice: &Lattice) -> Vec<(u32, u32)> {
    let mut edges: Vec<(u32, u32)> = Vec::new();
    for tet in &lattice.tets {
        for i in 0..4 {
            for j in 0..i {
                let (a, b) = (tet[i].min(tet[j]), tet[i].max(tet[j]));
                if lattice.inside[a as usize] != lattice.inside[b as usize] {
                    edges.push((a, b));
                }
            }
        }
    }
    edges.par_sort_unstable();
    edges.dedup();
    edges
}

/// Edges around each vertex.
struct Incidence {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Incidence {
    fn new(vertices: usize, edges: &[(u32, u32)]) -> Self {
        let mut starts = vec![0_u32; vertices + 1];
        for &(a, b) in edges {
            starts[a as usize + 1] += 1;
            starts[b as usize + 1] += 1;
        }
        for v in 0..vertices {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut items = vec![0; 2 * edges.len()];
        for (e, &(a, b)) in edges.iter().enumerate() {
            for v in [a, b] {
                items[next[v as usize] as usize] = e as u32;
                next[v as usize] += 1;
            }
        }
        Self { starts, items }
    }

    fn of(&self, v: u32) -> &[u32] {
        &self.items[self.starts[v as usize] as usize..self.starts[v as usize + 1] as usize]
    }
}
