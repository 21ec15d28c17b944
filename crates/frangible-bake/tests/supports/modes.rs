//! Modes of held bodies against closed forms.

use std::f64::consts::{PI, TAU};

use frangible::Material;
use frangible::glam::DVec3;
use frangible_bake::eigen::{Constraints, Modes, remaining_motions};
use frangible_bake::fem::{Cover, Elasticity, System, assemble_supported_cover};
use frangible_bake::frangible_mesh::InputMesh;
use frangible_bake::{
    BakeSpec, Baked, ImportOptions, MeshSize, Region, Shape, Support, bake_with, import_mesh,
};

use super::{GLASS, system};
use crate::common::{assert_near, held_modes};

fn assert_orthonormal(system: &System, constraints: &Constraints, modes: &Modes) {
    let remaining = remaining_motions(system, constraints);
    assert_eq!(remaining.len(), modes.rigid_motions);
    for i in 0..modes.eigenvalues.len() {
        let inertia = system.mass.multiply(modes.shape(i));
        let product = |x: &[f64]| x.iter().zip(&inertia).map(|(x, y)| x * y).sum::<f64>();
        for j in 0..=i {
            let expected = if i == j { 1.0 } else { 0.0 };
            let found = product(modes.shape(j));
            assert!(
                (found - expected).abs() < 1e-8,
                "modes {i} and {j}: {found}"
            );
        }
        for motion in &remaining {
            let length = motion.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!(product(motion).abs() < 1e-8 * length, "mode {i}");
        }
        assert!(
            constraints
                .unknowns()
                .iter()
                .all(|&u| modes.shape(i)[u] == 0.0)
        );
    }
}

/// 1.8751² √(EI/(ρA)) / (2πL²), Hz, of a square bar.
fn cantilever(material: &Elasticity, length: f64, side: f64) -> f64 {
    let speed = (material.youngs_modulus / material.density).sqrt();
    1.875_104_f64.powi(2) * speed * side / 12.0_f64.sqrt() / (TAU * length * length)
}

/// √(D/(ρh)), m²/s, of a plate.
fn plate_speed(thickness: f64) -> f64 {
    let bending = GLASS.youngs_modulus * thickness.powi(3) / (12.0 * (1.0 - 0.09));
    (bending / (GLASS.density * thickness)).sqrt()
}

#[test]
fn a_cantilever_rings_at_its_bending_frequency() {
    let (system, constraints) = system(&Shape::rod(0.5, 0.02), 0.02, 2, |x| [x.x < 1e-9; 3]);
    let modes = held_modes(&system, &constraints, 10);
    assert_eq!(modes.rigid_motions, 0);
    assert_near(
        modes.frequency(0),
        cantilever(&GLASS, 0.5, 0.02),
        0.01,
        "first bending",
    );
    assert_near(
        modes.frequency(1),
        cantilever(&GLASS, 0.5, 0.02),
        0.01,
        "the other plane",
    );
    let second = (4.694_091_f64 / 1.875_104).powi(2) * cantilever(&GLASS, 0.5, 0.02);
    assert_near(modes.frequency(2), second, 0.02, "second bending");
    assert_orthonormal(&system, &constraints, &modes);
}

#[test]
fn a_pane_held_across_its_border_rings_as_simply_supported_and_may_still_slide() {
    let (a, h) = (0.4, 0.004);
    let on_border = |x: f64| x < 1e-9 || x > a - 1e-9;
    let (system, constraints) = system(&Shape::plate(a, a, h), a / 24.0, 1, |x| {
        [false, false, on_border(x.x) || on_border(x.y)]
    });
    let modes = held_modes(&system, &constraints, 12);
    assert_eq!(modes.rigid_motions, 3);
    // (π/2) √(D/ρh) ((m/a)² + (n/a)²).
    for (mode, squares) in [(0, 2.0), (1, 5.0), (2, 5.0), (3, 8.0)] {
        let reference = PI / 2.0 * plate_speed(h) * squares / (a * a);
        assert_near(
            modes.frequency(mode),
            reference,
            0.025,
            &format!("mode {mode}"),
        );
    }
    assert_orthonormal(&system, &constraints, &modes);
}

#[test]
fn a_clamped_plate_rings_as_such() {
    let (a, h) = (0.4, 0.004);
    let on_border = |x: f64| x < 1e-9 || x > a - 1e-9;
    let (system, constraints) = system(&Shape::plate(a, a, h), a / 24.0, 1, |x| {
        [on_border(x.x) || on_border(x.y); 3]
    });
    let modes = held_modes(&system, &constraints, 4);
    assert_eq!(modes.rigid_motions, 0);
    let coefficient = TAU * modes.frequency(0) * a * a / plate_speed(h);
    assert_near(coefficient, 35.99, 0.03, "clamped on four sides");
}

#[test]
fn the_dense_solver_agrees_with_lanczos_on_held_bodies() {
    let (system, constraints) = system(&Shape::plate(0.4, 0.4, 0.02), 0.08, 1, |x| {
        [x.x < 1e-9, false, x.x < 1e-9]
    });
    let left = system.unknowns() - constraints.unknowns().len();
    assert!(left > 800, "{left} unknowns would go to the dense solver");
    let few = held_modes(&system, &constraints, left / 5);
    let many = held_modes(&system, &constraints, left / 5 + 1);
    assert_eq!(few.rigid_motions, 1);
    for (a, b) in few.eigenvalues.iter().zip(&many.eigenvalues) {
        assert_near(*a, *b, 1e-7, "eigenvalue");
    }
}

#[test]
fn unknowns_can_be_taken_from_a_consistent_mass_too() {
    let body = Shape::block([0.1, 0.05, 0.04])
        .fracture_mesh(
            MeshSize {
                edge: 0.01,
                layers: 0,
            },
            1,
        )
        .unwrap();
    let cover = Cover::new(&body, 400).unwrap();
    let system = assemble_supported_cover(&cover, &GLASS, &body, &[]);
    let held: Vec<[bool; 3]> = system
        .positions
        .iter()
        .map(|x| [x.x < 0.0, x.x < 0.0, false])
        .collect();
    let constraints = Constraints::of_nodes(&system.positions, &held);
    for wanted in [8, system.unknowns() / 4] {
        let modes = held_modes(&system, &constraints, wanted);
        assert_eq!(modes.rigid_motions, 1, "it may still go along z");
        assert_orthonormal(&system, &constraints, &modes);
    }
}

/// A square bar from the origin along x as a mesh, so that it is covered by a lattice.
fn bar(length: f64, side: f64) -> Shape {
    let corner = |i: u32, bit: u32, size: f64| f64::from(i >> bit & 1) * size;
    let positions =
        (0..8).map(|i| DVec3::new(corner(i, 0, length), corner(i, 1, side), corner(i, 2, side)));
    let quads = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let mesh = InputMesh {
        positions: positions.collect(),
        triangles: quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
        ..InputMesh::default()
    };
    import_mesh(&mesh, &ImportOptions::default()).unwrap().shape
}

#[test]
fn a_cantilever_of_any_shape_rings_at_its_bending_frequency() {
    let glass = Material::preset("glass").unwrap();
    let free = 0.24;
    // A region that holds a face, one that holds a part, one that ends amid an element, and a coarse lattice.
    for (held, elements) in [
        (0.0, None),
        (0.02, None),
        (0.0133, None),
        (0.02, Some(0.012)),
    ] {
        let spec = BakeSpec {
            modes: 4,
            analysis: elements.map(|edge| MeshSize { edge, layers: 0 }),
            supports: vec![Support::clamped(Region::below(0, held))],
            ..BakeSpec::new("bar", bar(free + held, 0.02), glass.clone())
        };
        let Baked { asset, report } = bake_with(&spec, |_| {}).unwrap();
        assert_eq!(report.rigid_motions, 0);
        let reference = cantilever(&Elasticity::from(&glass), free, 0.02);
        for frequency in &report.frequencies[..2] {
            assert_near(
                *frequency,
                reference,
                0.02,
                &format!("{held} m, {elements:?}"),
            );
        }
        let along = || asset.fracture().positions.iter().map(|p| p.x);
        let limit = along().fold(f32::INFINITY, f32::min) + held as f32 + 1e-6;
        assert_eq!(
            asset.supported().len(),
            along().filter(|x| *x < limit).count()
        );
    }
}

#[test]
fn springs_that_hold_one_axis_leave_the_motions_across_it() {
    let spec = BakeSpec {
        modes: 4,
        supports: vec![Support {
            region: Region::below(0, 0.0),
            axes: [true, false, false],
        }],
        ..BakeSpec::new("bar", bar(0.1, 0.02), Material::preset("glass").unwrap())
    };
    let report = bake_with(&spec, |_| {}).unwrap().report;
    // Along y, along z, about x.
    assert_eq!(report.rigid_motions, 3);
    assert!(report.frequencies[0] > 1000.0, "{:?}", report.frequencies);
}
