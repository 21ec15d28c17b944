//! Dense symmetric eigenproblems: small bodies, and the projected matrix of Lanczos.

use faer::diag::DiagMut;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::evd::{
    ComputeEigenvectors, EvdError, self_adjoint_evd, self_adjoint_evd_scratch,
};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::sparse::SparseColMat;
use faer::{Accum, Mat, MatMut, MatRef, Par, Spec};

use crate::eigen::basis::{Block, dot};
use crate::eigen::metric::{Basis, Metric};
use crate::eigen::portable::{self, Sums};
use crate::error::BakeError;

/// Rising eigenvalues of a symmetric matrix, from its lower triangle, on the calling thread alone; its eigenvectors are written
/// into `vectors`.
///
/// The matrix is divided by its largest entry first, since faer 0.24 loses digits on matrices of tiny norm.
pub(crate) fn eigen_into(
    matrix: MatRef<'_, f64>,
    vectors: MatMut<'_, f64>,
) -> Result<Vec<f64>, EvdError> {
    let n = matrix.nrows();
    let entries = (0..n).flat_map(|j| (0..n).map(move |i| matrix[(i, j)].abs()));
    let scale = entries.fold(f64::MIN_POSITIVE, f64::max);
    let scaled = Mat::from_fn(n, n, |i, j| matrix[(i, j)] / scale);
    let mut values = vec![0.0; n];
    let params = Spec::default();
    let mut memory = MemBuffer::new(self_adjoint_evd_scratch::<f64>(
        n,
        ComputeEigenvectors::Yes,
        Par::Seq,
        params,
    ));
    self_adjoint_evd(
        scaled.as_ref(),
        DiagMut::from_slice_mut(&mut values),
        Some(vectors),
        Par::Seq,
        MemStack::new(&mut memory),
        params,
    )?;
    values.iter_mut().for_each(|v| *v *= scale);
    Ok(values)
}

/// All eigenvalues, rising, and eigenvectors of a symmetric matrix (lower triangle used).
pub(crate) fn symmetric_eigen(sums: Sums, matrix: &Block) -> Result<(Vec<f64>, Block), BakeError> {
    if sums == Sums::Portable {
        return portable::symmetric(matrix).ok_or_else(|| BakeError::Factorization {
            reason: "dense eigenvalues: the matrix contains NaN".into(),
        });
    }
    let mut vectors = Block::zeros(matrix.rows, matrix.rows);
    let values =
        eigen_into(matrix.view(), vectors.view_mut()).map_err(|e| BakeError::Factorization {
            reason: format!("dense eigenvalues: {e:?}"),
        })?;
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
    sums: Sums,
) -> Result<(Vec<f64>, Block), BakeError> {
    let n = matrix.ncols();
    let factor = Triangle::new(full_lower(matrix), sums)?;
    let mut unit = Block::zeros(n, n);
    for j in 0..n {
        unit.data[j * n + j] = 1.0;
    }
    let mut inverse = metric.image(&unit).into_owned();
    // B − (B r)(B r)ᵀ: rigid motions r go to zero.
    take_outer(&mut inverse, rigid, sums);
    factor.solve(&mut inverse);
    let mut inverse = Block {
        data: (0..n * n)
            .map(|i| inverse.data[(i % n) * n + i / n])
            .collect(),
        rows: n,
    };
    factor.solve(&mut inverse);
    let (values, vectors) = symmetric_eigen(sums, &inverse)?;
    let mut out = Block::zeros(n, wanted);
    let mut eigenvalues = Vec::with_capacity(wanted);
    for i in 0..wanted {
        let theta = values[n - 1 - i].max(f64::MIN_POSITIVE);
        eigenvalues.push(1.0 / theta - shift);
        for (to, from) in out.column_mut(i).iter_mut().zip(vectors.column(n - 1 - i)) {
            *to = from / theta.sqrt();
        }
    }
    factor.solve_transposed(&mut out);
    Ok((eigenvalues, out))
}

/// A Cholesky factor, and how sums are taken with it.
struct Triangle {
    factor: Block,
    sums: Sums,
}

impl Triangle {
    /// The factor of a matrix, from its lower triangle.
    fn new(mut matrix: Block, sums: Sums) -> Result<Self, BakeError> {
        let n = matrix.rows;
        let refused = |reason: String| BakeError::Factorization { reason };
        if sums == Sums::Portable {
            if !portable::factorise_panel(&mut matrix.data, n, n) {
                return Err(refused("not positive definite".into()));
            }
        } else {
            let params = Spec::default();
            let mut memory = MemBuffer::new(cholesky_in_place_scratch::<f64>(n, Par::Seq, params));
            cholesky_in_place(
                matrix.view_mut(),
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                params,
            )
            .map_err(|e| refused(format!("{e:?}")))?;
        }
        Ok(Self {
            factor: matrix,
            sums,
        })
    }

    /// X ← L⁻¹ X.
    fn solve(&self, x: &mut Block) {
        if self.sums == Sums::Fast {
            return solve_lower_triangular_in_place(self.factor.view(), x.view_mut(), Par::Seq);
        }
        let n = self.factor.rows;
        for x in x.data.chunks_exact_mut(n) {
            for j in 0..n {
                let column = &self.factor.column(j)[j..];
                x[j] /= column[0];
                let solved = x[j];
                for (x, l) in x[j + 1..].iter_mut().zip(&column[1..]) {
                    *x -= solved * l;
                }
            }
        }
    }

    /// X ← L⁻ᵀ X.
    fn solve_transposed(&self, x: &mut Block) {
        if self.sums == Sums::Fast {
            let upper = self.factor.view().transpose();
            return solve_upper_triangular_in_place(upper, x.view_mut(), Par::Seq);
        }
        let n = self.factor.rows;
        for x in x.data.chunks_exact_mut(n) {
            for j in (0..n).rev() {
                let column = &self.factor.column(j)[j..];
                x[j] = (x[j] - dot(&column[1..], &x[j + 1..])) / column[0];
            }
        }
    }
}

/// X −= (B r)(B r)ᵀ.
fn take_outer(x: &mut Block, rigid: &Basis, sums: Sums) {
    let images = rigid.image_view();
    if sums == Sums::Fast {
        let transposed = images.transpose();
        return matmul(x.view_mut(), Accum::Add, images, transposed, -1.0, Par::Seq);
    }
    let n = x.rows;
    for r in 0..rigid.columns() {
        for (j, column) in x.data.chunks_exact_mut(n).enumerate() {
            let factor = images[(j, r)];
            for (i, x) in column.iter_mut().enumerate() {
                *x -= images[(i, r)] * factor;
            }
        }
    }
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
