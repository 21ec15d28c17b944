//! Eigenvalues of symmetric 3 × 3 matrices.

use glam::{DMat3, DVec3};

/// Sweeps after which every matrix has converged: one roughly squares the off-diagonal part, and mostly three suffice.
const SWEEPS: usize = 6;

/// Eigenvalues of a symmetric matrix, in no order, and right-handed unit eigenvectors as columns, by Jacobi rotations. Unlike closed forms they keep
/// all digits where eigenvalues are nearly equal, and unlike absolute tolerances they serve matrices of any size.
#[must_use]
pub fn symmetric_eigen(matrix: DMat3) -> (DVec3, DMat3) {
    let mut a = matrix.to_cols_array_2d();
    let mut v = DMat3::IDENTITY.to_cols_array_2d();
    for _ in 0..SWEEPS {
        let off = a[0][1].powi(2) + a[0][2].powi(2) + a[1][2].powi(2);
        let diagonal = a[0][0].powi(2) + a[1][1].powi(2) + a[2][2].powi(2);
        // Rounding: between equal values it would turn the axes by any angle.
        if off <= 1e-30 * diagonal {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = if theta.is_finite() {
                theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt())
            } else {
                0.0
            };
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            let turned = |x: f64, y: f64| (c * x - s * y, s * x + c * y);
            for row in &mut a {
                (row[p], row[q]) = turned(row[p], row[q]);
            }
            for k in 0..3 {
                (a[p][k], a[q][k]) = turned(a[p][k], a[q][k]);
                (v[p][k], v[q][k]) = turned(v[p][k], v[q][k]);
            }
        }
    }
    let values = DVec3::new(a[0][0], a[1][1], a[2][2]);
    (values, DMat3::from_cols_array_2d(&v))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvalues_and_vectors_rebuild_the_matrix() {
        let r = DMat3::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 1.1);
        for d in [
            DVec3::new(1.0, 2.0, 3.0),
            DVec3::new(1.0, 1.0 + 1e-7, 5.0),
            DVec3::splat(2.0),
        ] {
            // The moments of inertia of a crumb, kg·m².
            let matrix = r * DMat3::from_diagonal(d * 1e-13) * r.transpose();
            let (values, vectors) = symmetric_eigen(matrix);
            let back = vectors * DMat3::from_diagonal(values) * vectors.transpose();
            assert!((vectors.determinant() - 1.0).abs() < 1e-12);
            for k in 0..3 {
                assert!(
                    (back.col(k) - matrix.col(k)).length() < 1e-24,
                    "{back} against {matrix}"
                );
            }
        }
    }
}
