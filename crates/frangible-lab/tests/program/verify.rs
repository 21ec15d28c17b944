//! `frangible-lab verify`: all cases pass, the data is written, and a place that cannot be written is refused at once.

use std::fs;

use frangible_lab::data::read;

use super::{Folder, lab, refused, text};

#[test]
#[ignore = "computes all cases of `tests/cases.rs` again: `cargo xtask ci 'long tests'` runs it"]
fn all_cases_pass_and_are_written() {
    let folder = Folder::new("data");
    let docs = folder.path().join("docs");
    let output = lab(&["verify", "--write", docs.to_str().expect("a path")]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let data = read(&docs, "verification").expect("JSON");
    let cases = data["measured"].as_object().expect("cases");
    assert!(cases.len() >= 10);
    for case in cases.values() {
        for check in case["checks"].as_array().expect("a list of checks") {
            let number = |key: &str| check[key].as_f64().expect("a number");
            assert!(number("error") <= number("tolerance"), "{check}");
        }
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_refused_before_anything_is_computed() {
    let folder = Folder::new("file");
    let file = folder.path().join("taken");
    fs::write(&file, "a file").expect("a file");
    let file = file.to_str().expect("a path");
    for command in ["verify", "experiments", "pieces", "near-field"] {
        refused(&[command, "--write", file], &["--write DIR"]);
    }
}
