//! Forward and backward substitution with a supernodal Cholesky factor for eight right-hand sides at once.
//!
//! The rows of a supernode are gathered, processed as a dense block and scattered again, in whole rows of right-hand sides.

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::{Accum, Par};

use crate::eigen::panel::{Row, WIDTH, across, across_mut, add_multiple};

/// Replaces the rows of `x`, in the factor's order, by those of (L Lᵀ)⁻¹ x.
pub(crate) fn solve(factor: SupernodalLltRef<'_, usize, f64>, x: &mut [Row]) {
    let count = factor.symbolic().n_supernodes();
    let mut others: Vec<Row> = Vec::new();
    for s in 0..count {
        let node = factor.supernode(s);
        let (start, pattern) = (node.start(), node.pattern());
        let (top, bottom) = node.val().split_at_row(node.val().ncols());
        let own = &mut x[start..start + top.ncols()];
        solve_lower_triangular_in_place(top, across_mut(own).transpose_mut(), Par::Seq);
        others.clear();
        others.resize(pattern.len(), [0.0; WIDTH]);
        matmul(
            across_mut(&mut others),
            Accum::Replace,
            across(own),
            bottom.transpose(),
            1.0,
            Par::Seq,
        );
        for (&row, change) in pattern.iter().zip(&others) {
            add_multiple(&mut x[row], -1.0, change);
        }
    }
    for s in (0..count).rev() {
        let node = factor.supernode(s);
        let (start, pattern) = (node.start(), node.pattern());
        let (top, bottom) = node.val().split_at_row(node.val().ncols());
        others.clear();
        others.extend(pattern.iter().map(|&row| x[row]));
        let own = &mut x[start..start + top.ncols()];
        matmul(
            across_mut(own),
            Accum::Add,
            across(&others),
            bottom,
            -1.0,
            Par::Seq,
        );
        solve_upper_triangular_in_place(top.transpose(), across_mut(own).transpose_mut(), Par::Seq);
    }
}
