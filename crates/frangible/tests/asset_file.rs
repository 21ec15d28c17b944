//! Assets as files: they come back as they were, and nothing hostile gets in.

use std::fs;
use std::path::{Path, PathBuf};

use frangible::glam::Vec3;
use frangible::internals::AssetFileError;
use frangible::internals::asset::{
    Embedding, FORMAT_VERSION, RenderSurface, SaveOptions, SurfaceWalls, seal,
};
use frangible::{Asset, InputError};

mod common;
use common::{Size, drawn_surface, synthetic_asset};

const HEADER: usize = 32;
const ENTRY: usize = 24;

fn tiny() -> Asset {
    let asset = synthetic_asset(&Size {
        cubes: 1,
        analysis_nodes: 10,
        elements: 2,
        modes: 3,
    });
    let mut asset = Asset {
        supported: vec![1, 4, 7],
        render: Some(drawn_surface()),
        ..asset
    };
    let walls = |number: f32| {
        (0..12)
            .map(|t| if t < 8 { number } else { f32::INFINITY })
            .collect()
    };
    asset.surface.walls = SurfaceWalls {
        thickness: walls(0.004),
        stiffening: walls(0.0),
        margin: walls(0.02),
    };
    asset.modes.residual_modes = 1;
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

/// A folder of this test's own, removed in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        entries
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn an_asset_comes_back_bit_for_bit() {
    let whole = tiny();
    let free = Asset {
        supported: Vec::new(),
        ..whole.clone()
    };
    let plain = Asset {
        render: None,
        ..free.clone()
    };
    let bare = Asset {
        render: Some(RenderSurface::default()),
        ..whole.clone()
    };
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
        asset.fracture.positions.clone(),
        asset.fracture.tets.clone(),
    );
    assert_eq!(rebuilt.neighbours, asset.fracture.neighbours);
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
    assert_eq!(number(16, 2, 1, 3), asset.fracture.positions[2].y);
    assert_eq!(
        number(50, 1, 10, 12),
        asset.analysis.barycentric_gradients[1][3].y
    );
    assert_eq!(
        u32_at(&bytes, data_of(&bytes, 17) + 4 * 7),
        asset.fracture.tets[1][3]
    );
    let density = f64::from_bits(u64_at(&bytes, data_of(&bytes, 3) + 8 * 2) as u64);
    assert_eq!(density, asset.material.density);
}

#[test]
fn any_changed_byte_is_an_error() {
    let bytes = tiny().to_bytes();
    for at in 0..bytes.len() {
        for flip in [0x01, 0x80, 0xff] {
            let mut changed = bytes.clone();
            changed[at] ^= flip;
            assert!(
                Asset::from_bytes(&changed).is_err(),
                "byte {at} ^ {flip:#x}"
            );
        }
    }
}

#[test]
fn a_changed_byte_under_a_true_checksum_is_an_error_or_a_sound_asset() {
    let bytes = tiny().to_bytes();
    let (mut errors, mut sound) = (0, 0);
    for at in 0..bytes.len() {
        for flip in [0x01, 0x80, 0xff] {
            let mut changed = bytes.clone();
            changed[at] ^= flip;
            seal(&mut changed);
            match Asset::from_bytes(&changed) {
                Err(_) => errors += 1,
                Ok(asset) => {
                    let back = Asset::from_bytes(&asset.to_bytes()).unwrap();
                    assert!(same(&asset, &back), "byte {at} ^ {flip:#x}");
                    sound += 1;
                }
            }
        }
    }
    assert!(errors > 0 && sound > 0, "{errors} errors, {sound} sound");
}

#[test]
fn any_shortened_or_lengthened_file_is_an_error() {
    let mut bytes = tiny().to_bytes();
    let expected = bytes.len() as u64;
    for found in 1..bytes.len() {
        match Asset::from_bytes(&bytes[..found]).unwrap_err() {
            AssetFileError::Truncated {
                expected: e,
                found: f,
            } => {
                assert!(
                    e == if found < HEADER {
                        HEADER as u64
                    } else {
                        expected
                    }
                );
                assert_eq!(f, found as u64);
            }
            other => panic!("{found} bytes: {other}"),
        }
    }
    bytes.push(0);
    let found = expected + 1;
    assert_eq!(
        Asset::from_bytes(&bytes).unwrap_err(),
        AssetFileError::TooLong { expected, found }
    );
}

#[test]
fn random_bytes_are_no_asset_and_never_panic() {
    let mut state = 1_u64;
    let mut byte = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1);
        (state >> 56) as u8
    };
    for length in 0..2000 {
        let mut bytes: Vec<u8> = (0..length).map(|_| byte()).collect();
        assert!(Asset::from_bytes(&bytes).is_err());
        // The same behind a sound header: the table and what follows is noise.
        if length >= HEADER {
            bytes[..8].copy_from_slice(b"FRANGIBL");
            bytes[16..20].copy_from_slice(&FORMAT_VERSION.to_le_bytes());
            bytes[20..24].copy_from_slice(&(length as u32 % 9).to_le_bytes());
            seal(&mut bytes);
            assert!(matches!(
                Asset::from_bytes(&bytes),
                Err(AssetFileError::Section { .. })
            ));
        }
    }
}

#[test]
fn other_files_are_told_apart() {
    let mut stl = vec![0; 84 + 50];
    stl[80] = 1;
    let cases: [(&[u8], &str); 10] = [
        (b"", "empty"),
        (b"glTF\x02\0\0\0", "glTF"),
        (b"\n{ \"asset\": {} }", "glTF"),
        (b"ply\nformat ascii 1.0\n", "PLY"),
        (b"solid vase\n", "STL"),
        (&stl, "STL"),
        (b"PK\x03\x04....", "zip"),
        (b"# Blender\n\nmtllib a.mtl\nv 1 2 3\n", "OBJ"),
        (b"version https://git-lfs.github.com/spec/v1\n", "LFS"),
        (b"FRANGIBLY", "ends after 9 of 32"),
    ];
    for (bytes, word) in cases {
        let message = Asset::from_bytes(bytes).unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
    }
    let unknown = Asset::from_bytes(b"hello").unwrap_err().to_string();
    assert!(unknown.contains("something else"), "{unknown}");
}

#[test]
fn another_version_is_refused_before_anything_else_is_believed_and_says_how_to_go_on() {
    for found in [0, FORMAT_VERSION - 1, FORMAT_VERSION + 1, u32::MAX] {
        let mut bytes = tiny().to_bytes();
        bytes[16..20].copy_from_slice(&found.to_le_bytes());
        let error = Asset::from_bytes(&bytes).unwrap_err();
        let supported = FORMAT_VERSION;
        assert_eq!(error, AssetFileError::Version { found, supported });
        let text = error.to_string();
        assert!(
            text.contains(&format!("format is {found}, this one's is {supported}")),
            "{text}"
        );
        assert!(text.contains("bake it again: frangible bake"), "{text}");
    }
}

#[test]
fn what_a_body_lacks_its_file_lacks() {
    let whole = tiny();
    let mut bare = Asset {
        supported: Vec::new(),
        ..whole.clone()
    };
    bare.surface.walls = SurfaceWalls::default();
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
    let free = Asset {
        supported: Vec::new(),
        ..tiny()
    };
    let mut still = tiny();
    still.modes.shapes.fill(0.0);
    let mut wide = tiny();
    for (i, x) in wide.modes.shapes.iter_mut().enumerate() {
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
            let column = |a: &Asset| a.modes.shapes[mode..].iter().step_by(3).copied().collect();
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
    let Embedding { tets, nodes } = &mut unmoved.embedding;
    for point in tets.iter_mut().chain(nodes) {
        point.offset = Vec3::ZERO;
    }
    let mut nearly = unmoved.clone();
    nearly.embedding.nodes[1].offset.y = -0.0;
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
fn hostile_half_precision_is_refused() {
    let bytes = tiny().to_bytes_with(&SaveOptions::compact());
    let with = |at: usize, value: &[u8]| {
        let mut changed = bytes.clone();
        put(&mut changed, at, value);
        Asset::from_bytes(&changed).unwrap_err().to_string()
    };
    let expect = |problem: String, words: &str| assert!(problem.contains(words), "{problem}");
    // Infinity and NaN.
    for bits in [0x7c00_u16, 0xfc00, 0x7e01, 0xffff] {
        let at = data_of(&bytes, 83) + 2 * 4;
        expect(with(at, &bits.to_le_bytes()), "row 1 of the mode shapes");
    }
    for scale in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let at = data_of(&bytes, 84) + 4;
        expect(with(at, &scale.to_le_bytes()), "that of mode 1");
    }
    // Finite, but the product is not.
    let at = data_of(&bytes, 84);
    expect(with(at, &f32::MAX.to_le_bytes()), "of the mode shapes");
    let entry = entry_of(&bytes, 83);
    expect(with(entry + 4, &3_u16.to_le_bytes()), "1 f32 numbers");
    expect(with(entry + 6, &3_u16.to_le_bytes()), "rows of 3 f16");
    expect(with(entry + 16, &3_u64.to_le_bytes()), "no whole number");
    expect(with(entry + 16, &4_u64.to_le_bytes()), "rows of 3 modes");
    expect(with(entry + 16, &6_u64.to_le_bytes()), "mode shapes hold 3");
    expect(with(entry + 16, &0_u64.to_le_bytes()), "mode shapes hold 0");
    expect(with(entry, &9999_u32.to_le_bytes()), "is missing");
    let scales = entry_of(&bytes, 84);
    expect(with(scales + 16, &0_u64.to_le_bytes()), "of 0 modes");
    expect(with(scales, &9999_u32.to_le_bytes()), "is missing");
}

#[test]
fn a_hostile_table_is_refused() {
    let bytes = tiny().to_bytes();
    let with = |at: usize, value: &[u8]| {
        let mut changed = bytes.clone();
        put(&mut changed, at, value);
        section_problem(&changed)
    };
    let at = entry_of(&bytes, 17);
    let start = data_of(&bytes, 17) as u64;
    let expect = |problem: String, words: &str| assert!(problem.contains(words), "{problem}");
    expect(
        with(20, &u32::MAX.to_le_bytes()),
        "does not hold the 4294967295 sections",
    );
    expect(with(at + 8, &(start + 4).to_le_bytes()), "no multiple of 8");
    expect(
        with(at + 8, &0_u64.to_le_bytes()),
        "within what comes before",
    );
    expect(
        with(at + 8, &(start - 8).to_le_bytes()),
        "within what comes before",
    );
    expect(with(at + 16, &u64::MAX.to_le_bytes()), "beyond the end");
    expect(
        with(at + 8, &(u64::MAX - 7).to_le_bytes()),
        "beyond the end",
    );
    expect(
        with(at + 16, &15_u64.to_le_bytes()),
        "no whole number of rows",
    );
    expect(with(at + 4, &3_u16.to_le_bytes()), "holds rows of 4 f32");
    expect(with(at + 4, &999_u16.to_le_bytes()), "unknown");
    expect(with(at + 6, &0_u16.to_le_bytes()), "holds rows of 0 u32");
    expect(with(at, &16_u32.to_le_bytes()), "occurs twice");
    expect(
        with(at, &9999_u32.to_le_bytes()),
        "fracture tetrahedra: is missing",
    );
    expect(
        with(entry_of(&bytes, 112), &9999_u32.to_le_bytes()),
        "render positions: is missing",
    );
    expect(
        with(entry_of(&bytes, 3) + 16, &0_u64.to_le_bytes()),
        "exactly one row",
    );
    expect(with(data_of(&bytes, 1), &[0xff]), "not UTF-8");
    expect(
        with(data_of(&bytes, 96), &u32::MAX.to_le_bytes()),
        "does not share the 8 cell points",
    );
    expect(
        with(data_of(&bytes, 96), &0_u32.to_le_bytes()),
        "does not share the 8 cell points",
    );
    // The third byte of "Glasur –" …: the dash is three bytes from the eighth on.
    let lengths: Vec<u8> = [8_u32, 8].iter().flat_map(|n| n.to_le_bytes()).collect();
    expect(
        with(data_of(&bytes, 118), &lengths),
        "does not share the names",
    );
}

#[test]
fn sections_of_unknown_number_are_skipped() {
    let asset = Asset {
        render: None,
        ..tiny()
    };
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

#[test]
fn arrays_that_do_not_fit_are_refused() {
    let nan = f32::NAN;
    type Change = fn(&mut Asset);
    let cases: [(Change, &str); 46] = [
        (
            |a| a.supported[1] = 8,
            "supported node 1 lies beyond the 8 nodes",
        ),
        (|a| a.supported[1] = 1, "supported nodes do not rise"),
        (|a| a.supported.reverse(), "supported nodes do not rise"),
        (|a| a.material.density = f64::NAN, "density"),
        (|a| a.mass.mass = 0.0, "its mass is 0"),
        (|a| a.mass.volume = f64::INFINITY, "its volume is inf"),
        (|a| a.mass.centre.y = f64::NAN, "centre of mass"),
        (|a| a.mass.inertia.y_axis.y = -1.0, "inertia"),
        (|a| mesh(a).tets.clear(), "no tetrahedra"),
        (
            |a| mesh(a).tets[2][1] = 8,
            "tetrahedron 2 names a node beyond the 8",
        ),
        (|a| mesh(a).tets[3].swap(0, 1), "volume of tetrahedron 3"),
        (
            |a| mesh(a).tets[3][0] = mesh(a).tets[3][1],
            "volume of tetrahedron 3",
        ),
        (
            |a| mesh(a).positions[4].z = f32::NEG_INFINITY,
            "node 4 is not finite",
        ),
        (|a| mesh(a).neighbours.truncate(5), "neighbour row"),
        (|a| mesh(a).neighbours.swap(0, 1), "do not name each other"),
        (
            |a| mesh(a).neighbours[0] = [0; 4],
            "tetrahedra 0 and 0 do not name each other",
        ),
        (
            |a| *outside(a, 1) = 6,
            "tetrahedron 1 names neighbour 6 of 6",
        ),
        (
            |a| a.surface.triangles[1] = [0, 1, 99],
            "surface triangle 1 is no outer face",
        ),
        (
            |a| a.surface.tets[1] = 6,
            "surface triangle 1 names tetrahedron 6",
        ),
        (
            |a| a.surface.triangles.truncate(11),
            "surface triangle per outer face",
        ),
        (
            |a| a.surface.triangles[1] = [0, 0, 0],
            "surface triangle 1 is no outer face",
        ),
        (
            |a| a.surface.normals.clear(),
            "normal row per surface triangle",
        ),
        (
            |a| a.surface.curvature_radius[2] = 0.0,
            "curvature radius of surface triangle 2",
        ),
        (
            |a| a.surface.walls.margin.clear(),
            "one wall margin per surface triangle: 12, not 0; give every list",
        ),
        (
            |a| a.surface.walls.thickness[2] = 0.0,
            "wall thickness of surface triangle 2 is 0",
        ),
        (
            |a| a.surface.walls.thickness[3] = f32::NAN,
            "wall thickness of surface triangle 3 is NaN, not above zero; give metres",
        ),
        (
            |a| a.surface.walls.stiffening[4] = -1.0,
            "wall stiffening of surface triangle 4 is -1",
        ),
        (
            |a| a.surface.walls.margin[5] = f32::NAN,
            "wall margin of surface triangle 5 is NaN",
        ),
        (
            |a| a.surface.walls.margin[6] = -0.5,
            "wall margin of surface triangle 6 is -0.5",
        ),
        (
            |a| a.modes.residual_modes = 3,
            "3 of its 3 modes are to answer statically",
        ),
        (
            |a| a.analysis.elements[1][9] = 10,
            "analysis element 1 names a node beyond",
        ),
        (
            |a| a.analysis.barycentric_gradients.truncate(1),
            "gradient row",
        ),
        (
            |a| a.embedding.tets[5].element = 2,
            "embedded centroid 5 names",
        ),
        (
            |a| a.embedding.nodes[7].offset.x = f32::NAN,
            "embedded node 7 is not finite",
        ),
        (|a| a.embedding.nodes.truncate(3), "embedded point per node"),
        (|a| a.modes.eigenvalues[0] = 0.0, "eigenvalue of mode 0"),
        (|a| a.modes.eigenvalues.reverse(), "rising frequency"),
        (|a| a.modes.shapes[4] = f32::NAN, "row 1 of the mode shapes"),
        (|a| a.modes.peak_stress.clear(), "peak stress per mode"),
        (
            |a| a.cells[0].points[1].x = f32::INFINITY,
            "point of convex cell 0",
        ),
        (|a| a.cell_of_tet[1] = 1, "cell number of tetrahedron 1"),
        (
            |a| drawn(a).triangles[1][0] = 4,
            "render triangle 1 names a vertex",
        ),
        (
            |a| drawn(a).material_of_triangle[0] = 2,
            "material number of render triangle 0",
        ),
        (|a| drawn(a).colors[2][3] = 1.5, "colour of render vertex 2"),
        (
            |a| {
                drawn(a).colors.pop();
            },
            "one colour per render vertex",
        ),
        (
            |a| drawn(a).materials[1].metallic = 1.5,
            "render material 1",
        ),
    ];
    fn drawn(asset: &mut Asset) -> &mut RenderSurface {
        asset.render.as_mut().unwrap()
    }
    fn mesh(asset: &mut Asset) -> &mut frangible::internals::TetMesh {
        std::sync::Arc::make_mut(&mut asset.fracture)
    }
    fn outside(asset: &mut Asset, tet: usize) -> &mut u32 {
        let mut row = mesh(asset).neighbours[tet].iter_mut();
        row.find(|n| **n == frangible::internals::mesh::NO_NEIGHBOUR)
            .unwrap()
    }
    assert!(tiny().validate().is_ok());
    for (change, words) in cases {
        let mut asset = tiny();
        change(&mut asset);
        let error = Asset::from_bytes(&asset.to_bytes()).unwrap_err();
        assert!(matches!(error, AssetFileError::Input(_)), "{error}");
        assert!(
            error.to_string().contains(words),
            "{error}; expected: {words}"
        );
    }
    let mut asset = tiny();
    drawn(&mut asset).normals.pop();
    drawn(&mut asset).uvs[0][1] = nan;
    let error = asset.validate().unwrap_err();
    assert!(matches!(&error, InputError::Asset { problem, .. } if problem.contains("texture")));
}

#[test]
fn what_was_saved_is_loaded() {
    let folder = Folder::new("saved");
    let path = folder.0.join("vase.frangible");
    let asset = tiny();
    asset.save(&path).unwrap();
    assert!(same(&asset, &Asset::load(&path).unwrap()));
    // Over an older file, too.
    let renamed = Asset {
        name: "another".into(),
        ..asset
    };
    renamed.save(&path).unwrap();
    assert_eq!(Asset::load(&path).unwrap().name, "another");
    assert_eq!(folder.names(), ["vase.frangible"]);
}

#[test]
fn a_failed_save_names_the_path_and_leaves_what_was_there() {
    let folder = Folder::new("failed");
    let asset = tiny();
    let occupied = folder.0.join("folder.frangible");
    fs::create_dir(&occupied).unwrap();
    fs::write(occupied.join("inside"), "kept").unwrap();
    for path in [
        occupied,
        folder.0.join("missing/vase.frangible"),
        folder.0.join(".."),
    ] {
        let error = asset.save(&path).unwrap_err();
        assert!(
            matches!(&error, AssetFileError::Io { path: p, .. } if *p == path),
            "{error}"
        );
    }
    assert_eq!(folder.names(), ["folder.frangible"]);
    let good = folder.0.join("good.frangible");
    asset.save(&good).unwrap();
    let mut unsound = asset.clone();
    unsound.mass.mass = f64::NAN;
    let error = unsound.save(&good).unwrap_err().to_string();
    assert!(
        error.contains("good.frangible") && error.contains("mass"),
        "{error}"
    );
    assert!(same(&asset, &Asset::load(&good).unwrap()));
}

#[test]
fn a_failed_load_names_the_path() {
    let folder = Folder::new("unloadable");
    let mesh = folder.0.join("vase.obj");
    fs::write(&mesh, "v 0 0 0\n").unwrap();
    let error = Asset::load(&mesh).unwrap_err().to_string();
    assert!(
        error.contains("vase.obj") && error.contains("OBJ mesh"),
        "{error}"
    );
    for path in [folder.0.join("none.frangible"), folder.0.clone()] {
        let error = Asset::load(&path).unwrap_err();
        assert!(
            matches!(&error, AssetFileError::Io { path: p, .. } if *p == path),
            "{error}"
        );
    }
}
