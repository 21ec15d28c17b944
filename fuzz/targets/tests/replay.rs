//! Replay of the fuzzing seeds and findings: every file of `fuzz/corpus/TARGET` goes through its target.

use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

/// Paths in a folder beside this package, sorted.
fn listed(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .join(folder);
    let entries =
        fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    paths
}

fn replay(target: fn(&[u8]), name: &str) {
    let files = listed(&format!("corpus/{name}"));
    let fails = |file: &&PathBuf| {
        let bytes = fs::read(file).expect("a file that can be read");
        catch_unwind(|| target(&bytes)).is_err()
    };
    let failed: Vec<&PathBuf> = files.iter().filter(fails).collect();
    assert!(failed.is_empty(), "{name} fails with {failed:?}");
}

macro_rules! targets {
    ($($name:ident)*) => {
        const NAMES: &[&str] = &[$(stringify!($name)),*];

        $(#[test]
        fn $name() {
            replay(frangible_fuzz_targets::$name, stringify!($name));
        })*
    };
}

targets! {
    body_state
    c_interface
    impact
    impact_small
    read_asset
    read_gltf
    read_obj
    read_ply
    read_scene
    read_stl
    read_tets
    run_scene
    world
    world_small
}

#[test]
fn each_target_has_seeds_and_a_program_of_the_fuzzer() {
    for folder in ["corpus", "fuzz_targets"] {
        let stems = listed(folder)
            .into_iter()
            .map(|path| path.with_extension(""));
        let names: Vec<String> = stems
            .filter_map(|path| Some(path.file_name()?.to_str()?.to_owned()))
            .collect();
        assert_eq!(names, NAMES, "in fuzz/{folder}");
    }
}
