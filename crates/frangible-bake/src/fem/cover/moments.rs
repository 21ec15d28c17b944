//! Integrals of the quadratic shape functions over the part of the body that an element covers.

use frangible::glam::DVec3;

use crate::fem::element::{Elasticity, add_point};
use crate::fem::quadratic::{MID_EDGES, shape_gradients};

/// Integrals over a region, in the barycentric coordinates L of the element; their unit is a volume.
///
/// Products of two quadratic shape functions are forms of fourth order in L: the integrals of the 35 monomials of that
/// order tell all others, since the coordinates sum to one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moments {
    /// ∫ L_i L_j L_k L_l, i ≤ j ≤ k ≤ l, l running fastest.
    quartic: [f64; 35],
}

/// Walkington's rule of fifth order: weight and the four coordinates up to permutation.
/// N. J. Walkington, Quadrature on simplices of arbitrary dimension, 2000.
const VERTEX_POINTS: [(f64, f64); 2] = [
    (0.112_687_925_718_015_85, 0.310_885_919_263_300_6),
    (0.073_493_043_116_361_95, 0.092_735_250_310_891_23),
];
const EDGE_POINTS: (f64, f64) = (0.042_546_020_777_081_466, 0.045_503_704_125_649_65);

/// The rule of second order: the three equal coordinates of its points, (5 − √5)/20.
const FOUR_POINTS: f64 = 0.138_196_601_125_010_5;

/// Places of the first monomials whose lowest factor is L_i: of second, third and fourth order.
const PAIR: [usize; 4] = [0, 4, 7, 9];
const TRIPLE: [usize; 4] = [0, 10, 16, 19];
const QUADRUPLE: [usize; 4] = [0, 20, 30, 34];

impl Moments {
    pub(crate) const ZERO: Self = Self { quartic: [0.0; 35] };

    /// Adds a tetrahedron by the barycentric coordinates of its corners and its volume. Exact.
    pub(crate) fn add(&mut self, corners: [[f64; 4]; 4], volume: f64) {
        let sum: [f64; 4] = std::array::from_fn(|i| (0..4).map(|c| corners[c][i]).sum());
        for (weight, coordinate) in VERTEX_POINTS {
            for corner in &corners {
                let place = |i: usize| coordinate * sum[i] + (1.0 - 4.0 * coordinate) * corner[i];
                self.add_point(std::array::from_fn(place), weight * volume);
            }
        }
        let (weight, coordinate) = EDGE_POINTS;
        for a in 0..4 {
            for b in 0..a {
                let place = |i: usize| {
                    (0.5 - coordinate) * sum[i]
                        + (2.0 * coordinate - 0.5) * (corners[a][i] + corners[b][i])
                };
                self.add_point(std::array::from_fn(place), weight * volume);
            }
        }
    }

    /// Adds a tetrahedron much smaller than the element, by the four points that integrate quadratic functions.
    pub(crate) fn add_small(&mut self, corners: [[f64; 4]; 4], volume: f64) {
        let sum: [f64; 4] = std::array::from_fn(|i| (0..4).map(|c| corners[c][i]).sum());
        for corner in &corners {
            let place = |i: usize| FOUR_POINTS * sum[i] + (1.0 - 4.0 * FOUR_POINTS) * corner[i];
            self.add_point(std::array::from_fn(place), 0.25 * volume);
        }
    }

    /// Adds another region of the same element.
    pub(crate) fn merge(&mut self, other: &Self) {
        for (own, other) in self.quartic.iter_mut().zip(&other.quartic) {
            *own += other;
        }
    }

    /// All monomials of one order are those of the order below times L_0, then those without L_0 times L_1 and so on:
    /// runs that become vector instructions.
    #[inline]
    fn add_point(&mut self, l: [f64; 4], weight: f64) {
        let mut second = [0.0; 10];
        let mut third = [0.0; 20];
        for j in 0..4 {
            for k in j..4 {
                second[PAIR[j] + k - j] = l[j] * l[k];
            }
        }
        for i in 0..4 {
            let run = &second[PAIR[i]..];
            for (to, from) in third[TRIPLE[i]..].iter_mut().zip(run) {
                *to = l[i] * from;
            }
        }
        for i in 0..4 {
            let (share, run) = (weight * l[i], &third[TRIPLE[i]..]);
            for (to, from) in self.quartic[QUADRUPLE[i]..].iter_mut().zip(run) {
                *to += share * from;
            }
        }
    }

    /// ∫ L_i L_j L_k L_l.
    fn at(&self, mut order: [usize; 4]) -> f64 {
        order.sort_unstable();
        let [i, j, k, l] = order;
        let pair = PAIR[k] + l - k - PAIR[j];
        let triple = TRIPLE[j] + pair - TRIPLE[i];
        self.quartic[QUADRUPLE[i] + triple]
    }

    /// ∫ L_i L_j; their sum is the volume.
    fn second(&self) -> [[f64; 4]; 4] {
        let with = |i: usize, j: usize| {
            (0..4)
                .flat_map(|k| (0..4).map(move |l| [i, j, k, l]))
                .map(|order| self.at(order))
                .sum()
        };
        std::array::from_fn(|i| std::array::from_fn(|j| with(i, j)))
    }

    /// ∫ N_a N_b, b ≤ a.
    pub(crate) fn mass(&self) -> [[f64; 10]; 10] {
        let forms: [[([usize; 2], f64); 4]; 10] = std::array::from_fn(|a| {
            if a < 4 {
                // L (2 L − 1), where 1 is the sum of all four.
                std::array::from_fn(|j| ([a, j], if j == a { 1.0 } else { -1.0 }))
            } else {
                let whole = (MID_EDGES[a - 4], 4.0);
                let nothing = (MID_EDGES[a - 4], 0.0);
                [whole, nothing, nothing, nothing]
            }
        });
        let mut mass = [[0.0; 10]; 10];
        for a in 0..10 {
            for b in 0..=a {
                for ([i, j], x) in forms[a].into_iter().filter(|t| t.1 != 0.0) {
                    for ([k, l], y) in forms[b].into_iter().filter(|t| t.1 != 0.0) {
                        mass[a][b] += x * y * self.at([i, j, k, l]);
                    }
                }
            }
        }
        mass
    }

    /// Stiffness of the region: 3 × 3 blocks of the node pairs (a, b), b ≤ a.
    ///
    /// ∇N is linear, Σ_i L_i ∇N(corner i), so with ∫ L Lᵀ = R Rᵀ the columns of R are four points that
    /// integrate it exactly.
    pub(crate) fn stiffness(
        &self,
        gradients: &[DVec3; 4],
        material: &Elasticity,
    ) -> [[[[f64; 3]; 3]; 10]; 10] {
        let at_corners: [[DVec3; 10]; 4] = std::array::from_fn(|i| {
            let mut l = [0.0; 4];
            l[i] = 1.0;
            shape_gradients(l, gradients)
        });
        let mut k = [[[[0.0; 3]; 3]; 10]; 10];
        for column in root(self.second()) {
            let g: [DVec3; 10] =
                std::array::from_fn(|a| (0..4).map(|i| column[i] * at_corners[i][a]).sum());
            add_point(&mut k, &g, 1.0, material.lame());
        }
        k
    }
}

/// Columns of the Cholesky factor of a positive semidefinite matrix.
fn root(mut q: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
    let mut columns = [[0.0; 4]; 4];
    for k in 0..4 {
        let pivot = q[k][k];
        // A flat region leaves rounding on the last pivots.
        if pivot > 0.0 {
            for i in k..4 {
                columns[k][i] = q[i][k] / pivot.sqrt();
            }
            for i in k..4 {
                for j in k..4 {
                    q[i][j] -= columns[k][i] * columns[k][j];
                }
            }
        }
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::Moments;
    use crate::fem::element::{Elasticity, stiffness_t10};
    use crate::mesh::{barycentric_gradients, tet_volume};
    use frangible::glam::DVec3;

    const IDENTITY: [[f64; 4]; 4] = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];

    #[test]
    fn a_whole_element_has_the_textbook_matrices() {
        let x = [
            DVec3::ZERO,
            DVec3::new(1.0, 0.1, 0.0),
            DVec3::new(0.2, 1.1, 0.1),
            DVec3::new(0.3, 0.2, 0.9),
        ];
        let mut whole = Moments::ZERO;
        whole.add(IDENTITY, tet_volume(x));
        // Consistent mass of T10, times 420 over the volume: 6 and 1 among corners, −4 and −6 between a corner
        // and a mid-edge, 32, 16 and 8 among mid-edges.
        let unit = tet_volume(x) / 420.0;
        let mass = whole.mass();
        for (a, b, value) in [
            (0, 0, 6.0),
            (1, 0, 1.0),
            (4, 0, -4.0),
            (5, 0, -6.0),
            (4, 4, 32.0),
            (5, 4, 16.0),
            (9, 4, 8.0),
        ] {
            assert!((mass[a][b] / unit - value).abs() < 1e-12, "{a} {b}");
        }
        let material = Elasticity {
            youngs_modulus: 3.0,
            poisson_ratio: 0.3,
            density: 1.0,
        };
        let (found, expected) = (
            whole.stiffness(&barycentric_gradients(x), &material),
            stiffness_t10(x, &material),
        );
        for a in 0..10 {
            for b in 0..=a {
                for i in 0..3 {
                    for j in 0..3 {
                        assert!((found[a][b][i][j] - expected[a][b][i][j]).abs() < 1e-13);
                    }
                }
            }
        }
    }
}
