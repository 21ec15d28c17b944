//! Files on the command line: scenes, meshes, baked bodies.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::common::{Folder, frangible, refused, refused_in_a_sentence, text};

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
fn files_that_cannot_be_broken_are_refused_in_a_sentence() {
    let input = Folder::new("inputs");
    let file = |name: &str, text: &str| scene_file(&input, name, text);
    let absent = input.0.join("absent.obj").to_string_lossy().into_owned();
    let folder = input.0.to_string_lossy().into_owned();
    let body = "[[body]]\nshape = \"vase\"\n";
    for (path, parts) in [
        (absent.clone(), &["no such file", "absent.obj"][..]),
        ("glass".into(), &["no file `glass`", "--scene glass"]),
        (folder, &["this is a folder"]),
        (file("empty.stl", ""), &["empty.stl", "empty"]),
        (file("picture.jpg", "x"), &[".obj", ".frangible", ".toml"]),
        (file("text.toml", "once upon a time"), &["text.toml line 1"]),
        (
            file("key.toml", &format!("{body}\nmaterail = \"glass\"")),
            &["key.toml line 4", "`materail`", "did you mean `material`"],
        ),
        (
            file("value.toml", &format!("{body}drop = -2")),
            &["value.toml line 3", "the drop height is -2"],
        ),
        (
            file("far.toml", "[[body]]\nmesh = \"meshes/far.ply\""),
            &["no such file", "meshes/far.ply"],
        ),
        (
            file(
                "held.toml",
                &format!(
                    "{body}supports = [{{ below = -1 }}]\n[[projectile]]\nmass = 0.1\nradius = 0.015\nspeed = 5\n"
                ),
            ),
            &[
                "support 0 of `",
                "{ below = -1.0 }, contains no part of the body",
                "(the body reaches from 0 to 0.21",
                "m along z)",
            ],
        ),
    ] {
        refused_in_a_sentence("files", &["break", &path, "--no-pictures"], parts);
    }
    refused(
        "files",
        &["break", &absent, "--scene", "vase"],
        &["--scene"],
    );
}

#[test]
fn supports_that_cannot_be_meant_are_refused_with_an_example() {
    for (spec, part) in [
        ("below", "KIND:WHERE"),
        ("below:w:0", "an axis and a coordinate"),
        ("above:x:high", "an axis and a coordinate"),
        ("box:0,0,0,1", "lowest and its highest"),
        ("sphere:0,0,0", "centre and its radius"),
        ("sphere:0,0,0,-1", "radius that is not above zero"),
        ("group:", "a group takes a name"),
        ("circle:0", "kind of region is unknown"),
        ("below:z:0@xx", "letters x, y and z"),
        ("group:frame", "there is no group `frame`"),
    ] {
        refused_in_a_sentence("support", &["--scene", "pane", "--support", spec], &[part]);
    }
    let drop = ["--support", "below:z:0", "--drop", "1"];
    refused_in_a_sentence("support", &drop, &["cannot be dropped", "--ball"]);
}

#[test]
fn options_for_meshes_are_refused_elsewhere() {
    let check = |args: &[&str], parts: &[&str]| refused_in_a_sentence("mesh", args, parts);
    check(&["--size", "0.1"], &["--size applies only to mesh files"]);
    check(&["--resolution", "9"], &["resolution is 9", "500 to"]);
    check(&["--up", "z"], &["--up applies only to mesh files"]);
    check(&["--up", "q"], &["--up is `q`", "x, y or z"]);
    let input = Folder::new("mesh-input");
    let mesh = scene_file(&input, "a.obj", "v 0 0 0\n");
    check(&["break", &mesh, "--size", "-1"], &["size is -1", "3 m"]);
    check(&["break", &mesh, "--size", "nan"], &["size is NaN"]);
    check(&["break", &mesh, "--resolution", "7"], &["resolution is 7"]);
    check(
        &["break", &mesh, "--resolution", "-7"],
        &["resolution is -7"],
    );
    let baked = scene_file(&input, "a.frangible", "x");
    check(
        &["break", &baked, "--material", "glas"],
        &["unknown material `glas`; materials: glass, "],
    );
    check(
        &["break", &baked, "--size", "-0.1"],
        &["the body's size is -0.1"],
    );
    check(
        &["break", &baked, "--modes", "9"],
        &["already baked", "bake"],
    );
    check(
        &["break", &baked, "--resolution", "3000"],
        &["--resolution cannot change `a`", "`frangible bake`"],
    );
}

#[test]
fn bakes_that_cannot_be_are_refused_and_leave_nothing() {
    let folder = Folder::new("bake");
    let scene = scene_file(
        &folder,
        "two.toml",
        "[[body]]\nshape = \"vase\"\n[[body]]\nshape = \"bowl\"\n",
    );
    let out = |name: &str| folder.0.join(name).to_string_lossy().into_owned();
    let far = out("no-such-folder/a.frangible");
    let good = out("a.frangible");
    let wrong = out("a.obj");
    for (args, part) in [
        (vec!["--scene", "vas", "-o", &good], "did you mean `vase`"),
        (
            vec!["--scene", "vase", "-o", &wrong],
            "must end in .frangible",
        ),
        (vec!["--scene", "vase", "-o", &far], "-o FILE"),
        (vec![&scene, "-o", &good], "2 bodies"),
        (
            vec!["--scene", "vase", "-o", &good, "--modes", "0"],
            "--modes",
        ),
        (
            vec!["--scene", "vase", "-o", &good, "--size", "1"],
            "mesh files",
        ),
        (vec![&good, "-o", &good], "no such file"),
        (vec!["-o", &good], "FILE"),
        (vec!["--scene", "vase"], "--output"),
    ] {
        let output = frangible(&[&["bake"], &args[..]].concat(), None);
        let message = text(&output.stderr);
        assert!(!output.status.success(), "{args:?}");
        assert_ne!(output.status.code(), Some(101), "{message}");
        assert!(message.contains(part), "{args:?}: {message}");
        assert_eq!(folder.files(), ["two.toml"], "{args:?} left files");
    }
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

#[test]
fn meshes_that_cannot_be_broken_are_refused_in_a_sentence() {
    let input = Folder::new("bad-meshes");
    let path = |name: &str| input.0.join(name).to_string_lossy().into_owned();
    let file = |name: &str, bytes: &[u8]| {
        fs::write(path(name), bytes).expect("a mesh file");
        path(name)
    };
    let good = file("buddha.obj", box_obj([0.1; 3]).as_bytes());
    let diary = "Dear diary, today I renamed a letter to see what comes of it. ".repeat(9);
    let mut glb = b"glTF\x02\0\0\0\x00\x10\0\0\x00\x08\0\0JSON{\"asset\":".to_vec();
    let cut_glb = file("cut.glb", &glb);
    glb.truncate(7);
    let nan = box_obj([0.1; 3]).replacen("v 0 ", "v nan ", 1);
    let flat = "v 0 0 0\nv .1 0 0\nv .1 .1 0\nv 0 .1 0\nf 1 2 3 4\n";
    let mut cut_stl = vec![0; 84];
    cut_stl[80] = 5;
    cut_stl.extend([0; 120]);
    let cases: [(String, &[&str]); 13] = [
        (
            path("budha.obj"),
            &["no such file", "did you mean `buddha.obj`"],
        ),
        (path("no/such/folder.obj"), &["no such file", "folder.obj"]),
        (file("empty.glb", b""), &["empty"]),
        (
            file("diary.stl", diary.as_bytes()),
            &["text", "solid", "diary.stl"],
        ),
        (file("diary.glb", diary.as_bytes()), &["glTF", "diary.glb"]),
        (
            file("diary.obj", diary.as_bytes()),
            &["no triangles", "diary.obj"],
        ),
        (
            file("diary.frangible", diary.as_bytes()),
            &["diary.frangible"],
        ),
        (cut_glb, &["cut.glb"]),
        (file("shorter.glb", &glb), &["shorter.glb"]),
        (file("cut.stl", &cut_stl), &["truncated", "facet 3 of 5"]),
        (
            file("nan.obj", nan.as_bytes()),
            &["vertex 1", "finite", "nan.obj"],
        ),
        (
            file("flat.obj", flat.as_bytes()),
            &["flat", "thickness", "flat.obj"],
        ),
        (
            file("huge.obj", box_obj([120.0, 90.0, 60.0]).as_bytes()),
            &["120 m", "--size 0.12"],
        ),
    ];
    for (path, parts) in &cases {
        refused_in_a_sentence("bad-meshes-out", &["break", path, "--no-pictures"], parts);
        let baked = input.0.join("never.frangible");
        let args = ["bake", path, "-o", &*baked.to_string_lossy()];
        let output = frangible(&args, None);
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        assert!(!baked.exists(), "{path} was baked");
    }
    for (option, value, part) in [
        ("--resolution", "3", "500 to 2000000"),
        ("--resolution", "2000001", "500 to 2000000"),
        ("--size", "1e-5", "0.001 to 3 m"),
        ("--size", "1e9", "0.001 to 3 m"),
        ("--up", "w", "x, y or z"),
        ("--material", "glas", "materials: glass, "),
    ] {
        refused_in_a_sentence("bad-meshes-out", &["break", &good, option, value], &[part]);
    }
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

#[test]
fn walls_too_thin_are_refused_with_the_resolution_they_need_and_no_folder_is_left() {
    let input = Folder::new("thin");
    for (thickness, part) in [(0.003, "--resolution "), (0.0001, "at least ")] {
        let mesh = scene_file(&input, "cross.obj", &cross_obj(0.3, thickness));
        let out = input.0.join("out");
        let output = frangible(&["break", &mesh], Some(&out));
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(
            message.contains(part) && message.contains("`cross`"),
            "{message}"
        );
        assert_eq!(message.trim_end().lines().count(), 1, "{message}");
        assert!(!out.exists(), "an empty folder is left behind");
    }
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
