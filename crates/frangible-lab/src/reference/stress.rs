//! Green-Lagrange strain, Hooke's law, principal stresses `[G12 §4.4]`.

use frangible::Material;
use frangible::glam::DVec3;

use crate::reference::options::Strain;

pub(crate) type Matrix = [[f64; 3]; 3];

/// Stress σ (Pa) and strain energy density η (J/m³) from ∇u.
pub(crate) fn stress(material: &Material, gradient: &Matrix, kind: Strain) -> (Matrix, f64) {
    hooke(material, &strain(gradient, kind))
}

/// E, or its part that is linear in ∇u.
pub(crate) fn strain(gradient: &Matrix, kind: Strain) -> Matrix {
    match kind {
        Strain::GreenLagrange => green_lagrange(gradient),
        Strain::Linear => {
            let mut strain = [[0.0; 3]; 3];
            for i in 0..3 {
                for j in 0..3 {
                    strain[i][j] = 0.5 * (gradient[i][j] + gradient[j][i]);
                }
            }
            strain
        }
    }
}

/// E = ½(∇u + ∇uᵀ + ∇uᵀ∇u).
fn green_lagrange(gradient: &Matrix) -> Matrix {
    let mut strain = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            strain[i][j] = 0.5 * (gradient[i][j] + gradient[j][i]);
            for k in 0..3 {
                strain[i][j] += 0.5 * gradient[k][i] * gradient[k][j];
            }
        }
    }
    strain
}

/// σ = λ tr(E) I + 2μ E and η = ½ σ : E.
pub(crate) fn hooke(material: &Material, strain: &Matrix) -> (Matrix, f64) {
    let (e, nu) = (material.youngs_modulus, material.poisson_ratio);
    let lambda = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
    let mu = e / (2.0 * (1.0 + nu));
    let trace = strain[0][0] + strain[1][1] + strain[2][2];
    let mut sigma = [[0.0; 3]; 3];
    let mut energy = 0.0;
    for i in 0..3 {
        for j in 0..3 {
            sigma[i][j] = 2.0 * mu * strain[i][j] + if i == j { lambda * trace } else { 0.0 };
            energy += 0.5 * sigma[i][j] * strain[i][j];
        }
    }
    (sigma, energy)
}

/// Principal stresses, falling, and their unit directions (Jacobi: the largest entry off the diagonal first).
pub(crate) fn principal(sigma: &Matrix) -> ([f64; 3], [DVec3; 3]) {
    let mut a = *sigma;
    let mut v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let size: f64 = a.iter().flatten().map(|x| x.abs()).sum();
    for _ in 0..100 {
        let (mut p, mut q) = (0, 1);
        for (i, j) in [(0, 2), (1, 2)] {
            if a[i][j].abs() > a[p][q].abs() {
                (p, q) = (i, j);
            }
        }
        if a[p][q].abs() <= 1e-16 * size {
            break;
        }
        let angle = 0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p]);
        let (s, c) = angle.sin_cos();
        let mut turn = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        (turn[p][p], turn[q][q], turn[p][q], turn[q][p]) = (c, c, s, -s);
        a = product(&transposed(&turn), &product(&a, &turn));
        v = product(&v, &turn);
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[j][j].total_cmp(&a[i][i]));
    (
        order.map(|i| a[i][i]),
        order.map(|i| DVec3::new(v[0][i], v[1][i], v[2][i]).normalize()),
    )
}

fn transposed(a: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}
