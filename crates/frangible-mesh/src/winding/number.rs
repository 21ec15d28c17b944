//! The generalised winding number: exact for near triangles, expanded for far ones.

use std::f64::consts::PI;

use glam::DVec3;

use super::far::Far;
use super::packet::{Packet, WIDTH};
use super::tree::{Child, Tree};

/// Winding number of the surface around `p`.
pub(super) fn winding_number(tree: &Tree, far: &[Far], p: DVec3) -> f64 {
    let mut near = Angle::default();
    let expanded = visit(tree, far, 0, p, &mut near);
    expanded + near.total() / (2.0 * PI)
}

fn visit(tree: &Tree, far: &[Far], index: usize, p: DVec3, near: &mut Angle) -> f64 {
    let (mut sum, is_far) = far[index].sum(p);
    for slot in 0..WIDTH {
        if !is_far[slot] {
            match tree.nodes[index].child(slot) {
                Child::Empty => {}
                Child::Leaf(packet) => near.add(&tree.packets[packet], p),
                Child::Node(node) => sum += visit(tree, far, node, p, near),
            }
        }
    }
    sum
}

/// A sum of angles, kept as a product of complex numbers and the full turns lost in it: one arctangent does for all.
struct Angle {
    re: f64,
    im: f64,
    turns: f64,
}

impl Default for Angle {
    fn default() -> Self {
        Self {
            re: 1.0,
            im: 0.0,
            turns: 0.0,
        }
    }
}

impl Angle {
    /// Adds half the solid angle of each triangle of the packet [van Oosterom & Strackee 1983, Eq. 8].
    #[inline]
    fn add(&mut self, packet: &Packet, p: DVec3) {
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = &packet.corners;
        let mut sines = [0.0; WIDTH];
        let mut cosines = [0.0; WIDTH];
        for k in 0..WIDTH {
            let (ax, ay, az) = (ax[k] - p.x, ay[k] - p.y, az[k] - p.z);
            let (bx, by, bz) = (bx[k] - p.x, by[k] - p.y, bz[k] - p.z);
            let (cx, cy, cz) = (cx[k] - p.x, cy[k] - p.y, cz[k] - p.z);
            let a = (ax * ax + ay * ay + az * az).sqrt();
            let b = (bx * bx + by * by + bz * bz).sqrt();
            let c = (cx * cx + cy * cy + cz * cz).sqrt();
            sines[k] =
                ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
            cosines[k] = a * b * c
                + (ax * bx + ay * by + az * bz) * c
                + (bx * cx + by * cy + bz * cz) * a
                + (cx * ax + cy * ay + cz * az) * b;
        }
        for k in 0..WIDTH {
            self.rotate(cosines[k], sines[k]);
        }
    }

    /// Adds the argument of `cosine + i sine`, between −π and π.
    #[inline]
    fn rotate(&mut self, cosine: f64, sine: f64) {
        if cosine == 0.0 && sine == 0.0 {
            return;
        }
        let re = self.re * cosine - self.im * sine;
        let im = self.re * sine + self.im * cosine;
        if self.im >= 0.0 && sine >= 0.0 && im < 0.0 {
            self.turns += 1.0;
        } else if self.im < 0.0 && sine < 0.0 && im >= 0.0 {
            self.turns -= 1.0;
        }
        let scale = 1.0 / (re.abs() + im.abs());
        (self.re, self.im) = (scale * re, scale * im);
    }

    fn total(&self) -> f64 {
        // Adding zero turns −0 into 0: an argument of π counts as positive, as it does in `rotate`.
        (self.im + 0.0).atan2(self.re) + 2.0 * PI * self.turns
    }
}
