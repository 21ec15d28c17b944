//! Closest points on a surface, by a bounding volume hierarchy.

use std::ops::Range;

use glam::Vec3;

use super::boxes::{Boxes, WIDE};
use super::closest_on_triangle;

/// Most triangles of a leaf.
const LEAF: usize = WIDE;

/// Halvings from a box to its children: eight of them.
const LEVELS: u32 = WIDE.ilog2();

/// Up to eight children, `first..first + count` of the tree's boxes, or of its triangles.
#[derive(Clone, Copy, Debug)]
struct Node {
    children: Boxes,
    first: u32,
    count: u32,
    is_leaf: bool,
}

/// Bounding volume hierarchy of the triangles of a surface.
#[derive(Clone, Debug, Default)]
pub struct TriangleTree {
    nodes: Vec<Node>,
    order: Vec<u32>,
    /// Corner positions in the tree's order, m.
    corners: Vec<[Vec3; 3]>,
}

/// A point on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Triangle that contains the point.
    pub triangle: u32,
    /// Barycentric coordinates in the triangle.
    pub weights: [f32; 3],
    /// Position, m.
    pub position: Vec3,
}

impl TriangleTree {
    /// Builds the tree of these triangles; every index must refer to a position.
    #[must_use]
    pub fn new(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let corners: Vec<[Vec3; 3]> = triangles
            .iter()
            .map(|t| t.map(|v| positions[v as usize]))
            .collect();
        let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
        let mut halves = Vec::new();
        if !order.is_empty() {
            halve(&corners, &mut order, 0..triangles.len(), &mut halves);
        }
        let mut tree = Self {
            nodes: Vec::with_capacity(triangles.len() / 4),
            corners: order.iter().map(|&t| corners[t as usize]).collect(),
            order,
        };
        if let Some(root) = halves.first() {
            // The root takes the odd levels, so that the boxes below it are full.
            let levels = match depth(triangles.len()) % LEVELS {
                0 => LEVELS,
                odd => odd,
            };
            tree.add(root, &halves, levels);
        }
        tree
    }

    /// Adds a box and all that is in it; children stand side by side.
    fn add(&mut self, root: &Half, halves: &[Half], levels: u32) {
        let mut waiting = vec![(0, *root, levels)];
        self.nodes.push(Node::EMPTY);
        let mut next = 0;
        while let Some(&(at, half, levels)) = waiting.get(next) {
            next += 1;
            if half.second.is_none() {
                self.nodes[at] = self.leaf(&half);
                continue;
            }
            let mut children = Vec::with_capacity(WIDE);
            half.below(halves, levels, &mut children);
            let first = self.nodes.len();
            self.nodes[at] = Node {
                children: Boxes::new(children.iter().map(|c| (c.low, c.high))),
                first: first as u32,
                count: children.len() as u32,
                is_leaf: false,
            };
            self.nodes.resize(first + children.len(), Node::EMPTY);
            let places = (first..).zip(children);
            waiting.extend(places.map(|(at, child)| (at, child, LEVELS)));
        }
    }

    fn leaf(&self, half: &Half) -> Node {
        let triangles = self.corners[half.first..half.first + half.count].iter();
        let boxes = triangles.map(|x| (x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2])));
        Node {
            children: Boxes::new(boxes),
            first: half.first as u32,
            count: half.count as u32,
            is_leaf: true,
        }
    }

    /// Calls `found` for every triangle whose bounding box intersects this box, in the order of the tree.
    pub fn in_box(&self, low: Vec3, high: Vec3, mut found: impl FnMut(u32)) {
        let mut stack = [0_u32; STACK];
        let mut waiting = usize::from(!self.nodes.is_empty());
        while waiting > 0 {
            waiting -= 1;
            let node = &self.nodes[stack[waiting] as usize];
            let meet = node.children.meet(low, high);
            let those_that_meet = node.places().filter(|&k| meet[k]);
            if node.is_leaf {
                for k in those_that_meet {
                    found(self.order[node.first as usize + k]);
                }
            } else {
                for k in those_that_meet.rev() {
                    stack[waiting] = node.first + k as u32;
                    waiting += 1;
                }
            }
        }
    }

    /// Returns the closest point on the surface; of equally close triangles, the one with the lowest number.
    pub fn closest(&self, point: Vec3) -> SurfacePoint {
        let mut best = SurfacePoint {
            triangle: 0,
            weights: [1.0, 0.0, 0.0],
            position: point,
        };
        let mut nearest = f32::INFINITY;
        let mut stack = [(0.0_f32, 0_u32); STACK];
        let mut waiting = usize::from(!self.nodes.is_empty());
        while waiting > 0 {
            waiting -= 1;
            let (gap, at) = stack[waiting];
            if gap > nearest {
                continue;
            }
            let node = &self.nodes[at as usize];
            let gaps = node.children.gaps(point);
            if !node.is_leaf {
                let bottom = waiting;
                for k in node.places().filter(|&k| gaps[k] <= nearest) {
                    // The nearest on top.
                    let mut place = waiting;
                    while place > bottom && stack[place - 1].0 < gaps[k] {
                        stack[place] = stack[place - 1];
                        place -= 1;
                    }
                    stack[place] = (gaps[k], node.first + k as u32);
                    waiting += 1;
                }
                continue;
            }
            for k in node.places() {
                if gaps[k] > nearest {
                    continue;
                }
                let (x, triangle) = {
                    let place = node.first as usize + k;
                    (&self.corners[place], self.order[place])
                };
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

/// Boxes that can wait: seven of each level, and there are no more than 32 / 3 levels.
const STACK: usize = 128;

impl Node {
    const EMPTY: Self = Self {
        children: Boxes::EMPTY,
        first: 0,
        count: 0,
        is_leaf: true,
    };

    /// Places of its children among those side by side.
    fn places(&self) -> Range<usize> {
        0..self.count as usize
    }
}

/// A box halved again and again, `first..first + count` of the tree's triangles.
#[derive(Clone, Copy, Debug)]
struct Half {
    low: Vec3,
    high: Vec3,
    first: usize,
    count: usize,
    /// Place of its second half; the first one follows it.
    second: Option<usize>,
    /// Its own place.
    at: usize,
}

impl Half {
    /// Boxes `levels` levels below, or leaves, in the tree's order.
    fn below(&self, halves: &[Self], levels: u32, found: &mut Vec<Self>) {
        match self.second {
            Some(second) if levels > 0 => {
                halves[self.at + 1].below(halves, levels - 1, found);
                halves[second].below(halves, levels - 1, found);
            }
            _ => found.push(*self),
        }
    }
}

/// Halvings until no part has more triangles than a leaf.
fn depth(count: usize) -> u32 {
    let mut depth = 0;
    let mut largest = count;
    while largest > LEAF {
        largest -= largest / 2;
        depth += 1;
    }
    depth
}

/// Halves triangles along the longest side of their box until none of the parts has more than a leaf.
fn halve(corners: &[[Vec3; 3]], order: &mut [u32], part: Range<usize>, halves: &mut Vec<Half>) {
    let (first, count) = (part.start, part.len());
    let triangles = &mut order[part];
    let points = || triangles.iter().flat_map(|&t| corners[t as usize]);
    let low = points().fold(Vec3::INFINITY, Vec3::min);
    let high = points().fold(Vec3::NEG_INFINITY, Vec3::max);
    let at = halves.len();
    halves.push(Half {
        low,
        high,
        first,
        count,
        second: None,
        at,
    });
    if count <= LEAF {
        return;
    }
    let axis = (high - low).max_position();
    let centre = |t: u32| corners[t as usize].iter().map(|p| p[axis]).sum::<f32>();
    let middle = count / 2;
    triangles.select_nth_unstable_by(middle, |&a, &b| {
        centre(a).total_cmp(&centre(b)).then(a.cmp(&b))
    });
    halve(corners, order, first..first + middle, halves);
    halves[at].second = Some(halves.len());
    halve(corners, order, first + middle..first + count, halves);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::numbers;

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
        let mut numbers = numbers();
        let mut random = || Vec3::from_array(std::array::from_fn(|_| numbers()));
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
