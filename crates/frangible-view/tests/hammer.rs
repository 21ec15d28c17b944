//! The hammer: its blow, its effect, and its end.

use crate::common::{bits, folder, give, pane};
use frangible::glam::Vec3;
use frangible_view::{Command, Script, Session, Tool};

/// Position of the head, if it is there.
fn head(session: &Session) -> Option<Vec3> {
    let live = session.live().unwrap();
    let things = live.things().iter();
    let thing = things.rev().find(|thing| thing.name.contains("swing"))?;
    Some(live.pose(thing)?.translation)
}

#[test]
fn the_head_comes_on_an_arc_strikes_where_it_was_aimed_and_is_lifted_away() {
    let mut session = pane("swing");
    // Heavy enough, and there before the scene's own ball.
    give(&mut session, "hammer 0.3 12 steel");
    assert_eq!(session.shown().tool, Tool::Hammer);
    give(&mut session, "swing 0.03,0.1,1 0.03,0.1,0");
    let start = head(&session).expect("it is there at once");
    assert!(
        start.y > 0.2 && start.z > 0.15,
        "drawn back and up: {start}"
    );
    let mut way = vec![start];
    while session.shown().blow.is_none() {
        give(&mut session, "step 1");
        way.push(head(&session).unwrap());
        assert!(way.len() < 2000, "it never strikes");
    }
    // On a circle: equally far from the hand, which is as far above the place of the strike as an arm is long.
    let last = way[way.len() - 2];
    let pivot = last + 0.35 * Vec3::Y;
    for at in &way[..way.len() - 1] {
        assert!((at.distance(pivot) - 0.35).abs() < 0.01, "{at}");
    }
    let shown = session.shown();
    let blow = session.blow().expect("it struck");
    let weighed = blow.contacts.iter().map(|c| c.impulse * c.point);
    let middle = weighed.sum::<Vec3>() / blow.impulse();
    let hit = blow.pose.rotation * middle + blow.pose.translation;
    // Struck straight on; the crown has facets of 5 mm.
    assert!(
        (hit.x - 0.03).abs() < 3e-3 && (hit.y - 0.1).abs() < 3e-3,
        "{hit}"
    );
    let speed = blow
        .contacts
        .iter()
        .map(|c| c.approach_speed)
        .fold(0.0, f32::max);
    assert!((speed - 12.0).abs() < 0.5, "{speed} m/s");
    assert!(shown.pieces > 3, "glass does not withstand that");
    give(&mut session, "step 4000");
    assert_eq!(head(&session), None, "it is gone");
}

#[test]
fn a_swing_is_written_down_and_does_the_same_again() {
    let mut session = pane("swing-replay");
    give(&mut session, "hammer 0.4 6 steel");
    give(&mut session, "step 20");
    give(&mut session, "swing 0.4,0.5,1 -0.02,0.12,0");
    give(&mut session, "step 900");
    give(&mut session, "undo");
    give(&mut session, "step 500");
    let path = folder("swing-replay").join("done.txt");
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
fn a_blow_level_with_the_floor_does_not_catch_on_it() {
    let mut session = pane("swing-low");
    give(&mut session, "hammer 2 10 steel");
    // A head of 3 cm radius, aimed 1 cm above the floor.
    give(&mut session, "swing 0,0.01,1 0,0.01,0");
    let mut lowest = f32::INFINITY;
    while session.shown().blow.is_none() {
        give(&mut session, "step 1");
        lowest = lowest.min(head(&session).unwrap().y);
        assert!(session.shown().steps < 2000, "it never strikes the pane");
    }
    assert!(lowest > 0.025, "{lowest}");
}

#[test]
fn hammers_that_cannot_be_say_why() {
    let mut session = pane("swing-wrong");
    for (line, hint) in [
        ("hammer 0 5 steel", "hammer's mass is 0 kg"),
        ("hammer 1 500 steel", "must be 0.1 to 50 m/s"),
        ("hammer 1 5 cheese", "cheese"),
        ("swing 0,1,1 0,2,1", "the hammer has no target"),
    ] {
        let error = session.apply(Command::parse(line).unwrap()).unwrap_err();
        assert!(error.to_string().contains(hint), "{line}: {error}");
    }
}
