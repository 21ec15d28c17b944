//! Held bodies: what the supports hold stays, the rest falls.

use frangible_scenes::{Run, bake, play, scene};

/// Plays a scene of a held body with a coarse mesh and few modes.
fn coarse(name: &str) -> Run {
    let mut scene = scene(name).unwrap();
    scene.bodies[0].modes = 12;
    scene.bodies[0].resolution = Some(3000);
    let baked = bake(&scene, &mut |_| {}).unwrap();
    assert!(baked[0].asset.is_supported());
    play(&scene, &baked, &mut |_| {}).unwrap()
}

#[test]
fn pieces_that_touch_a_support_stay_and_the_others_fall() {
    // Of a shelf on two brackets one piece or more stays at each; of a clamped bar at the clamp.
    for (name, ends) in [("shelf", 2), ("cantilever", 1)] {
        let run = coarse(name);
        assert_eq!(run.breaks.len(), 1, "{name} must break");
        let last = run.recording.frame_count - 1;
        let (mut stay, mut fall, mut lie) = (0, 0, 0);
        for (i, node) in run.recording.nodes.iter().enumerate() {
            let is_piece = node.visible.end > last && node.visible.start > 0;
            if !is_piece {
                continue;
            }
            let first = run.recording.pose(i, node.visible.start).translation;
            let moved = run.recording.pose(i, last).translation.distance(first);
            if moved < 1e-6 {
                stay += 1;
            } else {
                // Held at 0.2 m and above: what is not held comes down, unless it lies on what is.
                let height = run.recording.pose(i, last).translation.y;
                if height < 0.15 {
                    fall += 1;
                } else {
                    lie += 1;
                }
            }
        }
        println!("{name}: {stay} stay, {fall} fall, {lie} lie on them");
        assert!(lie * 10 <= fall, "{name}: {lie} pieces hang, {fall} fall");
        assert!(
            stay >= ends && fall >= 1,
            "{name}: {stay} stay, {fall} fall"
        );
    }
}
