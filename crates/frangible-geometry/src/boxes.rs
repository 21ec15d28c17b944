//! Groups of eight boxes, tested together.

use glam::Vec3;

/// Boxes side by side: loops that a compiler turns into vector instructions.
pub(super) const WIDE: usize = 8;

/// Up to eight boxes, corner by corner; the owner knows their number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Boxes {
    /// x, y, z of the lower corners, m.
    low: [[f32; WIDE]; 3],
    /// x, y, z of the upper corners, m.
    high: [[f32; WIDE]; 3],
}

impl Boxes {
    /// No boxes.
    pub(super) const EMPTY: Self = Self {
        low: [[0.0; WIDE]; 3],
        high: [[0.0; WIDE]; 3],
    };

    /// Packs at most eight boxes; places without a box hold the one around the origin.
    pub(super) fn new(boxes: impl Iterator<Item = (Vec3, Vec3)>) -> Self {
        let mut all = Self::EMPTY;
        for (k, (low, high)) in boxes.enumerate() {
            for axis in 0..3 {
                all.low[axis][k] = low[axis];
                all.high[axis][k] = high[axis];
            }
        }
        all
    }

    /// Squared distance of a point from each box, m², rounded down a little: rounding must not hide a triangle in the box.
    pub(super) fn gaps(&self, point: Vec3) -> [f32; WIDE] {
        let (mut outside, mut from_low) = ([0.0_f32; WIDE], [0.0_f32; WIDE]);
        for axis in 0..3 {
            let (low, high, p) = (&self.low[axis], &self.high[axis], point[axis]);
            for k in 0..WIDE {
                let (below, above) = (low[k] - p, p - high[k]);
                let beyond = if below > above { below } else { above };
                let beyond = if beyond > 0.0 { beyond } else { 0.0 };
                outside[k] += beyond * beyond;
                from_low[k] += below * below;
            }
        }
        std::array::from_fn(|k| outside[k] * (1.0 - 1e-5) - 1e-7 * from_low[k])
    }

    /// Tests which of the boxes meet another box.
    pub(super) fn meet(&self, low: Vec3, high: Vec3) -> [bool; WIDE] {
        let mut meet = [true; WIDE];
        for axis in 0..3 {
            for k in 0..WIDE {
                meet[k] &= self.low[axis][k] <= high[axis] && self.high[axis][k] >= low[axis];
            }
        }
        meet
    }
}
