//! Cracks that part nothing are in the recording: a window with a star is not drawn whole.

use frangible_scenes::{Run, bake, play, scene};

/// A window held in its frame, with a coarse mesh, hit by a ball at this speed, m/s.
fn window_hit_at(speed: f64) -> Run {
    let mut scene = scene("window").unwrap();
    scene.duration = 0.5;
    scene.bodies[0].modes = 60;
    scene.bodies[0].resolution = Some(12_000);
    scene.projectiles[0].speed = speed;
    // Pieces of less than nine tenths of the window stay with a neighbour: its cracks part nothing.
    scene.fracture.crumb_share = 0.9;
    // A slow ball comes in an arc from below.
    scene.floor = None;
    let baked = bake(&scene).unwrap();
    play(&scene, &baked, &mut |_| {}).unwrap()
}

#[test]
fn a_body_that_cracks_and_holds_is_shown_with_its_cracks_from_then_on() {
    let cracked = [3.2, 3.6, 4.0].into_iter().find_map(|speed| {
        let run = window_hit_at(speed);
        let area: f64 = run.held.iter().map(|held| held.report.crack_area).sum();
        println!(
            "{speed} m/s: {} breaks, {area:.2e} m² of cracks",
            run.breaks.len()
        );
        let cracks = run.held.iter().any(|held| held.report.crack_area > 0.0);
        (cracks && run.breaks.is_empty()).then_some(run)
    });
    let run = cracked.expect("one of these speeds cracks the window and does not break it");
    let recording = &run.recording;
    recording.validate().unwrap();
    let name = |node: usize| recording.nodes[node].name.as_str();
    let windows: Vec<usize> = (0..recording.nodes.len())
        .filter(|&node| name(node) == name(0))
        .collect();
    assert!(windows.len() >= 2, "{windows:?}");
    // One at a time: where one ends the next begins, to the last frame.
    for pair in windows.windows(2) {
        let [before, after] = [pair[0], pair[1]].map(|node| &recording.nodes[node].visible);
        assert_eq!(before.end, after.start);
        assert!(!before.is_empty() && !after.is_empty());
    }
    let last = *windows.last().unwrap();
    assert_eq!(recording.nodes[last].visible.end, recording.frame_count);
    // The whole window, and the crack's faces and lines.
    let [whole, cracked] =
        [windows[0], last].map(|node| &recording.meshes[recording.nodes[node].mesh]);
    assert_eq!(cracked.parts[..whole.parts.len()], whole.parts[..]);
    let added: Vec<&str> = cracked.parts[whole.parts.len()..]
        .iter()
        .map(|part| recording.surfaces[part.surface].name.as_str())
        .collect();
    assert_eq!(added, ["glass crack", "glass crack line"]);
    // The moment called the first crack is the one from which it is seen.
    let first = recording.nodes[windows[1]].visible.start;
    assert_eq!(recording.moments.first_crack, first);
}
