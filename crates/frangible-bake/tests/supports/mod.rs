//! Bodies that are held: their modes against closed forms, and their held nodes.

mod assets;
mod modes;

use frangible::Material;
use frangible::glam::DVec3;
use frangible_bake::eigen::Constraints;
use frangible_bake::fem::{Elasticity, Elements, QuadraticMesh, System, assemble};
use frangible_bake::{BakeSpec, MeshSize, Region, Shape, Support, bake_with};

const GLASS: Elasticity = Elasticity {
    youngs_modulus: 70e9,
    poisson_ratio: 0.3,
    density: 2500.0,
};

/// Quadratic elements, and the nodes for which `held` says along which axes they are held.
fn system(
    shape: &Shape,
    edge: f64,
    layers: usize,
    held: impl Fn(DVec3) -> [bool; 3],
) -> (System, Constraints) {
    let mesh = QuadraticMesh::new(&shape.analysis_mesh(MeshSize { edge, layers }).unwrap());
    let system = assemble(&mesh.positions, Elements::Quadratic(&mesh.elements), &GLASS);
    let held: Vec<[bool; 3]> = mesh.positions.iter().map(|&x| held(x)).collect();
    let constraints = Constraints::of_nodes(&mesh.positions, &held);
    (system, constraints)
}

fn small_plate(supports: Vec<Support>) -> BakeSpec {
    let glass = Material::preset("glass").unwrap();
    BakeSpec {
        modes: 4,
        analysis: Some(MeshSize {
            edge: 0.05,
            layers: 1,
        }),
        fracture: Some(MeshSize {
            edge: 0.02,
            layers: 1,
        }),
        supports,
        ..BakeSpec::new("plate", Shape::plate(0.2, 0.2, 0.01), glass)
    }
}

#[test]
fn a_plate_held_along_z_keeps_three_motions() {
    let mut spec = small_plate(vec![Support {
        region: Region::below(2, 0.0),
        axes: [false, false, true],
    }]);
    let report = bake_with(&spec, |_| {}).unwrap().report;
    // Along x, along y, about z.
    assert_eq!(report.rigid_motions, 3);
    spec.supports[0].axes = [true; 3];
    let report = bake_with(&spec, |_| {}).unwrap().report;
    assert_eq!(report.rigid_motions, 0);
}
