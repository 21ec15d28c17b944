//! Files that were damaged, cut or made up.

use super::*;

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
    assert!(unknown.contains("another kind of file"), "{unknown}");
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
            text.contains(&format!(
                "format version is {found}, but this build reads version {supported}"
            )),
            "{text}"
        );
        assert!(text.contains("bake it again: frangible bake"), "{text}");
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
        expect(with(at, &scale.to_le_bytes()), "for mode 1");
    }
    // Finite, but the product is not.
    let at = data_of(&bytes, 84);
    expect(with(at, &f32::MAX.to_le_bytes()), "of the mode shapes");
    let entry = entry_of(&bytes, 83);
    expect(with(entry + 4, &3_u16.to_le_bytes()), "1 f32 numbers");
    expect(with(entry + 6, &3_u16.to_le_bytes()), "rows of 3 f16");
    expect(with(entry + 16, &3_u64.to_le_bytes()), "not a multiple");
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
    expect(
        with(at + 8, &(start + 4).to_le_bytes()),
        "not a multiple of 8",
    );
    expect(
        with(at + 8, &0_u64.to_le_bytes()),
        "inside the data before it",
    );
    expect(
        with(at + 8, &(start - 8).to_le_bytes()),
        "inside the data before it",
    );
    expect(with(at + 16, &u64::MAX.to_le_bytes()), "beyond the end");
    expect(
        with(at + 8, &(u64::MAX - 7).to_le_bytes()),
        "beyond the end",
    );
    expect(
        with(at + 16, &15_u64.to_le_bytes()),
        "not a multiple of the row size",
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
        "does not divide the 8 cell points",
    );
    expect(
        with(data_of(&bytes, 96), &0_u32.to_le_bytes()),
        "does not divide the 8 cell points",
    );
    // The third byte of "Glasur –" …: the dash is three bytes from the eighth on.
    let lengths: Vec<u8> = [8_u32, 8].iter().flat_map(|n| n.to_le_bytes()).collect();
    expect(
        with(data_of(&bytes, 118), &lengths),
        "does not divide the names",
    );
}
