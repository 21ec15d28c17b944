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
fn a_scene_in_which_nothing_breaks_is_refused() {
    let folder = Folder::new("compare-held");
    let scene = folder.path().join("soft.toml");
    let soft = PANE.replace("\"glass\"", "{ preset = \"glass\", strength = 1e10 }");
    fs::write(&scene, soft).expect("a scene");
    refused(
        &["compare", scene.to_str().expect("a path")],
        &["no impact breaks a body in the scene `soft`", "--seed"],
    );
}

#[test]
fn impossible_options_are_refused() {
    let folder = Folder::new("compare-options");
    let scene = folder.path().join("pane.toml");
    fs::write(&scene, PANE).expect("a scene");
    let scene = scene.to_str().expect("a path");
    for (option, value, part) in [
        ("--step", "-1", "the quasi-static step is"),
        ("--sites", "0", "the number of sites is 0"),
        ("--cells", "1000000", "the number of cells is 1000000"),
    ] {
        refused(&["compare", scene, option, value], &[part]);
    }
}

#[test]
fn every_method_has_its_numbers_and_a_pane_of_the_picture() {
    let folder = Folder::new("compare");
    let scene = folder.path().join("pane.toml");
    fs::write(&scene, PANE).expect("a scene");
    let (scene, png) = (
        scene.to_str().expect("a path"),
        folder.path().join("pane.png"),
    );
    let measured = |words: &[&str]| -> Value {
        let output = lab(&[&["compare", scene], words].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        serde_json::from_slice::<Value>(&output.stdout).expect("JSON")["measured"].take()
    };
    let report = measured(&["--picture", png.to_str().expect("a path")]);
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
    let picture = image::open(png).expect("a picture").into_rgb8();
    assert_eq!(picture.dimensions(), (3 * 420 + 2 * 4, 2 * 340 + 4));
    // Each pane shows something of its own.
    let pane = |i: u32| {
        let crop = image::imageops::crop_imm(&picture, i * 424, 60, 420, 280);
        crop.to_image().into_raw()
    };
    assert!(pane(0) != pane(1) && pane(1) != pane(2));
    // Fewer of them, the same numbers.
    let alone = &measured(&["--methods", "voronoi"])["methods"][0];
    assert_eq!(alone["crack_area_m2"], rows[4]["crack_area_m2"]);
    assert_eq!(alone["pieces"], rows[4]["pieces"]);
}
