//! Largest stress of each mode: what lets a harmless contact be refused without a look at the mesh.

use frangible::asset::{AnalysisMesh, EmbeddedPoint};
use frangible::glam::DVec3;
use frangible::modal::ModalBasis;

use crate::fem::{Elasticity, shape_gradients};

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
    let mut rough = Rough::new(m);
    for point in points {
        let e = point.element as usize;
        let l = point.barycentric.map(f64::from);
        let g: [DVec3; 10] =
            shape_gradients(l, &mesh.barycentric_gradients[e].map(|g| g.as_dvec3()));
        rough.measure(&mesh.elements[e], &g, modes, lambda as f32, mu as f32);
        for i in 0..m {
            // Nearly all points end here. Not a number is no reason to.
            if f64::from(rough.squared[i]) * MARGIN < peak[i] * peak[i] {
                continue;
            }
            let s = stress(&mesh.elements[e], &g, modes, i, lambda, mu);
            // The Frobenius norm is never below the spectral norm.
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

/// Square of the rough norms that may hide a larger true one: a thousand times their rounding.
const MARGIN: f64 = 1.01;

/// Stress of mode `i` at the point with these shape gradients: xx, yy, zz, yz, zx, xy, Pa per unit amplitude.
fn stress(
    element: &[u32; 10],
    g: &[DVec3; 10],
    modes: &ModalBasis,
    i: usize,
    lambda: f64,
    mu: f64,
) -> [f64; 6] {
    let mut strain = [0.0_f64; 6];
    for (node, g) in element.iter().zip(g) {
        let dof = 3 * *node as usize;
        let [u, v, w] = [0, 1, 2].map(|axis| f64::from(modes.row(dof + axis)[i]));
        let [gx, gy, gz] = g.to_array();
        strain[0] += u * gx;
        strain[1] += v * gy;
        strain[2] += w * gz;
        // Twice the shear strains.
        strain[3] += v * gz + w * gy;
        strain[4] += w * gx + u * gz;
        strain[5] += u * gy + v * gx;
    }
    let [xx, yy, zz, yz, zx, xy] = strain;
    let pressure = lambda * (xx + yy + zz);
    [
        2.0 * mu * xx + pressure,
        2.0 * mu * yy + pressure,
        2.0 * mu * zz + pressure,
        mu * yz,
        mu * zx,
        mu * xy,
    ]
}

/// Frobenius norms of all modes at a point, in f32 and one mode beside the next: vector instructions.
struct Rough {
    strain: [Vec<f32>; 6],
    squared: Vec<f32>,
}

impl Rough {
    fn new(modes: usize) -> Self {
        Self {
            strain: std::array::from_fn(|_| vec![0.0; modes]),
            squared: vec![0.0; modes],
        }
    }

    fn measure(
        &mut self,
        element: &[u32; 10],
        g: &[DVec3; 10],
        modes: &ModalBasis,
        lambda: f32,
        mu: f32,
    ) {
        let m = self.squared.len();
        self.strain.iter_mut().for_each(|s| s.fill(0.0));
        let [xx, yy, zz, yz, zx, xy] = &mut self.strain;
        let (xx, yy, zz) = (&mut xx[..m], &mut yy[..m], &mut zz[..m]);
        let (yz, zx, xy) = (&mut yz[..m], &mut zx[..m], &mut xy[..m]);
        let first = 3 * element[0] as usize;
        let [u0, v0, w0] = [0, 1, 2].map(|axis| &modes.row(first + axis)[..m]);
        // The gradients sum to zero: what all nodes have in common strains nothing, and would only round.
        for (node, g) in element.iter().zip(g).skip(1) {
            let dof = 3 * *node as usize;
            let [u, v, w] = [0, 1, 2].map(|axis| &modes.row(dof + axis)[..m]);
            let [gx, gy, gz] = g.as_vec3().to_array();
            for i in 0..m {
                let (u, v, w) = (u[i] - u0[i], v[i] - v0[i], w[i] - w0[i]);
                xx[i] += u * gx;
                yy[i] += v * gy;
                zz[i] += w * gz;
                yz[i] += v * gz + w * gy;
                zx[i] += w * gx + u * gz;
                xy[i] += u * gy + v * gx;
            }
        }
        for (i, squared) in self.squared.iter_mut().enumerate() {
            let pressure = lambda * (xx[i] + yy[i] + zz[i]);
            let normal = [xx[i], yy[i], zz[i]].map(|s| 2.0 * mu * s + pressure);
            let shear = [yz[i], zx[i], xy[i]].map(|s| mu * s);
            let sum = |s: [f32; 3]| s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
            *squared = sum(normal) + 2.0 * sum(shear);
        }
    }
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
