//! The embedding reproduces fields of the analysis mesh.

use frangible::glam::{DMat3, DVec3};
use frangible_bake::embed::Locator;
use frangible_bake::fem::{QuadraticMesh, shape_gradients, shape_values};
use frangible_bake::{BakeError, MeshSize, Shape};

fn analysis(shape: &Shape, edge: f64) -> QuadraticMesh {
    QuadraticMesh::new(&shape.analysis_mesh(MeshSize { edge, layers: 1 }).unwrap())
}

fn gradients_of_l(mesh: &QuadraticMesh, e: usize) -> [DVec3; 4] {
    let x = mesh.corners(e);
    let d = DMat3::from_cols(x[1] - x[0], x[2] - x[0], x[3] - x[0])
        .inverse()
        .transpose();
    [
        -(d.x_axis + d.y_axis + d.z_axis),
        d.x_axis,
        d.y_axis,
        d.z_axis,
    ]
}

/// Value at a point: shape functions at the closest point, then straight on along the gradient.
fn interpolate(
    mesh: &QuadraticMesh,
    field: &dyn Fn(DVec3) -> f64,
    at: (usize, [f64; 4], DVec3),
) -> f64 {
    let (e, l, offset) = at;
    let (values, gradients) = (
        shape_values(l),
        shape_gradients(l, &gradients_of_l(mesh, e)),
    );
    let node = |a: usize| field(mesh.positions[mesh.elements[e][a] as usize]);
    (0..10)
        .map(|a| node(a) * (values[a] + gradients[a].dot(offset)))
        .sum()
}

#[test]
fn a_linear_field_is_reproduced_to_rounding_inside_and_just_outside() {
    let shape = Shape::drinking_glass();
    let mesh = analysis(&shape, 0.0075);
    let locator = Locator::new(&mesh);
    let fine = shape
        .fracture_mesh(
            MeshSize {
                edge: 0.003,
                layers: 1,
            },
            1,
        )
        .unwrap();
    let field = |p: DVec3| 3.0 * p.x - 2.0 * p.y + 0.5 * p.z + 0.1;
    let mut outside = 0;
    for &p in &fine.positions {
        let at = locator.locate(p).unwrap();
        outside += usize::from(at.2 != DVec3::ZERO);
        assert!((interpolate(&mesh, &field, at) - field(p)).abs() < 1e-13);
    }
    assert!(
        outside > 100,
        "a rounded body has points outside its coarse mesh"
    );
}

#[test]
fn a_quadratic_field_is_reproduced_inside() {
    let shape = Shape::block([0.1, 0.08, 0.05]);
    let mesh = analysis(&shape, 0.025);
    let locator = Locator::new(&mesh);
    let fine = shape
        .fracture_mesh(
            MeshSize {
                edge: 0.01,
                layers: 0,
            },
            1,
        )
        .unwrap();
    let field = |p: DVec3| 30.0 * p.x * p.y - 20.0 * p.z * p.z + 5.0 * p.x * p.x - p.y * p.z + p.x;
    for &p in &fine.positions {
        let at = locator.locate(p).unwrap();
        assert!((interpolate(&mesh, &field, at) - field(p)).abs() < 1e-13);
    }
}

#[test]
fn a_point_far_outside_is_refused() {
    let locator = Locator::new(&analysis(&Shape::block([0.1; 3]), 0.025));
    for p in [
        DVec3::new(0.05, 0.05, 0.15),
        DVec3::splat(-1.0),
        DVec3::splat(f64::NAN),
    ] {
        let error = locator.locate(p).unwrap_err();
        assert!(matches!(error, BakeError::OutsideAnalysisMesh { .. }));
        assert!(error.to_string().contains("refine"));
    }
    // A millimetre out, the nearest point is straight below.
    let (_, _, offset) = locator.locate(DVec3::new(0.05, 0.04, 0.101)).unwrap();
    assert!(offset.distance(DVec3::new(0.0, 0.0, 0.001)) < 1e-12);
}
