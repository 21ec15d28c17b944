//! A small pane that bakes in a second, in a file of its own for each test.

use std::path::PathBuf;

use frangible_view::{Command, Session, Shown};

const PANE: &str = r#"
name = "small-pane"
floor = "stone"
[[body]]
name = "pane"
shape = { box = [0.2, 0.2, 0.006] }
material = "glass"
modes = 20
resolution = 3000
[[projectile]]
kind = "ball"
mass = 0.1
radius = 0.012
speed = 12.0
material = "steel"
"#;

/// A folder for the files of one test.
pub(crate) fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
        .join("frangible-view")
        .join(test);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The pane's scene as a file.
pub(crate) fn scene_file(test: &str) -> PathBuf {
    let path = folder(test).join("pane.toml");
    std::fs::write(&path, PANE).unwrap();
    path
}

/// Gives a command and waits for all it begins.
pub(crate) fn give(session: &mut Session, line: &str) {
    session.apply(Command::parse(line).unwrap()).unwrap();
    session.finish_jobs();
    let message = session.shown().message;
    assert!(!matches!(message, Some((_, true))), "{line}: {message:?}");
}

/// The pane before anything happened to it.
pub(crate) fn pane(test: &str) -> Session {
    let mut session = Session::new();
    give(
        &mut session,
        &format!("open {}", scene_file(test).display()),
    );
    session
}

/// The pane, broken by its ball.
pub(crate) fn broken(test: &str) -> Session {
    let mut session = pane(test);
    give(&mut session, "step 500");
    assert!(session.shown().pieces > 3, "it breaks");
    session
}

/// Every bit of where everything is.
pub(crate) fn bits(session: &Session) -> Vec<[u32; 7]> {
    let live = session.live().unwrap();
    let poses = live.things().iter().filter_map(|thing| live.pose(thing));
    let numbers = poses.map(|pose| {
        let [x, y, z] = pose.translation.to_array();
        let [a, b, c, d] = pose.rotation.to_array();
        [x, y, z, a, b, c, d].map(f32::to_bits)
    });
    numbers.collect()
}

/// Masses of the pieces of the last break.
pub(crate) fn masses(shown: &Shown) -> Vec<f64> {
    shown.blow.as_ref().unwrap().masses.clone()
}
