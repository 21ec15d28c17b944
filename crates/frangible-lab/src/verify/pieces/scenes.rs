//! Fragments of the built-in scenes.

use frangible::{Outcome, impact};
use frangible_scenes::{SCENE_NAMES, bake, breakable, play, scene};
use rayon::prelude::*;

use super::Broken;
use crate::Result;

/// Simulated time of the scenes, s: by then every body has met what breaks it.
const DURATION: f64 = 1.0;
/// Bodies that take the blow of each scene, each with weak points of its own.
const SEEDS: u64 = 4;

/// The bodies of all built-in scenes, broken as the scenes break them, each with several seeds.
///
/// # Errors
/// A scene that cannot be played.
pub fn broken_scenes() -> Result<Vec<Broken>> {
    let all: Result<Vec<Vec<Broken>>> = SCENE_NAMES.par_iter().map(|name| of_scene(name)).collect();
    Ok(all?.concat())
}

fn of_scene(name: &str) -> Result<Vec<Broken>> {
    let mut scene = scene(name)?;
    scene.duration = DURATION;
    let baked = bake(&scene)?;
    let run = play(&scene, &baked, &mut |_| {})?;
    let mut all = Vec::new();
    for (i, (spec, baked)) in scene.bodies.iter().zip(&baked).enumerate() {
        let Some(record) = run.break_of(i) else {
            continue;
        };
        let kind = breakable(spec, &baked.asset)?;
        for seed in 1..=SEEDS {
            let body = kind.body(seed);
            if let Outcome::Broke(fracture) = impact(&body, &record.contacts, &scene.fracture)? {
                all.push(Broken::new(name, body, *fracture));
            }
        }
    }
    Ok(all)
}
