//! `frangible-lab bench`: the figures are there and fit together; an impossible measurement is refused.

use super::{Folder, lab, refused, text};

#[test]
fn a_body_of_table_1_is_baked_once_and_measured() {
    let folder = Folder::new("bench");
    let cache = folder.text();
    let words = [
        "bench", "table1", "--body", "slab-low", "--runs", "2", "--json", "--cache", cache,
    ];
    let measured = || -> serde_json::Value {
        let output = lab(&words);
        assert!(output.status.success(), "{}", text(&output.stderr));
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    let (first, second) = (measured(), measured());
    let row = &first["table1"][0];
    assert_eq!(row["subject"]["name"], "slab-low");
    // The second run read the bakes of the first, and broke them the same way.
    assert_eq!(row["bake"], second["table1"][0]["bake"]);
    for model in ["paper", "two_samples", "ours"] {
        let (a, b) = (&row[model], &second["table1"][0][model]);
        for count in ["steps", "crossed", "cracks", "fragments"] {
            assert_eq!(a[count], b[count], "{model} {count}");
        }
        let number = |key: &str| a["warm"][key].as_f64().expect("a number");
        assert!(a["fragments"].as_u64() > Some(1), "{a}");
        let stages = ["response", "displacements", "cracks", "fragments"];
        assert!(stages.iter().all(|s| number(s) > 0.0), "{a}");
        assert!(
            number("total") > 0.0 && a["colliders"].as_f64() > Some(0.0),
            "{a}"
        );
    }
    assert!(row["paper"]["reference"].as_f64() > Some(0.0));
    assert!(first["contacts"].is_null());
}

#[test]
fn the_roofline_of_a_body_is_measured_and_written() {
    let folder = Folder::new("roofline");
    let cache = folder.text();
    let output = lab(&[
        "bench", "roofline", "--body", "slab-low", "--json", "--cache", cache, "--write", cache,
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let arithmetic = &found["roofline"]["arithmetic"];
    // f64 vectors are half as long; a wide margin, since others may use the machine.
    let halves = number(&arithmetic["separate"]) / number(&arithmetic["double"]);
    assert!((1.0..4.0).contains(&halves), "{arithmetic}");
    let body = &found["roofline"]["bodies"][0];
    let points: u64 = body["points"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|n| n.as_u64())
        .sum();
    assert!(points > 1000, "{body}");
    let stages = body["stages"].as_array().expect("a list");
    assert_eq!(stages.len(), 3);
    for stage in stages {
        let [operations, bytes, seconds] =
            ["operations", "bytes", "seconds"].map(|key| number(&stage[key]));
        // A stage's time is a difference of two: beside other work on the machine it may come out below zero.
        assert!(operations > bytes && seconds.is_finite(), "{stage}");
    }
    let page =
        std::fs::read_to_string(folder.path().join("roofline.md")).expect("the page is written");
    assert!(page.contains("| slab-low: displacements u = Φ q"), "{page}");
}

#[test]
fn a_section_is_written_and_the_others_stay() {
    let folder = Folder::new("bench-page");
    let page = folder.path().join("performance.md");
    std::fs::write(&page, "# Performance\n\n## Refused contacts\n\nas it was\n").expect("a page");
    let cache = folder.path().join("cache");
    let output = lab(&[
        "bench",
        "haptic",
        "--ticks",
        "600",
        "--runs",
        "1",
        "--cache",
        cache.to_str().expect("a plain path"),
        "--write",
        folder.text(),
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let page = std::fs::read_to_string(&page).expect("the page");
    let headings: Vec<&str> = page.lines().filter_map(|l| l.strip_prefix("## ")).collect();
    let expected = [
        "Refused contacts",
        "A plate under a hand, a thousand times a second",
        "How to measure it again",
    ];
    assert_eq!(headings, expected);
    assert!(
        page.contains("as it was") && page.contains("| no contact "),
        "{page}"
    );
}

#[test]
fn what_cannot_be_measured_is_refused() {
    refused(&["bench", "table1", "--body", "cow"], &["slab-low"]);
    refused(
        &["bench", "table1", "--body", "slab-low", "--write", "."],
        &["remove --body"],
    );
    refused(&["bench", "shop", "--body", "glass"], &["bench table1"]);
    refused(&["bench", "--runs", "0"], &["1..=10000"]);
    refused(&["bench", "haptic", "--ticks", "1"], &["100..=10000000"]);
    refused(&["bench", "--body", "glass", "--write", "."], &["--write"]);
}
