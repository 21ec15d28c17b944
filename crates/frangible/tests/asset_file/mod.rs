//! Assets as files: they come back as they were, and nothing hostile gets in.

use std::fs;
use std::path::{Path, PathBuf};

use frangible::glam::Vec3;
use frangible::internals::AssetFileError;
use frangible::internals::asset::{
    AssetParts, Embedding, FORMAT_VERSION, RenderSurface, SaveOptions, SurfaceWalls, seal,
};
use frangible::{Asset, InputError};

use crate::common::{Size, drawn_surface, synthetic_asset};

mod arrays;
mod disk;
mod hostile;

const HEADER: usize = 32;
const ENTRY: usize = 24;

fn tiny() -> Asset {
    let asset = synthetic_asset(&Size {
        cubes: 1,
        analysis_nodes: 10,
        elements: 2,
        modes: 3,
    });
    let mut asset = Asset::from_parts(AssetParts {
        supported: vec![1, 4, 7],
        render: Some(drawn_surface()),
        ..asset.into_parts()
    });
    let walls = |number: f32| {
        (0..12)
            .map(|t| if t < 8 { number } else { f32::INFINITY })
            .collect()
    };
    asset.parts_mut().surface.walls = SurfaceWalls {
        thickness: walls(0.004),
        stiffening: walls(0.0),
        margin: walls(0.02),
    };
    asset.parts_mut().modes.residual_modes = 1;
    asset
}

/// Debug shows every number with all its digits and signs, and knows nothing of the format.
fn same(a: &Asset, b: &Asset) -> bool {
    format!("{a:?}") == format!("{b:?}")
}

fn section_problem(bytes: &[u8]) -> String {
    match Asset::from_bytes(bytes).unwrap_err() {
        AssetFileError::Section { name, problem } => format!("{name}: {problem}"),
        other => panic!("{other}"),
    }
}

fn put(bytes: &mut [u8], at: usize, value: &[u8]) {
    bytes[at..at + value.len()].copy_from_slice(value);
    seal(bytes);
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

fn u64_at(bytes: &[u8], at: usize) -> usize {
    u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize
}

/// Where the entry of a section stands in the table.
fn entry_of(bytes: &[u8], id: u32) -> usize {
    let count = u32_at(bytes, 20) as usize;
    (0..count)
        .map(|i| HEADER + i * ENTRY)
        .find(|&at| u32_at(bytes, at) == id)
        .unwrap()
}

/// Numbers of the sections.
fn ids(bytes: &[u8]) -> Vec<u32> {
    let count = u32_at(bytes, 20) as usize;
    (0..count)
        .map(|i| u32_at(bytes, HEADER + i * ENTRY))
        .collect()
}

/// Where the data of a section starts.
fn data_of(bytes: &[u8], id: u32) -> usize {
    u64_at(bytes, entry_of(bytes, id) + 8)
}

#[test]
fn an_asset_comes_back_bit_for_bit() {
    let whole = tiny();
    let free = Asset::from_parts(AssetParts {
        supported: Vec::new(),
        ..whole.clone().into_parts()
    });
    let plain = Asset::from_parts(AssetParts {
        render: None,
        ..free.clone().into_parts()
    });
    let bare = Asset::from_parts(AssetParts {
        render: Some(RenderSurface::default()),
        ..whole.clone().into_parts()
    });
    for asset in [whole, free, plain, bare] {
        let bytes = asset.to_bytes();
        let back = Asset::from_bytes(&bytes).unwrap();
        assert!(same(&asset, &back));
        assert_eq!(bytes, back.to_bytes());
    }
}

#[test]
fn a_rebuilt_adjacency_is_the_stored_one() {
    let asset = Asset::from_bytes(&tiny().to_bytes()).unwrap();
    let rebuilt = frangible::internals::TetMesh::new(
        asset.fracture().positions.clone(),
        asset.fracture().tets.clone(),
    );
    assert_eq!(rebuilt.neighbours, asset.fracture().neighbours);
}

#[test]
fn the_layout_is_the_documented_one() {
    let asset = tiny();
    let bytes = asset.to_bytes();
    assert_eq!(&bytes[..8], b"FRANGIBL");
    assert_eq!(u32_at(&bytes, 16), FORMAT_VERSION);
    assert_eq!(u64_at(&bytes, 24), bytes.len());
    let number = |id, row: usize, column: usize, columns: usize| {
        f32::from_bits(u32_at(
            &bytes,
            data_of(&bytes, id) + 4 * (row * columns + column),
        ))
    };
    assert_eq!(number(16, 2, 1, 3), asset.fracture().positions[2].y);
    assert_eq!(
        number(50, 1, 10, 12),
        asset.analysis().barycentric_gradients[1][3].y
    );
    assert_eq!(
        u32_at(&bytes, data_of(&bytes, 17) + 4 * 7),
        asset.fracture().tets[1][3]
    );
    let density = f64::from_bits(u64_at(&bytes, data_of(&bytes, 3) + 8 * 2) as u64);
    assert_eq!(density, asset.material().density);
}

#[test]
fn what_a_body_lacks_its_file_lacks() {
    let whole = tiny();
    let mut bare = Asset::from_parts(AssetParts {
        supported: Vec::new(),
        ..whole.clone().into_parts()
    });
    bare.parts_mut().surface.walls = SurfaceWalls::default();
    let bytes = bare.to_bytes();
    for id in [36, 37, 38, 99] {
        let has = |bytes: &[u8]| ids(bytes).contains(&id);
        assert!(has(&whole.to_bytes()) && !has(&bytes), "section {id}");
    }
    assert!(same(&Asset::from_bytes(&bytes).unwrap(), &bare));
    let mut empty = whole.to_bytes();
    let at = entry_of(&empty, 99) + 16;
    put(&mut empty, at, &0_u64.to_le_bytes());
    assert!(section_problem(&empty).contains("supported nodes: is empty"));
    for id in [36, 37, 38, 85] {
        let mut torn = whole.to_bytes();
        let at = entry_of(&torn, id);
        put(&mut torn, at, &9999_u32.to_le_bytes());
        assert!(
            section_problem(&torn).ends_with("is missing"),
            "section {id}"
        );
    }
}

#[test]
fn a_compact_asset_comes_back_rounded_to_half_precision_and_otherwise_bit_for_bit() {
    let free = Asset::from_parts(AssetParts {
        supported: Vec::new(),
        ..tiny().into_parts()
    });
    let mut still = tiny();
    still.parts_mut().modes.shapes.fill(0.0);
    let mut wide = tiny();
    for (i, x) in wide.parts_mut().modes.shapes.iter_mut().enumerate() {
        *x *= [1e30, 1.0, 1e-30][i % 3];
    }
    for asset in [tiny(), free, still, wide] {
        let bytes = asset.to_bytes_with(&SaveOptions::compact());
        assert!(ids(&bytes).contains(&83) && !ids(&bytes).contains(&81));
        let back = Asset::from_bytes(&bytes).unwrap();
        assert!(same(&back, &asset.clone().with_compact_shapes()));
        // Rounding twice is rounding once.
        assert_eq!(back.to_bytes_with(&SaveOptions::compact()), bytes);
        assert!(same(&back, &back.clone().with_compact_shapes()));
        // Half of a unit in the last of eleven bits, or of the smallest step: 2⁻³⁹ of the largest number, at most.
        for mode in 0..3 {
            let column = |a: &Asset| {
                a.modes().shapes[mode..]
                    .iter()
                    .step_by(3)
                    .copied()
                    .collect()
            };
            let (exact, rounded): (Vec<f32>, Vec<f32>) = (column(&asset), column(&back));
            let largest = exact.iter().fold(0.0_f32, |m, x| m.max(x.abs()));
            for (x, y) in exact.iter().zip(&rounded) {
                let allowed = (x.abs() / 2048.0).max(largest * 2_f32.powi(-38));
                assert!((x - y).abs() <= allowed, "{x} became {y}");
            }
        }
    }
}

#[test]
fn offsets_that_are_all_zero_are_left_out() {
    let mut unmoved = tiny();
    let Embedding { tets, nodes } = unmoved.parts_mut().embedding;
    for point in tets.iter_mut().chain(nodes.iter_mut()) {
        point.offset = Vec3::ZERO;
    }
    let mut nearly = unmoved.clone();
    nearly.parts_mut().embedding.nodes[1].offset.y = -0.0;
    for options in [SaveOptions::default(), SaveOptions::compact()] {
        let written = |asset: &Asset| asset.to_bytes_with(&options);
        let (bytes, with_offsets) = (written(&unmoved), written(&nearly));
        assert!(!ids(&bytes).contains(&66) && !ids(&bytes).contains(&69));
        assert!(!ids(&with_offsets).contains(&66) && ids(&with_offsets).contains(&69));
        for (bytes, asset) in [(&bytes, &unmoved), (&with_offsets, &nearly)] {
            let back = Asset::from_bytes(bytes).unwrap();
            let expected = match options.compact {
                true => asset.clone().with_compact_shapes(),
                false => asset.clone(),
            };
            assert!(same(&back, &expected));
        }
    }
}

#[test]
fn sections_of_unknown_number_are_skipped() {
    let asset = Asset::from_parts(AssetParts {
        render: None,
        ..tiny().into_parts()
    });
    let bytes = asset.to_bytes();
    // Renaming the render sections of a file is adding sections nobody knows, of any kind.
    let mut newer = tiny().to_bytes();
    for id in 112..120 {
        let at = entry_of(&newer, id);
        put(&mut newer, at, &(id + 1_000_000).to_le_bytes());
        put(&mut newer, at + 4, &[0xab; 4]);
    }
    assert_eq!(Asset::from_bytes(&newer).unwrap().to_bytes(), bytes);
}
