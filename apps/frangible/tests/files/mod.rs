//! Files on the command line: scenes, meshes, baked bodies.

mod meshes;
mod refused;

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::common::{Folder, frangible, text};

/// A scene file in a folder of its own.
fn scene_file(folder: &Folder, name: &str, text: &str) -> String {
    let path = folder.0.join(name);
    fs::write(&path, text).expect("a scene file");
    path.to_string_lossy().into_owned()
}

#[test]
fn a_printed_scene_does_the_same_as_the_built_in_one() {
    let folder = Folder::new("printed");
    let args = ["--no-pictures", "--modes", "20", "--drop", "0.4"];
    let built_in = frangible(
        &[&["break", "--scene", "brick"], &args[..]].concat(),
        Some(&folder.0.join("built-in")),
    );
    assert!(built_in.status.success(), "{}", text(&built_in.stderr));
    let printed = frangible(&["scenes", "brick"], None);
    assert!(printed.status.success());
    let file = scene_file(&folder, "mine.toml", &text(&printed.stdout));
    let from_file = frangible(
        &[&["break", &file], &args[..]].concat(),
        Some(&folder.0.join("file")),
    );
    assert!(from_file.status.success(), "{}", text(&from_file.stderr));
    let [first, second] = ["built-in", "file"]
        .map(|run| fs::read(folder.0.join(run).join("brick.glb")).expect("the GLB"));
    assert!(first == second, "the files differ");
    let unknown = frangible(&["scenes", "brik"], None);
    assert!(!unknown.status.success());
    assert!(text(&unknown.stderr).contains("did you mean `brick`"));
}

#[test]
fn several_bodies_are_reported_one_by_one() {
    let folder = Folder::new("several");
    let file = scene_file(
        &folder,
        "pair.toml",
        r#"
duration = 0.2
[[body]]
name = "low"
shape = { box = [0.1, 0.1, 0.02] }
material = "glass"
modes = 10
position = [0, 0]
[[body]]
name = "high"
shape = { box = [0.1, 0.1, 0.02] }
material = "glass"
modes = 10
position = [1, 0]
drop = 0.02
[output]
glb = "animation.glb"
picture = false
wav = false
json = "report.json"
"#,
    );
    let out = folder.0.join("out");
    let output = frangible(&["break", &file, "--json"], Some(&out));
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let written = fs::read(out.join("report.json")).expect("the report");
    let again: serde_json::Value = serde_json::from_slice(&written).expect("JSON");
    assert_eq!(report, again);
    assert_eq!(report["scene"], "pair");
    let names: Vec<&str> = report["bodies"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|body| body["body"].as_str())
        .collect();
    assert_eq!(names, ["low", "high"]);
    assert!(report.get("broke").is_none(), "whose would it be?");
    let mut files: Vec<String> = fs::read_dir(&out)
        .expect("the folder")
        .map(|e| {
            e.expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    files.sort();
    assert_eq!(files, ["animation.glb", "report.json"]);
}

/// A box of these sides, in the file's unit, on the floor of y = 0.
fn box_obj([x, y, z]: [f64; 3]) -> String {
    let mut obj = String::new();
    for corner in 0..8 {
        let side = |bit: u8, length: f64| if corner >> bit & 1 == 1 { length } else { 0.0 };
        obj += &format!("v {} {} {}\n", side(0, x), side(1, y), side(2, z));
    }
    obj + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 2 4 8 6\nf 1 5 7 3\n"
}

/// Breaks quickly, and does break.
const QUICK: [&str; 9] = [
    "--drop",
    "20",
    "--resolution",
    "2000",
    "--modes",
    "20",
    "--material",
    "glass",
    "--no-pictures",
];

/// Runs and reads the report.
fn report(args: &[&str], out: &Path) -> serde_json::Value {
    let output = frangible(&[args, &["--json"]].concat(), Some(out));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("one JSON document")
}

#[test]
fn paths_are_relative_to_where_one_stands_and_in_a_scene_to_its_file() {
    let folder = Folder::new("relative");
    fs::create_dir_all(folder.0.join("far/meshes")).expect("folders");
    fs::write(
        folder.0.join("far/meshes/box.obj"),
        box_obj([0.05, 0.12, 0.08]),
    )
    .expect("a mesh");
    let scene = r#"
duration = 0.05
[[body]]
mesh = "meshes/box.obj"
material = "glass"
modes = 6
resolution = 500
drop = 0.01
"#;
    fs::write(folder.0.join("far/scene.toml"), scene).expect("a scene");
    let run = |args: &[&str], place: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_frangible"));
        let args = [&["break"], args, &["--no-pictures", "--out", "out"]].concat();
        let output = command
            .args(args)
            .current_dir(folder.0.join(place))
            .output();
        let output = output.expect("the program starts");
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    };
    run(&["far/scene.toml"], "");
    assert!(folder.0.join("out/scene.glb").is_file());
    let quick = ["--modes", "6", "--resolution", "500", "--drop", "0.01"];
    run(&[&["meshes/box.obj"], &quick[..]].concat(), "far");
    assert!(folder.0.join("far/out/box.glb").is_file());
}

/// Two plates of this size, m, that cross in the middle, as thick as given: thin, but no wall of two faces.
fn cross_obj(size: f64, thickness: f64) -> String {
    let (s, t) = (0.5 * size, 0.5 * thickness);
    let outline = [
        [t, t],
        [s, t],
        [s, -t],
        [t, -t],
        [t, -s],
        [-t, -s],
        [-t, -t],
        [-s, -t],
        [-s, t],
        [-t, t],
        [-t, s],
        [t, s],
    ];
    let mut text = String::new();
    for y in [0.0, size] {
        for [x, z] in outline {
            text += &format!("v {x} {y} {z}\n");
        }
    }
    for i in 0..12 {
        let (a, b) = (i + 1, (i + 1) % 12 + 1);
        text += &format!("f {a} {b} {} {}\n", b + 12, a + 12);
    }
    // Both ends: the square in the middle, and four arms.
    for first in [1, 13] {
        let v = |i: usize| first + i % 12;
        text += &format!("f {} {} {} {}\n", v(0), v(3), v(6), v(9));
        for arm in [0, 3, 6, 9] {
            text += &format!(
                "f {} {} {} {}\n",
                v(arm),
                v(arm + 1),
                v(arm + 2),
                v(arm + 3)
            );
        }
    }
    text
}

#[test]
fn a_file_without_a_command_is_told_the_command() {
    let output = frangible(&["my vase.obj"], None);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(message.trim_end().lines().count(), 1, "{message}");
    assert!(
        message.contains("frangible break \"my vase.obj\""),
        "{message}"
    );
    let misspelt = frangible(&["braek"], None);
    assert!(text(&misspelt.stderr).contains("break"));
}
