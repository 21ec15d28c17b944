//! Bodies placed where they cannot be.

use frangible::glam::Vec3;
use frangible_scenes::{Place, SCENE_NAMES, bake, play, scene};

use super::two_panes;

#[test]
fn a_body_inside_the_floor_is_refused() {
    let (scene, baked) = two_panes();
    let mut scene = scene.clone();
    scene.bodies[1].place = Place::Centre(Vec3::new(2.0, 0.15, 0.0));
    let message = play(&scene, baked, &mut |_| {}).unwrap_err().to_string();
    assert!(
        message.contains("`other` would start 50.0 mm below"),
        "{message}"
    );
}

#[test]
fn bodies_inside_each_other_are_refused_by_name_and_bodies_that_touch_are_not() {
    let (scene, baked) = two_panes();
    let mut scene = scene.clone();
    scene.projectiles.clear();
    scene.duration = 1.0 / 60.0;
    let mut play_at = |x: f32, z: f32| {
        scene.bodies[1].place = Place::Standing { over: [x, z] };
        play(&scene, baked, &mut |_| {})
    };
    // In the same place, a little aside, side by side with a corner in common, and with half of their thickness.
    for (x, z) in [(0.0, 0.0), (0.01, 0.0), (0.3, 0.001), (0.1, 0.002)] {
        let message = play_at(x, z).expect_err("an overlap").to_string();
        for part in ["`pane`", "`other`", "overlap", "position"] {
            assert!(message.contains(part), "{message}");
        }
    }
    // Side by side, one behind the other.
    for (x, z) in [(0.4, 0.0), (0.4001, 0.0), (0.0, 0.004), (0.0, 0.01)] {
        play_at(x, z).unwrap();
    }
}

#[test]
fn no_bodies_of_a_built_in_scene_overlap() {
    for name in SCENE_NAMES {
        let mut scene = scene(name).unwrap();
        if scene.bodies.len() < 2 {
            continue;
        }
        for body in &mut scene.bodies {
            (body.modes, body.followed) = (12, None);
        }
        scene.duration = 1.0 / 60.0;
        let baked = bake(&scene).unwrap();
        let played = play(&scene, &baked, &mut |_| {});
        assert!(played.is_ok(), "{name}: {}", played.unwrap_err());
    }
}
