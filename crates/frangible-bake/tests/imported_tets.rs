//! Bakes of tetrahedra from files, against the same elements assembled by themselves.

use frangible::Material;
use std::ops::ControlFlow;

use frangible_bake::eigen::lowest_modes;
use frangible_bake::fem::{Elasticity, Elements, assemble};
use frangible_bake::frangible_mesh::TetInput;
use frangible_bake::{AnalysisChoice, BakeReport, BakeSpec, MeshSize, Shape, bake, import_tets};

/// A rod of tetrahedra.
fn rod() -> (TetInput, frangible_bake::BodyMesh) {
    let size = MeshSize {
        edge: 0.01,
        layers: 0,
    };
    let mesh = Shape::block([0.08, 0.03, 0.02])
        .analysis_mesh(size)
        .unwrap();
    let input = TetInput {
        positions: mesh.positions.clone(),
        tets: mesh.tets.clone(),
        ..TetInput::default()
    };
    (input, mesh)
}

fn baked(input: &TetInput, choice: AnalysisChoice, quadratic: bool) -> BakeReport {
    let mut shape = import_tets(input, None, choice).unwrap().shape;
    if let Shape::Tets(tets) = &mut shape {
        tets.quadratic = quadratic;
    }
    let spec = BakeSpec {
        modes: 8,
        ..BakeSpec::new("rod", shape, Material::preset("glass").unwrap())
    };
    let (asset, report) = bake(&spec, &mut |_| {}).unwrap();
    asset.validate().unwrap();
    assert_eq!(
        asset.fracture.tets, input.tets,
        "the tetrahedra stay as they are"
    );
    report
}

#[test]
fn own_linear_elements_give_the_frequencies_of_their_own_assembly() {
    let (input, mesh) = rod();
    let material = Elasticity::from(&Material::preset("glass").unwrap());
    let system = assemble(&mesh.positions, Elements::Linear(&mesh.tets), &material);
    let direct = lowest_modes(&system, 8, &mut |_| ControlFlow::Continue(())).unwrap();
    let report = baked(&input, AnalysisChoice::Own, false);
    assert_eq!(report.unknowns, 3 * mesh.positions.len());
    for (i, &found) in report.frequencies.iter().enumerate() {
        assert!((found / direct.frequency(i) - 1.0).abs() < 1e-6, "mode {i}");
    }
}

#[test]
fn quadratic_elements_and_the_cover_agree_and_linear_ones_are_stiffer() {
    let (input, _) = rod();
    let own = baked(&input, AnalysisChoice::Auto, true);
    let cover = baked(&input, AnalysisChoice::Auto, false);
    let linear = baked(&input, AnalysisChoice::Own, false);
    // Both are converged to about a per cent at this size.
    assert!((own.frequencies[0] / cover.frequencies[0] - 1.0).abs() < 0.02);
    assert!(linear.frequencies[0] > 1.02 * own.frequencies[0]);
}
