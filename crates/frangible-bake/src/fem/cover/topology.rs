//! Elements of the parts of a body, and the nodes shared by elements.
//!
//! Parts of a cell that are not connected within it get an element each, and elements share a node only where
//! their parts are connected, so that two walls through one cell remain separate.
//! M. Nesme, P. G. Kry, L. Jeřábková, F. Faure, Preserving topology and elasticity for embedded deformable
//! models, SIGGRAPH 2009.

use frangible::glam::DVec3;
use frangible::internals::mesh::DisjointSets;

use crate::fem::cover::cut::{Parts, cut};
use crate::fem::cover::lattice::{Cell, Lattice, Quarters};
use crate::fem::cover::slivers::{Contacts, carriers};
use crate::mesh::BodyMesh;

/// The part of one tetrahedron of the body in one cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fragment {
    pub(crate) cell: Cell,
    /// Volume in cubes.
    pub(crate) volume: f64,
    /// Element that carries it.
    pub(crate) element: u32,
}

/// Fragments of all tetrahedra, and the elements they make.
#[derive(Clone, Debug)]
pub(crate) struct Topology {
    /// Fragments of tetrahedron t: `fragments[starts[t]..starts[t + 1]]`, by rising cell.
    pub(crate) fragments: Vec<Fragment>,
    pub(crate) starts: Vec<usize>,
    /// Cell of each element; copies of a cell follow one another.
    pub(crate) cells: Vec<Cell>,
}

/// Pairs of tetrahedra that share a face.
pub(crate) fn face_pairs(mesh: &BodyMesh) -> Vec<[u32; 2]> {
    let mut faces: Vec<([u32; 3], u32)> = Vec::with_capacity(4 * mesh.tets.len());
    for (t, tet) in mesh.tets.iter().enumerate() {
        for k in 0..4 {
            let mut face = [tet[(k + 1) % 4], tet[(k + 2) % 4], tet[(k + 3) % 4]];
            face.sort_unstable();
            faces.push((face, t as u32));
        }
    }
    faces.sort_unstable();
    faces
        .windows(2)
        .filter(|w| w[0].0 == w[1].0)
        .map(|w| [w[0].1, w[1].1])
        .collect()
}

impl Topology {
    pub(crate) fn new(mesh: &BodyMesh, faces: &[[u32; 2]], lattice: &Lattice) -> Self {
        let (mut fragments, mut starts) = (Vec::new(), vec![0]);
        let mut parts = Parts::default();
        for t in 0..mesh.tets.len() {
            let start = fragments.len();
            let x = mesh.corners(t).map(|p| lattice.in_sides(p));
            cut(x, &mut parts, &mut |cell, _, volume| {
                add_fragment(&mut fragments, start, cell, volume);
            });
            if fragments.len() == start {
                let centroid = x.iter().sum::<DVec3>() / 4.0;
                add_fragment(&mut fragments, start, Cell::at(centroid), 0.0);
            }
            fragments[start..].sort_unstable_by_key(|f| f.cell);
            starts.push(fragments.len());
        }
        let mut topology = Self {
            fragments,
            starts,
            cells: Vec::new(),
        };
        topology.number_components(faces);
        topology.merge_slivers();
        topology
    }

    /// Fragments of a tetrahedron.
    pub(crate) fn of(&self, tet: usize) -> &[Fragment] {
        &self.fragments[self.starts[tet]..self.starts[tet + 1]]
    }

    /// Elements are the components of the fragments under "same cell, and tetrahedra that share a face".
    fn number_components(&mut self, faces: &[[u32; 2]]) {
        let mut sets = DisjointSets::new(self.fragments.len());
        for &[t, u] in faces {
            let (t, u) = (t as usize, u as usize);
            let (mut i, mut j) = (self.starts[t], self.starts[u]);
            while i < self.starts[t + 1] && j < self.starts[u + 1] {
                let (a, b) = (self.fragments[i].cell, self.fragments[j].cell);
                if a == b {
                    sets.join(i as u32, j as u32);
                }
                (i, j) = (i + usize::from(a <= b), j + usize::from(b <= a));
            }
        }
        let roots: Vec<usize> = (0..self.fragments.len())
            .map(|i| sets.find(i as u32) as usize)
            .collect();
        let mut order: Vec<(Cell, usize)> = (0..roots.len())
            .filter(|&i| roots[i] == i)
            .map(|i| (self.fragments[i].cell, i))
            .collect();
        order.sort_unstable();
        let mut number = vec![0; roots.len()];
        for (e, &(_, root)) in order.iter().enumerate() {
            number[root] = e as u32;
        }
        for (fragment, root) in self.fragments.iter_mut().zip(roots) {
            fragment.element = number[root];
        }
        self.cells = order.into_iter().map(|x| x.0).collect();
    }

    /// Hands slivers to the elements next to them.
    fn merge_slivers(&mut self) {
        let mut volumes = vec![0.0; self.cells.len()];
        for f in &self.fragments {
            volumes[f.element as usize] += f.volume;
        }
        let met = (0..self.starts.len() - 1).flat_map(|t| {
            pairs(self.of(t)).map(|(a, b)| {
                let area = libm::cbrt(a.volume.min(b.volume)).powi(2);
                (a.element, b.element, area)
            })
        });
        let host = carriers(&self.cells, &volumes, &Contacts::new(&self.cells, met));
        let kept: Vec<usize> = (0..host.len()).filter(|&c| host[c] as usize == c).collect();
        let mut number = vec![0; host.len()];
        for (new, &old) in kept.iter().enumerate() {
            number[old] = new as u32;
        }
        for f in &mut self.fragments {
            f.element = number[host[f.element as usize] as usize];
        }
        self.cells = kept.into_iter().map(|c| self.cells[c]).collect();
    }

    /// Node numbers of the elements, corners before mid-edges, and where the nodes lie.
    pub(crate) fn nodes(&self, faces: &[[u32; 2]]) -> (Vec<[u32; 10]>, Vec<Quarters>) {
        let mut joined: Vec<(u32, u32)> = Vec::new();
        let mut join = |a: &Fragment, b: &Fragment| {
            if a.element != b.element {
                joined.push((a.element.min(b.element), a.element.max(b.element)));
            }
        };
        for t in 0..self.starts.len() - 1 {
            pairs(self.of(t)).for_each(|(a, b)| join(a, b));
        }
        for &[t, u] in faces {
            for a in self.of(t as usize) {
                self.of(u as usize).iter().for_each(|b| join(a, b));
            }
        }
        joined.sort_unstable();
        joined.dedup();
        let points: Vec<[Quarters; 10]> = self.cells.iter().map(|c| c.nodes()).collect();
        let mut sets = DisjointSets::new(10 * points.len());
        for (a, b) in joined {
            let (a, b) = (a as usize, b as usize);
            for (i, point) in points[a].iter().enumerate() {
                if let Some(j) = points[b].iter().position(|p| p == point) {
                    sets.join((10 * a + i) as u32, (10 * b + j) as u32);
                }
            }
        }
        let mut number = vec![u32::MAX; 10 * points.len()];
        let mut positions = Vec::new();
        for locals in [0..4, 4..10] {
            for (e, points) in points.iter().enumerate() {
                for a in locals.clone() {
                    let root = sets.find((10 * e + a) as u32) as usize;
                    if number[root] == u32::MAX {
                        number[root] = positions.len() as u32;
                        positions.push(points[a]);
                    }
                }
            }
        }
        let elements = (0..points.len())
            .map(|e| std::array::from_fn(|a| number[sets.find((10 * e + a) as u32) as usize]))
            .collect();
        (elements, positions)
    }
}

fn add_fragment(fragments: &mut Vec<Fragment>, start: usize, cell: Cell, volume: f64) {
    match fragments[start..].iter_mut().find(|f| f.cell == cell) {
        Some(fragment) => fragment.volume += volume,
        None => fragments.push(Fragment {
            cell,
            volume,
            element: 0,
        }),
    }
}

fn pairs(fragments: &[Fragment]) -> impl Iterator<Item = (&Fragment, &Fragment)> {
    fragments
        .iter()
        .enumerate()
        .flat_map(move |(i, a)| fragments[..i].iter().map(move |b| (b, a)))
}
