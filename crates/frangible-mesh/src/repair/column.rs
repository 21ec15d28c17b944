//! Shells above a point: winding numbers by vertical rays.

use glam::DVec3;

/// Triangles in a leaf.
const LEAF: usize = 8;

struct Node {
    low: [f64; 2],
    high: [f64; 3],
    /// Range in the order; of inner nodes the first child follows, the second is named here.
    range: (u32, u32),
    second: u32,
}

/// A tree of boxes in plan over the triangles of closed shells.
pub(crate) struct Columns<'a> {
    positions: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    shell_of: &'a [u32],
    order: Vec<u32>,
    nodes: Vec<Node>,
}

impl<'a> Columns<'a> {
    /// Over the triangles named in `order`.
    pub(crate) fn new(
        positions: &'a [DVec3],
        triangles: &'a [[u32; 3]],
        shell_of: &'a [u32],
        order: Vec<u32>,
    ) -> Self {
        let mut columns = Self {
            positions,
            triangles,
            shell_of,
            order,
            nodes: Vec::new(),
        };
        columns.build(0, columns.order.len());
        columns
    }

    fn corners(&self, t: u32) -> [DVec3; 3] {
        self.triangles[t as usize].map(|v| self.positions[v as usize])
    }

    fn build(&mut self, start: usize, end: usize) -> u32 {
        let mut low = DVec3::INFINITY;
        let mut high = DVec3::NEG_INFINITY;
        for &t in &self.order[start..end] {
            for p in self.corners(t) {
                low = low.min(p);
                high = high.max(p);
            }
        }
        let index = self.nodes.len();
        self.nodes.push(Node {
            low: [low.x, low.y],
            high: high.to_array(),
            range: (start as u32, end as u32),
            second: 0,
        });
        if end - start > LEAF {
            let axis = usize::from(high.y - low.y > high.x - low.x);
            let (positions, triangles) = (self.positions, self.triangles);
            let place = |t: u32| {
                triangles[t as usize]
                    .iter()
                    .map(|&v| positions[v as usize][axis])
                    .sum::<f64>()
            };
            let middle = (end - start) / 2;
            self.order[start..end].select_nth_unstable_by(middle, |&a, &b| {
                place(a).total_cmp(&place(b)).then(a.cmp(&b))
            });
            self.build(start, start + middle);
            self.nodes[index].second = self.build(start + middle, end);
        }
        index as u32
    }

    /// The shells around `p` with how often they wind around it, by shell.
    pub(crate) fn around(&self, p: DVec3) -> Vec<(u32, i32)> {
        let mut crossings: Vec<(u32, i32)> = Vec::new();
        let mut open = vec![0_u32];
        while let Some(index) = open.pop() {
            let Some(node) = self.nodes.get(index as usize) else {
                continue;
            };
            let is_off =
                p.x < node.low[0] || p.x > node.high[0] || p.y < node.low[1] || p.y > node.high[1];
            if is_off || p.z > node.high[2] {
                continue;
            }
            if node.second != 0 {
                open.extend([index + 1, node.second]);
                continue;
            }
            for &t in &self.order[node.range.0 as usize..node.range.1 as usize] {
                let crossing = self.crossing(t, p);
                if crossing != 0 {
                    crossings.push((self.shell_of[t as usize], crossing));
                }
            }
        }
        crossings.sort_unstable();
        let sums = crossings
            .chunk_by(|a, b| a.0 == b.0)
            .map(|same| (same[0].0, same.iter().map(|c| c.1).sum()));
        sums.filter(|&(_, sum)| sum != 0).collect()
    }

    /// Sign of the triangle's crossing with the ray that rises from `p`: each ray through an edge or a corner crosses
    /// exactly one of the triangles there.
    fn crossing(&self, t: u32, p: DVec3) -> i32 {
        let vertices = self.triangles[t as usize];
        let mut winding = 0;
        for k in 0..3 {
            let (from, to) = (vertices[k], vertices[(k + 1) % 3]);
            let (a, b) = (self.positions[from as usize], self.positions[to as usize]);
            if (a.y <= p.y) == (b.y <= p.y) {
                continue;
            }
            // Both triangles of an edge compute the same number, so that rounding cannot part them.
            let (l, h) = if from < to { (a, b) } else { (b, a) };
            let left = (h.x - l.x) * (p.y - l.y) - (h.y - l.y) * (p.x - l.x);
            let rises = b.y > a.y;
            let low_rises = h.y > l.y;
            if (left > 0.0) == low_rises && left != 0.0 {
                winding += if rises { 1 } else { -1 };
            }
        }
        if winding == 0 {
            return 0;
        }
        let [a, b, c] = self.corners(t);
        let normal = (b - a).cross(c - a);
        let above = (a - p).dot(normal) / normal.z;
        if above > 0.0 { winding } else { 0 }
    }
}
