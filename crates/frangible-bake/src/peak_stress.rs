//! Largest stress of each mode: what lets a harmless contact be refused without a look at the mesh.

use frangible::Asset;
use frangible::asset::{AnalysisMesh, EmbeddedPoint};
use frangible::glam::DVec3;
use frangible::modal::ModalBasis;

use crate::fem::{Elasticity, shape_gradients};

/// The asset with the peak stress of its modes found anew, as the bake does: for one whose mode shapes were rounded.
#[must_use]
pub fn restressed(mut asset: Asset) -> Asset {
    let elasticity = Elasticity::from(&asset.material);
    asset.modes.peak_stress = peak_stress(
        &asset.analysis,
        &asset.embedding.tets,
        &asset.modes,
        &elasticity,
    );
    asset
}

/// Largest spectral norm of each mode's linear stress σ = λ tr(ε) I + 2μ ε over the given points,
/// Pa per unit amplitude (m·√kg).
pub(crate) fn peak_stress(
    mesh: &AnalysisMesh,
    points: &[EmbeddedPoint],
    modes: &ModalBasis,
    material: &Elasticity,
) -> Vec<f32> {
    let m = modes.count();
    let (lambda, mu) = material.lame();
    let mut peak = vec![0.0_f64; m];
    let mut strain = vec![[0.0_f64; 6]; m];
    for point in points {
        let e = point.element as usize;
        let l = point.barycentric.map(f64::from);
        let g: [DVec3; 10] =
            shape_gradients(l, &mesh.barycentric_gradients[e].map(|g| g.as_dvec3()));
        strain.fill([0.0; 6]);
        for a in 0..10 {
            let dof = 3 * mesh.elements[e][a] as usize;
            let (u, v, w) = (modes.row(dof), modes.row(dof + 1), modes.row(dof + 2));
            let [gx, gy, gz] = g[a].to_array();
            for i in 0..m {
                let (u, v, w) = (f64::from(u[i]), f64::from(v[i]), f64::from(w[i]));
                let s = &mut strain[i];
                s[0] += u * gx;
                s[1] += v * gy;
                s[2] += w * gz;
                // Twice the shear strains.
                s[3] += v * gz + w * gy;
                s[4] += w * gx + u * gz;
                s[5] += u * gy + v * gx;
            }
        }
        for i in 0..m {
            let [xx, yy, zz, yz, zx, xy] = strain[i];
            let pressure = lambda * (xx + yy + zz);
            let s = [
                2.0 * mu * xx + pressure,
                2.0 * mu * yy + pressure,
                2.0 * mu * zz + pressure,
                mu * yz,
                mu * zx,
                mu * xy,
            ];
            // The Frobenius norm is never below the spectral norm: nearly all points end here.
            let squared = s[0] * s[0]
                + s[1] * s[1]
                + s[2] * s[2]
                + 2.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
            if squared > peak[i] * peak[i] {
                peak[i] = peak[i].max(spectral_norm(s));
            }
        }
    }
    peak.iter().map(|&x| x as f32).collect()
}

/// Largest absolute eigenvalue of a symmetric 3 × 3 matrix (xx, yy, zz, yz, zx, xy), by the
/// trigonometric solution of its characteristic cubic.
pub(crate) fn spectral_norm([xx, yy, zz, yz, zx, xy]: [f64; 6]) -> f64 {
    let mean = (xx + yy + zz) / 3.0;
    let (a, b, c) = (xx - mean, yy - mean, zz - mean);
    let p = ((a * a + b * b + c * c + 2.0 * (yz * yz + zx * zx + xy * xy)) / 6.0).sqrt();
    if p == 0.0 {
        return mean.abs();
    }
    let determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * zx) + zx * (xy * yz - b * zx);
    let angle = (determinant / (2.0 * p * p * p)).clamp(-1.0, 1.0).acos() / 3.0;
    let largest = mean + 2.0 * p * angle.cos();
    let smallest = mean + 2.0 * p * (angle + std::f64::consts::TAU / 3.0).cos();
    largest.abs().max(smallest.abs())
}

#[cfg(test)]
mod tests {
    use super::spectral_norm;

    #[test]
    fn spectral_norm_of_known_matrices() {
        assert!((spectral_norm([1.0, -3.0, 2.0, 0.0, 0.0, 0.0]) - 3.0).abs() < 1e-12);
        // Pure shear τ has eigenvalues ±τ and 0; all ones has 3.
        assert!((spectral_norm([0.0, 0.0, 0.0, 0.0, 0.0, 2.0]) - 2.0).abs() < 1e-12);
        assert!((spectral_norm([1.0; 6]) - 3.0).abs() < 1e-12);
    }
}
