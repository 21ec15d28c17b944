//! `frangible-lab figures`: a figure has its numbers, and a name that none has is refused.

use super::{lab, refused, text};

#[test]
fn a_figure_has_its_numbers() {
    let output = lab(&["figures", "fig3"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let data: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let figure = &data["measured"]["fig3"];
    let mut modes: Vec<u64> = Vec::new();
    for list in ["leaning", "on_rail", "shown"] {
        for row in figure[list].as_array().expect("rows") {
            let seconds = ["modal_s", "hertz_s"].map(|key| row[key].as_f64().expect("a number"));
            assert!(seconds.iter().all(|s| (1e-5..1e-2).contains(s)), "{row}");
            modes.push(row["mode"].as_u64().expect("a mode"));
        }
    }
    // The paper: the most excited mode depends on how the rod falls.
    modes.sort_unstable();
    modes.dedup();
    assert!(modes.len() >= 2, "{modes:?}");
    assert!(data["measured"]["fig4"].is_null());
}

#[test]
fn an_unknown_figure_is_refused_with_those_there_are() {
    refused(
        &["figures", "fig33"],
        &["there is no figure `fig33`", "fig3", "fig12"],
    );
}
