//! The view model, without a window.

use crate::common::{self, bits, broken, folder, give, masses, pane};
use frangible_view::{Command, Script, Session, Subject};

#[test]
fn a_break_undone_breaks_the_same_again() {
    let mut session = broken("undo");
    let shown = session.shown();
    let (pieces, after) = (masses(&shown), bits(&session));
    let steps = shown.steps;
    assert_eq!(shown.undoable, 1);
    give(&mut session, "undo");
    let shown = session.shown();
    assert_eq!((shown.pieces, shown.whole, shown.undoable), (0, 1, 0));
    assert!(shown.paused, "else it would break again at once");
    assert!(shown.time > 0.0, "not the beginning");
    // Fewer steps are left than there were.
    let mut again = 0;
    while bits(&session) != after {
        give(&mut session, "step 1");
        again += 1;
        assert!(again <= steps, "it never comes to the same");
    }
    assert_eq!(masses(&session.shown()), pieces);
    assert!(again < steps);
}

#[test]
fn what_was_done_does_the_same_again_as_a_script() {
    let mut session = pane("replay");
    give(&mut session, "ball 0.05 0.01 15 steel");
    give(&mut session, "knob strength 35");
    give(&mut session, "step 40");
    give(&mut session, "throw 0.4,0.3,1 0.03,0.12,0");
    give(&mut session, "step 400");
    give(&mut session, "undo");
    give(&mut session, "step 350");
    let path = folder("replay").join("done.txt");
    give(&mut session, &format!("save script {}", path.display()));
    let mut script = Script::read(&path).unwrap();
    let mut second = Session::new();
    while let Some(command) = script.next_command() {
        give(&mut second, &command.to_string());
    }
    assert!(session.shown().pieces > 1);
    assert_eq!(bits(&session), bits(&second));
}

#[test]
fn a_thrown_ball_flies_to_what_it_was_aimed_at() {
    let mut session = pane("throw");
    // Let the scene's own ball come second.
    give(&mut session, "ball 0.2 0.01 80 steel");
    give(&mut session, "throw 0.05,0.4,0.8 0.02,0.1,0");
    let start = session.shown();
    assert_eq!(start.pieces, 0);
    give(&mut session, "step 60");
    let shown = session.shown();
    let blow = shown.blow.expect("it hits the pane");
    let there = blow.point.unwrap();
    // The ball of 1 cm touches where its centre is over the face, 13 mm before the middle plane that the ray was aimed at.
    let centre = [0.02 + 0.013 * 0.03 / 0.8, 0.1 + 0.013 * 0.3 / 0.8];
    assert!(
        (there.x - centre[0]).abs() < 1e-3 && (there.y - centre[1]).abs() < 1e-3,
        "{there}"
    );
}

#[test]
fn a_thing_in_the_hand_goes_where_it_is_pulled_and_flies_on_when_it_is_let_go() {
    let mut session = pane("grab");
    // However hard the hand jerks it: this is about where it goes.
    give(&mut session, "knob strength 10000");
    let centre = |session: &Session| {
        let live = session.live().unwrap();
        live.pose(&live.things()[0]).unwrap().translation
    };
    // A ball of the scene is on its way; the pane is lifted over it.
    give(&mut session, "grab 0,0.15,1 0,0.15,0");
    give(&mut session, "pull 0,0.15,1 0.1,0.6,0");
    give(&mut session, "step 1000");
    let held = centre(&session);
    // The ray at the distance at which it was taken, and the centre 5 cm below that.
    let way = frangible::glam::Vec3::new(0.1, 0.45, -1.0).normalize() * 0.997;
    let there = frangible::glam::Vec3::new(0.0, 0.15, 1.0) + way - frangible::glam::Vec3::Y * 0.05;
    assert!(held.distance(there) < 0.02, "{held}, not {there}");
    assert_eq!(session.shown().pieces, 0);
    give(&mut session, "let-go");
    // Before it has met the floor, from which so strong a pane bounces almost as high.
    give(&mut session, "step 1000");
    let fallen = held.y - centre(&session).y;
    assert!(fallen > 0.1, "it falls, by {fallen} m");
    // The floor cannot be taken away.
    give(&mut session, "grab 0.9,1,0.9 0.9,0,0.9");
    give(&mut session, "pull 0.9,1,0.9 0.9,1,0");
    give(&mut session, "step 10");
}

#[test]
fn the_same_impact_with_the_same_knobs_gives_the_same_pieces() {
    let mut session = broken("again");
    let before = masses(&session.shown());
    give(&mut session, "hit-again");
    let shown = session.shown();
    let compared = shown.compared.unwrap();
    assert!(compared.differences.is_empty());
    let [old, new] = &compared.blows;
    assert_eq!(old.masses, before);
    assert_eq!(new.masses, before);
    assert_eq!(shown.subject, Subject::Compare);
}

#[test]
fn a_body_too_strong_to_break_holds_the_same_impact() {
    let mut session = broken("strong");
    give(&mut session, "knob strength 10000");
    assert!(session.shown().turned);
    give(&mut session, "hit-again");
    let compared = session.shown().compared.unwrap();
    assert!(compared.blows[0].pieces > 3);
    assert_eq!(compared.blows[1].pieces, 1);
    let (label, values, unit) = &compared.differences[0];
    assert_eq!((label.as_str(), unit.as_str()), ("strength R_c", "MPa"));
    assert!((values[1] - 10_000.0).abs() < 1e-6);
    // And so does the scene, begun again with it.
    give(&mut session, "reset");
    give(&mut session, "step 500");
    assert_eq!(session.shown().pieces, 0);
}

#[test]
fn knobs_of_the_modes_bake_again_and_the_others_do_not() {
    let mut session = pane("bakes");
    let apply = |session: &mut Session, line: &str| {
        session.apply(Command::parse(line).unwrap()).unwrap();
        let bakes = session.shown().bake.is_some();
        session.finish_jobs();
        bakes
    };
    assert!(!apply(&mut session, "knob youngs-modulus 50"));
    assert!(!apply(&mut session, "knob density 3000"));
    assert!(apply(&mut session, "knob poisson 0.3"));
    assert!(apply(&mut session, "knob modes 12"));
    let live = session.live().unwrap();
    let body = live.body_before(live.things()[0].handle).unwrap();
    let asset = body.asset();
    assert_eq!(asset.modes().count(), 12);
    assert_eq!(asset.material().poisson_ratio, 0.3);
    assert_eq!(asset.material().density, 3000.0);
    assert_eq!(asset.material().youngs_modulus, 50e9);
    // An earlier bake is at hand.
    assert!(!apply(&mut session, "knob modes 20"));
}

#[test]
fn the_strained_body_is_coloured_by_its_tension_and_moves_with_the_exaggeration() {
    let mut session = broken("stress");
    give(&mut session, "look stress");
    let course = session.shown().course.unwrap();
    assert!(
        course.peak_tension > course.strength,
        "else it would not have broken"
    );
    let analysis = session.analysis().unwrap().clone();
    let report = &session.blow().unwrap().report;
    assert_eq!(course.cracks, report.cracks);
    assert_eq!(analysis.cracks.len(), report.cracks);
    assert_eq!(analysis.weak_points.len(), report.weak_points);
    let at = |session: &mut Session| session.shown().picture.batches[0].clone();
    let largest = |values: &[f32]| values.iter().copied().fold(0.0, f32::max);
    // At its worst moment the colours go far up, and before the contact nothing has one.
    let worst = at(&mut session);
    assert!(largest(&worst.values) > 0.3, "{}", largest(&worst.values));
    give(&mut session, "scrub 0");
    let early = largest(&at(&mut session).values);
    assert!(early < 0.5 * largest(&worst.values), "{early}");
    // Twice the exaggeration, twice the way.
    give(&mut session, &format!("scrub {}", analysis.worst_moment()));
    let mut positions = Vec::new();
    for factor in [0, 10, 20] {
        give(&mut session, &format!("exaggerate {factor}"));
        positions.push(at(&mut session).positions.clone());
    }
    for ((still, once), twice) in positions[0].iter().zip(&positions[1]).zip(&positions[2]) {
        assert!((*twice - *still - 2.0 * (*once - *still)).length() < 1e-5);
    }
    assert!(
        positions[0]
            .iter()
            .zip(&positions[1])
            .any(|(a, b)| a.distance(*b) > 1e-4)
    );
}

#[test]
fn cracks_have_the_area_that_the_report_says() {
    let mut session = broken("cracks");
    give(&mut session, "look cracks");
    let shown = session.shown();
    let analysis = session.analysis().unwrap().clone();
    let area: f32 = analysis
        .cracks
        .iter()
        .flat_map(|crack| &crack.triangles)
        .map(|([a, b, c], _)| 0.5 * (*b - *a).cross(*c - *a).length())
        .sum();
    let reported = shown.blow.as_ref().unwrap().crack_area as f32;
    assert!(
        (area / reported - 1.0).abs() < 1e-3,
        "{area} of {reported} m²"
    );
    // Drawn: the body and its cracks.
    assert_eq!(shown.picture.batches.len(), 2);
}

#[test]
fn cracks_grow_along_the_timeline() {
    let mut session = broken("timeline");
    let drawn = |session: &mut Session, command: &str, batch: usize| {
        give(session, command);
        let picture = session.shown().picture;
        picture.batches.get(batch).map_or(0, |b| b.positions.len())
    };
    // The cracks come first and the body after them; before they come there is the body alone.
    let all = drawn(&mut session, "look cracks", 0);
    let half = drawn(&mut session, "scrub 0.5", 0);
    assert!(0 < half && half < all, "{half} of {all} corners");
    drawn(&mut session, "scrub 0", 0);
    assert_eq!(session.shown().picture.batches.len(), 1);
    // Over the strained body lie the lines along which cracks have cut its surface.
    give(&mut session, "look stress");
    let lines = ["scrub 0", "scrub 0.5", "scrub 1"].map(|moment| drawn(&mut session, moment, 1));
    let [none, some, most] = lines;
    assert!(
        none == 0 && some > 0 && some <= most,
        "{none} {some} {most}"
    );
}

#[test]
fn pieces_drawn_apart_are_farther_from_each_other_and_can_be_selected() {
    let mut session = broken("select");
    give(&mut session, "select 0,0.09,1 0,0.09,0");
    let whole = session.shown();
    give(&mut session, "explode 2");
    let apart = session.shown();
    let corners = |shown: &frangible_view::Shown| -> Vec<_> {
        let batches = shown.picture.batches.iter();
        batches.flat_map(|batch| batch.positions.clone()).collect()
    };
    let ways = corners(&whole).into_iter().zip(corners(&apart));
    let farthest = ways.map(|(a, b)| a.distance(b)).fold(0.0, f32::max);
    let things = session.live().unwrap().things().iter();
    let births = things.filter_map(|thing| match thing.kind {
        frangible_scenes::ThingKind::Piece { birth, .. } => Some(birth.length()),
        _ => None,
    });
    let outermost = births.fold(0.0, f32::max);
    assert!(outermost > 0.05 && (farthest - 2.0 * outermost).abs() < 1e-4);
    // Each piece is aimed at from above. A bent one may be missed, because its centre of mass lies beside it; a flat one is
    // met, and has a mass and a box around it.
    give(&mut session, "explode 0");
    let live = session.live().unwrap();
    let things = live.things().iter();
    let pieces = things.filter(|t| t.mass > 0.0 && t.name.contains("piece"));
    let centres: Vec<_> = pieces.map(|t| live.pose(t).unwrap().translation).collect();
    let mut met = centres.iter().filter_map(|at| {
        let (x, y, z) = (at.x, at.y, at.z);
        let ray = format!("select {x},{},{z} {x},{y},{z}", y + 1.0);
        give(&mut session, &ray);
        session.shown().selection.filter(|thing| thing.mass > 0.0)
    });
    let selection = met.next().expect("a piece lies there");
    assert!(selection.mass > 0.0 && selection.volume > 0.0);
    assert!(selection.size[0] >= selection.size[2] && selection.size[2] > 0.0);
}

#[test]
fn a_scene_whose_numbers_make_no_strength_is_refused() {
    let path = common::scene_file("strengthless");
    let pane = std::fs::read_to_string(&path).unwrap();
    let glass = "material = \"glass\"";
    for (line, name) in [
        (
            "material = { preset = \"glass\", fracture_energy = 0 }",
            "fracture energy",
        ),
        ("specimen = inf", "specimen"),
        ("weibull_modulus = 0.5", "Weibull modulus"),
        (
            "fatigue = { exponent = 0, rate = 2e6, increase = 1.5 }",
            "fatigue exponent",
        ),
    ] {
        std::fs::write(&path, pane.replace(glass, line)).unwrap();
        let open = Command::parse(&format!("open {}", path.display())).unwrap();
        let error = Session::new().apply(open).unwrap_err().to_string();
        assert!(error.contains(name), "{line}: {error}");
    }
}

#[test]
fn commands_that_make_no_sense_say_what_would() {
    let mut session = Session::new();
    for (line, hint) in [
        ("step 3", "load one"),
        ("reset", "choose one"),
        ("look stress", "there has been no contact yet"),
        ("undo", "nothing has broken yet"),
        ("scene glas", "did you mean `glass`?"),
        ("open nowhere.toml", "there is no such file"),
        ("hit-again", "there has been no contact yet"),
        ("knob strength 3", "no scene is loaded"),
        ("knob strenth 3", "did you mean `strength`?"),
        ("ball 1 1 1 cheese", "cheese"),
        ("ball 0 0.1 3 steel", "mass"),
        ("screenshot x.png", "this session has none"),
        ("save glb x.glb", "no scene is loaded"),
    ] {
        let error = session.apply(Command::parse(line).unwrap()).unwrap_err();
        assert!(error.to_string().contains(hint), "{line}: {error}");
        assert_eq!(session.shown().message.unwrap().0, error.to_string());
    }
}

#[test]
fn a_cancelled_bake_leaves_the_session_as_good_as_new() {
    let mut session = Session::new();
    session
        .apply(Command::parse("scene rabbit").unwrap())
        .unwrap();
    assert!(session.is_busy());
    assert!(session.shown().bake.is_some());
    give(&mut session, "cancel-bake");
    assert!(!session.is_busy());
    let path = common::scene_file("cancelled");
    give(&mut session, &format!("open {}", path.display()));
    assert_eq!(session.shown().whole, 1);
}

#[test]
fn what_is_saved_is_what_is_there() {
    let mut session = broken("saved");
    let folder = folder("saved");
    for turned in ["toughness 4", "load-duration 60", "sized-flaws 0"] {
        give(&mut session, &format!("knob {turned}"));
    }
    for (what, name) in [("glb", "x.glb"), ("scene", "x.toml"), ("report", "x.json")] {
        give(
            &mut session,
            &format!("save {what} {}", folder.join(name).display()),
        );
    }
    let scene = frangible_scenes::read_scene(&folder.join("x.toml")).unwrap();
    assert_eq!(scene.bodies[0].material.fracture_energy, 4.0);
    let fracture = &scene.fracture;
    assert_eq!(
        (fracture.load_duration, fracture.sized_flaws),
        (60.0, false)
    );
    let glb = std::fs::read(folder.join("x.glb")).unwrap();
    assert_eq!(&glb[..4], b"glTF");
    let text = std::fs::read_to_string(folder.join("x.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&text).unwrap();
    let pieces = report["masses_kg"].as_array().unwrap().len();
    assert_eq!(pieces, masses(&session.shown()).len());
    assert_eq!(report["pieces"], pieces);
}
