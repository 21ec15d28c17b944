//! Principal axes of an inertia, which engines store.

use glam::{DMat3, DVec3};

/// Principal moments and right-handed axes of an inertia, by Jacobi rotations in f64. Engines have closed forms in f32, which lose half the digits
/// where moments are nearly equal, and absolute tolerances, below which the moments of a crumb, 1e-13 kg·m², fall.
#[must_use]
pub fn principal_axes(inertia: DMat3) -> (DVec3, DMat3) {
    let mut a = inertia.to_cols_array_2d();
    let mut v = DMat3::IDENTITY.to_cols_array_2d();
    for _ in 0..32 {
        let off = a[0][1].powi(2) + a[0][2].powi(2) + a[1][2].powi(2);
        let diagonal = a[0][0].powi(2) + a[1][1].powi(2) + a[2][2].powi(2);
        if off <= 1e-30 * diagonal || !off.is_finite() {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + libm::hypot(theta, 1.0));
            let c = 1.0 / libm::hypot(t, 1.0);
            let s = t * c;
            for k in 0..3 {
                let (x, y) = (a[k][p], a[k][q]);
                (a[k][p], a[k][q]) = (c * x - s * y, s * x + c * y);
            }
            for k in 0..3 {
                let (x, y) = (a[p][k], a[q][k]);
                (a[p][k], a[q][k]) = (c * x - s * y, s * x + c * y);
            }
            for k in 0..3 {
                let (x, y) = (v[p][k], v[q][k]);
                (v[p][k], v[q][k]) = (c * x - s * y, s * x + c * y);
            }
        }
    }
    (
        DVec3::new(a[0][0], a[1][1], a[2][2]),
        DMat3::from_cols_array_2d(&v),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_axes_rebuild_the_inertia() {
        let r = DMat3::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 1.1);
        for d in [
            DVec3::new(1.0, 2.0, 3.0),
            DVec3::new(1.0, 1.0 + 1e-7, 5.0),
            DVec3::splat(2.0),
        ] {
            let inertia = r * DMat3::from_diagonal(d * 1e-13) * r.transpose();
            let (moments, axes) = principal_axes(inertia);
            let back = axes * DMat3::from_diagonal(moments) * axes.transpose();
            assert!((axes.determinant() - 1.0).abs() < 1e-12);
            for k in 0..3 {
                assert!(
                    (back.col(k) - inertia.col(k)).length() < 1e-24,
                    "{back} against {inertia}"
                );
            }
        }
    }
}
