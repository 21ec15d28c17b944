//! Projectiles that set out later and leave again, in a scene that runs step by step and in one that is played.

use std::collections::BTreeMap;

use frangible_scenes::{LiveScene, Projectile, Scene, bake, play, scene};

/// The brick under a hammer, made light: its pieces do not break again.
fn five_blows() -> Scene {
    let mut scene = scene("five-blows").unwrap();
    scene.bodies[0].modes = 20;
    scene.bodies[0].resolution = Some(2500);
    scene.pieces.generations = 0;
    scene
}

#[test]
fn hammers_come_strike_and_leave_as_when_the_scene_is_played() {
    let scene = five_blows();
    let baked = bake(&scene).unwrap();
    let run = play(&scene, &baked, &mut |_| {}).unwrap();
    let mut live = LiveScene::new(&scene, &baked).unwrap();
    // First and last time at which each hammer is there.
    let mut there: BTreeMap<String, [f64; 2]> = BTreeMap::new();
    let mut first_break = None;
    while live.time() < 2.2 {
        live.step().unwrap();
        if let (None, Some(event)) = (first_break, live.world().breaks().first()) {
            first_break = Some((live.time(), event.fracture.fragments.len()));
        }
        for thing in live.things().iter().filter(|t| t.name.contains("hammer")) {
            if live.pose(thing).is_some() {
                let span = there.entry(thing.name.clone());
                span.or_insert([live.time(); 2])[1] = live.time();
            }
        }
    }
    let (time, pieces) = first_break.expect("the first blow breaks the brick");
    let played = run.breaks.first().expect("it does so when played");
    // Until the first break both take the same steps.
    assert!((time - played.time).abs() < 1e-4, "{time} {}", played.time);
    assert_eq!(pieces, played.masses.len());
    let nodes = run.recording.nodes.iter();
    let hammers: Vec<_> = nodes.filter(|n| n.name.contains("hammer")).collect();
    assert_eq!(hammers.len(), 5);
    assert_eq!(there.len(), 5, "{there:?}");
    let frame = 1.0 / 60.0;
    for node in hammers {
        let [came, left] = there[&node.name];
        let began = node.visible.start as f64 * frame;
        let ended = node.visible.end as f64 * frame;
        assert!(
            (came - began).abs() < 2.0 * frame,
            "{}: {came} {began}",
            node.name
        );
        assert!(
            (left - ended).abs() < 2.5 * frame,
            "{}: {left} {ended}",
            node.name
        );
        assert!((left - came - 0.25).abs() < 2.0 * frame);
    }
}

#[test]
fn what_was_not_thrown_yet_when_the_scene_was_saved_is_thrown_again_after_it_is_restored() {
    let scene = five_blows();
    let baked = bake(&scene).unwrap();
    let mut live = LiveScene::new(&scene, &baked).unwrap();
    while live.time() < 0.3 {
        live.step().unwrap();
    }
    let saved = live.save();
    let run_on = |live: &mut LiveScene| {
        while live.time() < 0.55 {
            live.step().unwrap();
        }
        let things = live.things().iter();
        let poses = things.filter_map(|thing| Some((thing.name.clone(), live.pose(thing)?)));
        poses
            .map(|(name, pose)| format!("{name} {pose:?}"))
            .collect::<Vec<_>>()
    };
    let once = run_on(&mut live);
    assert!(
        once.iter().any(|line| line.starts_with("hammer 2")),
        "{once:?}"
    );
    live.restore(&saved);
    assert!(!live.things().iter().any(|thing| thing.name == "hammer 2"));
    assert_eq!(run_on(&mut live), once);
}

#[test]
fn what_flies_slowly_towards_a_body_at_rest_is_seen_to_arrive() {
    let mut scene = scene("window").unwrap();
    scene.floor = None;
    (scene.bodies[0].modes, scene.bodies[0].resolution) = (10, Some(3000));
    // So slow that it takes longer than a run goes on once all rests; the second sets out when all has rested for long.
    let ball = &mut scene.projectiles[0];
    ball.speed = 0.9;
    let later = Projectile {
        delay: 2.0,
        ..ball.clone()
    };
    scene.projectiles.push(later);
    let baked = bake(&scene).unwrap();
    let run = play(&scene, &baked, &mut |_| {}).unwrap();
    let mut blows = run.blows.iter().map(|blow| blow.time);
    assert!(blows.clone().any(|time| (0.3..2.0).contains(&time)));
    assert!(blows.any(|time| time > 2.3), "{}", run.simulated);
}
