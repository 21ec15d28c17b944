//! Mesh files of several parts.

use std::fmt::Write as _;

use crate::common::{Folder, frangible, refused_in_a_sentence, text};

/// Two blocks of 100 × 50 × 50 mm with this gap between their ends, m.
fn two_blocks(gap: f64) -> String {
    let mut obj = String::new();
    for (i, name) in ["left", "right"].iter().enumerate() {
        let _ = writeln!(obj, "o {name}");
        for corner in 0..8 {
            let x = 0.1 * f64::from(corner & 1) + i as f64 * (0.1 + gap);
            let [y, z] = [1, 2].map(|k| 0.05 * f64::from(corner >> k & 1));
            let _ = writeln!(obj, "v {x} {y} {z}");
        }
        for face in [
            [1, 3, 4, 2],
            [5, 6, 8, 7],
            [1, 2, 6, 5],
            [3, 7, 8, 4],
            [1, 5, 7, 3],
            [2, 4, 8, 6],
        ] {
            let [a, b, c, d] = face.map(|v| v + 8 * i);
            let _ = writeln!(obj, "f {a} {b} {c} {d}");
        }
    }
    obj
}

fn file(folder: &Folder, gap: f64) -> String {
    let path = folder.0.join("blocks.obj");
    std::fs::write(&path, two_blocks(gap)).expect("a mesh file");
    path.to_string_lossy().into_owned()
}

const QUICK: [&str; 6] = [
    "--no-pictures",
    "--no-sound",
    "--modes",
    "8",
    "--resolution",
    "2000",
];

#[test]
fn two_parts_are_two_bodies_and_welded_parts_are_one() {
    let input = Folder::new("parts-input");
    let blocks = file(&input, 0.002);
    for (options, bodies, note) in [
        (&[][..], 2, "2 closed parts, each a body of its own"),
        (
            &["--parts", "largest"],
            1,
            "the largest of 2 closed parts, `left`, is the body",
        ),
        (
            &["--parts", "weld", "--gap", "0.002"],
            1,
            "gaps of up to 2.000 mm are filled",
        ),
    ] {
        let out = Folder::new("parts");
        let args = [
            &["break", &blocks, "--drop", "0.01", "--json"],
            &QUICK[..],
            options,
        ]
        .concat();
        let run = frangible(&args, Some(&out.0));
        assert!(run.status.success(), "{}", text(&run.stderr));
        let report: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
        let list = report["bodies"].as_array().map_or(1, Vec::len);
        assert_eq!(list, bodies, "{options:?}");
        let notes = report["notes"].to_string();
        assert!(notes.contains(note), "{notes}");
        if bodies == 2 {
            for body in report["bodies"].as_array().expect("bodies") {
                let closed = body["surface_volume_m3"].as_f64().expect("a volume");
                assert!((closed / 2.5e-4 - 1.0).abs() < 1e-6);
                let meshed = body["volume_m3"].as_f64().expect("a volume");
                // The lattice may cut off corners, by less than 3 %.
                assert!((meshed / closed - 1.0).abs() < 0.03);
            }
        }
    }
}

#[test]
fn a_baked_file_holds_one_body_and_each_part_can_have_its_own() {
    let input = Folder::new("parts-baked");
    let blocks = file(&input, 0.002);
    let output = input.0.join("b.frangible");
    let output = output.to_string_lossy();
    let bake = [
        "bake",
        &blocks,
        "-o",
        &output,
        "--modes",
        "8",
        "--resolution",
        "2000",
    ];
    let refused = frangible(&bake, None);
    assert!(!refused.status.success());
    let message = text(&refused.stderr);
    for part in [
        "several bodies",
        "`left` (50 %)",
        "--parts largest",
        "--parts weld",
    ] {
        assert!(message.contains(part), "{message}");
    }
    let done = frangible(&[&bake[..], &["--parts", "separate"]].concat(), None);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let mut files = input.files();
    files.sort();
    assert_eq!(
        files,
        ["b-left.frangible", "b-right.frangible", "blocks.obj"]
    );
}

#[test]
fn parts_that_cannot_be_chosen_are_refused_in_a_sentence() {
    let input = Folder::new("parts-refused");
    let blocks = file(&input, 0.002);
    let with = |options: &[&str], parts: &[&str]| {
        let args = [&["break", &*blocks][..], options].concat();
        refused_in_a_sentence("parts-refused-out", &args, parts);
    };
    with(
        &["--parts", "weld"],
        &["`left`", "`right`", "2.000 mm apart", "0.0020 m"],
    );
    with(&["--parts", "weld", "--gap", "0.001"], &["1.000 mm"]);
    with(&["--parts", "all"], &["separate, largest or weld"]);
    with(&["--gap", "0.001"], &["--parts weld"]);
    with(&["--parts", "largest", "--wall", "0.002"], &["--wall"]);
    let scene = &["break", "--scene", "glass", "--parts", "largest"];
    refused_in_a_sentence("parts-scene", scene, &["--parts", "mesh files"]);
}
