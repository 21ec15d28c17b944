//! Files in memory stand for the same scenes as those on the disk.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frangible_scenes::{Files, Opened, open_sources, open_sources_from, scene_of_file_from};

const TETRAHEDRON: &str = "\
v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn given(files: &[(&str, &str)]) -> Files {
    let files = files
        .iter()
        .map(|(name, text)| (PathBuf::from(name), text.as_bytes().to_vec()));
    Files::Given(files.collect::<BTreeMap<_, _>>())
}

fn refused(name: &str, files: &Files) -> String {
    let scene = scene_of_file_from(Path::new(name), files);
    let opened = scene.and_then(|scene| open_sources_from(&scene, files));
    opened.unwrap_err().to_string()
}

#[test]
fn a_mesh_in_memory_is_the_body_that_it_is_on_the_disk() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let path = folder.join("given.obj");
    std::fs::write(&path, TETRAHEDRON).unwrap();
    let on_disk = scene_of_file_from(&path, &Files::Disk).unwrap();
    let files = given(&[("given.obj", TETRAHEDRON)]);
    let in_memory = scene_of_file_from(Path::new("given.obj"), &files).unwrap();
    assert_eq!(on_disk.name, in_memory.name);
    let shape = |opened: &[Opened]| format!("{opened:?}");
    assert_eq!(
        shape(&open_sources(&on_disk).unwrap()),
        shape(&open_sources_from(&in_memory, &files).unwrap())
    );
}

#[test]
fn a_scene_in_memory_finds_its_mesh_there() {
    let scene = "[[body]]\nmesh = \"given.obj\"\nmaterial = \"glass\"\n";
    let both = given(&[("scene.toml", scene), ("given.obj", TETRAHEDRON)]);
    let parsed = scene_of_file_from(Path::new("scene.toml"), &both).unwrap();
    assert_eq!(open_sources_from(&parsed, &both).unwrap().len(), 1);
    let alone = given(&[("scene.toml", scene)]);
    let message = refused("scene.toml", &alone);
    assert!(
        message.contains("given.obj") && message.contains("this file is missing"),
        "{message}"
    );
}

#[test]
fn what_is_no_mesh_is_refused_in_memory_as_on_the_disk() {
    for (name, text, wanted) in [
        ("a.txt", "hello", "a.txt"),
        ("a.obj", "", "empty"),
        ("a.obj", "hello", "a.obj"),
        ("a.stl", "solid", "a.stl"),
        ("a.msh", "hello", "a.msh"),
    ] {
        let message = refused(name, &given(&[(name, text)]));
        assert!(message.contains(wanted), "{message}");
    }
}
