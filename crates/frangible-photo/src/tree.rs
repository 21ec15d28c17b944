//! Boxes in boxes, to find the faces that a ray may meet.
//!
//! Rapier's tree of boxes does the same; with one face to a leaf and room to change it takes twice the time, and nearly all of a picture's
//! time is spent here.

use frangible_recording::glam::Vec3A;

/// Faces of a leaf, at most.
const LEAF: usize = 4;

/// Slices of a box between which it may be divided.
const SLICES: usize = 12;

/// Boxes in boxes are never so deep: a division leaves at least one face on each side, and halves where it must.
const DEEPEST: usize = 64;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Box3 {
    pub(crate) low: Vec3A,
    pub(crate) high: Vec3A,
}

impl Box3 {
    const EMPTY: Self = Self {
        low: Vec3A::INFINITY,
        high: Vec3A::NEG_INFINITY,
    };

    pub(crate) fn around(points: [Vec3A; 3]) -> Self {
        let [a, b, c] = points;
        Self {
            low: a.min(b).min(c),
            high: a.max(b).max(c),
        }
    }

    fn with(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    fn half_area(self) -> f32 {
        let side = (self.high - self.low).max(Vec3A::ZERO);
        side.x * side.y + side.y * side.z + side.z * side.x
    }

    fn middle(self) -> Vec3A {
        0.5 * (self.low + self.high)
    }
}

#[derive(Clone, Copy)]
struct Node {
    bounds: Box3,
    /// In a leaf, the place of its first face in the order; else the number of the second of its two boxes, of which the first comes next.
    next: u32,
    /// Faces of a leaf, else none.
    faces: u32,
}

/// A tree of boxes over numbered faces.
#[derive(Default)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    /// Numbers of the faces, leaf by leaf.
    order: Vec<u32>,
}

impl Tree {
    /// A tree over faces with these boxes, divided where rays have the least to do (surface area heuristic).
    pub(crate) fn new(boxes: &[Box3]) -> Self {
        let mut tree = Self {
            nodes: Vec::with_capacity(boxes.len()),
            order: (0..boxes.len() as u32).collect(),
        };
        if !boxes.is_empty() {
            tree.divide(boxes, 0, boxes.len(), 0);
        }
        tree
    }

    fn divide(&mut self, boxes: &[Box3], begin: usize, end: usize, depth: usize) {
        let faces = &mut self.order[begin..end];
        let all = |faces: &[u32]| {
            let boxes = faces.iter().map(|&face| boxes[face as usize]);
            boxes.fold(Box3::EMPTY, Box3::with)
        };
        let bounds = all(faces);
        let number = self.nodes.len();
        self.nodes.push(Node {
            bounds,
            next: begin as u32,
            faces: faces.len() as u32,
        });
        if faces.len() <= LEAF {
            return;
        }
        let middle = if depth < DEEPEST / 2 {
            best_division(boxes, faces)
        } else {
            faces.len() / 2
        };
        self.divide(boxes, begin, begin + middle, depth + 1);
        self.nodes[number].next = self.nodes.len() as u32;
        self.nodes[number].faces = 0;
        self.divide(boxes, begin + middle, end, depth + 1);
    }

    /// Calls `ask` for the faces whose boxes a ray meets, near ones first. `ask` takes a face and the distance beyond which nothing counts any more,
    /// and returns the new distance.
    #[inline]
    pub(crate) fn along(
        &self,
        from: Vec3A,
        along: Vec3A,
        mut best: f32,
        mut ask: impl FnMut(u32, f32) -> f32,
    ) {
        if self.nodes.is_empty() {
            return;
        }
        let inverse = along.recip();
        let way = |node: u32| {
            let Box3 { low, high } = self.nodes[node as usize].bounds;
            let (low, high) = ((low - from) * inverse, (high - from) * inverse);
            let near = low.min(high).max_element().max(0.0);
            let far = low.max(high).min_element();
            if far >= near { near } else { f32::INFINITY }
        };
        let mut stack = [(0, 0.0); DEEPEST];
        let mut waiting = 1;
        stack[0] = (0, way(0));
        while waiting > 0 {
            waiting -= 1;
            let (mut number, near) = stack[waiting];
            if near >= best {
                continue;
            }
            loop {
                let node = &self.nodes[number as usize];
                if node.faces > 0 {
                    let first = node.next as usize;
                    for &face in &self.order[first..first + node.faces as usize] {
                        best = ask(face, best);
                    }
                    break;
                }
                let (mut nearer, mut farther) = (number + 1, node.next);
                let (mut near, mut far) = (way(nearer), way(farther));
                if far < near {
                    (nearer, farther) = (farther, nearer);
                    (near, far) = (far, near);
                }
                if far < best {
                    stack[waiting] = (farther, far);
                    waiting += 1;
                }
                if near >= best {
                    break;
                }
                number = nearer;
            }
        }
    }
}

/// Sorts faces into two parts. Returns the number in the first.
fn best_division(boxes: &[Box3], faces: &mut [u32]) -> usize {
    let middle = |face: u32| boxes[face as usize].middle();
    let bounds = faces.iter().fold(Box3::EMPTY, |bounds, &face| {
        let at = middle(face);
        bounds.with(Box3 { low: at, high: at })
    });
    let sides = bounds.high - bounds.low;
    let axis = (0..3)
        .max_by(|&a, &b| sides[a].total_cmp(&sides[b]))
        .unwrap_or(0);
    let half = faces.len() / 2;
    if sides[axis] <= 0.0 {
        return half;
    }
    let scale = SLICES as f32 / sides[axis];
    let slice = |face: u32| {
        let at = (middle(face)[axis] - bounds.low[axis]) * scale;
        (at as usize).min(SLICES - 1)
    };
    let mut slices = [(Box3::EMPTY, 0_usize); SLICES];
    for &face in faces.iter() {
        let (bounds, count) = &mut slices[slice(face)];
        *bounds = bounds.with(boxes[face as usize]);
        *count += 1;
    }
    let cost = |part: &[(Box3, usize)]| {
        let whole = part.iter().fold((Box3::EMPTY, 0), |sum, slice| {
            (sum.0.with(slice.0), sum.1 + slice.1)
        });
        whole.0.half_area() * whole.1 as f32
    };
    let total = |cut: &usize| {
        let (first, second) = slices.split_at(*cut);
        cost(first) + cost(second)
    };
    let cut = (1..SLICES)
        .min_by(|a, b| total(a).total_cmp(&total(b)))
        .unwrap_or(1);
    // Sorted, so that equal faces keep one order.
    faces.sort_by_key(|&face| slice(face) >= cut);
    let first = faces.iter().filter(|&&face| slice(face) < cut).count();
    if first == 0 || first == faces.len() {
        half
    } else {
        first
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn no_box_in_the_way_is_left_out() {
        let mut random = Random::new(1, 2);
        let mut point = || Vec3A::new(random.next(), random.next(), random.next());
        let boxes: Vec<Box3> = (0..300)
            .map(|_| {
                let low = point();
                Box3 {
                    low,
                    high: low + 0.1 * point(),
                }
            })
            .collect();
        let tree = Tree::new(&boxes);
        for _ in 0..200 {
            let from = 3.0 * point() - Vec3A::ONE;
            let along = (point() - from).normalize();
            let meets = |b: &Box3| {
                let (low, high) = ((b.low - from) / along, (b.high - from) / along);
                low.max(high).min_element() >= low.min(high).max_element().max(0.0)
            };
            let mut asked = vec![false; boxes.len()];
            tree.along(from, along, f32::MAX, |face, best| {
                asked[face as usize] = true;
                best
            });
            for (face, bounds) in boxes.iter().enumerate() {
                assert!(asked[face] || !meets(bounds), "box {face}");
            }
        }
    }

    #[test]
    fn faces_in_one_place_are_divided_all_the_same() {
        let one = Box3 {
            low: Vec3A::ZERO,
            high: Vec3A::ONE,
        };
        let tree = Tree::new(&[one; 100]);
        let mut asked = 0;
        tree.along(
            Vec3A::splat(-1.0),
            Vec3A::ONE.normalize(),
            f32::MAX,
            |_, best| {
                asked += 1;
                best
            },
        );
        assert_eq!(asked, 100);
    }
}
