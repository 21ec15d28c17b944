//! `frangible-lab compare`: the messages for bad input, and the files left by good input.

use std::fs;

use serde_json::Value;

use super::{Folder, lab, refused, text};

const PANE: &str = r#"
duration = 0.5
floor = "stone"
[[body]]
name = "pane"
shape = { box = [0.2, 0.2, 0.006] }
material = "glass"
modes = 20
resolution = 3000
[[projectile]]
mass = 0.1
radius = 0.012
speed = 25.0
"#;

#[test]
fn unknown_scenes_and_methods_are_met_with_the_nearest() {
    refused(
        &["compare", "--scene", "glas"],
        &["scene `glas`", "did you mean `glass`"],
    );
    refused(
        &["compare", "--methods", "ours,voronoy"],
        &["method `voronoy`", "did you mean `voronoi`"],
    );
}

#[test]
fn a_scene_in_which_nothing_breaks_is_refused_and_leaves_no_folder() {
    let folder = Folder::new("compare-held");
    let scene = folder.path().join("soft.toml");
    fs::write(
        &scene,
        PANE.replace("\"glass\"", "{ preset = \"glass\", strength = 1e10 }"),
    )
    .expect("a scene");
    let out = folder.path().join("out");
    let output = lab(&[
        "compare",
        scene.to_str().expect("a path"),
        "--out",
        out.to_str().expect("a path"),
    ]);
    let message = text(&output.stderr);
    assert!(!output.status.success());
    assert!(
        message.contains("no impact breaks a body in the scene `soft`"),
        "{message}"
    );
    assert!(message.contains("--seed"), "{message}");
    assert!(!out.exists());
}

#[test]
fn impossible_options_are_refused() {
    let folder = Folder::new("compare-options");
    let scene = folder.path().join("pane.toml");
    fs::write(&scene, PANE).expect("a scene");
    let scene = scene.to_str().expect("a path");
    let out = folder.path().join("out");
    for (option, value, part) in [
        ("--step", "-1", "the quasi-static step is"),
        ("--sites", "0", "the number of sites is 0"),
        ("--cells", "1000000", "the number of cells is 1000000"),
    ] {
        let output = lab(&[
            "compare",
            scene,
            option,
            value,
            "--out",
            out.to_str().expect("a path"),
        ]);
        let message = text(&output.stderr);
        assert!(!output.status.success());
        assert!(
            message.starts_with("error: ") && message.contains(part),
            "{message}"
        );
    }
}

#[test]
fn the_methods_are_told_of_in_table_and_json() {
    let folder = Folder::new("compare");
    let scene = folder.path().join("pane.toml");
    fs::write(&scene, PANE).expect("a scene");
    let out = folder.path().join("out");
    let scene = scene.to_str().expect("a path");
    let output = lab(&[
        "compare",
        scene,
        "--no-pictures",
        "--json",
        "--out",
        out.to_str().expect("a path"),
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let file = fs::read(out.join("pane-compare.json")).expect("the report");
    assert_eq!(
        report,
        serde_json::from_slice::<Value>(&file).expect("JSON")
    );
    let rows = report["methods"].as_array().expect("rows");
    let names: Vec<&str> = rows.iter().filter_map(|r| r["method"].as_str()).collect();
    let all = [
        "ours",
        "quasi-static",
        "elements",
        "energy-voronoi",
        "voronoi",
    ];
    assert_eq!(names, all);
    for row in rows {
        assert!(row["pieces"].as_u64() > Some(1), "{row}");
        assert!(
            row["volume_error"].as_f64().expect("a number").abs() < 1e-12,
            "{row}"
        );
        assert!(row["energy_j"].as_f64() > Some(0.0), "{row}");
    }
    let table = fs::read_to_string(out.join("pane-compare.md")).expect("the table");
    assert_eq!(
        table.lines().filter(|line| line.starts_with('|')).count(),
        2 + all.len()
    );

    // Fewer of them, the same numbers.
    let output = lab(&[
        "compare",
        scene,
        "--no-pictures",
        "--json",
        "--methods",
        "voronoi",
        "--out",
        out.to_str().expect("a path"),
    ]);
    let alone: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let alone = &alone["methods"][0];
    assert_eq!(alone["crack_area_cm2"], rows[4]["crack_area_cm2"]);
    assert_eq!(alone["pieces"], rows[4]["pieces"]);
}

#[test]
fn the_picture_has_a_pane_for_the_impact_and_each_method() {
    let folder = Folder::new("compare-picture");
    let scene = folder.path().join("pane.toml");
    fs::write(&scene, PANE).expect("a scene");
    let out = folder.path().join("out");
    let output = lab(&[
        "compare",
        scene.to_str().expect("a path"),
        "--methods",
        "ours,voronoi",
        "--out",
        out.to_str().expect("a path"),
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let picture = image::open(out.join("pane-compare.png"))
        .expect("a picture")
        .into_rgb8();
    assert_eq!(picture.dimensions(), (3 * 420 + 2 * 4, 340));
    // Each pane shows something of its own.
    let pane = |i: u32| {
        let crop = image::imageops::crop_imm(&picture, i * 424, 60, 420, 280);
        crop.to_image().into_raw()
    };
    assert!(pane(0) != pane(1) && pane(1) != pane(2));
}
