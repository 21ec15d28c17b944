//! Modal analysis against its own invariants; `frangible_lab::verify` has the closed forms.

use std::ops::ControlFlow;

use crate::common::{assert_near, free_modes, norm};
use frangible_bake::eigen::{lowest_modes, residual, rigid_motions};
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
        let seventh = free_modes(&system, 1).eigenvalues[0];
        assert!(seventh > 1e6, "the lowest elastic eigenvalue is {seventh}");
    }
}

#[test]
fn modes_are_mass_orthonormal_and_solve_the_problem() {
    let system = quadratic(&Shape::bowl(), 0.012, 1, &GLASS);
    let modes = free_modes(&system, 60);
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
    let (few, many) = (free_modes(&system, n / 5), free_modes(&system, n / 5 + 1));
    for (i, (a, b)) in few.eigenvalues.iter().zip(&many.eigenvalues).enumerate() {
        assert_near(*a, *b, 1e-7, &format!("eigenvalue {i}"));
    }
}

#[test]
fn more_modes_than_the_mesh_has_is_an_error_that_says_how_many() {
    let system = quadratic(&Shape::block([1.0, 1.0, 1.0]), 1.0, 1, &GLASS);
    let available = system.unknowns() - 6;
    assert_eq!(free_modes(&system, available).eigenvalues.len(), available);
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

/// Rounding alone leaves residuals near the limit here: the last digits of a thin plate's stiffness are large.
#[test]
fn thin_plates_of_few_elements_have_their_modes() {
    let plate = Shape::plate(0.4, 0.4, 0.01);
    for squares in 1..=6 {
        let system = quadratic(&plate, 0.4 / f64::from(squares), 1, &GLASS);
        let found = free_modes(&system, 6);
        println!(
            "{squares}: {:.1} Hz, residual {:.0e}",
            found.frequency(0),
            found.max_residual
        );
        // With lumped mass the first frequency rises towards 217 Hz: 152, 203 …
        if squares > 3 {
            assert_near(found.frequency(0), 217.4, 0.02, "first frequency, Hz");
        }
    }
}
