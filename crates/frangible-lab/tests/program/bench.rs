//! `frangible-lab bench`: the figures are there and fit together; an impossible measurement is refused.

use super::{Folder, lab, refused, text};

#[test]
fn a_body_of_table_1_is_baked_once_and_measured() {
    let folder = Folder::new("bench");
    let cache = folder.text();
    let words = [
        "bench", "table1", "--body", "slab-low", "--runs", "2", "--cache", cache,
    ];
    let measured = || -> serde_json::Value {
        let output = lab(&words);
        assert!(output.status.success(), "{}", text(&output.stderr));
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    let (first, second) = (measured(), measured());
    assert!(first["machine"]["processor"].is_string(), "{first}");
    let (row, other) = (&first["measured"][0], &second["measured"][0]);
    assert_eq!(row["subject"]["name"], "slab-low");
    // The second run read the bakes of the first, and broke them the same way.
    assert_eq!(row["bake_s"], other["bake_s"]);
    for model in ["paper", "two_samples", "ours"] {
        let (a, b) = (&row[model], &other[model]);
        for count in ["steps", "crossed", "cracks", "fragments"] {
            assert_eq!(a[count], b[count], "{model} {count}");
        }
        let number = |key: &str| a["warm_s"][key].as_f64().expect("a number");
        assert!(a["fragments"].as_u64() > Some(1), "{a}");
        let stages = ["response", "stresses", "cracks", "fragments"];
        assert!(stages.iter().all(|s| number(s) > 0.0), "{a}");
        assert!(
            number("total") > 0.0 && a["colliders_s"].as_f64() > Some(0.0),
            "{a}"
        );
    }
    assert!(row["paper"]["reference_s"].as_f64() > Some(0.0));
}

#[test]
fn what_cannot_be_measured_is_refused() {
    refused(&["bench", "table1", "--body", "cow"], &["slab-low"]);
    refused(
        &["bench", "table1", "--body", "slab-low", "--write", "."],
        &["--body", "--write"],
    );
    refused(&["bench", "again", "--body", "glass"], &["bench table1"]);
    refused(&["bench", "table1", "--runs", "0"], &["1..=10000"]);
}
