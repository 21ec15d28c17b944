//! `frangible verify`: all cases pass, the page is written, and a place that cannot be written is refused at once.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of its own for a test.
fn folder(test: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("frangible-verify-{}-{test}", std::process::id()));
    fs::create_dir_all(&path).expect("a folder for the test");
    path
}

fn verify(what: &[&str], write: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_frangible"));
    command.arg("verify").args(what);
    command.args(["--json", "--write"]).arg(write);
    command.output().expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn all_cases_pass_and_the_page_is_the_published_one() {
    let folder = folder("page");
    let place = folder.join("docs");
    let output = verify(&[], &place);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["pass"], true);
    let cases = report["cases"].as_array().expect("a list of cases");
    assert!(cases.len() >= 10);
    for case in cases {
        assert!(case["seconds"].as_f64().is_some_and(|s| s >= 0.0));
        for check in case["checks"].as_array().expect("a list of checks") {
            let number = |key: &str| check[key].as_f64().expect("a number");
            assert_eq!(check["pass"], true, "{check}");
            assert!(number("error") <= number("tolerance"), "{check}");
        }
    }
    // Headings and names as published; frangible-verify compares the numbers.
    let published = include_str!("../../../docs/verification.md");
    let written = fs::read_to_string(place.join("verification.md")).expect("the page");
    let names = |page: &str| -> Vec<String> {
        let first = |line: &str| line.split(" | ").next().unwrap_or("").to_string();
        page.lines().map(first).collect()
    };
    assert_eq!(
        names(&written),
        names(published),
        "run `frangible verify --write docs`"
    );
    let plot = fs::read(place.join("verification/convergence.png")).expect("the plot");
    assert!(plot.starts_with(b"\x89PNG"));
    let _ = fs::remove_dir_all(folder);
}

#[test]
fn a_folder_that_cannot_be_made_is_refused_before_anything_is_computed() {
    let folder = folder("file");
    let file = folder.join("taken");
    fs::write(&file, "a file").expect("a file");
    for what in [&[][..], &["experiments"], &["pieces"]] {
        let output = verify(what, &file);
        assert!(!output.status.success());
        let message = text(&output.stderr);
        assert!(
            message.starts_with("error: ") && message.contains("--write DIR"),
            "{message}"
        );
        assert!(output.stdout.is_empty());
    }
    let _ = fs::remove_dir_all(folder);
}
