//! The assets that fuzzing starts from follow the format. With `FRANGIBLE_WRITE_SEEDS=1` they are written anew.

use std::fs;
use std::path::Path;

use frangible::Asset;
use frangible::glam::Vec3;
use frangible::internals::asset::{AssetParts, Embedding, SaveOptions, SurfaceWalls};

use crate::common::{Size, drawn_surface, synthetic_asset};

fn seeds() -> [(&'static str, Asset, SaveOptions); 5] {
    let asset = |cubes, analysis_nodes, elements, modes| {
        synthetic_asset(&Size {
            cubes,
            analysis_nodes,
            elements,
            modes,
        })
    };
    let mut drawn = Asset::from_parts(AssetParts {
        render: Some(drawn_surface()),
        ..asset(1, 10, 1, 2).into_parts()
    });
    let walls = |number: f32| vec![number; drawn.surface().triangles.len()];
    drawn.parts_mut().surface.walls = SurfaceWalls {
        thickness: walls(0.004),
        stiffening: walls(0.0),
        margin: walls(f32::INFINITY),
    };
    drawn.parts_mut().modes.residual_modes = 1;
    // Where no point has an offset, a compact file has none either.
    let mut unmoved = asset(1, 10, 1, 1).with_compact_shapes();
    let Embedding { tets, nodes } = unmoved.parts_mut().embedding;
    let points = tets.iter_mut().chain(nodes.iter_mut());
    points.for_each(|point| point.offset = Vec3::ZERO);
    [
        ("unmoved", unmoved, SaveOptions::compact()),
        ("least", asset(1, 10, 1, 1), SaveOptions::default()),
        ("drawn", drawn, SaveOptions::default()),
        ("cubes", asset(2, 12, 3, 2), SaveOptions::default()),
        (
            "compact",
            asset(1, 10, 1, 2).with_compact_shapes(),
            SaveOptions::compact(),
        ),
    ]
}

#[test]
fn the_assets_that_fuzzing_starts_from_can_be_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/read_asset");
    if !folder.is_dir() {
        println!("skipped: {} is not here", folder.display());
        return;
    }
    for (name, asset, options) in seeds() {
        let path = folder.join(name);
        if std::env::var_os("FRANGIBLE_WRITE_SEEDS").is_some() {
            fs::write(&path, asset.to_bytes_with(&options)).unwrap();
        }
        let read = Asset::from_bytes(&fs::read(&path).unwrap())
            .unwrap_or_else(|e| panic!("{e}: set FRANGIBLE_WRITE_SEEDS=1 to write {name} anew"));
        assert_eq!(format!("{read:?}"), format!("{asset:?}"), "{name}");
    }
}
