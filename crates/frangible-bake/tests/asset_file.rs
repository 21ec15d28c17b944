//! A baked asset survives its file.

use frangible::internals::TetMesh;
use frangible::{Asset, Material};
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};

#[test]
fn a_baked_asset_comes_back_bit_for_bit() {
    let material = Material::preset("glass").unwrap();
    let mut spec = BakeSpec::new("glass", Shape::drinking_glass(), material);
    let size = |edge| Some(MeshSize { edge, layers: 1 });
    (spec.analysis, spec.fracture) = (size(0.011), size(0.004));
    spec.modes = 12;
    let asset = bake(&spec).unwrap();

    let bytes = asset.to_bytes();
    let back = Asset::from_bytes(&bytes).unwrap();
    // Debug shows every number with all its digits and signs.
    assert!(format!("{asset:?}") == format!("{back:?}"));
    assert!(bytes == back.to_bytes());
    let rebuilt = TetMesh::new(
        back.fracture().positions.clone(),
        back.fracture().tets.clone(),
    );
    assert!(rebuilt.neighbours == back.fracture().neighbours);
}
