//! The last impact by several methods, in the view model.

use crate::common::{broken, folder, give, pane};
use frangible_view::{Command, Session, Subject};

fn names(session: &Session) -> Vec<&'static str> {
    let methods = session.methods().expect("methods");
    methods.chosen.iter().map(|method| method.name()).collect()
}

fn refusal(session: &mut Session, line: &str) -> String {
    let refused = session.apply(Command::parse(line).unwrap());
    refused.expect_err("refused").to_string()
}

#[test]
fn the_first_four_methods_stand_side_by_side_with_their_numbers() {
    let mut session = broken("methods");
    let pieces = session.blow().unwrap().pieces();
    give(&mut session, "compare-methods first");
    let shown = session.shown();
    assert_eq!(shown.subject, Subject::Methods);
    assert!(shown.paused && !shown.busy);
    let four = ["ours", "quasi-static", "elements", "energy-voronoi"];
    assert_eq!(names(&session), four);
    let methods = &shown.methods;
    assert_eq!(methods[0].pieces, pieces, "ours is what happened");
    for outcome in methods {
        assert!(outcome.pieces > 1 && outcome.crack_area > 0.0 && outcome.energy > 0.0);
    }
    // A label for each pane, all in different places, and something to see in each.
    let labels = &shown.picture.labels;
    assert_eq!(labels.len(), 4);
    assert!(labels[0].text.starts_with("ours: "), "{}", labels[0].text);
    for (i, a) in labels.iter().enumerate() {
        assert!(labels[..i].iter().all(|b| a.at.distance(b.at) > 0.2));
        let near = |p: &frangible::glam::Vec3| p.distance(a.at) < 0.25;
        let mut corners = shown.picture.batches.iter().flat_map(|b| &b.positions);
        assert!(corners.any(near), "{}", a.text);
    }
}

#[test]
fn other_methods_are_chosen_and_what_is_known_is_kept() {
    let mut session = broken("methods-chosen");
    give(&mut session, "compare-methods voronoi,ours");
    assert_eq!(names(&session), ["voronoi", "ours"]);
    let first = session.methods().unwrap().outcomes.clone();
    // About as many cells as pieces, in a convex pane: on either side crumbs join a neighbour.
    let [cells, pieces] = [first[0].numbers.pieces, first[1].numbers.pieces];
    assert!(
        5 * cells.abs_diff(pieces) < pieces,
        "{cells} cells, {pieces} pieces"
    );
    give(&mut session, "compare-methods ours,elements,voronoi");
    assert_eq!(names(&session), ["ours", "elements", "voronoi"]);
    let now = &session.methods().unwrap().outcomes;
    assert_eq!(now.len(), 3);
    for (old, new) in first.iter().zip(now) {
        assert!(std::sync::Arc::ptr_eq(old, new), "not computed again");
    }
    // Away and back: those that were chosen last.
    give(&mut session, "look world");
    give(&mut session, "compare-methods first");
    assert_eq!(names(&session), ["ours", "elements", "voronoi"]);
    give(&mut session, "look world");
    give(&mut session, "look methods");
    assert_eq!(session.shown().subject, Subject::Methods);
}

#[test]
fn a_new_break_is_compared_anew_and_an_undone_one_forgotten() {
    let mut session = broken("methods-undo");
    give(&mut session, "compare-methods ours");
    give(&mut session, "undo");
    assert!(session.methods().is_none());
    assert_eq!(session.shown().subject, Subject::World);
    assert!(refusal(&mut session, "look methods").contains("(M)"));
}

#[test]
fn the_numbers_are_in_the_report_that_is_saved() {
    let mut session = broken("methods-report");
    give(&mut session, "compare-methods ours,voronoi");
    let path = folder("methods-report").join("report.json");
    give(&mut session, &format!("save report {}", path.display()));
    let text = std::fs::read_to_string(&path).unwrap();
    let report: serde_json::Value = serde_json::from_str(&text).unwrap();
    let rows = report["methods"].as_array().unwrap();
    assert_eq!(rows.len(), 2);
    assert_eq!(rows[0]["method"], "ours");
    assert_eq!(rows[0]["pieces"], report["pieces"]);
    assert_eq!(rows[0]["crack_area_m2"], report["crack_area_m2"]);
}

#[test]
fn what_cannot_be_compared_is_told() {
    let mut session = pane("methods-refused");
    assert!(
        refusal(&mut session, "compare-methods first").contains("there has been no contact yet")
    );
    give(&mut session, "step 500");
    let all = "compare-methods ours,quasi-static,elements,energy-voronoi,voronoi";
    assert!(refusal(&mut session, all).contains("up to 4"));
    let wrong = Command::parse("compare-methods vorono").expect_err("no method");
    assert!(
        wrong.to_string().contains("did you mean `voronoi`"),
        "{wrong}"
    );
}
