//! Assembly of stiffness and lumped mass.

use faer::sparse::SparseColMat;
use frangible::glam::DVec3;

use crate::fem::element::{Elasticity, stiffness_t4, stiffness_t10};
use crate::fem::mass::Mass;
use crate::fem::pattern::Pattern;
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
    /// M, kg.
    pub mass: Mass,
}

/// Assembles K and the lumped M. T10 elements use HRZ lumping: 1/36 of the element's mass for a corner, 4/27 for a mid-edge node.
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
    let pattern = Pattern::new(positions.len(), elements);
    let mut values = vec![0.0; pattern.entries()];
    let mut mass = vec![0.0; positions.len()];
    for element in elements {
        let x = std::array::from_fn(|k| positions[element[k] as usize]);
        let element_mass = density * tet_volume(x);
        for a in 0..N {
            mass[element[a] as usize] += shares[a] * element_mass;
        }
        pattern.add(&mut values, element, &stiffness(x));
    }
    System {
        positions: positions.to_vec(),
        stiffness: pattern.matrix(values),
        mass: Mass::Lumped(mass),
    }
}

impl System {
    /// Returns the number of unknowns, three per node.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        3 * self.positions.len()
    }

    /// Returns K x for a vector of 3 × nodes numbers, N.
    #[must_use]
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        self.multiply_with(x, |value| value)
    }

    /// Returns |K| |x|, N: the scale of the rounding error of [`System::multiply`].
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
