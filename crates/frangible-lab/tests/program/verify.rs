//! `frangible-lab verify`: all cases pass, the page is written, and a place that cannot be written is refused at once.

use std::fs;

use super::{Folder, lab, refused, text};

#[test]
#[ignore = "computes all cases of `tests/cases.rs` again: `cargo xtask ci 'long tests'` runs it"]
fn all_cases_pass_and_the_page_is_the_published_one() {
    let folder = Folder::new("page");
    let place = folder.path().join("docs");
    let output = lab(&[
        "verify",
        "--json",
        "--write",
        place.to_str().expect("a path"),
    ]);
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
    // Headings and names as published; `tests/cases.rs` compares the numbers.
    let published = include_str!("../../../../docs/verification.md");
    let written = fs::read_to_string(place.join("verification.md")).expect("the page");
    let names = |page: &str| -> Vec<String> {
        let first = |line: &str| line.split(" | ").next().unwrap_or("").to_string();
        page.lines().map(first).collect()
    };
    assert_eq!(
        names(&written),
        names(published),
        "run `frangible-lab verify --write docs`"
    );
    let plot = fs::read(place.join("verification/convergence.png")).expect("the plot");
    assert!(plot.starts_with(b"\x89PNG"));
}

#[test]
fn a_folder_that_cannot_be_made_is_refused_before_anything_is_computed() {
    let folder = Folder::new("file");
    let file = folder.path().join("taken");
    fs::write(&file, "a file").expect("a file");
    let file = file.to_str().expect("a path");
    for command in ["verify", "experiments", "pieces", "near-field"] {
        refused(&[command, "--json", "--write", file], &["--write DIR"]);
    }
}
