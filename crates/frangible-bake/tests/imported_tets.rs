//! Bakes of tetrahedra from files, against the same elements assembled by themselves.

use frangible::Material;
use std::ops::ControlFlow;

use frangible_bake::eigen::lowest_modes;
use frangible_bake::fem::{Elasticity, Elements, assemble};
use frangible_bake::frangible_mesh::{TetGroup, TetInput};
use frangible_bake::{
    AnalysisChoice, BakeReport, BakeSpec, Baked, MeshSize, Region, Shape, Support, bake_with,
    import_tets,
};

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
    let Baked { asset, report } = bake_with(&spec, |_| {}).unwrap();
    asset.validate().unwrap();
    assert_eq!(
        asset.fracture().tets,
        input.tets,
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

#[test]
fn a_held_group_of_few_large_tetrahedra_is_clamped_by_the_lattice() {
    let (mut input, _) = rod();
    let nodes = (0..input.positions.len() as u32).filter(|&v| input.positions[v as usize].x < 1e-9);
    let wall: Vec<u32> = nodes.collect();
    let faces = frangible::internals::TetMesh::new(
        input.positions.iter().map(|p| p.as_vec3()).collect(),
        input.tets.clone(),
    )
    .boundary();
    let on_wall = |face: &[u32; 3]| face.iter().all(|v| wall.contains(v));
    input.faces = faces.iter().map(|f| f.0).filter(on_wall).collect();
    input.groups = vec![TetGroup {
        name: "wall".into(),
        dimension: 2,
        members: (0..input.faces.len() as u32).collect(),
    }];
    let shape = import_tets(&input, None, AnalysisChoice::Cover)
        .unwrap()
        .shape;
    let Shape::Tets(tets) = &shape else {
        panic!("no tetrahedra")
    };
    let groups = tets.named_parts();
    assert_eq!((groups.len(), groups[0].points.len()), (1, wall.len()));
    let spec = BakeSpec {
        modes: 8,
        groups,
        supports: vec![Support::clamped(Region::Group("wall".into()))],
        ..BakeSpec::new("rod", shape, Material::preset("glass").unwrap())
    };
    let Baked { asset, report } = bake_with(&spec, |_| {}).unwrap();
    assert_eq!(
        (asset.supported().len(), report.rigid_motions),
        (wall.len(), 0)
    );
    // Cantilever of length L, height h: 1.8751² √(E/12ρ) h / 2πL²; shear lowers it by some per cent at L/h = 4.
    let slender = 1.8751_f64.powi(2) * (70e9_f64 / (12.0 * 2500.0)).sqrt() * 0.02
        / (std::f64::consts::TAU * 0.08 * 0.08);
    let ratio = report.frequencies[0] / slender;
    assert!(
        (0.9..1.02).contains(&ratio),
        "{} Hz, slender beam {slender}",
        report.frequencies[0]
    );
}
