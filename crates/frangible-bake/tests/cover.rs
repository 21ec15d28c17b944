//! Elements that merely cover a body: against closed forms, conforming meshes and their own invariants.

use crate::common::{assert_near, free_modes, norm};
use frangible::glam::{DQuat, DVec3};
use frangible_bake::eigen::{Modes, residual, rigid_motions};
use frangible_bake::fem::{
    Cover, Elasticity, Elements, QuadraticMesh, System, assemble, assemble_cover, shape_values,
};
use frangible_bake::{BakeError, BodyMesh, MeshSize, Shape};

const GLASS: Elasticity = Elasticity {
    youngs_modulus: 70e9,
    poisson_ratio: 0.23,
    density: 2500.0,
};

/// A fine mesh, turned so that nothing is aligned with the lattice.
fn body(shape: &Shape, edge: f64, layers: usize) -> BodyMesh {
    turned(shape.fracture_mesh(MeshSize { edge, layers }, 1).unwrap())
}

fn turned(mut body: BodyMesh) -> BodyMesh {
    let turn = DQuat::from_axis_angle(DVec3::new(0.3, -0.7, 0.5).normalize(), 0.83);
    for p in &mut body.positions {
        *p = turn * *p;
    }
    body
}

fn covered(body: &BodyMesh, elements: usize, material: &Elasticity) -> System {
    assemble_cover(&Cover::new(body, elements).unwrap(), material)
}

fn frequencies(modes: &Modes) -> Vec<f64> {
    (0..modes.eigenvalues.len())
        .map(|i| modes.frequency(i))
        .collect()
}

/// Bricks of `size` at the given places of a grid, six tetrahedra each.
fn bricks(places: &[[u32; 3]], size: [f64; 3]) -> BodyMesh {
    let mut corners: Vec<[u32; 3]> = places
        .iter()
        .flat_map(|&[i, j, k]| {
            (0..8).map(move |c| [i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)])
        })
        .collect();
    corners.sort_unstable();
    corners.dedup();
    let number = |c: [u32; 3]| corners.binary_search(&c).unwrap() as u32;
    let mut tets = Vec::new();
    for &place in places {
        // Paths from the lowest corner to the highest, one axis after another.
        for (order, odd) in [
            ([0, 1, 2], false),
            ([1, 2, 0], false),
            ([2, 0, 1], false),
            ([0, 2, 1], true),
            ([2, 1, 0], true),
            ([1, 0, 2], true),
        ] {
            let mut at = place;
            let mut tet = [number(at); 4];
            for (corner, axis) in order.into_iter().enumerate() {
                at[axis] += 1;
                tet[corner + 1] = number(at);
            }
            if odd {
                tet.swap(2, 3);
            }
            tets.push(tet);
        }
    }
    BodyMesh {
        positions: corners
            .iter()
            .map(|c| DVec3::from_array([0, 1, 2].map(|k| f64::from(c[k]) * size[k])))
            .collect(),
        cell_of_tet: vec![0; tets.len()],
        tets,
        cells: 1,
    }
}

/// Two prongs, 60 × 10 × 2 mm, one millimetre apart, on a foot 5 mm long; `along` bricks to 5 mm.
fn fork(along: u32, across: u32) -> BodyMesh {
    let mut places = Vec::new();
    for i in 0..13 * along {
        for j in 0..across {
            places.extend((0..5).filter(|&k| i < along || k != 2).map(|k| [i, j, k]));
        }
    }
    bricks(
        &places,
        [0.005 / f64::from(along), 0.01 / f64::from(across), 0.001],
    )
}

#[test]
fn the_mass_is_that_of_the_body_and_rigid_motions_cost_nothing() {
    let body = body(&Shape::bowl(), 0.006, 1);
    let system = covered(&body, 800, &GLASS);
    let mass: f64 = system.mass.row_sums().iter().sum();
    // The empty part of the elements has a hundred-millionth of the density.
    assert_near(mass, GLASS.density * body.volume(), 1e-6, "mass");
    for motion in rigid_motions(&system) {
        let scale = norm(&system.multiply_magnitudes(&motion));
        assert!(norm(&system.multiply(&motion)) < 1e-13 * scale);
    }
    // Inertia about x through the centre of mass, against the sum over the fine tetrahedra.
    let spin = &rigid_motions(&system)[3];
    let inertia: f64 = spin
        .iter()
        .zip(system.mass.multiply(spin))
        .map(|(x, y)| x * y)
        .sum();
    let corners = (0..body.tets.len()).map(|t| body.corners(t));
    let exact = frangible::internals::MassProperties::of_tetrahedra(GLASS.density, corners);
    assert_near(inertia, exact.inertia.x_axis.x, 1e-6, "moment of inertia");
}

#[test]
fn modes_are_mass_orthonormal_and_solve_the_problem() {
    let system = covered(&body(&Shape::drinking_glass(), 0.005, 1), 1000, &GLASS);
    let modes = free_modes(&system, 60);
    let rigid = rigid_motions(&system);
    for i in 0..60 {
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
        for motion in &rigid {
            assert!(product(motion).abs() < 1e-9 * norm(motion));
        }
        let (residual, limit) = residual(&system, modes.eigenvalues[i], modes.shape(i));
        assert!(residual <= limit, "mode {i}: {residual} above {limit}");
    }
    assert!(modes.eigenvalues.windows(2).all(|w| w[0] <= w[1]));
    // Seventh and not null.
    assert!(modes.eigenvalues[0] > 1e6);
}

#[test]
fn lanczos_agrees_with_the_dense_solver() {
    let system = covered(&body(&Shape::plate(0.4, 0.4, 0.02), 0.03, 2), 150, &GLASS);
    let n = system.unknowns();
    assert!(n > 800, "{n} unknowns would go to the dense solver");
    let (few, many) = (free_modes(&system, n / 5), free_modes(&system, n / 5 + 1));
    for (i, (a, b)) in few.eigenvalues.iter().zip(&many.eigenvalues).enumerate() {
        assert_near(*a, *b, 1e-7, &format!("eigenvalue {i}"));
    }
}

#[test]
fn frequencies_of_a_thin_walled_glass_fall_towards_those_of_a_conforming_mesh() {
    let glass = Shape::drinking_glass();
    let size = MeshSize {
        edge: 0.707 * glass.analysis_size().unwrap().edge,
        layers: 1,
    };
    let mesh = QuadraticMesh::new(&glass.analysis_mesh(size).unwrap());
    let conforming = assemble(&mesh.positions, Elements::Quadratic(&mesh.elements), &GLASS);
    // Within 0.9 % of the modes of its limit, but for one at 1.4 %.
    let conforming = frequencies(&free_modes(&conforming, 20));
    let fine = body(&glass, 0.0035, 1);
    let mut before = vec![f64::INFINITY; 20];
    for elements in [1000, 2500, 6000] {
        let found = frequencies(&free_modes(&covered(&fine, elements, &GLASS), 20));
        for i in 0..20 {
            assert!(found[i] < before[i], "mode {i} at {elements} elements");
            // Nor do they fall too far: a Ritz method comes from above.
            assert!(found[i] > 0.98 * conforming[i], "mode {i}");
        }
        before = found;
    }
    for i in 0..20 {
        assert_near(before[i], conforming[i], 0.025, &format!("mode {i}"));
    }
}

#[test]
fn prongs_that_share_lattice_cells_ring_as_separate_prongs() {
    let fine = turned(fork(4, 8));
    let cover = Cover::new(&fine, 1500).unwrap();
    assert!(
        cover.side > 0.003,
        "cells must span the gap: {}",
        cover.side
    );
    let conforming = QuadraticMesh::new(&fork(1, 2));
    let conforming = free_modes(
        &assemble(
            &conforming.positions,
            Elements::Quadratic(&conforming.elements),
            &GLASS,
        ),
        4,
    );
    let found = free_modes(&assemble_cover(&cover, &GLASS), 4);
    // The cell at the root of the gap bridges it, which shortens the prongs a little.
    // One bar five millimetres thick would start at thirteen times the frequency.
    for i in 0..4 {
        assert_near(
            found.frequency(i),
            conforming.frequency(i),
            0.05,
            &format!("mode {i}"),
        );
    }
}

#[test]
fn walls_that_are_not_joined_share_no_nodes() {
    let along = 2;
    let fine = fork(along, 4);
    let cover = Cover::new(&fine, 600).unwrap();
    let mut owner = vec![0; cover.mesh.positions.len()];
    let mut near = 0;
    for (t, &element) in cover.element_of_tet.iter().enumerate() {
        let centroid = fine.corners(t).iter().sum::<DVec3>() / 4.0;
        // Beyond the foot by more than an element.
        if centroid.x > 0.005 + 2.0 * cover.side {
            let prong = if centroid.z < 0.0025 { 1 } else { 2 };
            for node in cover.mesh.elements[element as usize] {
                let owner = &mut owner[node as usize];
                assert!(*owner == 0 || *owner == prong, "tetrahedron {t}");
                *owner = prong;
            }
            near += 1;
        }
    }
    assert!(near > 1000, "{near} tetrahedra of the prongs looked at");
    // The same places are taken twice.
    let mut corners: Vec<[u64; 3]> = (0..cover.mesh.elements.len())
        .map(|e| {
            cover
                .mesh
                .corners(e)
                .iter()
                .sum::<DVec3>()
                .to_array()
                .map(f64::to_bits)
        })
        .collect();
    let elements = corners.len();
    corners.sort_unstable();
    corners.dedup();
    assert!(
        corners.len() + 50 < elements,
        "{} of {elements}",
        corners.len()
    );
}

#[test]
fn a_quadratic_field_is_reproduced_by_the_embedding() {
    let fine = body(&Shape::drinking_glass(), 0.005, 1);
    let cover = Cover::new(&fine, 800).unwrap();
    let field = |p: DVec3| 30.0 * p.x * p.y - 20.0 * p.z * p.z + 5.0 * p.x * p.x - p.y * p.z + p.x;
    let embedding = cover.embedding(&fine);
    let centroids = (0..fine.tets.len()).map(|t| fine.corners(t).iter().sum::<DVec3>() / 4.0);
    let points = fine.positions.iter().copied().chain(centroids);
    for (p, at) in points.zip(embedding.nodes.iter().chain(&embedding.tets)) {
        let nodes = cover.mesh.elements[at.element as usize];
        let weights = shape_values(at.barycentric.map(f64::from));
        let value: f64 = (0..10)
            .map(|a| weights[a] * field(cover.mesh.positions[nodes[a] as usize]))
            .sum();
        // Barycentric coordinates are stored in f32.
        assert!((value - field(p)).abs() < 1e-7, "{value} at {p}");
        assert!(at.barycentric.iter().all(|&l| l > -0.2), "{at:?}");
        assert_eq!(at.offset, frangible::glam::Vec3::ZERO);
    }
}

#[test]
fn the_number_of_elements_is_about_the_one_wanted() {
    let fine = body(&Shape::block([0.1, 0.07, 0.05]), 0.01, 0);
    for wanted in [100, 1000, 3000] {
        let found = Cover::new(&fine, wanted).unwrap().mesh.elements.len();
        assert_near(found as f64, wanted as f64, 0.1, "elements");
    }
}

#[test]
fn the_same_body_gives_the_same_bits() {
    let fine = body(&Shape::bowl(), 0.008, 1);
    let [a, b] = [(), ()].map(|()| covered(&fine, 500, &GLASS));
    assert_eq!(a.positions, b.positions);
    assert_eq!(a.stiffness.val(), b.stiffness.val());
    assert_eq!(free_modes(&a, 20).shapes, free_modes(&b, 20).shapes);
}

#[test]
fn bodies_that_cannot_be_covered_are_errors() {
    let good = body(&Shape::block([0.1; 3]), 0.05, 0);
    assert!(matches!(
        Cover::new(&good, 0),
        Err(BakeError::NotPositive { .. })
    ));
    assert!(matches!(
        Cover::new(&BodyMesh::default(), 100),
        Err(BakeError::NotPositive { .. })
    ));
    let (mut missing, mut infinite, mut turned) = (good.clone(), good.clone(), good.clone());
    missing.tets[3][2] = 1_000_000;
    infinite.positions[0].x = f64::NAN;
    turned.tets[5].swap(0, 1);
    for bad in [missing, infinite, turned] {
        assert!(matches!(
            Cover::new(&bad, 100),
            Err(BakeError::Inverted { .. })
        ));
    }
}

#[test]
fn a_single_tetrahedron_takes_as_many_elements_as_it_bears() {
    let one = |thickness: f64| BodyMesh {
        positions: vec![
            DVec3::ZERO,
            DVec3::X,
            thickness * DVec3::Y,
            thickness * DVec3::Z,
        ],
        tets: vec![[0, 1, 2, 3]],
        cell_of_tet: vec![0],
        cells: 1,
    };
    for wanted in [1, 100] {
        let system = covered(&one(1.0), wanted, &GLASS);
        let mass: f64 = system.mass.row_sums().iter().sum();
        // An element much larger than the body weighs a little itself.
        assert_near(mass, GLASS.density / 6.0, 1e-4, "mass");
        free_modes(&system, 3);
    }
    // A needle is not cut into thousands of slices.
    let needle = Cover::new(&one(1e-6), 1000).unwrap();
    assert!(needle.mesh.elements.len() < 1000);
}
