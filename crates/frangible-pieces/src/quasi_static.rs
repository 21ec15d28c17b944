//! Linear elasticity of the piece without inertia: factored once, one solve per load.
//!
//! A free piece is accelerated by what pushes it, and its own inertia balances that (d'Alembert): the load less M R a, R
//! the six rigid motions. Balanced, it may be held anywhere in a statically determinate way without a reaction: by six
//! springs at three nodes.
//! Linear tetrahedra of one layer lock in bending, so the elements are the quadratic ones of [`reanalysis`](crate::reanalysis()).

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::solvers::Solve as _;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, Mat, Par, Side, Spec};
use frangible::glam::{DVec3, Vec3};
use frangible::piece::{Elastic, Portion, Response, Statics};
use frangible_bake::eigen::rigid_motions;
use frangible_bake::fem::System;

use crate::PieceError;
use crate::dense::refused;
use crate::lattice::Lattice;

/// A factored piece.
struct Factored {
    /// L of the stiffness: its pattern and its values.
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    unknowns: usize,
    /// R, one column per rigid motion, and (Rᵀ M R)⁻¹ Rᵀ of the forces' balance; empty of a held piece.
    rigid: Vec<Vec<f64>>,
    /// M R.
    inertia: Vec<Vec<f64>>,
    /// Rᵀ M R, inverted: row-major.
    inverse: Vec<f64>,
    /// Translations M x, for the weight.
    translations: [Vec<f64>; 3],
}

impl std::fmt::Debug for Factored {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Factored({} unknowns)", self.unknowns)
    }
}

/// Quasi-static response of the piece on about `elements` quadratic elements.
///
/// # Errors
/// A piece without volume, or a stiffness that cannot be factored.
pub fn quasi_static(portion: &Arc<Portion>, elements: usize) -> Result<Elastic, PieceError> {
    let lattice = Lattice::new(portion, elements)?;
    let held = !portion.supported().is_empty();
    let statics = Factored::new(lattice.system, held)?;
    Ok(Elastic {
        analysis: lattice.analysis,
        tets: lattice.tets,
        nodes: lattice.nodes,
        response: Response::Static(Arc::new(statics)),
    })
}

impl Factored {
    fn new(system: System, held: bool) -> Result<Self, PieceError> {
        let n = system.unknowns();
        let springs = if held {
            Vec::new()
        } else {
            determinate(&system.positions).to_vec()
        };
        let k = &system.stiffness;
        let mut entries = Vec::with_capacity(k.compute_nnz() + 6);
        let mut diagonal = vec![0.0; n];
        for j in 0..n {
            for (i, &value) in k.row_idx_of_col(j).zip(k.val_of_col(j)) {
                entries.push(Triplet::new(i, j, value));
                if i == j {
                    diagonal[i] = value;
                }
            }
        }
        entries.extend(springs.iter().map(|&i| Triplet::new(i, i, diagonal[i])));
        let matrix = SparseColMat::try_new_from_triplets(n, n, &entries).map_err(refused)?;
        // One thread: pieces are factored side by side, and the bits must not depend on how many there are.
        let ordering = SymmetricOrdering::Amd;
        let params = CholeskySymbolicParams::default();
        let symbolic =
            factorize_symbolic_cholesky(matrix.symbolic(), Side::Lower, ordering, params)
                .map_err(refused)?;
        let mut values = vec![0.0; symbolic.len_val()];
        let params = Spec::default();
        let mut memory =
            MemBuffer::new(symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, params));
        symbolic
            .factorize_numeric_llt(
                &mut values,
                matrix.as_ref(),
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                params,
            )
            .map_err(refused)?;
        let all = rigid_motions(&system);
        let mass = |x: &Vec<f64>| system.mass.multiply(x);
        let translations = [0, 1, 2].map(|k| mass(&all[k]));
        let rigid = if held { Vec::new() } else { all };
        let inertia: Vec<Vec<f64>> = rigid.iter().map(mass).collect();
        let gram = Mat::from_fn(rigid.len(), rigid.len(), |i, j| dot(&rigid[i], &inertia[j]));
        let inverse = if held {
            Vec::new()
        } else {
            let unit = Mat::<f64>::identity(6, 6);
            let inverse = gram.llt(Side::Lower).map_err(refused)?.solve(unit);
            (0..36).map(|i| inverse[(i / 6, i % 6)]).collect()
        };
        Ok(Self {
            symbolic,
            values,
            unknowns: n,
            rigid,
            inertia,
            inverse,
            translations,
        })
    }
}

impl Statics for Factored {
    fn displacement(&self, forces: &[f64]) -> Vec<f64> {
        let mut balanced = forces.to_vec();
        let along: Vec<f64> = self.rigid.iter().map(|r| dot(r, forces)).collect();
        for (i, inertia) in self.inertia.iter().enumerate() {
            let a: f64 = (0..6).map(|j| self.inverse[6 * i + j] * along[j]).sum();
            for (f, m) in balanced.iter_mut().zip(inertia) {
                *f -= a * m;
            }
        }
        let mut u = Mat::from_fn(balanced.len(), 1, |i, _| balanced[i]);
        let factor = LltRef::new(&self.symbolic, &self.values);
        let mut memory = MemBuffer::new(self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let stack = MemStack::new(&mut memory);
        factor.solve_in_place_with_conj(Conj::No, u.as_mut(), Par::Seq, stack);
        (0..balanced.len()).map(|i| u[(i, 0)]).collect()
    }

    fn bytes(&self) -> usize {
        let vectors = self.rigid.len() + self.inertia.len() + self.translations.len();
        8 * (self.values.len() + vectors * self.unknowns + self.inverse.len())
    }

    fn weight(&self, gravity: Vec3) -> Vec<f64> {
        let g = gravity.as_dvec3().to_array();
        (0..self.unknowns)
            .map(|i| (0..3).map(|k| g[k] * self.translations[k][i]).sum())
            .collect()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Six unknowns at three nodes that hold a body without straining it.
fn determinate(positions: &[DVec3]) -> [usize; 6] {
    let farthest = |measure: &dyn Fn(DVec3) -> f64| {
        let places = positions.iter().enumerate();
        places
            .max_by(|a, b| measure(*a.1).total_cmp(&measure(*b.1)))
            .map_or(0, |(i, _)| i)
    };
    let a = 0;
    let b = farthest(&|x| x.distance_squared(positions[a]));
    let ab = positions[b] - positions[a];
    let c = farthest(&|x| ab.cross(x - positions[a]).length_squared());
    // Held at a: all three axes. At b: all but the one along which ab mostly runs. At c: the one in which a turn about ab
    // moves it most.
    let along = largest(ab);
    let [second, third] = [(along + 1) % 3, (along + 2) % 3];
    let turn = ab.cross(positions[c] - positions[a]);
    [
        3 * a,
        3 * a + 1,
        3 * a + 2,
        3 * b + second,
        3 * b + third,
        3 * c + largest(turn),
    ]
}

fn largest(v: DVec3) -> usize {
    let v = v.abs();
    if v.x >= v.y && v.x >= v.z {
        0
    } else if v.y >= v.z {
        1
    } else {
        2
    }
}
