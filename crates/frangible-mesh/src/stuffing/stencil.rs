//! The part of each lattice tetrahedron that lies inside, as tetrahedra.
//!
//! Every face is cut the same way by the two tetrahedra that share it: a quadrilateral on a face is split by a rule
//! that looks at that face only.

use glam::DVec3;

use crate::stuffing::lattice::Lattice;
use crate::stuffing::warp::{Side, Warped};

/// Tetrahedra of the inside. Vertices: those of the lattice, then one per cut.
pub(crate) struct Cut {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) tets: Vec<[u32; 4]>,
    /// For each vertex, true if it was put on the surface.
    pub(crate) on_surface: Vec<bool>,
}

/// Cuts every lattice tetrahedron.
pub(crate) fn cut(lattice: &Lattice, warped: &Warped) -> Cut {
    let lattice_vertices = warped.positions.len() as u32;
    let mut cutter = Cutter {
        lattice,
        warped,
        positions: warped
            .positions
            .iter()
            .chain(&warped.cuts)
            .copied()
            .collect(),
        tets: Vec::with_capacity(2 * lattice.tets.len()),
    };
    lattice.tets.iter().for_each(|tet| cutter.cut(*tet));
    let on_surface = (0..cutter.positions.len())
        .map(|v| v >= lattice_vertices as usize || warped.sides[v] == Side::On)
        .collect();
    Cut {
        positions: cutter.positions,
        tets: cutter.tets,
        on_surface,
    }
}

struct Cutter<'a> {
    lattice: &'a Lattice,
    warped: &'a Warped,
    positions: Vec<DVec3>,
    tets: Vec<[u32; 4]>,
}

impl Cutter<'_> {
    fn cut(&mut self, tet: [u32; 4]) {
        let mut by_side: [Vec<u32>; 3] = Default::default();
        for v in tet {
            let place = match self.warped.sides[v as usize] {
                Side::Inside => 0,
                Side::On => 1,
                Side::Outside => 2,
            };
            by_side[place].push(v);
        }
        let [inside, on, outside] = &by_side;
        match (&inside[..], &on[..], &outside[..]) {
            ([], ..) => {}
            (_, _, []) => self.push(tet),
            (&[a], [], &[b, c, d]) => {
                let [b, c, d] = [b, c, d].map(|x| self.cut_point(a, x));
                self.push([a, b, c, d]);
            }
            (&[a], &[z], &[c, d]) => {
                let [c, d] = [c, d].map(|x| self.cut_point(a, x));
                self.push([a, z, c, d]);
            }
            (&[a], &[y, z], &[d]) => {
                let d = self.cut_point(a, d);
                self.push([a, y, z, d]);
            }
            (&[a, b], &[z], &[d]) => {
                let (ca, cb) = (self.cut_point(a, d), self.cut_point(b, d));
                let (first, second) = if self.runs_from_first(a, b, d) {
                    ([a, b, cb, z], [a, cb, ca, z])
                } else {
                    ([a, b, ca, z], [b, cb, ca, z])
                };
                self.push(first);
                self.push(second);
            }
            (&[a, b, c], [], &[d]) => {
                let cuts = [a, b, c].map(|x| self.cut_point(x, d));
                let before = [
                    self.runs_from_first(a, b, d),
                    self.runs_from_first(a, c, d),
                    self.runs_from_first(b, c, d),
                ];
                self.prism([a, b, c], cuts, before);
            }
            (&[a, b], [], &[c, d]) => {
                let [ac, ad, bc, bd] =
                    [(a, c), (a, d), (b, c), (b, d)].map(|(x, y)| self.cut_point(x, y));
                let (c_after, d_after) =
                    (self.runs_from_first(a, b, c), self.runs_from_first(a, b, d));
                let last = if c_after == d_after {
                    // Free: the shorter diagonal.
                    let p = |v: u32| self.positions[v as usize];
                    p(ac).distance_squared(p(bd)) <= p(ad).distance_squared(p(bc))
                } else {
                    // c before a before d, or the other way round: a cycle has no tetrahedra.
                    d_after
                };
                self.prism([a, ac, ad], [b, bc, bd], [c_after, d_after, last]);
            }
            // No other split of four vertices is left.
            _ => {}
        }
    }

    /// Splits the prism between triangles `a` and `b` into three. `before` says for the pairs 01, 02, 12 whether the
    /// diagonal runs from the first of `a` to the second of `b`; never a cycle.
    fn prism(&mut self, a: [u32; 3], b: [u32; 3], [b01, b02, b12]: [bool; 3]) {
        let rank = [
            usize::from(!b01) + usize::from(!b02),
            usize::from(b01) + usize::from(!b12),
            usize::from(b02) + usize::from(b12),
        ];
        let mut order = [0, 1, 2];
        order.sort_unstable_by_key(|&i| rank[i]);
        let [x, y, z] = order;
        self.push([a[x], a[y], a[z], b[z]]);
        self.push([a[x], a[y], b[y], b[z]]);
        self.push([a[x], b[x], b[y], b[z]]);
    }

    /// Returns true if the diagonal of the face of `a`, `b` (inside) and `out` runs from `a` to the cut beyond `b`.
    fn runs_from_first(&self, a: u32, b: u32, out: u32) -> bool {
        let centre = |v: u32| self.lattice.is_centre[v as usize];
        match (centre(a) == centre(out), centre(b) == centre(out)) {
            // The cut on the long edge a–out gets the diagonal.
            (true, false) => false,
            (false, true) => true,
            // Both cuts on short edges: the shorter diagonal, which both neighbours see alike.
            _ => {
                let p = |v: u32| self.positions[v as usize];
                let (ca, cb) = (self.cut_point(a, out), self.cut_point(b, out));
                let (first, second) = (p(a).distance_squared(p(cb)), p(b).distance_squared(p(ca)));
                first < second || (first == second && a < b)
            }
        }
    }

    /// Vertex of the cut between two lattice vertices.
    fn cut_point(&self, a: u32, b: u32) -> u32 {
        let key = (a.min(b), a.max(b));
        // Present by construction: an edge from inside to outside keeps its cut.
        let place = self.warped.edges.partition_point(|e| *e < key);
        (self.warped.positions.len() + place) as u32
    }

    fn push(&mut self, mut tet: [u32; 4]) {
        let [a, b, c, d] = tet.map(|v| self.positions[v as usize]);
        if (b - a).cross(c - a).dot(d - a) < 0.0 {
            tet.swap(2, 3);
        }
        self.tets.push(tet);
    }
}
