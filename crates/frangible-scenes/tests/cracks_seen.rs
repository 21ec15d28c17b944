//! Cracks that part nothing are in the recording: a shelf with a star is not drawn whole.

use frangible_scenes::{Run, bake, play, scene};

/// The glass shelf with a coarse mesh, hit from above by a ball of this mass, kg.
fn shelf_hit_by(mass: f64) -> Run {
    let mut scene = scene("shelf").unwrap();
    scene.duration = 0.5;
    scene.bodies[0].modes = 60;
    scene.bodies[0].resolution = Some(12_000);
    scene.projectiles[0].mass = mass;
    let baked = bake(&scene, &mut |_| {}).unwrap();
    play(&scene, &baked, &mut |_| {}).unwrap()
}

#[test]
fn a_body_that_cracks_and_holds_is_shown_with_its_cracks_from_then_on() {
    let cracked = [0.02, 0.04, 0.06, 0.1, 0.15, 0.25].into_iter().find_map(|mass| {
        let run = shelf_hit_by(mass);
        let cracks = run.held.iter().any(|held| held.report.crack_area > 0.0);
        (cracks && run.breaks.is_empty()).then_some(run)
    });
    let run = cracked.expect("one of these balls cracks the shelf and does not break it");
    let recording = &run.recording;
    recording.validate().unwrap();
    let name = |node: usize| recording.nodes[node].name.as_str();
    let shelves: Vec<usize> = (0..recording.nodes.len())
        .filter(|&node| name(node) == name(0))
        .collect();
    assert!(shelves.len() >= 2, "{shelves:?}");
    // One at a time: where one ends the next begins, to the last frame.
    for pair in shelves.windows(2) {
        let [before, after] = [pair[0], pair[1]].map(|node| &recording.nodes[node].visible);
        assert_eq!(before.end, after.start);
        assert!(!before.is_empty() && !after.is_empty());
    }
    let last = *shelves.last().unwrap();
    assert_eq!(recording.nodes[last].visible.end, recording.frame_count);
    // The whole shelf, and the crack's faces and lines.
    let [whole, cracked] =
        [shelves[0], last].map(|node| &recording.meshes[recording.nodes[node].mesh]);
    assert_eq!(cracked.parts[..whole.parts.len()], whole.parts[..]);
    let added: Vec<&str> = cracked.parts[whole.parts.len()..]
        .iter()
        .map(|part| recording.surfaces[part.surface].name.as_str())
        .collect();
    assert_eq!(added, ["glass crack", "glass crack line"]);
    // The moment called the first crack is the one from which it is seen.
    let first = recording.nodes[shelves[1]].visible.start;
    assert_eq!(recording.moments.first_crack, first);
}
