//! Closest point of a surface, by a tree of boxes.

use glam::Vec3;

use super::closest_on_triangle;

/// Most triangles of a leaf.
const LEAF: usize = 8;

/// A box: triangles `first..first + count` of the tree's order, or two children, `first` and the box after this one.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: Vec3,
    high: Vec3,
    first: u32,
    /// 0 for a box with children.
    count: u32,
}

/// Boxes over the triangles of a surface.
#[derive(Clone, Debug, Default)]
pub(crate) struct TriangleTree {
    nodes: Vec<Node>,
    order: Vec<u32>,
    /// Corner positions in the tree's order, m.
    corners: Vec<[Vec3; 3]>,
}

/// The point of a surface closest to a given one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SurfacePoint {
    /// Its triangle.
    pub(crate) triangle: u32,
    /// Weights of the triangle's corners.
    pub(crate) weights: [f32; 3],
    /// Where it is, m.
    pub(crate) position: Vec3,
}

impl TriangleTree {
    pub(crate) fn new(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let corners: Vec<[Vec3; 3]> = triangles
            .iter()
            .map(|t| t.map(|v| positions[v as usize]))
            .collect();
        let mut tree = Self {
            nodes: Vec::with_capacity(triangles.len() / 2),
            order: (0..triangles.len() as u32).collect(),
            corners: Vec::new(),
        };
        if !triangles.is_empty() {
            tree.build(&corners, 0, triangles.len());
        }
        tree.corners = tree.order.iter().map(|&t| corners[t as usize]).collect();
        tree
    }

    fn build(&mut self, corners: &[[Vec3; 3]], first: usize, count: usize) {
        let part = &mut self.order[first..first + count];
        let points = || part.iter().flat_map(|&t| corners[t as usize]);
        let low = points().fold(Vec3::INFINITY, Vec3::min);
        let high = points().fold(Vec3::NEG_INFINITY, Vec3::max);
        let node = self.nodes.len();
        self.nodes.push(Node {
            low,
            high,
            first: first as u32,
            count: count as u32,
        });
        if count <= LEAF {
            return;
        }
        let axis = (high - low).max_position();
        let at = |t: u32| corners[t as usize].iter().map(|p| p[axis]).sum::<f32>();
        let middle = count / 2;
        part.select_nth_unstable_by(middle, |&a, &b| at(a).total_cmp(&at(b)).then(a.cmp(&b)));
        self.build(corners, first, middle);
        let second = self.nodes.len() as u32;
        self.build(corners, first + middle, count - middle);
        self.nodes[node].count = 0;
        self.nodes[node].first = second;
    }

    /// Calls for every triangle whose own box meets this one, in the tree's order.
    pub(crate) fn in_box(&self, low: Vec3, high: Vec3, mut found: impl FnMut(u32)) {
        let meets = |l: Vec3, h: Vec3| l.cmple(high).all() && h.cmpge(low).all();
        let mut stack = [0_u32; 64];
        let mut waiting = usize::from(!self.nodes.is_empty());
        while waiting > 0 {
            waiting -= 1;
            let at = stack[waiting];
            let node = &self.nodes[at as usize];
            if !meets(node.low, node.high) {
                continue;
            }
            if node.count == 0 {
                stack[waiting] = node.first;
                stack[waiting + 1] = at + 1;
                waiting += 2;
                continue;
            }
            let leaf = node.first as usize..(node.first + node.count) as usize;
            for (x, &triangle) in self.corners[leaf.clone()].iter().zip(&self.order[leaf]) {
                if meets(x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2])) {
                    found(triangle);
                }
            }
        }
    }

    /// The closest point of the surface; of equally close triangles the one with the lowest number.
    pub(crate) fn closest(&self, point: Vec3) -> SurfacePoint {
        let mut best = SurfacePoint {
            triangle: 0,
            weights: [1.0, 0.0, 0.0],
            position: point,
        };
        let mut nearest = f32::INFINITY;
        // Depth is the logarithm of the number of triangles, at most 32.
        let mut stack = [0_u32; 64];
        let mut waiting = usize::from(!self.nodes.is_empty());
        while waiting > 0 {
            waiting -= 1;
            let at = stack[waiting];
            let node = &self.nodes[at as usize];
            if gap(node.low, node.high, point) > nearest {
                continue;
            }
            if node.count == 0 {
                let (a, b) = (at + 1, node.first);
                let [gap_a, gap_b] = [a, b].map(|child| {
                    let child = &self.nodes[child as usize];
                    gap(child.low, child.high, point)
                });
                let nearer_first = gap_a <= gap_b;
                let (near, far) = if nearer_first { (a, b) } else { (b, a) };
                stack[waiting] = far;
                stack[waiting + 1] = near;
                waiting += 2;
                continue;
            }
            let leaf = node.first as usize..(node.first + node.count) as usize;
            for (x, &triangle) in self.corners[leaf.clone()].iter().zip(&self.order[leaf]) {
                let (low, high) = (x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2]));
                if gap(low, high, point) > nearest {
                    continue;
                }
                let weights =
                    closest_on_triangle(x.map(Vec3::as_dvec3), point.as_dvec3()).map(|w| w as f32);
                let position = x[0] * weights[0] + x[1] * weights[1] + x[2] * weights[2];
                let distance = position.distance_squared(point);
                if distance < nearest || (distance == nearest && triangle < best.triangle) {
                    nearest = distance;
                    best = SurfacePoint {
                        triangle,
                        weights,
                        position,
                    };
                }
            }
        }
        best
    }
}

/// Squared distance of a point from a box, m², a little less than it is: rounding must not hide a triangle.
fn gap(low: Vec3, high: Vec3, point: Vec3) -> f32 {
    let outside = (low - point).max(point - high).max(Vec3::ZERO);
    outside.length_squared() * (1.0 - 1e-5) - 1e-7 * (point - low).length_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Purpose, stream, uniform};

    fn brute_force(corners: &[[Vec3; 3]], point: Vec3) -> (f32, usize) {
        let mut best = (f32::INFINITY, 0);
        for (i, x) in corners.iter().enumerate() {
            let w = closest_on_triangle(x.map(Vec3::as_dvec3), point.as_dvec3()).map(|w| w as f32);
            let distance = (x[0] * w[0] + x[1] * w[1] + x[2] * w[2]).distance_squared(point);
            if distance < best.0 {
                best = (distance, i);
            }
        }
        best
    }

    #[test]
    fn the_tree_finds_what_looking_at_all_triangles_finds() {
        let mut rng = stream(1, Purpose::WeakPoints, 0);
        let mut random = || Vec3::from_array(std::array::from_fn(|_| uniform(&mut rng) as f32));
        for count in [1, 2, 9, 300] {
            // Flat in z, so that many are equally far; shared corners, as in a mesh.
            let positions: Vec<Vec3> = (0..count + 2)
                .map(|_| random() * Vec3::new(1.0, 1.0, 0.0))
                .collect();
            let triangles: Vec<[u32; 3]> = (0..count as u32).map(|i| [i, i + 1, i + 2]).collect();
            let corners: Vec<_> = triangles
                .iter()
                .map(|t| t.map(|v| positions[v as usize]))
                .collect();
            let tree = TriangleTree::new(&positions, &triangles);
            for k in 0..200 {
                let point = if k % 3 == 0 {
                    positions[k % (count + 2)]
                } else {
                    random() * 2.0 - 0.5
                };
                let found = tree.closest(point);
                let (distance, triangle) = brute_force(&corners, point);
                assert_eq!(found.triangle as usize, triangle);
                assert_eq!(found.position.distance_squared(point), distance);
                let (low, high) = (point - 0.05, point + 0.05);
                let mut met = Vec::new();
                tree.in_box(low, high, |t| met.push(t));
                met.sort_unstable();
                let expected: Vec<u32> = (0..count as u32)
                    .filter(|&t| {
                        let [a, b, c] = corners[t as usize];
                        a.min(b).min(c).cmple(high).all() && a.max(b).max(c).cmpge(low).all()
                    })
                    .collect();
                assert_eq!(met, expected);
            }
        }
    }
}
