//! Intersections of a segment with the triangles.

use glam::DVec3;

use super::packet::{Packet, WIDTH};
use super::tree::{Child, Node, Tree};

/// Margin beyond its sides in which a triangle still counts as hit, in barycentric coordinates: rather twice than not at all.
const RIM: f64 = 1e-10;

/// A place where a segment meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    /// Parameter along the segment, 0..1.
    pub(super) t: f64,
    /// True if the segment passes from the back of the triangle to its front.
    pub(super) leaves: bool,
    /// Index of the triangle in the surface.
    pub(super) face: u32,
}

/// All hits of the segment, by `t`. A hit of a shared side appears once per triangle.
pub(super) fn hits(tree: &Tree, from: DVec3, to: DVec3) -> Vec<Hit> {
    let along = to - from;
    let mut found = Vec::new();
    // A finite stand-in for 1/0 keeps 0 · ∞ out of the slab test.
    let inverse = along.to_array().map(|d| {
        let inverse = 1.0 / d;
        inverse.clamp(-1e300, 1e300)
    });
    if !tree.nodes.is_empty() {
        visit(tree, 0, from, along, DVec3::from_array(inverse), &mut found);
    }
    found.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.face.cmp(&b.face)));
    found
}

fn visit(
    tree: &Tree,
    index: usize,
    from: DVec3,
    along: DVec3,
    inverse: DVec3,
    found: &mut Vec<Hit>,
) {
    let node = &tree.nodes[index];
    let met = boxes_met(node, from, inverse);
    for slot in 0..WIDTH {
        if met[slot] {
            match node.child(slot) {
                Child::Empty => {}
                Child::Leaf(packet) => triangles_met(&tree.packets[packet], from, along, found),
                Child::Node(child) => visit(tree, child, from, along, inverse, found),
            }
        }
    }
}

#[inline]
fn boxes_met(node: &Node, from: DVec3, inverse: DVec3) -> [bool; WIDTH] {
    let mut start = [0.0; WIDTH];
    let mut end = [1.0; WIDTH];
    for axis in 0..3 {
        for k in 0..WIDTH {
            let one = (node.low[axis][k] - from[axis]) * inverse[axis];
            let other = (node.high[axis][k] - from[axis]) * inverse[axis];
            let (near, far) = if one < other {
                (one, other)
            } else {
                (other, one)
            };
            start[k] = if near > start[k] { near } else { start[k] };
            end[k] = if far < end[k] { far } else { end[k] };
        }
    }
    std::array::from_fn(|k| start[k] <= end[k] + 1e-10)
}

/// [Möller & Trumbore 1997], both faces.
fn triangles_met(packet: &Packet, from: DVec3, along: DVec3, found: &mut Vec<Hit>) {
    for lane in 0..WIDTH {
        let [a, b, c] = packet.triangle(lane);
        let (ab, ac) = (b - a, c - a);
        let across = along.cross(ac);
        let volume = ab.dot(across);
        if volume == 0.0 {
            continue;
        }
        let scale = 1.0 / volume;
        let offset = from - a;
        let second = scale * offset.dot(across);
        let turned = offset.cross(ab);
        let third = scale * along.dot(turned);
        let t = scale * ac.dot(turned);
        if second >= -RIM
            && third >= -RIM
            && second + third <= 1.0 + RIM
            && (0.0..=1.0).contains(&t)
        {
            found.push(Hit {
                t,
                leaves: volume < 0.0,
                face: packet.faces[lane],
            });
        }
    }
}
