//! One refinement step for modes whose residual is above the rounding limit.
//!
//! An error of a mode along a higher mode j appears in the residual multiplied by λ_j, so that the residual of a stiff body
//! consists mainly of rounding noise. The step x − (A + sB)⁻¹ (A x − λ B x) reduces it by the factor (λ + s) / (λ_j + s).

use faer::sparse::SparseColMat;

use super::basis::Block;
use super::factor::Shifted;
use super::metric::{Basis, Metric};
use super::panel::{Row, WIDTH, add_multiple, panel_of_columns};
use super::residual::add_product;

/// Refines all columns of `vectors` and their eigenvalues; `scaled` is the lower triangle of A. Orthogonality is that of the
/// columns given, but for the noise taken away.
pub(crate) fn refine(
    scaled: &SparseColMat<usize, f64>,
    metric: &Metric,
    rigid: &Basis,
    shifted: &Shifted,
    eigenvalues: &mut [f64],
    vectors: &mut Block,
) {
    let rows = vectors.rows;
    for (group, columns) in vectors.data.chunks_mut(WIDTH * rows).enumerate() {
        let count = columns.len() / rows;
        let values = &mut eigenvalues[group * WIDTH..group * WIDTH + count];
        let mut lambda = [0.0; WIDTH];
        lambda[..count].copy_from_slice(values);
        let mut x = panel_of_columns(columns, rows);
        refine_panel(scaled, metric, rigid, shifted, &mut x, &mut lambda);
        values.copy_from_slice(&lambda[..count]);
        for (l, column) in columns.chunks_exact_mut(rows).enumerate() {
            for (to, row) in column.iter_mut().zip(&x) {
                *to = row[l];
            }
        }
    }
}

/// Refines up to eight vectors, one per lane.
fn refine_panel(
    scaled: &SparseColMat<usize, f64>,
    metric: &Metric,
    rigid: &Basis,
    shifted: &Shifted,
    x: &mut [Row],
    eigenvalues: &mut Row,
) {
    let inertia = |x: &[Row]| metric.panel_image(x).unwrap_or_else(|| x.to_vec());
    let stiffness = |x: &[Row]| {
        let mut image = vec![[0.0; WIDTH]; x.len()];
        add_product(scaled, 1, x, &mut image);
        image
    };
    let mut rest = stiffness(x);
    for (r, b) in rest.iter_mut().zip(inertia(x)) {
        for l in 0..WIDTH {
            r[l] -= eigenvalues[l] * b[l];
        }
    }
    for (x, d) in x.iter_mut().zip(shifted.solve(&rest)) {
        for l in 0..WIDTH {
            x[l] -= d[l];
        }
    }
    // The solution magnifies what noise there is along rigid motions.
    let images = rigid.image_view();
    for r in 0..rigid.columns() {
        let motion = rigid.vectors.column(r);
        let mut share = [0.0; WIDTH];
        for (i, x) in x.iter().enumerate() {
            add_multiple(&mut share, images[(i, r)], x);
        }
        for (x, &m) in x.iter_mut().zip(motion) {
            add_multiple(x, -m, &share);
        }
    }
    let (a, b) = (stiffness(x), inertia(x));
    let dot = |y: &[Row], l: usize| x.iter().zip(y).map(|(x, y)| x[l] * y[l]).sum::<f64>();
    let (energy, mass): (Row, Row) = (
        std::array::from_fn(|l| dot(&a, l)),
        std::array::from_fn(|l| dot(&b, l)),
    );
    for l in (0..WIDTH).filter(|&l| mass[l] > 0.0) {
        eigenvalues[l] = energy[l] / mass[l];
        let scale = mass[l].sqrt().recip();
        x.iter_mut().for_each(|x| x[l] *= scale);
    }
}
