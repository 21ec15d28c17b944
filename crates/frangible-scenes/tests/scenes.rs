//! Scenes from bake to recording.

use std::sync::{Arc, OnceLock};

use frangible::Asset;
use frangible_export::{Recording, write_glb};
use frangible_scenes::{Action, Run, SCENE_NAMES, Scene, SceneError, bake, play, scene};

/// A built-in scene with few modes.
fn cheap(name: &str) -> (Scene, Arc<Asset>) {
    let mut scene = scene(name).unwrap();
    scene.modes = 40;
    let asset = bake(&scene, &mut |_| {}).unwrap().0;
    (scene, asset)
}

fn glass() -> &'static (Arc<Asset>, [Run; 2]) {
    static RUNS: OnceLock<(Arc<Asset>, [Run; 2])> = OnceLock::new();
    RUNS.get_or_init(|| {
        let (scene, asset) = cheap("glass");
        let runs = [(); 2].map(|()| play(&scene, &asset, &mut |_| {}).unwrap());
        (asset, runs)
    })
}

#[test]
fn every_built_in_scene_is_sound() {
    for name in SCENE_NAMES {
        let scene = scene(name).unwrap();
        assert_eq!(scene.name, name);
        assert!(!scene.summary.is_empty());
        scene.validate().unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

#[test]
fn an_unknown_scene_and_unusable_numbers_are_refused_by_name() {
    let message = scene("glas").unwrap_err().to_string();
    assert!(
        message.contains("glass") && message.contains("did you mean"),
        "{message}"
    );
    let refused = |change: fn(&mut Scene)| {
        let mut scene = scene("vase").unwrap();
        change(&mut scene);
        scene.validate().expect_err("it must be refused")
    };
    let message = refused(|s| s.duration = f64::NAN).to_string();
    assert!(message.contains("duration"), "{message}");
    let message = refused(|s| s.modes = 0).to_string();
    assert!(message.contains("modes"), "{message}");
    let message = refused(|s| s.action = Action::Drop { height: -1.0 }).to_string();
    assert!(message.contains("height"), "{message}");
    assert!(matches!(
        refused(|s| s.floor = "cheese".into()),
        SceneError::Material(_)
    ));
    let message = refused(|s| {
        if let Action::Ball(ball) = &mut s.action {
            ball.speed = 1e4;
        }
    });
    assert!(message.to_string().contains("speed"), "{message}");
}

#[test]
fn a_dropped_glass_breaks_comes_to_rest_and_loses_nothing() {
    let (asset, [run, _]) = glass();
    assert_eq!(run.breaks.len(), 1);
    let masses = &run.breaks[0].masses;
    println!(
        "{} pieces, {:.2} s, {} frames",
        masses.len(),
        run.simulated,
        run.recording.frame_count
    );
    assert!(masses.len() > 3, "{} pieces", masses.len());
    assert!(run.at_rest, "not at rest after {} s", run.simulated);
    let mass: f64 = masses.iter().sum();
    assert!(
        (mass / asset.mass.mass - 1.0).abs() < 1e-9,
        "{mass} kg of {} kg",
        asset.mass.mass
    );
    assert!((run.breaks[0].volume / asset.mass.volume - 1.0).abs() < 1e-9);
    assert!(
        masses.windows(2).all(|w| w[0] >= w[1]),
        "masses fall: {masses:?}"
    );
    run.recording.validate().unwrap();
    let pieces = run
        .recording
        .nodes
        .iter()
        .filter(|n| n.name.contains("piece"))
        .count();
    assert_eq!(pieces, masses.len());
}

#[test]
fn the_same_scene_gives_the_same_file() {
    let (_, runs) = glass();
    let [first, second] = runs
        .each_ref()
        .map(|run| write_glb(&run.recording).unwrap());
    assert!(
        first == second,
        "two plays differ: {} and {} bytes",
        first.len(),
        second.len()
    );
}

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
fn a_ball_flies_on_through_the_pane() {
    let (mut scene, asset) = cheap("pane");
    scene.duration = 0.6;
    let run = play(&scene, &asset, &mut |_| {}).unwrap();
    assert_eq!(run.breaks.len(), 1, "the pane holds");
    run.recording.validate().unwrap();
    let ball = run
        .recording
        .nodes
        .iter()
        .find(|n| n.name == "ball")
        .unwrap();
    let z: Vec<f32> = ball.poses.iter().map(|p| p.translation.z).collect();
    let n = z.len();
    println!(
        "z of the ball {:.3} → {:.3} … {:.3} m",
        z[0],
        z[n - 2],
        z[n - 1]
    );
    assert!(
        z[0] > 0.0 && z[n - 1] < 0.0,
        "the ball does not get through: z {} m",
        z[n - 1]
    );
    assert!(z[n - 1] < z[n - 2], "the ball comes back");
}
