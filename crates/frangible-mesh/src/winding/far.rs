//! Contribution of a far group of triangles to the winding number: a Taylor expansion with three terms [B18 Eq. 12].
//!
//! The derivatives of −1/r are symmetric and without trace, so of each moment only that part counts: 3 + 5 + 7
//! numbers. With d = centre − p the sum is (N·d + (Q(d) + O(d)/r²)/r²)/r³, Q and O harmonic polynomials.

use std::f64::consts::PI;

use glam::DVec3;

use super::moments::{self, Moments};
use super::packet::{Lanes, Packet, WIDTH};
use super::tree::{Child, Tree};

/// A group is far when its centre is this many of its radii away [B18 §3.3]. At 2 the error reaches 0.011 on a hollow
/// ball, at 2.5 it stays below 0.006 and takes 1.6 times as long, at 3 below 0.004 and 2.2 times.
const ACCURACY: f64 = 2.5;

/// Expansions of a node's four children.
#[derive(Clone, Debug)]
pub(super) struct Far {
    /// Centroids by axis, m.
    centre: [Lanes; 3],
    /// Squared distance beyond which the expansion holds, m².
    beyond: Lanes,
    /// Area vectors N by axis, m².
    dipole: [Lanes; 3],
    /// Factors of x²−z², y²−z², xy, xz, yz in Q, m³.
    quadrupole: [Lanes; 5],
    /// Factors of x(x²−3y²), x(x²−3z²), y(y²−3x²), y(y²−3z²), z(z²−3x²), z(z²−3y²), xyz in O, m⁴.
    octupole: [Lanes; 7],
}

impl Far {
    /// Sum over the children that are far from `p`, and which those are.
    #[inline]
    pub(super) fn sum(&self, p: DVec3) -> (f64, [bool; WIDTH]) {
        let mut values = [0.0; WIDTH];
        let mut far = [false; WIDTH];
        let [n0, n1, n2] = &self.dipole;
        let [q0, q1, q2, q3, q4] = &self.quadrupole;
        let [o0, o1, o2, o3, o4, o5, o6] = &self.octupole;
        for k in 0..WIDTH {
            let x = self.centre[0][k] - p.x;
            let y = self.centre[1][k] - p.y;
            let z = self.centre[2][k] - p.z;
            let (xx, yy, zz) = (x * x, y * y, z * z);
            let rr = xx + yy + zz;
            let inverse = 1.0 / rr;
            let dipole = n0[k] * x + n1[k] * y + n2[k] * z;
            let quadrupole =
                q0[k] * (xx - zz) + q1[k] * (yy - zz) + x * (q2[k] * y + q3[k] * z) + q4[k] * y * z;
            let octupole = x * (o0[k] * (xx - 3.0 * yy) + o1[k] * (xx - 3.0 * zz) + o6[k] * y * z)
                + y * (o2[k] * (yy - 3.0 * xx) + o3[k] * (yy - 3.0 * zz))
                + z * (o4[k] * (zz - 3.0 * xx) + o5[k] * (zz - 3.0 * yy));
            let value =
                inverse * inverse.sqrt() * (dipole + inverse * (quadrupole + inverse * octupole));
            far[k] = rr > self.beyond[k];
            values[k] = if far[k] { value } else { 0.0 };
        }
        ((values[0] + values[1]) + (values[2] + values[3]), far)
    }

    fn set(&mut self, k: usize, moments: &Moments, radius_squared: f64) {
        for axis in 0..3 {
            self.centre[axis][k] = moments.centre[axis];
            self.dipole[axis][k] = moments.zeroth[axis] / (4.0 * PI);
        }
        self.beyond[k] = ACCURACY * ACCURACY * radius_squared;
        for (slot, factor) in quadrupole(moments).into_iter().enumerate() {
            self.quadrupole[slot][k] = factor;
        }
        for (slot, factor) in octupole(moments).into_iter().enumerate() {
            self.octupole[slot][k] = factor;
        }
    }
}

/// −3/4π of the symmetric, trace-free part of ∫n⊗δ.
fn quadrupole(moments: &Moments) -> [f64; 5] {
    let m = &moments.first;
    let third = (m[0][0] + m[1][1] + m[2][2]) / 3.0;
    [
        m[0][0] - third,
        m[1][1] - third,
        m[0][1] + m[1][0],
        m[0][2] + m[2][0],
        m[1][2] + m[2][1],
    ]
    .map(|factor| -3.0 / (4.0 * PI) * factor)
}

/// 15/8π of the symmetric, trace-free part of ∫n⊗δ⊗δ.
fn octupole(moments: &Moments) -> [f64; 7] {
    let [x, y, z] = &moments.second;
    // The cubic Σ∫nᵢδⱼδₖ dᵢdⱼdₖ: for each axis the factors of its cube and of it times the others' squares.
    let rows = [
        [x[0], x[1] + 2.0 * y[3], x[2] + 2.0 * z[4]],
        [y[1], y[0] + 2.0 * x[3], y[2] + 2.0 * z[5]],
        [z[2], z[0] + 2.0 * x[4], z[1] + 2.0 * y[5]],
    ];
    let scale = 15.0 / (8.0 * PI);
    let mut factors = [0.0; 7];
    for (axis, [cube, one, other]) in rows.into_iter().enumerate() {
        // Less r²/10 times its Laplacian, the cubic is harmonic.
        let trace = (6.0 * cube + 2.0 * one + 2.0 * other) / 10.0;
        factors[2 * axis] = scale * (one - trace) / -3.0;
        factors[2 * axis + 1] = scale * (other - trace) / -3.0;
    }
    factors[6] = scale * 2.0 * (x[5] + y[4] + z[3]);
    factors
}

/// Expansions for every node of the tree.
pub(super) fn expand(tree: &Tree) -> Vec<Far> {
    let nothing = Far {
        centre: [[0.0; WIDTH]; 3],
        beyond: [f64::INFINITY; WIDTH],
        dipole: [[0.0; WIDTH]; 3],
        quadrupole: [[0.0; WIDTH]; 5],
        octupole: [[0.0; WIDTH]; 7],
    };
    let mut far = vec![nothing; tree.nodes.len()];
    let mut sums = vec![(Moments::default(), 0..0); tree.nodes.len()];
    for (index, node) in tree.nodes.iter().enumerate().rev() {
        let mut parts = Vec::with_capacity(WIDTH);
        let (mut first, mut end) = (usize::MAX, 0);
        for slot in 0..WIDTH {
            let (part, range) = match node.child(slot) {
                Child::Empty => continue,
                Child::Leaf(p) => (moments::of_packet(&tree.packets[p]), p..p + 1),
                Child::Node(n) => sums[n].clone(),
            };
            (first, end) = (first.min(range.start), end.max(range.end));
            let radius_squared = tree.packets[range]
                .iter()
                .map(|packet| farthest(packet, part.centre))
                .fold(0.0, f64::max);
            far[index].set(slot, &part, radius_squared);
            parts.push(part);
        }
        sums[index] = (moments::join(&parts), first..end);
    }
    far
}

/// Largest squared distance of a packet's corners from `centre`, m².
fn farthest(packet: &Packet, centre: DVec3) -> f64 {
    let mut largest = [0.0; WIDTH];
    for [x, y, z] in &packet.corners {
        for k in 0..WIDTH {
            let (dx, dy, dz) = (x[k] - centre.x, y[k] - centre.y, z[k] - centre.z);
            largest[k] = f64::max(largest[k], dx * dx + dy * dy + dz * dz);
        }
    }
    largest.into_iter().fold(0.0, f64::max)
}
