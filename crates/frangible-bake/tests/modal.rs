//! Modal analysis against closed forms and its own invariants.

use std::ops::ControlFlow;

use frangible_bake::eigen::{Modes, lowest_modes, residual, rigid_motions};
use frangible_bake::fem::{Elasticity, Elements, QuadraticMesh, System, assemble};
use frangible_bake::{BakeError, MeshSize, Shape};

const GLASS: Elasticity = Elasticity {
    youngs_modulus: 70e9,
    poisson_ratio: 0.23,
    density: 2500.0,
};

fn quadratic(shape: &Shape, edge: f64, layers: usize, material: &Elasticity) -> System {
    let mesh = QuadraticMesh::new(&shape.analysis_mesh(MeshSize { edge, layers }).unwrap());
    assemble(
        &mesh.positions,
        Elements::Quadratic(&mesh.elements),
        material,
    )
}

fn modes(system: &System, wanted: usize) -> Modes {
    lowest_modes(system, wanted, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn assert_near(value: f64, reference: f64, tolerance: f64, what: &str) {
    assert!(
        (value / reference - 1.0).abs() < tolerance,
        "{what}: {value} is not within {tolerance} of {reference}"
    );
}

#[test]
fn stiffness_has_six_null_modes() {
    let mesh = Shape::drinking_glass()
        .analysis_mesh(MeshSize {
            edge: 0.012,
            layers: 1,
        })
        .unwrap();
    let quadratic_mesh = QuadraticMesh::new(&mesh);
    for system in [
        assemble(&mesh.positions, Elements::Linear(&mesh.tets), &GLASS),
        assemble(
            &quadratic_mesh.positions,
            Elements::Quadratic(&quadratic_mesh.elements),
            &GLASS,
        ),
    ] {
        for motion in rigid_motions(&system) {
            let (k, magnitude) = (
                system.multiply(&motion),
                system.multiply_magnitudes(&motion),
            );
            assert!(
                norm(&k) < 1e-13 * norm(&magnitude),
                "{} of {}",
                norm(&k),
                norm(&magnitude)
            );
        }
        let seventh = modes(&system, 1).eigenvalues[0];
        assert!(seventh > 1e6, "the lowest elastic eigenvalue is {seventh}");
    }
}

#[test]
fn modes_are_mass_orthonormal_and_solve_the_problem() {
    let system = quadratic(&Shape::bowl(), 0.012, 1, &GLASS);
    let modes = modes(&system, 60);
    let rigid = rigid_motions(&system);
    let product = |a: &[f64], b: &[f64]| {
        let image = system.mass.multiply(b);
        a.iter().zip(image).map(|(x, y)| x * y).sum::<f64>()
    };
    for i in 0..60 {
        for j in 0..=i {
            let expected = if i == j { 1.0 } else { 0.0 };
            assert!(
                (product(modes.shape(i), modes.shape(j)) - expected).abs() < 1e-8,
                "modes {i} and {j}"
            );
        }
        for motion in &rigid {
            assert!(product(modes.shape(i), motion).abs() < 1e-9 * product(motion, motion).sqrt());
        }
        let (residual, limit) = residual(&system, modes.eigenvalues[i], modes.shape(i));
        assert!(residual <= limit, "mode {i}: {residual} above {limit}");
        let largest = modes
            .shape(i)
            .iter()
            .copied()
            .max_by(|a, b| a.abs().total_cmp(&b.abs()))
            .unwrap();
        assert!(largest > 0.0 || modes.shape(i).iter().any(|x| *x > -largest * (1.0 - 1e-6)));
    }
    assert!(modes.eigenvalues.windows(2).all(|w| w[0] <= w[1]));
}

#[test]
fn lanczos_agrees_with_the_dense_solver() {
    // 4 × 4 × 1 squares: 1 089 unknowns. Asking for 200 takes Lanczos, for 240 the dense solver.
    let system = quadratic(&Shape::plate(0.4, 0.4, 0.02), 0.08, 1, &GLASS);
    let n = system.unknowns();
    assert!(n > 800, "{n} unknowns would go to the dense solver");
    let (few, many) = (modes(&system, n / 5), modes(&system, n / 5 + 1));
    for (i, (a, b)) in few.eigenvalues.iter().zip(&many.eigenvalues).enumerate() {
        assert_near(*a, *b, 1e-7, &format!("eigenvalue {i}"));
    }
}

#[test]
fn free_bar_rings_at_its_axial_and_bending_frequencies() {
    let system = quadratic(&Shape::rod(0.5, 0.03), 0.015, 2, &GLASS);
    let modes = modes(&system, 12);
    let frequencies: Vec<f64> = (0..12).map(|i| modes.frequency(i)).collect();
    // Timoshenko's beam for the first pair; c/(2L) with c = √(E/ρ) for the axial mode.
    assert_near(frequencies[0], 644.0, 0.01, "bending");
    assert_near(frequencies[1], 644.0, 0.01, "bending in the other plane");
    // The axial mode is the one whose displacement is all along x.
    let along_x = |i: usize| {
        let shape = modes.shape(i);
        norm(&shape.iter().step_by(3).copied().collect::<Vec<_>>()) / norm(shape)
    };
    let axial = (0..12)
        .find(|&i| along_x(i) > 0.99)
        .expect("an axial mode among the first twelve");
    assert_near(frequencies[axial], 5291.0, 0.01, "axial");
}

#[test]
fn free_square_plate_has_leissas_coefficients() {
    let (a, h) = (0.4, 0.004);
    let material = Elasticity {
        youngs_modulus: 70e9,
        poisson_ratio: 0.3,
        density: 2500.0,
    };
    let modes = modes(
        &quadratic(&Shape::plate(a, a, h), a / 16.0, 1, &material),
        5,
    );
    let bending = 70e9 * h * h * h / (12.0 * (1.0 - 0.09));
    for (i, reference) in [13.47, 19.60, 24.27, 34.80, 34.80].into_iter().enumerate() {
        let coefficient = modes.eigenvalues[i].sqrt() * a * a * (2500.0 * h / bending).sqrt();
        assert_near(coefficient, reference, 0.015, &format!("coefficient {i}"));
    }
}

#[test]
fn linear_elements_lock_in_bending_and_quadratic_ones_do_not() {
    let shape = Shape::plate(0.4, 0.4, 0.01);
    let material = Elasticity {
        youngs_modulus: 100e9,
        poisson_ratio: 0.23,
        density: 2500.0,
    };
    let mesh = shape
        .analysis_mesh(MeshSize {
            edge: 0.025,
            layers: 1,
        })
        .unwrap();
    let linear = modes(
        &assemble(&mesh.positions, Elements::Linear(&mesh.tets), &material),
        1,
    );
    assert!(
        linear.frequency(0) > 2.0 * 260.6,
        "T4: {} Hz",
        linear.frequency(0)
    );
    let quadratic = modes(&quadratic(&shape, 0.025, 1, &material), 1);
    assert_near(quadratic.frequency(0), 260.6, 0.005, "T10");
}

#[test]
fn eigenvalues_scale_with_stiffness_and_size() {
    let reference = modes(
        &quadratic(&Shape::block([0.1, 0.08, 0.05]), 0.025, 2, &GLASS),
        20,
    );
    let stiffer = Elasticity {
        youngs_modulus: 3.0 * GLASS.youngs_modulus,
        ..GLASS
    };
    let stiffer = modes(
        &quadratic(&Shape::block([0.1, 0.08, 0.05]), 0.025, 2, &stiffer),
        20,
    );
    let larger = modes(
        &quadratic(&Shape::block([0.2, 0.16, 0.1]), 0.05, 2, &GLASS),
        20,
    );
    for i in 0..20 {
        assert_near(
            stiffer.eigenvalues[i],
            3.0 * reference.eigenvalues[i],
            1e-8,
            "E × 3",
        );
        assert_near(
            larger.eigenvalues[i],
            reference.eigenvalues[i] / 4.0,
            1e-8,
            "size × 2",
        );
        assert_near(
            norm(larger.shape(i)),
            norm(reference.shape(i)) / 2.0_f64.powf(1.5),
            1e-6,
            "shape",
        );
    }
}

#[test]
fn more_modes_than_the_mesh_has_is_an_error_that_says_how_many() {
    let system = quadratic(&Shape::block([1.0, 1.0, 1.0]), 1.0, 1, &GLASS);
    let available = system.unknowns() - 6;
    assert_eq!(modes(&system, available).eigenvalues.len(), available);
    let error =
        lowest_modes(&system, available + 1, &mut |_| ControlFlow::Continue(())).unwrap_err();
    assert_eq!(
        error,
        BakeError::Modes {
            wanted: available + 1,
            available
        }
    );
    assert!(error.to_string().contains(&available.to_string()));
}
