//! Pieces at the end of a scene: where they lie, and that they are closed.

use frangible_recording::Recording;
use frangible_scenes::play;

use super::glass;
use crate::common::drawn::{Lie, closed, lies};
use crate::common::made::made;

/// Heights of the lowest vertex of everything seen in the last frame, m.
fn lowest_vertices(recording: &Recording) -> Vec<(String, f32)> {
    let last = recording.frame_count - 1;
    let seen = recording
        .nodes
        .iter()
        .enumerate()
        .filter(|(_, node)| node.visible.contains(&last));
    seen.map(|(i, node)| {
        let pose = recording.pose(i, last);
        let heights = recording.meshes[node.mesh]
            .positions
            .iter()
            .map(|&p| (pose.rotation.normalize() * p + pose.translation).y);
        (node.name.clone(), heights.fold(f32::INFINITY, f32::min))
    })
    .collect()
}

#[test]
fn pieces_end_on_the_floor() {
    let (_, [run, _]) = glass();
    let lowest = lowest_vertices(&run.recording);
    let heights = || lowest.iter().map(|l| 1e3 * l.1);
    println!(
        "lowest {:.2} mm, highest {:.2} mm",
        heights().fold(f32::MAX, f32::min),
        heights().fold(f32::MIN, f32::max)
    );
    assert_eq!(lowest.len(), run.breaks[0].masses.len());
    for (name, y) in lowest {
        assert!(y > -0.003, "{name} lies {:.1} mm below the floor", -1e3 * y);
        assert!(y < 0.060, "{name} hovers {:.1} mm above the floor", 1e3 * y);
    }
}

#[test]
fn pieces_at_rest_lie_where_they_are_drawn() {
    let (_, [run, _]) = glass();
    let lies = lies(&run.recording);
    let most = |f: fn(&Lie) -> f64| 1e3 * lies.iter().map(f).fold(0.0, f64::max);
    println!(
        "{} at rest, {:.2} mm in the floor, {:.2} mm in another, {:.2} mm apart",
        lies.len(),
        most(|lie| lie.in_floor),
        most(|lie| lie.in_other.0),
        most(|lie| lie.apart)
    );
    // A few may still roll.
    assert!(10 * lies.len() > 9 * run.breaks[0].masses.len());
    for lie in lies {
        assert!(lie.is_true(), "{lie}");
    }
}

#[test]
fn pieces_of_made_meshes_at_rest_lie_where_they_are_drawn() {
    let (mut resting, mut drawn, mut off) = (0, 0, Vec::new());
    for seed in 0..4 {
        let (scene, baked) = made(seed).unwrap();
        let run = play(&scene, &baked, &mut |_| {}).unwrap();
        let lies = lies(&run.recording);
        resting += lies.len();
        let wrong = lies.into_iter().filter(|lie| !lie.is_true());
        off.extend(wrong.map(|lie| format!("seed {seed}, {lie}")));
        // Faces that close the gap between an author's surface and crack faces may lie on each other, so that an edge has four: sides are not
        // counted. The mesh of a body follows that surface within a part of a tetrahedron, which is much of a small piece.
        let things = closed(&run.recording);
        let whole: f64 = things.iter().map(|c| c.volume).sum();
        let off: f64 = things.iter().map(|c| c.volume * c.volume_off).sum();
        assert!(off < 5e-3 * whole, "seed {seed}: {off} of {whole} m³");
        drawn += things.len();
    }
    println!(
        "{drawn} drawn, {resting} at rest, {} of them off: {off:#?}",
        off.len()
    );
    assert!(resting > 20, "{resting} of {drawn}");
    assert!(off.is_empty(), "{off:#?}");
}

#[test]
fn drawn_pieces_are_closed_and_hold_their_volume() {
    let (_, [run, _]) = glass();
    let closed = closed(&run.recording);
    assert!(closed.len() > run.breaks[0].masses.len());
    for c in closed {
        let (name, sides) = (&c.name, c.open_sides);
        assert_eq!(sides, 0, "{name}: {sides} sides do not have two faces");
        let off = 100.0 * c.volume_off;
        assert!(off < 0.5, "{name}: its volume is off by {off:.3} %");
    }
}
