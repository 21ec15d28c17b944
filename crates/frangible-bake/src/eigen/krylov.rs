//! B-orthonormal panels: the rigid motions, then the Lanczos blocks.

use crate::eigen::basis::Block;
use crate::eigen::dense::symmetric_eigen;
use crate::eigen::factor::Shifted;
use crate::eigen::metric::{Basis, Metric};
use crate::eigen::panel::{
    Row, Square, WIDTH, cholesky, inner, multiply, panel_of_columns, product, subtract,
};
use crate::eigen::portable::Sums;
use crate::eigen::watch::Watch;
use crate::error::BakeError;
use crate::phase::Phase;
use crate::random;

/// Share of a column's size below which its part beside the other columns asks for a second pass: each digit lost here is one
/// lost by orthogonality.
const LITTLE: f64 = 1e-3;

/// A panel and B times it; nothing where that is the panel itself.
pub(crate) struct Pair {
    pub(crate) vectors: Vec<Row>,
    images: Option<Vec<Row>>,
}

impl Pair {
    pub(crate) fn images(&self) -> &[Row] {
        self.images.as_deref().unwrap_or(&self.vectors)
    }
}

/// A basis that grows.
pub(crate) struct Krylov<'a> {
    metric: &'a Metric,
    /// The rigid motions, if any, padded with zeros.
    rigid: Vec<Pair>,
    pub(crate) blocks: Vec<Pair>,
    /// Method of summation.
    pub(crate) sums: Sums,
}

impl<'a> Krylov<'a> {
    pub(crate) fn new(metric: &'a Metric, rigid: &Basis, sums: Sums) -> Self {
        let mut pairs = Vec::new();
        if rigid.columns() > 0 {
            let vectors = panel_of_columns(&rigid.vectors.data, rigid.vectors.rows);
            let images = metric.panel_image(&vectors);
            pairs.push(Pair { vectors, images });
        }
        Self {
            metric,
            rigid: pairs,
            blocks: Vec::new(),
            sums,
        }
    }

    fn image(&self, w: &[Row], watch: &mut Watch<'_>) -> Option<Vec<Row>> {
        watch.time(Phase::Mass, || self.metric.panel_image(w))
    }

    /// w −= V Vᵀ B w with all panels.
    fn project_out_all(&self, w: &mut [Row]) {
        for pair in self.rigid.iter().chain(&self.blocks) {
            let c = inner(self.sums, pair.images(), w);
            subtract(self.sums, w, &pair.vectors, &c);
        }
    }

    /// Makes `w` orthogonal to all panels and its columns B-orthonormal; gives the triangle R with w_before = w R + V ….
    /// `None` when a column depends on the others.
    pub(crate) fn orthonormalise(
        &self,
        mut w: Vec<Row>,
        watch: &mut Watch<'_>,
    ) -> Option<(Pair, Square)> {
        let mut triangle = None;
        // At most three: the second pass is rare, the third never seen.
        for _ in 0..3 {
            watch.time(Phase::Orthogonalisation, || self.project_out_all(&mut w));
            let mut images = self.image(&w, watch);
            let (again, r) = watch.time(Phase::Orthogonalisation, || {
                let mut once = |w: &mut Vec<Row>| {
                    let gram = inner(self.sums, images.as_deref().unwrap_or(w), w);
                    let (r, inverse, least) = cholesky(&gram)?;
                    multiply(self.sums, w, &inverse);
                    if let Some(images) = &mut images {
                        multiply(self.sums, images, &inverse);
                    }
                    Some((r, least))
                };
                let (first, least) = once(&mut w)?;
                let (second, _) = once(&mut w)?;
                Some((least < LITTLE, product(&second, &first)))
            })?;
            let r = match &triangle {
                Some(before) => product(&r, before),
                None => r,
            };
            if !again {
                return Some((Pair { vectors: w, images }, r));
            }
            triangle = Some(r);
        }
        None
    }

    /// A first block: random numbers.
    pub(crate) fn start(&self, rows: usize, watch: &mut Watch<'_>) -> Option<Pair> {
        let entry = |i: usize| random::symmetric(1, i as u64);
        let w = (0..rows).map(|i| std::array::from_fn(|l| entry(l * rows + i)));
        Some(self.orthonormalise(w.collect(), watch)?.0)
    }

    /// About the lowest elastic eigenvalue, 1/s², from above: two inverse iterations of a block.
    pub(crate) fn lowest_guess(
        &self,
        shifted: &Shifted,
        watch: &mut Watch<'_>,
    ) -> Result<Option<f64>, BakeError> {
        let rows = shifted.rows();
        let Some(mut block) = self.start(rows, watch) else {
            return Ok(None);
        };
        let mut theta = None;
        for _ in 0..2 {
            watch.tell(0.05)?;
            let w = watch.time(Phase::Solves, || shifted.solve(block.images()));
            let projected = Block {
                data: inner(self.sums, block.images(), &w).concat(),
                rows: WIDTH,
            };
            theta = symmetric_eigen(self.sums, &projected)?.0.last().copied();
            match self.orthonormalise(w, watch) {
                Some((next, _)) => block = next,
                None => break,
            }
        }
        Ok(theta
            .filter(|theta| *theta > 0.0)
            .map(|theta| 1.0 / theta - shifted.shift))
    }

    /// The combinations `coefficients` (one column each, an entry per vector of the blocks) plus those of one more
    /// panel, as columns.
    pub(crate) fn combine(&self, coefficients: &Block, last: &Pair, tail: &Block) -> Block {
        /// Rows at a time, so that the basis is read from memory once.
        const PART: usize = 128;
        let rows = last.vectors.len();
        let wanted = coefficients.columns();
        let mut out = Block::zeros(rows, wanted);
        let groups: Vec<Vec<Square>> = (0..wanted)
            .step_by(WIDTH)
            .map(|from| {
                let square = |block: &Block, first: usize| -> Square {
                    std::array::from_fn(|a| {
                        std::array::from_fn(|l| match from + l < wanted {
                            // `subtract` takes the negative.
                            true => -block.column(from + l)[first + a],
                            false => 0.0,
                        })
                    })
                };
                let mut squares: Vec<Square> = (0..self.blocks.len())
                    .map(|b| square(coefficients, b * WIDTH))
                    .collect();
                squares.push(square(tail, 0));
                squares
            })
            .collect();
        let mut part = Vec::new();
        for start in (0..rows).step_by(PART) {
            let end = (start + PART).min(rows);
            for (group, squares) in groups.iter().enumerate() {
                part.clear();
                part.resize(end - start, [0.0; WIDTH]);
                for (pair, square) in self.blocks.iter().chain([last]).zip(squares) {
                    subtract(self.sums, &mut part, &pair.vectors[start..end], square);
                }
                let from = group * WIDTH;
                for (l, column) in (from..(from + WIDTH).min(wanted)).enumerate() {
                    let to = &mut out.column_mut(column)[start..end];
                    to.iter_mut().zip(&part).for_each(|(x, row)| *x = row[l]);
                }
            }
        }
        out
    }
}
