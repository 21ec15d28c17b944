//! `frangible-lab figures`: a figure is written with its text, and a name that none has is refused.

use std::fs;
use std::process::Output;

use super::{Folder, lab, refused, text};

/// Returns true if nothing can be drawn on this machine, and says so.
fn lacks_driver(output: &Output) -> bool {
    let lacks = text(&output.stderr).contains("no graphics adapter found");
    if lacks {
        println!("skipped: figures are drawn by a graphics driver, and there is none");
    }
    lacks
}

#[test]
fn a_figure_is_written_with_its_text_and_others_keep_theirs() {
    let folder = Folder::new("fig3");
    let page = folder.path().join("figures.md");
    let other = "## Fig. 7: the slab at three fracture toughnesses\n\nan older text | agrees |\n";
    fs::write(&page, format!("# a page\n\n{other}")).expect("a page");
    let output = lab(&["figures", "fig3", "--write", folder.text()]);
    if lacks_driver(&output) {
        return;
    }
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(
        text(&output.stdout).contains("agrees"),
        "{}",
        text(&output.stdout)
    );
    let png = fs::read(folder.path().join("figures/fig3.png")).expect("the picture");
    assert!(
        png.starts_with(b"\x89PNG") && png.len() < 150_000,
        "{}",
        png.len()
    );
    let written = fs::read_to_string(&page).expect("the page");
    let [rod, slab] = ["\n## Fig. 3", other].map(|part| written.find(part).expect(part));
    assert!(rod < slab, "{written}");
    assert!(written.contains("figures/fig3.png") && !written.contains("# a page"));
}

#[test]
fn an_unknown_figure_is_refused_with_those_there_are() {
    let folder = Folder::new("unknown");
    let place = folder.path().join("docs");
    let words = [
        "figures",
        "fig33",
        "--write",
        place.to_str().expect("a path"),
    ];
    refused(
        &words,
        &["there is no figure `fig33`, did you mean `fig3`?", "fig12"],
    );
    assert!(!place.exists(), "a folder was made");
}

#[test]
fn a_figure_as_json_has_its_claims_and_tables() {
    let folder = Folder::new("figure-json");
    let output = lab(&["figures", "fig3", "--json", "--write", folder.text()]);
    if lacks_driver(&output) {
        return;
    }
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let figure = &report["figures"][0];
    assert_eq!(figure["name"], "fig3");
    let claims = figure["claims"].as_array().expect("claims");
    assert!(!claims.is_empty() && claims.iter().all(|c| c["agrees"].is_boolean()));
    for table in figure["tables"].as_array().expect("tables") {
        let columns = table["heading"].as_array().expect("a heading").len();
        let rows = table["rows"].as_array().expect("rows");
        assert!(
            rows.iter()
                .all(|row| row.as_array().map(Vec::len) == Some(columns))
        );
    }
}
