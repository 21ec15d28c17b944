//! Scenes of tempered glass.

use std::path::Path;

use frangible_scenes::{GamePlan, Scene, SceneError, bake, parse_scene, play, play_as_game, scene};

#[test]
fn a_side_window_falls_into_dice_and_all_of_it_is_there() {
    let mut scene = scene("side-window").expect("a scene");
    scene.duration = 0.6;
    let bodies = bake(&scene).expect("a bake");
    let run = play(&scene, &bodies, &mut |_| {}).expect("a run");
    let first = run.break_of(0).expect("a break");
    assert_eq!(first.masses.len(), 60);
    assert!(first.report.volume_error.abs() < 1e-5);
    // Between 40 dice in 50 × 50 mm and twice as many, of hexagons' sides through 4 mm.
    let whole = first.volume / 0.004;
    let area = first.report.crack_area;
    let widths = [5e-3, 8e-3].map(|width| 2.0 * whole / width * 0.004);
    assert!(
        area < 1.1 * widths[0] && area > 0.8 * widths[1],
        "{area} {widths:?}"
    );
    assert!(
        run.breaks.iter().any(|b| b.generation > 0),
        "no clump parted"
    );
}

fn parse(text: &str) -> Result<Scene, SceneError> {
    parse_scene(text, Path::new("."))
}

#[test]
fn tempered_glass_is_known_by_name_and_a_body_that_is_no_wall_is_refused() {
    let text = |shape: &str, material: &str| {
        format!(
            "[[body]]\nname = \"thing\"\nshape = {shape}\nmaterial = {material}\nmodes = 10\nresolution = 2000\n"
        )
    };
    let pane = "{ box = [0.2, 0.2, 0.004] }";
    let known = parse(&text(pane, "\"heat-strengthened glass\"")).expect("a scene");
    assert!((known.bodies[0].material.residual_stress - 45e6).abs() < 1.0);
    let own = "{ preset = \"glass\", residual_stress = 80e6 }";
    let own = parse(&text(pane, own)).expect("a scene");
    assert!((own.bodies[0].material.residual_stress - 80e6).abs() < 1.0);
    let too_much = "{ preset = \"glass\", residual_stress = 140e6 }";
    let refused = parse(&text(pane, too_much)).and_then(|scene| bake(&scene).map(|_| ()));
    let refused = refused.expect_err("too much").to_string();
    assert!(
        refused.contains("residual stress is 140000000 Pa"),
        "{refused}"
    );
    let block = text("{ box = [0.2, 0.1, 0.06] }", "\"tempered-glass\"");
    let refused = parse(&block).and_then(|scene| bake(&scene).map(|_| ()));
    let refused = refused.expect_err("a block").to_string();
    assert!(
        refused.contains("not one wall of even thickness"),
        "{refused}"
    );
}

/// Run it alone, with `--ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn frames_of_a_game() {
    for name in ["side-window", "shower-door"] {
        let mut scene = scene(name).expect("a scene");
        for body in &mut scene.bodies {
            (body.resolution, body.modes) = (Some(6000), 40);
        }
        let bodies = bake(&scene).expect("a bake");
        let run = play_as_game(&scene, &bodies, GamePlan::default(), &mut |_| {}).expect("a run");
        let mut frames: Vec<f64> = run.frames.iter().map(|t| 1e3 * t).collect();
        frames.sort_by(f64::total_cmp);
        let at = |share: f64| frames[(share * (frames.len() - 1) as f64) as usize];
        println!(
            "{name}: {} breaks, {} partings, {} bodies; frames {:.1} ms, p99 {:.1}, longest {:.1}",
            run.breaks,
            run.again,
            run.poses.len(),
            at(0.5),
            at(0.99),
            at(1.0)
        );
    }
}
