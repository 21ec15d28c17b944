//! The closest point of the surface.

use glam::DVec3;

use super::packet::{Lanes, Packet, WIDTH};
use super::tree::{Child, Node, Tree};

/// The place of a surface closest to some point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Position, m.
    pub position: DVec3,
    /// Distance from the point asked for, m.
    pub distance: f64,
    /// Index of the triangle in the surface; the lowest of those equally close.
    pub face: u32,
    /// Unit normal of that triangle, outwards.
    pub normal: DVec3,
}

/// The best so far: squared distance, triangle, and its packet.
struct Best {
    squared: f64,
    face: u32,
    packet: usize,
}

/// The closest triangle no farther than `within`: its index in the surface and its corners.
pub(super) fn nearest(tree: &Tree, p: DVec3, within: f64) -> Option<(u32, [DVec3; 3])> {
    let mut best = Best {
        squared: (within * within).min(f64::MAX),
        face: u32::MAX,
        packet: 0,
    };
    visit(tree, 0, p, &mut best);
    // Not the lane that was closest: it may be a spare one.
    let packet = tree.packets.get(best.packet)?;
    let lane = packet.faces.iter().position(|&face| face == best.face)?;
    Some((best.face, packet.triangle(lane)))
}

fn visit(tree: &Tree, index: usize, p: DVec3, best: &mut Best) {
    let Some(node) = tree.nodes.get(index) else {
        return;
    };
    let mut keys = order_keys(box_distances(node, p));
    let mut arrange = |i: usize, j: usize| {
        (keys[i], keys[j]) = (keys[i].min(keys[j]), keys[i].max(keys[j]));
    };
    arrange(0, 1);
    arrange(2, 3);
    arrange(0, 2);
    arrange(1, 3);
    arrange(1, 2);
    for key in keys {
        let slot = (key & SLOT) as usize;
        // Not less than: boxes equally far may hold an equally close triangle of lower index.
        if key & !SLOT > best.squared.to_bits() {
            break;
        }
        match node.child(slot) {
            Child::Empty => {}
            Child::Leaf(packet) => {
                let squared = distances_squared(&tree.packets[packet], p);
                for lane in 0..WIDTH {
                    let face = tree.packets[packet].faces[lane];
                    if squared[lane] < best.squared
                        || (squared[lane] == best.squared && face < best.face)
                    {
                        *best = Best {
                            squared: squared[lane],
                            face,
                            packet,
                        };
                    }
                }
            }
            Child::Node(child) => visit(tree, child, p, best),
        }
    }
}

/// The bits of a key that say which child it is.
const SLOT: u64 = 3;

/// Distances as whole numbers that sort like them, rounded down to make room for the slot. Sorting these takes no
/// branch.
#[inline]
fn order_keys(distances: Lanes) -> [u64; WIDTH] {
    std::array::from_fn(|slot| distances[slot].to_bits() & !SLOT | slot as u64)
}

/// Squared distances to the boxes of a node's children, m²; a little less, so that rounding never hides a triangle.
#[inline]
fn box_distances(node: &Node, p: DVec3) -> Lanes {
    let mut squared = [0.0; WIDTH];
    for axis in 0..3 {
        for k in 0..WIDTH {
            let below = node.low[axis][k] - p[axis];
            let above = p[axis] - node.high[axis][k];
            let d = if below > above { below } else { above };
            let d = if d > 0.0 { d } else { 0.0 };
            squared[k] += d * d;
        }
    }
    squared.map(|d| d * (1.0 - 1e-12))
}

/// Squared distances to a packet's triangles, m²: to the plane where the foot lies in the triangle, else to the
/// closest of the three sides.
#[inline]
fn distances_squared(packet: &Packet, p: DVec3) -> Lanes {
    let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = &packet.corners;
    let mut result = [0.0; WIDTH];
    for k in 0..WIDTH {
        let (ux, uy, uz) = (bx[k] - ax[k], by[k] - ay[k], bz[k] - az[k]);
        let (vx, vy, vz) = (cx[k] - ax[k], cy[k] - ay[k], cz[k] - az[k]);
        let (wx, wy, wz) = (cx[k] - bx[k], cy[k] - by[k], cz[k] - bz[k]);
        let (px, py, pz) = (p.x - ax[k], p.y - ay[k], p.z - az[k]);
        let (qx, qy, qz) = (p.x - bx[k], p.y - by[k], p.z - bz[k]);
        let (uu, vv, ww) = (
            ux * ux + uy * uy + uz * uz,
            vx * vx + vy * vy + vz * vz,
            wx * wx + wy * wy + wz * wz,
        );
        let (pu, pv, qw) = (
            px * ux + py * uy + pz * uz,
            px * vx + py * vy + pz * vz,
            qx * wx + qy * wy + qz * wz,
        );
        let along_u = share(pu, uu);
        let along_v = share(pv, vv);
        let along_w = share(qw, ww);
        let length = |x: f64, y: f64, z: f64| x * x + y * y + z * z;
        let to_u = length(px - along_u * ux, py - along_u * uy, pz - along_u * uz);
        let to_v = length(px - along_v * vx, py - along_v * vy, pz - along_v * vz);
        let to_w = length(qx - along_w * wx, qy - along_w * wy, qz - along_w * wz);
        let least = if to_u < to_v { to_u } else { to_v };
        let least = if to_w < least { to_w } else { least };
        let (nx, ny, nz) = (uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
        let uv = ux * vx + uy * vy + uz * vz;
        let second = vv * pu - uv * pv;
        let third = uu * pv - uv * pu;
        let nn = nx * nx + ny * ny + nz * nz;
        let height = px * nx + py * ny + pz * nz;
        let over = (second > 0.0) & (third > 0.0) & (second + third < nn);
        let plane = height * height / nn;
        result[k] = if over & (plane < least) { plane } else { least };
    }
    result
}

/// `part / whole` held to 0..1, and 0 for a side without length.
#[inline]
fn share(part: f64, whole: f64) -> f64 {
    let t = part / whole;
    let t = if t > 0.0 { t } else { 0.0 };
    if t < 1.0 { t } else { 1.0 }
}

/// The point of a triangle closest to `p` [Ericson 2005, §5.1.5].
pub(super) fn closest_on_triangle([a, b, c]: [DVec3; 3], p: DVec3) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let ap = p - a;
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + d1 / (d1 - d3) * ab;
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + d2 / (d2 - d6) * ac;
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return b + t * (c - b);
    }
    let scale = 1.0 / (va + vb + vc);
    a + scale * (vb * ab + vc * ac)
}
