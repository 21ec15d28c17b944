//! The small bodies that the tests of `frangible` break are what their recipes here give. With `FRANGIBLE_WRITE_SEEDS=1` they are
//! written anew; `cargo xtask rebake` does that.

use std::fs;
use std::path::Path;

use frangible::glam::DVec3;
use frangible::internals::asset::SaveOptions;
use frangible::{Asset, Material};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};

/// Most bytes of a body: they are part of the repository and of the published package.
const MOST_BYTES: usize = 150_000;

/// A pane that is a wall everywhere, a block that is none, and a shelf that is held at one end.
fn recipes() -> [BakeSpec; 3] {
    let recipe = |name: &str, shape: Shape, material: &str, [elements, tets]: [f64; 2]| BakeSpec {
        modes: 24,
        analysis: Some(shape.size_for(elements).unwrap()),
        fracture: Some(shape.size_for(tets).unwrap()),
        ..BakeSpec::new(name, shape, Material::preset(material).unwrap())
    };
    let held = Region::Box {
        low: DVec3::splat(-1.0),
        high: DVec3::new(0.02, 1.0, 1.0),
    };
    [
        recipe(
            "pane",
            Shape::plate(0.2, 0.2, 0.004),
            "glass",
            [100.0, 600.0],
        ),
        recipe(
            "block",
            Shape::block([0.21, 0.1, 0.05]),
            "brick",
            [60.0, 700.0],
        ),
        BakeSpec {
            supports: vec![Support::clamped(held)],
            ..recipe(
                "shelf",
                Shape::block([0.3, 0.04, 0.01]),
                "glass",
                [60.0, 600.0],
            )
        },
    ]
}

#[test]
fn the_bodies_that_the_core_breaks_are_what_their_recipes_give() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../frangible/tests/bodies");
    if !folder.is_dir() {
        println!("skipped: {} is not here", folder.display());
        return;
    }
    for recipe in recipes() {
        let name = recipe.name.clone();
        let path = folder.join(format!("{name}.frangible"));
        let asset = bake(&recipe).unwrap();
        let bytes = asset.to_bytes_with(&SaveOptions::compact());
        println!(
            "{name}: {} tetrahedra, {} elements, {} analysis nodes, {} bytes",
            asset.fracture().tets.len(),
            asset.analysis().elements.len(),
            asset.analysis().nodes.len(),
            bytes.len()
        );
        assert!(bytes.len() <= MOST_BYTES, "{name}: {} bytes", bytes.len());
        if std::env::var_os("FRANGIBLE_WRITE_SEEDS").is_some() {
            fs::write(&path, &bytes).unwrap();
        }
        let stored = Asset::load(&path)
            .unwrap_or_else(|e| panic!("{e}: set FRANGIBLE_WRITE_SEEDS=1 to write {name} anew"));
        // Another processor rounds the modes otherwise, so the bytes need not be the same.
        assert_eq!(stored.fracture().tets, asset.fracture().tets, "{name}");
        assert_eq!(stored.supported(), asset.supported(), "{name}");
        assert_eq!(stored.modes().count(), asset.modes().count(), "{name}");
        for mode in 0..asset.modes().count() {
            let ratio = stored.modes().frequency(mode) / asset.modes().frequency(mode);
            assert!((ratio - 1.0).abs() < 1e-6, "{name}, mode {mode}: {ratio}");
        }
    }
}
