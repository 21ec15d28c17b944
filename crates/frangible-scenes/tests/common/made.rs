//! Scenes of bodies whose meshes are made from a seed.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use frangible_scenes::{
    BakedBody, Files, Scene, SceneError, bake_opened, open_scene_from, parse_scene,
};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Rings and sectors of a mesh.
const RINGS: usize = 20;
const SECTORS: usize = 40;

/// Materials, in turn.
const MATERIALS: [&str; 4] = ["porcelain", "glass", "chocolate", "brick"];

/// An OBJ of a ball of about 0.15 m that is stretched along its axes and has bumps and dents, all by lot.
pub(crate) fn mesh(seed: u64) -> String {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut lot =
        |low: f64, high: f64| low + (high - low) * f64::from(rng.next_u32()) / f64::from(u32::MAX);
    let stretch: [f64; 3] = [(); 3].map(|()| lot(0.4, 1.0));
    let bumps: Vec<([f64; 3], f64)> = (0..5)
        .map(|_| ([(); 3].map(|()| lot(-1.0, 1.0)), lot(-0.25, 0.4)))
        .collect();
    let place = |ring: usize, sector: usize| {
        let polar = std::f64::consts::PI * ring as f64 / RINGS as f64;
        let turn = std::f64::consts::TAU * sector as f64 / SECTORS as f64;
        let toward = [
            polar.sin() * turn.cos(),
            polar.cos(),
            -polar.sin() * turn.sin(),
        ];
        let grown: f64 = bumps
            .iter()
            .map(|(at, height)| {
                let away: f64 = (0..3).map(|k| (toward[k] - at[k]).powi(2)).sum();
                height * (-2.0 * away).exp()
            })
            .sum();
        [0, 1, 2].map(|k| 0.075 * (1.0 + grown) * stretch[k] * toward[k])
    };
    let mut text = String::new();
    let mut vertex = |[x, y, z]: [f64; 3]| {
        let _ = writeln!(text, "v {x} {y} {z}");
    };
    vertex(place(0, 0));
    for ring in 1..RINGS {
        (0..SECTORS).for_each(|sector| vertex(place(ring, sector)));
    }
    vertex(place(RINGS, 0));
    let last = 2 + (RINGS - 1) * SECTORS;
    let at = |ring: usize, sector: usize| match ring {
        0 => 1,
        RINGS => last,
        _ => 2 + (ring - 1) * SECTORS + sector % SECTORS,
    };
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            let [a, b, c, d] = [
                at(ring, sector),
                at(ring + 1, sector),
                at(ring + 1, sector + 1),
                at(ring, sector + 1),
            ];
            if ring + 1 < RINGS {
                let _ = writeln!(text, "f {a} {b} {c}");
            }
            if ring > 0 {
                let _ = writeln!(text, "f {a} {c} {d}");
            }
        }
    }
    text
}

/// The body of a seed, which falls onto the floor.
pub(crate) fn made(seed: u64) -> Result<(Scene, Vec<BakedBody>), SceneError> {
    let material = MATERIALS[seed as usize % MATERIALS.len()];
    let text = format!(
        "name = \"made-{seed}\"\nseed = {seed}\nduration = 6\n[[body]]\nname = \"body\"\nmesh = \"made.obj\"\n\
         material = \"{material}\"\ndrop = 12.0\nresolution = 3000\nmodes = 24\n"
    );
    let mut files = BTreeMap::new();
    files.insert(PathBuf::from("made.obj"), mesh(seed).into_bytes());
    let scene = parse_scene(&text, Path::new(""))?;
    let (scene, opened) = open_scene_from(&scene, &Files::Given(files))?;
    let baked = bake_opened(&scene, opened, &mut |_| {})?;
    Ok((scene, baked))
}
