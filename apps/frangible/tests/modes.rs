//! Tests of `frangible modes`: its report, its files, and its refusals.

use std::fs;
use std::process::Command;

use crate::common::{Folder, frangible, text};

/// A glass shelf held at one end, 12 modes.
const SHELF: &str = r#"
[[body]]
name = "shelf"
shape = { box = [0.3, 0.05, 0.01] }
material = "glass"
modes = 12
supports = [{ box = [[-1, -1, -1], [0.0001, 1, 1]] }]
"#;

fn file(folder: &Folder, name: &str, contents: &str) -> String {
    let path = folder.0.join(name);
    fs::write(&path, contents).expect("a file");
    path.to_string_lossy().into_owned()
}

fn path(folder: &Folder, name: &str) -> String {
    folder.0.join(name).to_string_lossy().into_owned()
}

/// The report of a run that works.
fn report(args: &[&str]) -> serde_json::Value {
    let output = frangible(&[&["modes", "--json"], args].concat(), None);
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn list(report: &serde_json::Value, key: &str) -> Vec<f64> {
    let list = report[key].as_array();
    let list = list.unwrap_or_else(|| panic!("{key} is no list in {report}"));
    list.iter().map(|x| x.as_f64().expect(key)).collect()
}

#[test]
fn a_body_and_its_baked_file_have_the_same_modes_and_those_of_a_cantilever() {
    let folder = Folder::new("modes-same");
    let scene = file(&folder, "shelf.toml", SHELF);
    let baked = path(&folder, "shelf.frangible");
    let bake = frangible(&["bake", &scene, "-o", &baked], None);
    assert!(bake.status.success(), "{}", text(&bake.stderr));
    let from_scene = report(&[&scene, "--no-pictures"]);
    let from_file = report(&[&baked, "--no-pictures"]);
    let frequencies = list(&from_scene, "frequencies_hz");
    assert_eq!(frequencies, list(&from_file, "frequencies_hz"));
    assert_eq!(frequencies.len(), 12);
    assert!(frequencies.windows(2).all(|f| f[0] <= f[1]));
    // The bake's own report rounds it.
    let said = format!("12 kept, from {:.0} Hz", frequencies[0]);
    assert!(text(&bake.stdout).contains(&said), "{}", text(&bake.stdout));

    // Euler and Bernoulli: f = 1.8751² √(E/ρ) h / (√12 · 2π L²). A short wide shelf is stiffer across, hence 4 %.
    let glass = frangible_material();
    let speed = (glass.youngs_modulus / glass.density).sqrt();
    let reference =
        1.875_104_f64.powi(2) * speed * 0.01 / (12_f64.sqrt() * std::f64::consts::TAU * 0.09);
    assert!(
        (frequencies[0] / reference - 1.0).abs() < 0.04,
        "{} Hz, not {reference}",
        frequencies[0]
    );
    // ζ = (α ω² + β) / 2ω.
    let ratios = list(&from_scene, "damping_ratios");
    let omega = std::f64::consts::TAU * frequencies[3];
    let ratio = (glass.stiffness_damping * omega * omega + glass.mass_damping) / (2.0 * omega);
    assert!((ratios[3] / ratio - 1.0).abs() < 1e-9);
    assert!(
        list(&from_scene, "peak_stress_pa_per_m")
            .iter()
            .all(|&s| s > 0.0)
    );

    for of in [&from_scene, &from_file] {
        assert_eq!(of["name"], "shelf");
        assert_eq!(of["material"], "glass");
        assert_eq!(of["supported"], true);
        assert!(of["supported_nodes"].as_u64().is_some_and(|n| n > 3));
        let mass = of["mass_kg"].as_f64().expect("the mass");
        assert!((mass / (glass.density * 0.3 * 0.05 * 0.01) - 1.0).abs() < 1e-3);
    }
    assert_eq!(from_scene["rigid_motions"], 0);
    assert!(
        from_scene["largest_residual"]
            .as_f64()
            .is_some_and(|r| r < 1e-6)
    );
    assert!(from_file["largest_residual"].is_null());
}

fn frangible_material() -> frangible::Material {
    frangible::Material::preset("glass").expect("glass")
}

#[test]
fn the_table_lists_what_was_asked_for_and_the_files_are_there() {
    let folder = Folder::new("modes-table");
    let scene = file(&folder, "shelf.toml", SHELF);
    let [png, vtu, fracture] = ["a.png", "a.vtu", "b.vtu"].map(|name| path(&folder, name));
    let args = ["modes", &scene, "--modes", "3", "-o", &png, "--vtu", &vtu];
    let output = frangible(&[&args[..], &["--fracture-vtu", &fracture]].concat(), None);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let said = text(&output.stdout);
    for part in [
        "shelf, glass",
        "no rigid-body mode left",
        "MPa/mm",
        "damped",
        "and 9 more",
        "a.vtu",
    ] {
        assert!(said.contains(part), "no `{part}` in {said}");
    }
    assert_eq!(
        said.lines().filter(|line| line.contains("MPa/mm")).count(),
        3
    );
    // Without a graphics driver there is a note instead of the picture.
    if said.contains("note") {
        assert!(said.contains("no picture"), "{said}");
    } else {
        let bytes = fs::read(&png).expect("the picture");
        assert!(bytes.starts_with(b"\x89PNG") && bytes.len() > 5000);
    }
    for (path, kind) in [(&vtu, 24), (&fracture, 10)] {
        let bytes = fs::read(path).expect("the grid");
        let head = String::from_utf8_lossy(&bytes[..20_000.min(bytes.len())]).into_owned();
        for name in [
            "mode_01",
            "mode_12",
            "von_mises_07",
            "principal_12",
            "frequencies_hz",
        ] {
            assert!(
                head.contains(&format!("Name=\"{name}\"")),
                "{name} of {kind}"
            );
        }
        assert!(!head.contains("mode_13"));
    }
    let mut left = folder.files();
    left.retain(|name| name != "a.png");
    left.sort();
    assert_eq!(left, ["a.vtu", "b.vtu", "shelf.toml"]);
}

#[test]
fn the_drivers_do_not_complain_before_the_report() {
    let folder = Folder::new("modes-quiet");
    let scene = file(&folder, "shelf.toml", SHELF);
    let output = Command::new(env!("CARGO_BIN_EXE_frangible"))
        .args(["modes", &scene, "-o", &path(&folder, "a.png")])
        .env_remove("XDG_RUNTIME_DIR")
        .output()
        .expect("the program starts");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(
        !text(&output.stderr).contains("XDG_RUNTIME_DIR"),
        "{}",
        text(&output.stderr)
    );
}

#[test]
fn what_cannot_be_looked_at_is_refused_in_a_sentence_and_leaves_nothing() {
    let folder = Folder::new("modes-refused");
    let two = "[[body]]\nshape = \"vase\"\n[[body]]\nshape = \"bowl\"\n";
    let two = file(&folder, "two.toml", two);
    let damaged = file(&folder, "damaged.frangible", "no body at all");
    let nan = file(
        &folder,
        "nan.toml",
        "[[body]]\nshape = { box = [nan, 1, 1] }\n",
    );
    let absent = path(&folder, "absent.frangible");
    let far = path(&folder, "none/a.png");
    let photo = file(&folder, "photo.jpg", "x");
    let wrong = path(&folder, "a.jpg");
    let grid = path(&folder, "a.vtu");
    let before = folder.files().len();
    for (args, part) in [
        (vec![&*absent], "no such file"),
        (vec![&two], "2 bodies"),
        (vec![&damaged], "damaged.frangible"),
        (vec![&nan], "NaN"),
        (vec![&photo], ".frangible"),
        (vec!["--scene", "vas"], "did you mean `vase`"),
        (vec!["--scene", "vase", "--modes", "0"], "--modes is 0"),
        (vec!["--scene", "vase", "--modes", "37"], "1 to 36"),
        (vec!["--scene", "vase", "--modes", "-2"], "--modes is -2"),
        (vec!["--scene", "vase", "-o", &wrong], "must end in .png"),
        (vec!["--scene", "vase", "--vtu", &far], "must end in .vtu"),
        (vec!["--scene", "vase", "-o", &far], "-o FILE"),
        (
            vec!["--scene", "vase", "--vtu", &grid, "--fracture-vtu", &grid],
            "the same file",
        ),
        (
            vec!["--scene", "vase", "--size", "1"],
            "--size applies only to mesh",
        ),
        (vec!["--scene", "vase", "--material", "gless"], "glass"),
    ] {
        let output = frangible(&[&["modes"], &args[..]].concat(), None);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{args:?}: {message}");
        assert!(message.starts_with("error: "), "{message}");
        assert_eq!(message.trim_end().lines().count(), 1, "{message}");
        assert!(message.contains(part), "{args:?}: {message}");
        assert!(output.stdout.is_empty());
        assert_eq!(folder.files().len(), before, "{args:?} left files");
    }
    // By the command line itself.
    for args in [&["modes"][..], &["modes", &two, "--scene", "vase"]] {
        assert_eq!(frangible(args, None).status.code(), Some(2), "{args:?}");
    }
}
