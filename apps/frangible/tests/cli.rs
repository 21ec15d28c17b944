//! Tests of the command line: the messages for bad input, and the files left by good input.

use std::fs;
use std::process::{Command, Stdio};

use crate::common::{Folder, frangible, refused, refused_in_a_sentence, text};

#[test]
fn unknown_names_are_met_with_the_nearest() {
    let check = |args: &[&str], parts: &[&str]| refused_in_a_sentence("names", args, parts);
    check(
        &["--scene", "glas"],
        &["scene `glas`", "did you mean `glass`"],
    );
    check(
        &["break", "--scene", "glas"],
        &["scene `glas`", "did you mean `glass`"],
    );
    check(&["--scene", ""], &["scene ``", "glass"]);
    check(&["--material", "porcelan"], &["`porcelan`", "porcelain"]);
    check(&["--ball", "0.1,0.02,10,stel"], &["`stel`", "steel"]);
}

#[test]
fn impossible_drops_are_refused() {
    for height in ["nan", "-1", "0", "inf", "-inf", "1e9"] {
        refused_in_a_sentence(
            "drop",
            &["--drop", height],
            &["the drop height is", "above 0 and at most 100 m"],
        );
    }
    refused("drop", &["--drop", "high"], &["high", "--drop"]);
}

#[test]
fn impossible_numbers_of_modes_are_refused() {
    for modes in ["0", "-3"] {
        refused_in_a_sentence(
            "modes",
            &["--modes", modes],
            &["--modes", modes, "1 to 400"],
        );
    }
    refused_in_a_sentence(
        "modes",
        &["--modes", "100000"],
        &["number of modes", "100000", "1 to 400"],
    );
    refused("modes", &["--modes", "1.5"], &["1.5", "--modes"]);
}

#[test]
fn impossible_balls_are_refused() {
    let check = |ball: &str, parts: &[&str]| {
        refused_in_a_sentence("ball", &["--scene", "pane", "--ball", ball], parts);
    };
    for bad in ["nan", "-1", "0", "inf"] {
        check(&format!("{bad},0.01,10"), &["the ball's mass is", "kg"]);
        check(&format!("0.1,{bad},10"), &["the ball's radius is", " m"]);
        check(&format!("0.1,0.01,{bad}"), &["the ball's speed is", "m/s"]);
    }
    check("0.1,0.01", &["`0.1,0.01`", "MASS,RADIUS,SPEED"]);
    check("", &["MASS,RADIUS,SPEED"]);
    check("0.1,0.01,10,steel,red", &["red", "MASS,RADIUS,SPEED"]);
    check("heavy,0.01,10", &["mass", "`heavy`", "kg"]);
    check("0.1,0.01,fast", &["speed", "`fast`", "m/s"]);
}

#[test]
fn impossible_aims_are_refused() {
    let check = |option: &str, value: &str, parts: &[&str]| {
        refused_in_a_sentence(
            "aim",
            &["--scene", "pane", "--ball", "0.1,0.01,10", option, value],
            parts,
        );
    };
    check("--at", "nan,0,0", &["--at", "finite"]);
    check("--at", "0,inf,0", &["--at", "finite"]);
    check("--at", "1,2", &["--at", "`1,2`", "three numbers"]);
    check("--at", "a,b,c", &["--at", "`a,b,c`", "three numbers"]);
    check("--toward", "0,0,0", &["--toward", "not all zero"]);
    check("--toward", "nan,0,1", &["--toward", "finite"]);
}

#[test]
fn impossible_sheets_are_refused() {
    for count in ["0", "-2", "1000000"] {
        refused_in_a_sentence(
            "sheet",
            &["--contact-sheet", count],
            &["--contact-sheet", count, "1 to "],
        );
    }
}

#[test]
fn options_that_clash_or_do_not_exist_are_refused() {
    refused(
        "clash",
        &["--ball", "0.1,0.01,10", "--drop", "1"],
        &["--ball", "--drop"],
    );
    refused("clash", &["--at", "0,0,0"], &["--ball"]);
    refused(
        "clash",
        &["--seed", "-1"],
        &["-1", "--seed", "whole number"],
    );
    refused("clash", &["--no-such-option"], &["--no-such-option"]);
    refused_in_a_sentence(
        "clash",
        &["--contact-sheet", "9", "--no-pictures"],
        &["--contact-sheet 9", "--no-pictures", "remove one"],
    );
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_the_work() {
    let folder = Folder::new("unwritable");
    let file = folder.0.join("file");
    fs::write(&file, "mine").expect("a file");
    for out in [file.clone(), file.join("below"), file.join("far/below")] {
        let output = frangible(&["--no-pictures"], Some(&out));
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(
            message.starts_with("error: ") && message.trim_end().lines().count() == 1,
            "{message}"
        );
        assert!(
            message.contains(&*out.to_string_lossy())
                && message.contains("file` is not a folder")
                && message.contains("--out"),
            "{message}"
        );
    }
    assert_eq!(fs::read(&file).expect("the file"), b"mine");
    assert_eq!(folder.files(), ["file"]);
}

#[test]
fn help_names_every_option_and_its_unit() {
    for args in [&["--help"][..], &["break", "--help"]] {
        let output = frangible(args, None);
        let help = text(&output.stdout);
        assert!(output.status.success());
        for option in [
            "--scene",
            "--material",
            "--drop",
            "--ball",
            "--at",
            "--toward",
            "--seed",
            "--modes",
            "--out",
            "--contact-sheet",
            "--json",
            "--no-pictures",
            "--size",
            "--resolution",
            "--up",
            "--wall",
        ] {
            assert!(help.contains(option), "no {option} in: {help}");
        }
        for unit in ["metres", "kg", "m/s", "in m "] {
            assert!(help.contains(unit), "no {unit} in: {help}");
        }
    }
}

#[test]
fn scenes_lists_scenes_and_materials() {
    let output = frangible(&["scenes"], None);
    let list = text(&output.stdout);
    assert!(output.status.success());
    let named = |name: &str| {
        list.lines()
            .any(|line| line.split_whitespace().next() == Some(name))
    };
    for scene in frangible_scenes::SCENE_NAMES {
        assert!(named(scene), "no {scene} in: {list}");
    }
    for material in frangible::Material::presets() {
        assert!(named(material.name), "no {} in: {list}", material.name);
    }
    for action in ["(brick; 5 × hammer 0.5 kg", "3 × drop 0.9032 m; ball"] {
        assert!(list.contains(action), "no `{action}` in: {list}");
    }
}

#[test]
fn a_gentle_drop_is_reported_as_json() {
    let folder = Folder::new("gentle");
    let output = frangible(
        &["--drop", "0.03", "--no-pictures", "--json", "--modes", "20"],
        Some(&folder.0),
    );
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let report: serde_json::Value =
        serde_json::from_slice(&output.stdout).expect("one JSON document");
    assert_eq!(report["broke"], false, "{report:#}");
    assert_eq!(report["fragments"], 1);
    assert_eq!(report["modes"], 20);
    assert_held(&report);
    let mut files = folder.files();
    files.sort();
    assert_eq!(files, ["glass.glb", "glass.wav"]);
    let sound = &report["sound"];
    let level = |key: &str| sound[key].as_f64().unwrap_or(f64::NAN);
    assert_eq!(sound["level"], "loudness", "{report:#}");
    assert!((level("loudness_lufs") + 16.0).abs() < 0.5, "{report:#}");
    assert!(level("true_peak_db") < -0.99, "{report:#}");
    assert!(level("full_scale_db") <= level("loudest_db"), "{report:#}");
    // Dropped by 3 cm it is heard, and lasts a second at least at 48 kHz and four bytes.
    let wav = fs::read(folder.0.join("glass.wav")).expect("the WAV");
    assert!(wav.starts_with(b"RIFF") && wav.len() > 4 * 48_000);
    assert!(wav[44..].iter().any(|&byte| byte != 0));
    assert!(
        fs::read(folder.0.join("glass.glb"))
            .expect("the GLB")
            .starts_with(b"glTF")
    );
}

#[test]
fn a_sound_true_to_scale_is_as_loud_as_fits_and_says_how_loud_that_is() {
    let folder = Folder::new("true");
    let args = "--drop 0.03 --no-pictures --modes 20 --level true";
    let args: Vec<&str> = args.split(' ').collect();
    let output = frangible(&args, Some(&folder.0));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    let note = "the loudest sample of the sound corresponds to ";
    assert!(table.contains(note), "no `{note}` in: {table}");
    let wav = fs::read(folder.0.join("glass.wav")).expect("the WAV");
    let samples = wav[44..].as_chunks::<2>().0.iter();
    let loudest = samples.map(|bytes| i16::from_le_bytes(*bytes).unsigned_abs());
    assert_eq!(loudest.max(), Some(32_767));
}

#[test]
fn a_ball_that_meets_nothing_is_told_how_to_aim() {
    let folder = Folder::new("missed");
    let args = "--scene window --ball 0.1,0.02,5 --at 3,3,3 --modes 8 --resolution 2000 --no-pictures --no-sound";
    let args: Vec<&str> = args.split(' ').collect();
    let output = frangible(&args, Some(&folder.0));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    for part in [
        "none hard enough",
        "no projectile hit a body",
        "--at and --toward",
    ] {
        assert!(table.contains(part), "no `{part}` in: {table}");
    }
}

#[test]
fn the_same_arguments_give_the_same_bytes() {
    let folder = Folder::new("twice");
    let run = |name: &str| {
        let out = folder.0.join(name);
        let args = [
            "--scene",
            "glass",
            "--drop",
            "2.5",
            "--no-pictures",
            "--modes",
            "40",
            "--seed",
            "3",
            "--json",
        ];
        let output = frangible(&args, Some(&out));
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(report["broke"], true, "{report:#}");
        fs::read(out.join("glass.glb")).expect("the GLB")
    };
    let (first, second) = (run("first"), run("second"));
    assert!(first.starts_with(b"glTF"));
    assert!(
        first == second,
        "{} and {} bytes, or other ones",
        first.len(),
        second.len()
    );
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_frangible"))
        .arg("scenes")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("its end");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.is_empty(), "{said}");
}

/// Checks the report of the hardest blow on a body that held: it has a time, and its stress is not zero.
fn assert_held(report: &serde_json::Value) {
    let impact = &report["impact"];
    let number = |key: &str| impact[key].as_f64().unwrap_or(f64::NAN);
    assert!(number("margin") > 0.0, "{report:#}");
    assert!(number("time_s") > 0.0, "{report:#}");
    assert!(number("stress_bound_pa") > 0.0, "{report:#}");
    assert!(impact["peak_stress_pa"] != 0.0, "{report:#}");
    let blows = report["blows"].as_array().expect("a list");
    assert!(!blows.is_empty(), "{report:#}");
    assert!(
        blows.iter().all(|blow| blow["broke"] == false),
        "{report:#}"
    );
    let hardest = |blow: &&serde_json::Value| blow["time_s"] == impact["time_s"];
    assert_eq!(blows.iter().filter(hardest).count(), 1, "{report:#}");
}
