//! A scene up to its first break is the scene that is played.

use frangible_scenes::{bake, first_break, play, scene};

#[test]
fn the_first_break_is_that_of_the_scene_when_it_is_played() {
    // The vase falls, holds, tips over and breaks: by then its rotation has been damped for many frames.
    let mut scene = scene("vase").unwrap();
    scene.bodies[0].modes = 40;
    scene.bodies[0].resolution = Some(8000);
    let baked = bake(&scene).unwrap();
    let played = play(&scene, &baked, &mut |_| {}).unwrap();
    let played = played.breaks.first().expect("the vase breaks");
    let first = first_break(&scene, &baked, &mut |_| {}).unwrap().unwrap();
    assert_eq!(
        (first.time, first.contacts),
        (played.time, played.contacts.clone())
    );
}
