//! Everything in the scene is drawn, and nothing is written in vain.

use std::collections::BTreeSet;

use frangible_scenes::{bake, parse_scene};

use super::*;

const SCENE: &str = r#"
floor = "stone"
[[body]]
name = "pane"
shape = { box = [0.2, 0.2, 0.006] }
material = "glass"
modes = 20
resolution = 3000
supports = [{ side = "-y", at = 0.03 }]
[[projectile]]
mass = 0.1
radius = 0.012
speed = 12
"#;

fn live() -> LiveScene {
    let scene = parse_scene(SCENE, std::path::Path::new("pane.toml")).unwrap();
    LiveScene::new(&scene, &bake(&scene).unwrap()).unwrap()
}

fn step(live: &mut LiveScene, count: usize) {
    (0..count).for_each(|_| live.step().unwrap());
}

/// Every triangle there should be, corner by corner, rounded to a tenth of a millimetre, with its surface.
fn expected(live: &LiveScene, explode: f32) -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    for thing in live.things() {
        let Some(pose) = live.pose(thing) else {
            continue;
        };
        let pose = apart(thing, pose, explode);
        for part in &thing.mesh.parts {
            for face in part.indices.chunks_exact(3) {
                let corners = [face[0], face[1], face[2]]
                    .map(|v| pose.rotation * thing.mesh.positions[v as usize] + pose.translation);
                all.insert(named(&live.surfaces()[part.surface].name, corners));
            }
        }
    }
    all
}

fn drawn(batches: &[Arc<Batch>]) -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    for batch in batches {
        let BatchLooks::Surface(surface) = &batch.looks else {
            panic!("a scene has no values");
        };
        for face in batch.faces.iter() {
            let corners = face.map(|v| batch.positions[v as usize]);
            all.insert(named(&surface.name, corners));
        }
    }
    all
}

fn named(surface: &str, corners: [Vec3; 3]) -> String {
    let round = |p: Vec3| (p * 1e4).round().as_ivec3().to_string();
    format!("{surface} {}", corners.map(round).join(" "))
}

/// Almost all in common: a corner may round the other way.
fn assert_same(a: &BTreeSet<String>, b: &BTreeSet<String>) {
    let common = a.intersection(b).count() as f64;
    let most = a.len().max(b.len()) as f64;
    assert!(common > 0.9 * most, "{common} of {most}");
}

#[test]
fn what_is_drawn_is_what_is_there_through_breaks_undoing_and_debris() {
    let mut live = live();
    let mut mesher = Mesher::default();
    let saved = live.save();
    for explode in [0.0, 0.0, 1.5, 0.0] {
        step(&mut live, 220);
        assert_same(
            &drawn(&mesher.batches(&live, explode)),
            &expected(&live, explode),
        );
    }
    assert!(live.things().len() > 4, "it broke");
    let gone = live.things().last().unwrap().handle;
    live.world_mut().physics.remove_body(gone);
    assert_same(&drawn(&mesher.batches(&live, 0.0)), &expected(&live, 0.0));
    live.restore(&saved);
    assert_same(&drawn(&mesher.batches(&live, 0.0)), &expected(&live, 0.0));
}

#[test]
fn what_did_not_move_is_the_same_batch_and_copies_are_written_again_and_again() {
    let mut live = live();
    let mut mesher = Mesher::default();
    let first = mesher.batches(&live, 0.0);
    for (a, b) in first.iter().zip(mesher.batches(&live, 0.0)) {
        assert!(Arc::ptr_eq(a, &b));
    }
    // The ball flies, the pane is held.
    step(&mut live, 20);
    let second = mesher.batches(&live, 0.0);
    let same = |(a, b): (&Arc<Batch>, &Arc<Batch>)| Arc::ptr_eq(a, b);
    let kept = first.iter().zip(&second).filter(|&pair| same(pair)).count();
    assert!(kept > 0 && kept < second.len(), "{kept}");
    // Whoever still has the first copies finds them as they were.
    let ball = first.iter().zip(&second).find(|&pair| !same(pair)).unwrap();
    assert_ne!(ball.0.positions, ball.1.positions);
    assert!(ball.1.stamp > ball.0.stamp);
    step(&mut live, 600);
    // One picture held by whoever draws, one on its way: three copies do.
    let mut held = std::collections::VecDeque::new();
    let mut copies = BTreeSet::new();
    for round in 0..40 {
        step(&mut live, 1);
        let batches = mesher.batches(&live, 0.0);
        if round > 5 {
            copies.extend(batches.iter().map(|batch| Arc::as_ptr(batch) as usize));
        }
        held.push_back(batches);
        if held.len() > 2 {
            held.pop_front();
        }
    }
    assert!(copies.len() <= 3 * held[0].len(), "{}", copies.len());
    drop(held);
    let allocated = allocation_counter::measure(|| {
        step_free(&mut mesher, &live);
    });
    assert!(allocated.bytes_total < 4096, "{allocated:?}");
}

fn step_free(mesher: &mut Mesher, live: &LiveScene) {
    // Everything moves, drawn apart a little more.
    for explode in [0.01, 0.02, 0.03] {
        drop(mesher.batches(live, explode));
    }
}
