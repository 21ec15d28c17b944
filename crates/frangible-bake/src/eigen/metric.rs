//! The inner product xᵀ B y in which modes are orthonormal, and bases that know their images B x.

use std::borrow::Cow;

use faer::MatRef;
use faer::sparse::SparseColMat;

use crate::eigen::basis::{Block, dot, inner, orthonormalise, subtract};
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
    },
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
        Self::Mass {
            matrix: scaled,
            axes: 3,
        }
    }

    /// B x, column by column.
    pub(crate) fn image<'a>(&self, x: &'a Block) -> Cow<'a, Block> {
        match self {
            Self::Plain => Cow::Borrowed(x),
            Self::Mass { matrix, axes } => {
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
    /// B times the columns; `None` where B = I.
    images: Option<Block>,
}

impl Basis {
    pub(crate) fn columns(&self) -> usize {
        self.vectors.columns()
    }

    fn images(&self) -> &Block {
        self.images.as_ref().unwrap_or(&self.vectors)
    }

    pub(crate) fn into_images(self) -> Block {
        self.images.unwrap_or(self.vectors)
    }

    pub(crate) fn append(&mut self, other: &Self) {
        self.vectors.data.extend_from_slice(&other.vectors.data);
        if let (Some(images), Some(others)) = (&mut self.images, &other.images) {
            images.data.extend_from_slice(&others.data);
        }
    }

    /// w −= v vᵀ B w with the columns `from..to`; gives vᵀ B w.
    pub(crate) fn project_out(&self, w: &mut Block, from: usize, to: usize) -> Block {
        if from == to {
            return Block {
                data: Vec::new(),
                rows: 1,
            };
        }
        let c = inner(self.images().part(from, to), w.view());
        subtract(w, self.vectors.part(from, to), c.view());
        c
    }

    /// The same with all columns.
    pub(crate) fn project_out_all(&self, w: &mut Block) {
        self.project_out(w, 0, self.columns());
    }

    /// Images of all columns.
    pub(crate) fn image_view(&self) -> MatRef<'_, f64> {
        self.images().view()
    }
}
