//! Scenes as a game plays them.

use frangible_scenes::{GamePlan, bake, play_as_game, scene};

#[test]
fn a_game_sees_the_same_in_every_run() {
    let mut plate = scene("shards").expect("a scene");
    plate.duration = 1.2;
    for body in &mut plate.bodies {
        (body.resolution, body.modes) = (Some(6000), 30);
    }
    let baked = bake(&plate).expect("a bake");
    let run = || play_as_game(&plate, &baked, GamePlan::default(), &mut |_| {}).expect("a run");
    let (first, second) = (run(), run());
    assert_eq!(first.breaks, 1);
    assert!(first.poses.len() > 3, "{} bodies", first.poses.len());
    assert_eq!(first.frames.len(), 72);
    assert_eq!(
        (first.poses, first.breaks, first.again),
        (second.poses, second.breaks, second.again)
    );
}
