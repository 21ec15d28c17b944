//! Assembly of stiffness and lumped mass.

use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use frangible::glam::DVec3;

use crate::fem::element::{Elasticity, stiffness_t4, stiffness_t10};
use crate::mesh::tet_volume;

/// Elements to assemble, by their node numbers.
#[derive(Clone, Copy, Debug)]
pub enum Elements<'a> {
    /// Linear tetrahedra.
    Linear(&'a [[u32; 4]]),
    /// Quadratic tetrahedra, corners first.
    Quadratic(&'a [[u32; 10]]),
}

/// Stiffness and mass of a free body; degree of freedom `3 * node + axis`.
#[derive(Clone, Debug)]
pub struct System {
    /// Node positions, m.
    pub positions: Vec<DVec3>,
    /// Lower triangle of K, N/m.
    pub stiffness: SparseColMat<usize, f64>,
    /// Lumped mass of each node, kg.
    pub mass: Vec<f64>,
}

/// Assembles K and the lumped M. Mass of T10: HRZ, 1/36 of the element to a corner, 4/27 to a mid-edge.
#[must_use]
pub fn assemble(positions: &[DVec3], elements: Elements<'_>, material: &Elasticity) -> System {
    match elements {
        Elements::Linear(tets) => {
            assemble_with(positions, tets, [0.25; 4], material.density, |x| {
                stiffness_t4(x, material)
            })
        }
        Elements::Quadratic(tets) => {
            let (c, m) = (1.0 / 36.0, 4.0 / 27.0);
            let shares = [c, c, c, c, m, m, m, m, m, m];
            assemble_with(positions, tets, shares, material.density, |x| {
                stiffness_t10(x, material)
            })
        }
    }
}

fn assemble_with<const N: usize>(
    positions: &[DVec3],
    elements: &[[u32; N]],
    shares: [f64; N],
    density: f64,
    stiffness: impl Fn([DVec3; 4]) -> [[[[f64; 3]; 3]; N]; N],
) -> System {
    let nodes = positions.len();
    let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(elements.len() * N * (N + 1) / 2);
    for element in elements {
        for (a, &row) in element.iter().enumerate() {
            pairs.extend(
                element[..=a]
                    .iter()
                    .map(|&column| (row.min(column), row.max(column))),
            );
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    // Blocks of node column c lie at starts[c]..starts[c + 1], the diagonal one first.
    let mut starts = vec![0; nodes + 1];
    for &(column, _) in &pairs {
        starts[column as usize + 1] += 1;
    }
    for c in 0..nodes {
        starts[c + 1] += starts[c];
    }
    let (mut col_ptr, mut row_idx) = (vec![0], Vec::with_capacity(9 * pairs.len()));
    for c in 0..nodes {
        for axis in 0..3 {
            for &(_, row) in &pairs[starts[c]..starts[c + 1]] {
                let first = if row as usize == c { axis } else { 0 };
                row_idx.extend((first..3).map(|i| 3 * row as usize + i));
            }
            col_ptr.push(row_idx.len());
        }
    }
    let mut values = vec![0.0; row_idx.len()];
    let mut mass = vec![0.0; nodes];
    for element in elements {
        let x = std::array::from_fn(|k| positions[element[k] as usize]);
        let k = stiffness(x);
        let element_mass = density * tet_volume(x);
        for a in 0..N {
            mass[element[a] as usize] += shares[a] * element_mass;
            for b in 0..=a {
                let (row, column) = (element[a].max(element[b]), element[a].min(element[b]));
                let c = column as usize;
                let block = pairs[starts[c]..starts[c + 1]].partition_point(|p| p.1 < row);
                for i in 0..3 {
                    for j in 0..3 {
                        // k holds (a, b); the stored block is (row, column), perhaps transposed.
                        let value = if element[a] == row {
                            k[a][b][i][j]
                        } else {
                            k[a][b][j][i]
                        };
                        if block == 0 {
                            if i >= j {
                                values[col_ptr[3 * c + j] + i - j] += value;
                            }
                        } else {
                            // The diagonal block takes 3 − j entries of column j, every other three.
                            values[col_ptr[3 * c + j] + 3 * block - j + i] += value;
                        }
                    }
                }
            }
        }
    }
    let symbolic = SymbolicSparseColMat::new_checked(3 * nodes, 3 * nodes, col_ptr, None, row_idx);
    System {
        positions: positions.to_vec(),
        stiffness: SparseColMat::new(symbolic, values),
        mass,
    }
}

impl System {
    /// K x for one vector of 3 × nodes numbers, N.
    #[must_use]
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        self.multiply_with(x, |value| value)
    }

    /// |K| |x|: what the rounding of [`System::multiply`] is measured by, N.
    #[must_use]
    pub fn multiply_magnitudes(&self, x: &[f64]) -> Vec<f64> {
        self.multiply_with(x, f64::abs)
    }

    fn multiply_with(&self, x: &[f64], f: impl Fn(f64) -> f64) -> Vec<f64> {
        let mut y = vec![0.0; x.len()];
        let (pattern, values) = self.stiffness.parts();
        for (j, &xj) in x.iter().enumerate() {
            let range = pattern.col_range(j);
            let mut sum = 0.0;
            for (&i, &value) in pattern.row_idx()[range.clone()].iter().zip(&values[range]) {
                y[i] += f(value * xj);
                // The upper triangle, but for the diagonal, which counts once.
                sum += if i == j { 0.0 } else { f(value * x[i]) };
            }
            y[j] += sum;
        }
        y
    }
}
