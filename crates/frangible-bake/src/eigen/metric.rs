//! The inner product xᵀ B y in which modes are orthonormal, and bases that store their images B x.

use std::borrow::Cow;

use faer::MatRef;
use faer::sparse::SparseColMat;

use crate::eigen::basis::{Block, dot, orthonormalise};
use crate::eigen::panel::{Row, WIDTH, add_multiple};
use crate::fem::{Mass, multiply_symmetric};

/// B of the scaled problem A x = λ B x.
pub(crate) enum Metric {
    /// B = I, since the mass is lumped.
    Plain,
    /// Lower triangle of B, unit diagonal, each entry for the diagonal ones of a block of `axes` unknowns: three where
    /// none of a node's is missing.
    Mass {
        matrix: SparseColMat<usize, f64>,
        axes: usize,
        rows: Rows,
    },
}

/// All of a symmetric matrix, row by row: products write each result once.
pub(crate) struct Rows {
    starts: Vec<usize>,
    entries: Vec<(usize, f64)>,
}

impl Rows {
    fn new(lower: &SparseColMat<usize, f64>) -> Self {
        let (pattern, values) = lower.parts();
        let n = pattern.ncols();
        let mut starts = vec![0_usize; n + 1];
        let each = |visit: &mut dyn FnMut(usize, usize, f64)| {
            for j in 0..n {
                for entry in pattern.col_range(j) {
                    visit(pattern.row_idx()[entry], j, values[entry]);
                }
            }
        };
        each(&mut |i, j, _| {
            starts[i + 1] += 1;
            starts[j + 1] += usize::from(i != j);
        });
        for i in 0..n {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut entries = vec![(0, 0.0); starts[n]];
        each(&mut |i, j, value| {
            entries[next[i]] = (j, value);
            next[i] += 1;
            if i != j {
                entries[next[j]] = (i, value);
                next[j] += 1;
            }
        });
        Self { starts, entries }
    }
}

frangible::widest! {
    /// (S ⊗ I) x, where I has `axes` rows.
    fn product(rows: &Rows, axes: usize, x: &[Row]) -> Vec<Row> {
        let mut image = Vec::with_capacity(x.len());
        for range in rows.starts.windows(2) {
            let entries = &rows.entries[range[0]..range[1]];
            for axis in 0..axes {
                let mut sum = [0.0; WIDTH];
                for &(j, value) in entries {
                    add_multiple(&mut sum, value, &x[axes * j + axis]);
                }
                image.push(sum);
            }
        }
        image
    }
}

impl Metric {
    /// B = D M D with D = diag(M)^-½, which is `inverse_root` (three per node).
    pub(crate) fn new(mass: &Mass, inverse_root: &[f64]) -> Self {
        let Mass::Consistent(matrix) = mass else {
            return Self::Plain;
        };
        let mut scaled = matrix.clone();
        let (pattern, values) = scaled.parts_mut();
        for j in 0..pattern.ncols() {
            for entry in pattern.col_range(j) {
                values[entry] *= inverse_root[3 * pattern.row_idx()[entry]] * inverse_root[3 * j];
            }
        }
        Self::of_matrix(scaled, 3)
    }

    /// B by its lower triangle, each entry for the diagonal ones of a block of `axes` unknowns.
    pub(crate) fn of_matrix(matrix: SparseColMat<usize, f64>, axes: usize) -> Self {
        Self::Mass {
            rows: Rows::new(&matrix),
            matrix,
            axes,
        }
    }

    /// B x of a panel; `None` where that is x itself.
    pub(crate) fn panel_image(&self, x: &[Row]) -> Option<Vec<Row>> {
        let Self::Mass { axes, rows, .. } = self else {
            return None;
        };
        Some(product(rows, *axes, x))
    }

    /// B x, column by column.
    pub(crate) fn image<'a>(&self, x: &'a Block) -> Cow<'a, Block> {
        match self {
            Self::Plain => Cow::Borrowed(x),
            Self::Mass { matrix, axes, .. } => {
                let mut image = Block::zeros(x.rows, x.columns());
                for j in 0..x.columns() {
                    multiply_symmetric(matrix, *axes, x.column(j), image.column_mut(j));
                }
                Cow::Owned(image)
            }
        }
    }

    /// Makes the columns of `w` B-orthonormal; gives them as a basis and the triangle R with
    /// w_before = w R. `None` when a column depends on the others.
    pub(crate) fn orthonormalise(&self, mut w: Block) -> Option<(Basis, Block)> {
        match self {
            Self::Plain => {
                let r = orthonormalise(&mut w)?;
                let basis = Basis {
                    vectors: w,
                    images: None,
                };
                Some((basis, r))
            }
            Self::Mass { .. } => {
                let mut images = self.image(&w).into_owned();
                let r = orthonormalise_pair(&mut w, &mut images)?;
                let basis = Basis {
                    vectors: w,
                    images: Some(images),
                };
                Some((basis, r))
            }
        }
    }
}

/// Gram–Schmidt, twice, on columns and their images at once: the images follow linearly.
fn orthonormalise_pair(w: &mut Block, images: &mut Block) -> Option<Block> {
    let (rows, b) = (w.rows, w.columns());
    let mut r = Block::zeros(b, b);
    for j in 0..b {
        let (done, rest) = w.data.split_at_mut(j * rows);
        let (done_images, rest_images) = images.data.split_at_mut(j * rows);
        let (column, image) = (&mut rest[..rows], &mut rest_images[..rows]);
        let before = dot(column, image).max(0.0).sqrt();
        for _ in 0..2 {
            for i in 0..j {
                let range = i * rows..(i + 1) * rows;
                let c = dot(&done_images[range.clone()], column);
                r.data[j * b + i] += c;
                subtract_multiple(column, c, &done[range.clone()]);
                subtract_multiple(image, c, &done_images[range]);
            }
        }
        let after = dot(column, image).max(0.0).sqrt();
        if !(after > 1e-13 * before && after > 0.0) {
            return None;
        }
        r.data[j * b + j] = after;
        column
            .iter_mut()
            .chain(image.iter_mut())
            .for_each(|x| *x /= after);
    }
    Some(r)
}

fn subtract_multiple(from: &mut [f64], factor: f64, what: &[f64]) {
    for (x, y) in from.iter_mut().zip(what) {
        *x -= factor * y;
    }
}

/// B-orthonormal columns.
#[derive(Clone)]
pub(crate) struct Basis {
    /// The columns.
    pub(crate) vectors: Block,
    /// B times the columns; `None` if B = I.
    images: Option<Block>,
}

impl Basis {
    pub(crate) fn columns(&self) -> usize {
        self.vectors.columns()
    }

    fn images(&self) -> &Block {
        self.images.as_ref().unwrap_or(&self.vectors)
    }

    /// Images of all columns.
    pub(crate) fn image_view(&self) -> MatRef<'_, f64> {
        self.images().view()
    }
}
