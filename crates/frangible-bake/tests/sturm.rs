//! No mode missed, none found twice: Sylvester's law of inertia says that K − σM has as many negative pivots as there
//! are eigenvalues below σ.

use std::sync::Arc;

use crate::common::held_modes;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLdltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Par, Side};
use frangible::glam::DVec3;
use frangible_bake::eigen::Constraints;
use frangible_bake::fem::{
    Cover, Elasticity, Elements, Mass, QuadraticMesh, System, assemble, assemble_cover,
};
use frangible_bake::frangible_mesh::DistanceSolid;
use frangible_bake::shapes::SolidShape;
use frangible_bake::{MeshSize, Shape};

const GLASS: Elasticity = Elasticity {
    youngs_modulus: 70e9,
    poisson_ratio: 0.23,
    density: 2500.0,
};

/// The lower triangle of D (K − σM) D without the unknowns that are held, D = diag(M)^-½.
fn shifted(system: &System, constraints: &Constraints, sigma: f64) -> SparseColMat<usize, f64> {
    let mut number = vec![Some(0); system.unknowns()];
    for &held in constraints.unknowns() {
        number[held] = None;
    }
    let mut left = 0;
    for place in number.iter_mut().flatten() {
        *place = left;
        left += 1;
    }
    let root: Vec<f64> = system.mass.diagonal().iter().map(|m| m.sqrt()).collect();
    let mut entries = Vec::new();
    let mut add = |i: usize, j: usize, value: f64| {
        if let (Some(row), Some(column)) = (number[i], number[j]) {
            entries.push(Triplet::new(
                row,
                column,
                value / (root[i / 3] * root[j / 3]),
            ));
        }
    };
    for j in 0..system.unknowns() {
        let k = system.stiffness.as_ref();
        for (i, value) in k.row_idx_of_col(j).zip(k.val_of_col(j)) {
            add(i, j, *value);
        }
    }
    match &system.mass {
        Mass::Lumped(mass) => {
            for i in 0..system.unknowns() {
                add(i, i, -sigma * mass[i / 3]);
            }
        }
        Mass::Consistent(matrix) => {
            for j in 0..matrix.ncols() {
                for (i, value) in matrix.as_ref().row_idx_of_col(j).zip(matrix.val_of_col(j)) {
                    for axis in 0..3 {
                        add(3 * i + axis, 3 * j + axis, -sigma * value);
                    }
                }
            }
        }
    }
    SparseColMat::try_new_from_triplets(left, left, &entries).unwrap()
}

/// Negative pivots of a dense factorization with Bunch and Kaufman's pivoting.
fn negative_dense(matrix: &SparseColMat<usize, f64>) -> usize {
    let n = matrix.ncols();
    let mut dense = Mat::<f64>::zeros(n, n);
    for j in 0..n {
        for (i, value) in matrix.as_ref().row_idx_of_col(j).zip(matrix.val_of_col(j)) {
            dense[(i, j)] = *value;
            dense[(j, i)] = *value;
        }
    }
    let factor = dense.lblt(Side::Lower);
    let (diagonal, below) = (
        factor.B_diag().column_vector(),
        factor.B_subdiag().column_vector(),
    );
    let (mut negative, mut j) = (0, 0);
    while j < n {
        if j + 1 < n && below[j] != 0.0 {
            // A block of two, by its determinant and trace.
            let determinant = diagonal[j] * diagonal[j + 1] - below[j] * below[j];
            negative += match (determinant < 0.0, diagonal[j] + diagonal[j + 1] < 0.0) {
                (true, _) => 1,
                (false, true) => 2,
                (false, false) => 0,
            };
            j += 2;
        } else {
            negative += usize::from(diagonal[j] < 0.0);
            j += 1;
        }
    }
    negative
}

/// Negative pivots of a sparse L D Lᵀ.
fn negative_sparse(matrix: &SparseColMat<usize, f64>) -> usize {
    let symbolic = factorize_symbolic_cholesky(
        matrix.symbolic(),
        Side::Lower,
        SymmetricOrdering::Amd,
        CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        },
    )
    .unwrap();
    let mut values = vec![0.0; symbolic.len_val()];
    let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
    symbolic
        .factorize_numeric_ldlt(
            &mut values,
            matrix.as_ref(),
            Side::Lower,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
            Default::default(),
        )
        .unwrap();
    let SymbolicCholeskyRaw::Supernodal(raw) = symbolic.raw() else {
        panic!("a supernodal factor was asked for");
    };
    let factor = SupernodalLdltRef::new(raw, &values);
    // The pivot of a column stands where its one would.
    (0..raw.n_supernodes())
        .map(|s| {
            let block = factor.supernode(s).val();
            (0..block.ncols()).filter(|&j| block[(j, j)] < 0.0).count()
        })
        .sum()
}

/// Counts below σ in `slices` gaps between the found modes, the last of them just above the highest gap.
fn check(system: &System, constraints: &Constraints, wanted: usize, what: &str) {
    let modes = held_modes(system, constraints, wanted);
    let values = &modes.eigenvalues;
    // Only where two neighbours are clearly apart can σ lie between them.
    let gaps: Vec<usize> = (1..wanted)
        .filter(|&i| values[i] > 1.000_1 * values[i - 1])
        .collect();
    assert!(gaps.len() > 4, "{what}: hardly two modes are apart");
    let chosen = (0..5).map(|part| gaps[part * (gaps.len() - 1) / 4]);
    let levels = chosen.map(|i| (i, 0.5 * (values[i - 1] + values[i])));
    // And below the lowest, where only rigid motions are.
    for (below, sigma) in levels.chain([(0, 0.5 * values[0])]) {
        let matrix = shifted(system, constraints, sigma);
        let counted = match matrix.ncols() {
            ..1000 => negative_dense(&matrix),
            _ => negative_sparse(&matrix),
        };
        assert_eq!(
            counted,
            modes.rigid_motions + below,
            "{what}: below {sigma} 1/s²"
        );
    }
}

fn quadratic(shape: &Shape, edge: f64, layers: usize) -> System {
    let mesh = QuadraticMesh::new(&shape.analysis_mesh(MeshSize { edge, layers }).unwrap());
    assemble(&mesh.positions, Elements::Quadratic(&mesh.elements), &GLASS)
}

#[test]
fn no_mode_of_a_box_or_a_bar_is_missed_or_doubled() {
    let free = Constraints::default();
    let cube = quadratic(&Shape::block([0.1; 3]), 0.034, 0);
    check(
        &cube,
        &free,
        90,
        "a cube, which has double and triple modes",
    );
    let bar = quadratic(&Shape::rod(0.5, 0.03), 0.03, 1);
    check(&bar, &free, 80, "a square bar, which bends in pairs");
}

#[test]
fn no_mode_of_a_square_plate_is_missed_or_doubled() {
    let plate = Shape::plate(0.4, 0.4, 0.008);
    let free = Constraints::default();
    check(&quadratic(&plate, 0.08, 1), &free, 100, "a coarse plate");
    check(&quadratic(&plate, 0.034, 1), &free, 120, "a finer plate");
}

#[test]
fn no_mode_of_a_covered_ball_is_missed_or_doubled() {
    // Its modes come in multiplets of 2 l + 1, which the lattice hardly splits.
    let ball = Arc::new(DistanceSolid::sphere(DVec3::ZERO, 0.05));
    let shape = Shape::Solid(SolidShape {
        tets: 6000,
        ..SolidShape::new(ball)
    });
    let body = shape
        .fracture_mesh(shape.fracture_size().unwrap(), 1)
        .unwrap();
    let free = Constraints::default();
    for elements in [100, 500] {
        let system = assemble_cover(&Cover::new(&body, elements).unwrap(), &GLASS);
        check(&system, &free, 60, "a covered ball");
    }
}

#[test]
fn no_mode_of_a_held_body_is_missed_or_doubled() {
    for (axes, what) in [([true; 3], "clamped"), ([false, false, true], "held in z")] {
        let system = quadratic(&Shape::plate(0.2, 0.2, 0.01), 0.034, 1);
        let low = system
            .positions
            .iter()
            .fold(f64::INFINITY, |m, p| m.min(p.x));
        let on_edge = |p: &DVec3| p.x < low + 1e-9;
        let held: Vec<[bool; 3]> = system
            .positions
            .iter()
            .map(|p| axes.map(|axis| axis && on_edge(p)))
            .collect();
        let constraints = Constraints::of_nodes(&system.positions, &held);
        check(&system, &constraints, 60, what);
    }
}

#[test]
fn no_mode_of_linear_tetrahedra_is_missed_or_doubled() {
    let free = Constraints::default();
    for (edge, layers) in [(0.045, 1), (0.016, 1)] {
        let slab = Shape::plate(0.4, 0.4, 0.0125);
        let mesh = slab.analysis_mesh(MeshSize { edge, layers }).unwrap();
        let system = assemble(&mesh.positions, Elements::Linear(&mesh.tets), &GLASS);
        check(&system, &free, 100, "linear tetrahedra");
    }
    // The mesh that carries the cracks, irregular on purpose.
    let glass = Shape::drinking_glass();
    let size = MeshSize {
        edge: 0.008,
        layers: 1,
    };
    let mesh = glass.fracture_mesh(size, 1).unwrap();
    let system = assemble(&mesh.positions, Elements::Linear(&mesh.tets), &GLASS);
    check(&system, &free, 100, "a fracture mesh");
}

#[test]
fn modes_have_the_same_bits_whatever_the_threads() {
    let bowl = Shape::bowl();
    let body = bowl
        .fracture_mesh(
            MeshSize {
                edge: 0.006,
                layers: 1,
            },
            1,
        )
        .unwrap();
    let covered = assemble_cover(&Cover::new(&body, 500).unwrap(), &GLASS);
    for system in [quadratic(&bowl, 0.02, 1), covered] {
        assert!(system.unknowns() > 800, "the dense solver would be used");
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            let modes = pool.install(|| held_modes(&system, &Constraints::default(), 50));
            let bits = modes.shapes.iter().chain(&modes.eigenvalues);
            bits.map(|x| x.to_bits()).collect::<Vec<_>>()
        };
        let once = run(1);
        assert!(once == run(1), "two runs differ");
        assert!(once == run(2), "two threads give other bits than one");
    }
}
