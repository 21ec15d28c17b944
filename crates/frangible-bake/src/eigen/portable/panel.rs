//! Products of panels of eight vectors.

use crate::eigen::panel::{Row, Square, WIDTH, add_multiple};

/// Rows of Vᵀ W that are summed at once.
const HALF: usize = WIDTH / 2;

frangible::widest! {
    /// Vᵀ W.
    pub(crate) fn inner(v: &[Row], w: &[Row]) -> Square {
        let mut out = [[0.0; WIDTH]; WIDTH];
        for (half, out) in out.chunks_exact_mut(HALF).enumerate() {
            let mut sums = [[0.0; WIDTH]; HALF];
            for (v, w) in v.iter().zip(w) {
                for (a, sum) in sums.iter_mut().enumerate() {
                    add_multiple(sum, v[half * HALF + a], w);
                }
            }
            out.copy_from_slice(&sums);
        }
        out
    }

    /// W −= V C.
    pub(crate) fn subtract(w: &mut [Row], v: &[Row], c: &Square) {
        for (w, v) in w.iter_mut().zip(v) {
            let mut sum = [0.0; WIDTH];
            for (factor, c) in v.iter().zip(c) {
                add_multiple(&mut sum, *factor, c);
            }
            add_multiple(w, -1.0, &sum);
        }
    }

    /// W ← W C.
    pub(crate) fn multiply(w: &mut [Row], c: &Square) {
        for w in w {
            let mut sum = [0.0; WIDTH];
            for (factor, c) in w.iter().zip(c) {
                add_multiple(&mut sum, *factor, c);
            }
            *w = sum;
        }
    }
}
