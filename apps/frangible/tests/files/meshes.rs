//! Meshes that are broken, whole, open or thin.

use std::fs;

use super::{QUICK, box_obj, report, scene_file};
use crate::common::{Folder, frangible, refused_in_a_sentence, text};

#[test]
fn a_mesh_breaks_and_so_does_its_bake_into_the_same_pieces() {
    let folder = Folder::new("mesh-and-bake");
    // A name that needs care in shells, and in paths.
    let mesh = scene_file(&folder, "a bödy.obj", &box_obj([0.05, 0.12, 0.08]));
    let direct = report(
        &[&["break", &mesh], &QUICK[..]].concat(),
        &folder.0.join("direct"),
    );
    assert_eq!(direct["broke"], true, "{direct:#}");
    let tets = direct["fracture_tets"].as_f64().expect("a number");
    assert!((tets / 2000.0 - 1.0).abs() < 0.15, "{tets} tetrahedra");
    let density = frangible::Material::preset("glass").expect("glass").density;
    let mass = density * 0.05 * 0.12 * 0.08;
    let weighed = direct["mass_kg"].as_f64().expect("a number");
    assert!(
        (weighed / mass - 1.0).abs() < 0.03,
        "{weighed} kg, not {mass}"
    );

    let baked = folder
        .0
        .join("a bödy.frangible")
        .to_string_lossy()
        .into_owned();
    // `break` alone has these.
    let for_bake: Vec<&str> = QUICK[2..8].to_vec();
    let output = frangible(
        &[&["bake", &mesh, "-o", &baked], &for_bake[..]].concat(),
        None,
    );
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let args = ["break", &baked, "--drop", "20", "--no-pictures"];
    let loaded = report(&args, &folder.0.join("loaded"));
    for figure in [
        "fragments",
        "mass_kg",
        "impact",
        "largest_fragments_kg",
        "simulated_s",
    ] {
        assert_eq!(direct[figure], loaded[figure], "{figure}");
    }
    let light = loaded["mass_kg"].as_f64().expect("a mass");
    let [direct, loaded] = ["direct", "loaded"]
        .map(|run| fs::read(folder.0.join(run).join("a bödy.glb")).expect("the GLB"));
    assert!(direct == loaded, "the animations differ");

    // Another size without a bake: twice as long is eight times as heavy. Another Poisson's ratio needs one.
    let args = ["break", &baked, "--drop", "0.01", "--no-pictures"];
    let large = report(
        &[&args[..], &["--size", "0.24", "--material", "glass"]].concat(),
        &folder.0.join("large"),
    );
    let times = large["mass_kg"].as_f64().expect("a mass") / light;
    assert!((times / 8.0 - 1.0).abs() < 0.02, "{times} times");
    refused_in_a_sentence(
        "ratio",
        &[&args[..], &["--material", "porcelain"]].concat(),
        &[
            "glass",
            "0.23",
            "0.22",
            "frangible bake MESH --material porcelain",
        ],
    );

    // One byte of it turned round: refused, and nothing written.
    let mut bytes = fs::read(&baked).expect("the baked body");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0x10;
    let damaged = folder
        .0
        .join("damaged.frangible")
        .to_string_lossy()
        .into_owned();
    fs::write(&damaged, &bytes).expect("a damaged copy");
    refused_in_a_sentence("damaged", &["break", &damaged], &["damaged.frangible"]);
    fs::write(&damaged, &bytes[..middle]).expect("a cut copy");
    refused_in_a_sentence("damaged", &["break", &damaged], &["damaged.frangible"]);
    let elsewhere = folder.0.to_string_lossy().into_owned();
    let output = frangible(&["bake", &mesh, "-o", &elsewhere], None);
    assert!(!output.status.success());
    let output = frangible(&["bake", &baked, "-o", &baked], None);
    assert!(text(&output.stderr).contains("already baked"));
}

#[test]
fn an_open_surface_is_filled_and_the_note_says_how_heavy_it_is() {
    let folder = Folder::new("open");
    let args = ["--drop", "0.01", "--resolution", "2000", "--modes", "12"];
    let notes = |name: &str, obj: &str| {
        let mesh = scene_file(&folder, name, obj);
        let args = [&["break", &mesh, "--no-pictures"], &args[..]].concat();
        let report = report(&args, &folder.0.join("out"));
        let mass = report["mass_kg"].as_f64().expect("a mass");
        (report["notes"].to_string(), format!("{mass:.3} kg"))
    };
    let closed = box_obj([0.1; 3]);
    let (told, _) = notes("closed.obj", &closed);
    assert!(!told.contains("filled"), "{told}");
    // Without its lid, and with two edges written as faces.
    let (told, mass) = notes("open.obj", &closed.replace("f 3 7 8 4\n", "f 7 8\nf 3 4\n"));
    for part in [
        "open",
        "filled as a solid",
        &mass,
        "2 faces with fewer than three vertices",
    ] {
        assert!(told.contains(part), "no `{part}` in {told}");
    }
}

#[test]
fn an_open_surface_with_a_wall_is_a_shell_of_that_thickness() {
    let folder = Folder::new("wall");
    let open = box_obj([0.1; 3]).replace("f 3 7 8 4\n", "");
    let mesh = scene_file(&folder, "pot.obj", &open);
    let args = ["--drop", "0.01", "--modes", "12", "--no-pictures"];
    let weighed = |wall: &[&str]| {
        let args = [&["break", &mesh], wall, &args[..]].concat();
        let report = report(&args, &folder.0.join("out"));
        let mass = report["mass_kg"].as_f64().expect("a mass");
        (mass, report["notes"].to_string())
    };
    let (solid, _) = weighed(&["--resolution", "2000"]);
    let (shell, notes) = weighed(&["--wall", "0.012"]);
    // Five sides of 0.01 m² and 12 mm, beside 1 dm³; edges and rims add and take a little.
    assert!((shell / solid - 0.6).abs() < 0.06, "{shell} of {solid} kg");
    assert!(!notes.contains("filled"), "{notes}");
    refused_in_a_sentence("wall", &["break", &mesh, "--wall", "-1"], &["wall"]);
    refused_in_a_sentence("wall", &["--scene", "glass", "--wall", "0.01"], &["--wall"]);
}

#[test]
fn size_and_up_make_a_body_in_metres_stand() {
    let folder = Folder::new("size");
    // 120 mm along z, which is up, in a file whose unit is the millimetre.
    let mesh = scene_file(&folder, "mm.obj", &box_obj([50.0, 80.0, 120.0]));
    let metres = scene_file(&folder, "m.obj", &box_obj([0.05, 0.12, 0.08]));
    let mass = |args: &[&str]| {
        let report = report(
            &[args, &QUICK[2..], &["--drop", "0.01"]].concat(),
            &folder.0.join("out"),
        );
        report["mass_kg"].as_f64().expect("a mass")
    };
    let from_mm = mass(&["break", &mesh, "--size", "0.12", "--up", "z"]);
    let from_m = mass(&["break", &metres]);
    assert!(
        (from_mm / from_m - 1.0).abs() < 0.01,
        "{from_mm} and {from_m} kg"
    );
    // The whole body in the animation, y up: as high as it is long, standing.
    let glb = fs::read(folder.0.join("out/mm.glb")).expect("the GLB");
    let length = u32::from_le_bytes(glb[12..16].try_into().expect("four bytes")) as usize;
    let json: serde_json::Value = serde_json::from_slice(&glb[20..20 + length]).expect("JSON");
    let heights: Vec<f64> = json["accessors"]
        .as_array()
        .expect("accessors")
        .iter()
        .filter_map(|a| Some(a["max"][1].as_f64()? - a["min"][1].as_f64()?))
        .collect();
    assert!(
        heights.iter().any(|h| (h - 0.12).abs() < 0.002),
        "heights {heights:?}"
    );
}

#[test]
fn a_thin_pane_a_bent_sheet_and_a_flat_one_break_without_a_lattice() {
    let folder = Folder::new("layers");
    let args = [
        "--drop",
        "0.01",
        "--modes",
        "12",
        "--no-pictures",
        "--no-sound",
    ];
    let volume = |mesh: &str, wall: &[&str]| {
        let args = [&["break", mesh], wall, &args[..]].concat();
        let report = report(&args, &folder.0.join("out"));
        let notes = report["notes"].to_string();
        assert!(
            !notes.contains("hole") && !notes.contains("beside the drawn"),
            "{notes}"
        );
        report["volume_m3"].as_f64().expect("a volume")
    };
    let pane = scene_file(&folder, "pane.obj", &box_obj([0.3, 0.002, 0.3]));
    assert!((volume(&pane, &[]) / 1.8e-4 - 1.0).abs() < 1e-4);
    let quad = "v 0 0 0\nv 0.2 0 0\nv 0.2 0 0.1\nv 0 0 0.1\nf 1 4 3 2\n";
    let sheet = scene_file(&folder, "sheet.obj", quad);
    assert!((volume(&sheet, &["--wall", "0.004"]) / 8e-5 - 1.0).abs() < 1e-4);
    let bent = "v 0 0 0\nv 0.1 0.03 0\nv 0.2 0 0\nv 0 0 0.1\nv 0.1 0.03 0.1\nv 0.2 0 0.1\nf 1 4 5 2\nf 2 5 6 3\n";
    let bent = scene_file(&folder, "bent.obj", bent);
    for mesh in [&sheet, &bent] {
        refused_in_a_sentence("layers-out", &["break", mesh], &["--wall METRES"]);
    }
}
