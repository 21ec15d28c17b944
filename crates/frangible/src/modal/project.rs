//! Projection of nodal loads onto the modes; all sums of mode shapes over nodes use these functions.
//!
//! A push p on the node b adds φ_i(b) · p to the modal push of mode i `[G12 §4.2]`.

use std::ops::{AddAssign, Mul, Range};

use glam::Vec3;

use super::ModalBasis;

impl ModalBasis {
    /// Adds φ_i(node) · `push` to the sum of each mode, axis after axis, in the precision of the sums.
    #[inline]
    pub fn add_push<T>(&self, node: usize, push: [T; 3], sums: &mut [T])
    where
        T: Copy + From<f32> + Mul<Output = T> + AddAssign,
    {
        for (row, push) in self.rows(node).into_iter().zip(push) {
            for (sum, &phi) in sums.iter_mut().zip(row) {
                *sum += push * T::from(phi);
            }
        }
    }

    /// Adds φ_i(node) · `push` to the sums of some modes, all axes at once: the sums round otherwise than those of
    /// [`Self::add_push`], and a bound does not mind.
    #[inline]
    pub(crate) fn add_push_to(
        &self,
        modes: Range<usize>,
        node: usize,
        push: Vec3,
        sums: &mut [f32],
    ) {
        let [x, y, z] = self.rows(node).map(|row| &row[modes.clone()]);
        for (((sum, x), y), z) in sums.iter_mut().zip(x).zip(y).zip(z) {
            *sum += push.x * x + push.y * y + push.z * z;
        }
    }

    /// Adds `weight` times φ_i(node) to the shape of each mode.
    #[inline]
    pub fn add_shape(&self, node: usize, weight: f32, shapes: &mut [Vec3]) {
        let [x, y, z] = self.rows(node);
        for (((shape, &x), &y), &z) in shapes.iter_mut().zip(x).zip(y).zip(z) {
            *shape += Vec3::new(x, y, z) * weight;
        }
    }
}
