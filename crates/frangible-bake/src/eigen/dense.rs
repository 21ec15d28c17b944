//! Dense symmetric eigenproblems: small bodies, and the projected matrix of Lanczos.

use faer::diag::DiagMut;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::sparse::SparseColMat;
use faer::{Accum, Par, Spec};

use crate::eigen::basis::Block;
use crate::eigen::metric::{Basis, Metric};
use crate::error::BakeError;

/// All eigenvalues, rising, and eigenvectors of a symmetric matrix (lower triangle used).
///
/// Divides by the largest entry first: faer 0.24 loses digits on matrices of tiny norm.
pub(crate) fn symmetric_eigen(matrix: &Block) -> Result<(Vec<f64>, Block), BakeError> {
    let n = matrix.rows;
    let scale = matrix
        .data
        .iter()
        .fold(0.0_f64, |m, x| m.max(x.abs()))
        .max(f64::MIN_POSITIVE);
    let scaled = Block {
        data: matrix.data.iter().map(|x| x / scale).collect(),
        rows: n,
    };
    let mut values = vec![0.0; n];
    let mut vectors = Block::zeros(n, n);
    let params = Spec::default();
    let mut memory = MemBuffer::new(self_adjoint_evd_scratch::<f64>(
        n,
        ComputeEigenvectors::Yes,
        Par::Seq,
        params,
    ));
    self_adjoint_evd(
        scaled.view(),
        DiagMut::from_slice_mut(&mut values),
        Some(vectors.view_mut()),
        Par::Seq,
        MemStack::new(&mut memory),
        params,
    )
    .map_err(|e| BakeError::Factorization {
        reason: format!("dense eigenvalues: {e:?}"),
    })?;
    values.iter_mut().for_each(|v| *v *= scale);
    Ok((values, vectors))
}

/// The `wanted` lowest elastic modes of A x = λ B x, from the lower triangle of A + sB = L Lᵀ: eigenvalues of
/// L⁻¹ B L⁻ᵀ are 1/(λ + s). B may be nearly singular.
pub(crate) fn solve_shifted(
    matrix: &SparseColMat<usize, f64>,
    shift: f64,
    metric: &Metric,
    rigid: &Basis,
    wanted: usize,
) -> Result<(Vec<f64>, Block), BakeError> {
    let n = matrix.ncols();
    let mut factor = full_lower(matrix);
    let params = Spec::default();
    let mut memory = MemBuffer::new(cholesky_in_place_scratch::<f64>(n, Par::Seq, params));
    cholesky_in_place(
        factor.view_mut(),
        LltRegularization::default(),
        Par::Seq,
        MemStack::new(&mut memory),
        params,
    )
    .map_err(|e| BakeError::Factorization {
        reason: format!("{e:?}"),
    })?;
    let mut unit = Block::zeros(n, n);
    for j in 0..n {
        unit.data[j * n + j] = 1.0;
    }
    let mut inverse = metric.image(&unit).into_owned();
    // B − (B r)(B r)ᵀ: rigid motions r go to zero.
    let images = rigid.image_view();
    matmul(
        inverse.view_mut(),
        Accum::Add,
        images,
        images.transpose(),
        -1.0,
        Par::Seq,
    );
    solve_lower_triangular_in_place(factor.view(), inverse.view_mut(), Par::Seq);
    let mut inverse = Block {
        data: (0..n * n)
            .map(|i| inverse.data[(i % n) * n + i / n])
            .collect(),
        rows: n,
    };
    solve_lower_triangular_in_place(factor.view(), inverse.view_mut(), Par::Seq);
    let (values, vectors) = symmetric_eigen(&inverse)?;
    let mut out = Block::zeros(n, wanted);
    let mut eigenvalues = Vec::with_capacity(wanted);
    for i in 0..wanted {
        let theta = values[n - 1 - i].max(f64::MIN_POSITIVE);
        eigenvalues.push(1.0 / theta - shift);
        for (to, from) in out.column_mut(i).iter_mut().zip(vectors.column(n - 1 - i)) {
            *to = from / theta.sqrt();
        }
    }
    solve_upper_triangular_in_place(factor.view().transpose(), out.view_mut(), Par::Seq);
    Ok((eigenvalues, out))
}

/// A sparse lower triangle as a dense one.
fn full_lower(sparse: &SparseColMat<usize, f64>) -> Block {
    let n = sparse.ncols();
    let mut matrix = Block::zeros(n, n);
    for j in 0..n {
        let a = sparse.as_ref();
        for (&i, &value) in a.symbolic().row_idx()[a.symbolic().col_range(j)]
            .iter()
            .zip(a.val_of_col(j))
        {
            matrix.data[j * n + i] += value;
        }
    }
    matrix
}
