//! Frequencies of a free box without any finite element: a Ritz series of Legendre polynomials.
//!
//! The method of resonant ultrasound spectroscopy: H. H. Demarest, J. Acoust. Soc. Am. 49, 768 (1971); W. M. Visscher et
//! al., J. Acoust. Soc. Am. 90, 2154 (1991). The series converges exponentially, from above, and shares with the bake
//! nothing but Hooke's law. The box is symmetric about three planes, so its modes fall into eight classes by parity.

use faer::{Mat, Side};
use frangible_bake::fem::Elasticity;

/// Eigenvalues below this share of the largest are those of rigid motions.
const NULL: f64 = 1e-12;

/// Frequencies of the elastic modes of a free box of these sides, m, rising, Hz: as many as are asked for. `degrees`:
/// highest power of each coordinate; 12 along a side that bends and 4 through the thickness give five digits or more.
#[must_use]
pub fn box_frequencies(
    size: [f64; 3],
    material: &Elasticity,
    degrees: [usize; 3],
    wanted: usize,
) -> Vec<f64> {
    let mut squares: Vec<f64> = (0..8)
        .flat_map(|class| class_eigenvalues(size, material, degrees, class))
        .collect();
    squares.sort_by(f64::total_cmp);
    // The six rigid motions are there to rounding.
    let floor = NULL * squares.last().copied().unwrap_or(0.0);
    squares
        .into_iter()
        .filter(|square| *square > floor)
        .take(wanted)
        .map(|square| square.sqrt() / std::f64::consts::TAU)
        .collect()
}

/// The lowest of them alone, by its class alone: eight times as fast, for series of high degree.
#[must_use]
pub fn first_box_frequency(size: [f64; 3], material: &Elasticity, degrees: [usize; 3]) -> f64 {
    let lowest_of = |class: usize, degrees: [usize; 3]| {
        let values = class_eigenvalues(size, material, degrees, class);
        let floor = NULL * values.iter().copied().fold(0.0, f64::max);
        let elastic = values.into_iter().filter(|value| *value > floor);
        elastic.fold(f64::INFINITY, f64::min)
    };
    let short = degrees.map(|n| n.min(8));
    let class = (0..8).min_by(|&a, &b| lowest_of(a, short).total_cmp(&lowest_of(b, short)));
    class.map_or(f64::NAN, |class| lowest_of(class, degrees).sqrt()) / std::f64::consts::TAU
}

fn class_eigenvalues(
    size: [f64; 3],
    material: &Elasticity,
    degrees: [usize; 3],
    class: usize,
) -> Vec<f64> {
    let parity = [class & 1, class >> 1 & 1, class >> 2];
    eigenvalues(size, material, degrees, parity)
}

/// A function of the series: displacement along `axis`, powers of the Legendre polynomials along x, y, z.
struct Term {
    axis: usize,
    degrees: [usize; 3],
}

/// Eigenvalues of the modes of one class, whose displacement along x is odd in x where `parity[0]` is 0, else even, and
/// likewise for the others.
fn eigenvalues(
    size: [f64; 3],
    material: &Elasticity,
    degrees: [usize; 3],
    parity: [usize; 3],
) -> Vec<f64> {
    let mut terms = Vec::new();
    for axis in 0..3 {
        let start = |along: usize| (parity[along] + usize::from(along == axis)) % 2;
        for i in (start(0)..=degrees[0]).step_by(2) {
            for j in (start(1)..=degrees[1]).step_by(2) {
                for k in (start(2)..=degrees[2]).step_by(2) {
                    let degrees = [i, j, k];
                    terms.push(Term { axis, degrees });
                }
            }
        }
    }
    let (lambda, mu) = material.lame();
    let same = |a: usize, b: usize| f64::from(u8::from(a == b));
    let entry = |a: &Term, b: &Term| {
        let mut sum = 0.0;
        for p in 0..3 {
            for q in 0..3 {
                // C_apbq of an isotropic solid.
                let stiffness = lambda * same(a.axis, p) * same(b.axis, q)
                    + mu * (same(a.axis, b.axis) * same(p, q) + same(a.axis, q) * same(b.axis, p));
                if stiffness != 0.0 {
                    let integral: f64 = (0..3)
                        .map(|s| integral(a.degrees[s], p == s, b.degrees[s], q == s))
                        .product();
                    sum += stiffness * 4.0 / (size[p] * size[q]) * integral;
                }
            }
        }
        sum / material.density
    };
    let n = terms.len();
    let mut matrix = Mat::from_fn(n, n, |i, j| entry(&terms[i], &terms[j]));
    // faer loses digits on matrices far from one in norm.
    let scale = matrix.norm_max();
    matrix /= faer::Scale(scale);
    let values = matrix.self_adjoint_eigenvalues(Side::Lower);
    values
        .unwrap_or_default()
        .into_iter()
        .map(|value| value * scale)
        .collect()
}

/// ∫ of the product of two normalised Legendre polynomials over −1..1, either of them differentiated or not.
fn integral(i: usize, i_derived: bool, j: usize, j_derived: bool) -> f64 {
    let odd = (i + j) % 2 == 1;
    let plain = match (i_derived, j_derived) {
        (false, false) => return f64::from(u8::from(i == j)),
        // ∫ P_i P_j' = 2 where j > i and the product is even.
        (false, true) => f64::from(u8::from(odd && j > i)) * 2.0,
        (true, false) => f64::from(u8::from(odd && i > j)) * 2.0,
        // ∫ P_i' P_j' = m (m + 1), m the lesser degree.
        (true, true) => {
            let m = i.min(j) as f64;
            f64::from(u8::from(!odd)) * m * (m + 1.0)
        }
    };
    plain * 0.5 * (((2 * i + 1) * (2 * j + 1)) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::{box_frequencies, first_box_frequency};
    use frangible_bake::fem::Elasticity;

    /// ω = π √2 √(μ/ρ) / L, whatever ν: equivoluminal, its faces free of stress.
    #[test]
    fn a_cube_has_lames_mode() {
        for poisson_ratio in [0.0, 0.2, 0.3, 0.45] {
            let material = Elasticity {
                youngs_modulus: 2.0 * (1.0 + poisson_ratio),
                poisson_ratio,
                density: 1.0,
            };
            let found = box_frequencies([1.0; 3], &material, [10; 3], 40);
            let lame = 0.5 * 2.0_f64.sqrt();
            let nearest = found.iter().map(|f| (f / lame - 1.0).abs());
            assert!(nearest.fold(1.0, f64::min) < 1e-6, "{found:?}");
        }
    }

    #[test]
    fn the_series_falls_and_has_converged() {
        let material = Elasticity {
            youngs_modulus: 100e9,
            poisson_ratio: 0.23,
            density: 2500.0,
        };
        let of = |n, k| box_frequencies([0.4, 0.4, 0.01], &material, [n, n, k], 5);
        let (low, middle, high) = (of(8, 3), of(11, 3), of(14, 5));
        for i in 0..5 {
            assert!(middle[i] <= low[i] * (1.0 + 1e-9) && high[i] <= middle[i] * (1.0 + 1e-9));
            assert!(middle[i] / high[i] - 1.0 < 2e-3, "mode {i}");
        }
        let first = first_box_frequency([0.4, 0.4, 0.01], &material, [14, 14, 5]);
        assert!((first / high[0] - 1.0).abs() < 1e-9);
    }
}
