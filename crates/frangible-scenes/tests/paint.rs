//! Weakness painted on a mesh with vertex colours.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::common::{blow, steel_ball};
use frangible::glam::Vec3;
use frangible::internals::impact_traced;
use frangible::{Asset, Breakable, FractureConfig};
use frangible_bake::weakness::{self, Channel, Paint, Patch, Zone};
use frangible_scenes::{Scene, bake, bake_with, parse_scene, play};

/// Sides of the plate, m.
const PLATE: [f32; 3] = [0.2, 0.12, 0.006];

/// Position of the paint, m from the middle, and half its width, m.
const PAINT: (f32, f32) = (0.03, 0.006);

/// A folder of its own, gone afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("frangible-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A plate as OBJ, its faces divided into squares of 4 mm, a line across it painted red on white; or without any colour.
fn plate(painted: bool) -> String {
    let mut text = String::new();
    let [nx, ny] = [PLATE[0], PLATE[1]].map(|side| (side / 0.004).round() as u32);
    let number = |i: u32, j: u32, k: u32| (k * (ny + 1) + j) * (nx + 1) + i + 1;
    for k in 0..2 {
        for j in 0..=ny {
            for i in 0..=nx {
                let x = PLATE[0] * (i as f32 / nx as f32 - 0.5);
                let y = PLATE[1] * (j as f32 / ny as f32 - 0.5);
                let z = PLATE[2] * (k as f32 - 0.5);
                let color = match painted {
                    false => "",
                    true if (x - PAINT.0).abs() <= PAINT.1 => " 1 0 0",
                    true => " 1 1 1",
                };
                writeln!(text, "v {x} {y} {z}{color}").unwrap();
            }
        }
    }
    let mut face = |corners: [u32; 4]| {
        let [a, b, c, d] = corners;
        writeln!(text, "f {a} {b} {c} {d}").unwrap();
    };
    for j in 0..ny {
        for i in 0..nx {
            let at = |di, dj, k| number(i + di, j + dj, k);
            face([at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)]);
            face([at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)]);
        }
    }
    for i in 0..nx {
        for (j, step) in [(0, [0, 1]), (ny, [1, 0])] {
            let [a, b] = step.map(|s| i + s);
            face([
                number(a, j, 0),
                number(b, j, 0),
                number(b, j, 1),
                number(a, j, 1),
            ]);
        }
    }
    for j in 0..ny {
        for (i, step) in [(0, [1, 0]), (nx, [0, 1])] {
            let [a, b] = step.map(|s| j + s);
            face([
                number(i, a, 0),
                number(i, b, 0),
                number(i, b, 1),
                number(i, a, 1),
            ]);
        }
    }
    text
}

/// A steel ball in the middle of the plate; where the mesh is painted, green is missing.
fn scene(folder: &Path, mesh: &str, weakness: &str) -> Scene {
    let text = format!(
        "duration = 1\n[[body]]\nmesh = \"{mesh}\"\nup = \"y\"\nmaterial = \"glass\"\nmodes = 40\nweibull_modulus = 0\n\
         resolution = 12000\nposition = [0, 1, 0]\n{weakness}\n\
         [[projectile]]\nmass = 0.13\nradius = 0.016\nspeed = 6\ntoward = [0, 0, -1]\n"
    );
    parse_scene(&text, folder).unwrap()
}

const WEAK_WHERE_RED: &str = "weakness = [{ paint = \"green\", strength = [0.25, 1] }]";

/// Share of the plate's width over which cracks of a blow in its middle run in the paint.
fn cracked_along(kind: &Breakable, seed: u64) -> f64 {
    let asset = kind.asset();
    let hit = blow(
        asset,
        Vec3::new(0.0, 0.0, 0.5 * PLATE[2]),
        Vec3::NEG_Z,
        6.0,
        steel_ball(0.13),
    );
    let config = FractureConfig::default();
    let (_, trace) = impact_traced(&kind.body(seed), std::slice::from_ref(&hit), &config).unwrap();
    const BINS: usize = 20;
    let mut cut = [false; BINS];
    for element in trace.cracks.iter().flatten() {
        let p = asset.fracture().centroid(element.tet as usize);
        if (p.x - PAINT.0).abs() <= PAINT.1 {
            let bin = ((p.y / PLATE[1] + 0.5) * BINS as f32) as usize;
            cut[bin.min(BINS - 1)] = true;
        }
    }
    cut.iter().filter(|c| **c).count() as f64 / BINS as f64
}

fn kind(asset: &Arc<Asset>, scene: &Scene) -> Breakable {
    let fields = weakness::from_paint(asset, &scene.bodies[0].paint)
        .unwrap()
        .with_weibull_modulus(0.0);
    let kind = Breakable::uniform(Arc::clone(asset)).unwrap();
    kind.with_fields(fields).unwrap()
}

#[test]
fn a_painted_plate_breaks_along_the_paint() {
    let folder = Folder::new("paint");
    fs::write(folder.0.join("painted.obj"), plate(true)).unwrap();
    fs::write(folder.0.join("bare.obj"), plate(false)).unwrap();
    let painted = scene(&folder.0, "painted.obj", WEAK_WHERE_RED);
    let baked = bake(&painted).unwrap();
    let asset = &baked[0].asset;
    assert!(!asset.render().unwrap().colors.is_empty());

    // Of the same asset: with what its paint means, and as if it meant nothing.
    let bare = scene(&folder.0, "painted.obj", "");
    const SEEDS: u64 = 12;
    let along = |scene: &Scene| {
        let kind = kind(asset, scene);
        let shares: Vec<f64> = (1..=SEEDS).map(|s| cracked_along(&kind, s)).collect();
        let right_across = shares.iter().filter(|s| **s >= 0.8).count();
        println!("cracked along the line: {shares:.2?}; right across {right_across} of {SEEDS}");
        right_across
    };
    let (with, without) = (along(&painted), along(&bare));
    assert!(with > SEEDS as usize / 2, "{with}");
    assert!(with >= without + SEEDS as usize / 3, "{with} {without}");

    // The colours go through a file.
    let loaded = Arc::new(Asset::from_bytes(&asset.to_bytes()).unwrap());
    assert_eq!(
        weakness::from_paint(&loaded, &painted.bodies[0].paint).unwrap(),
        weakness::from_paint(asset, &painted.bodies[0].paint).unwrap()
    );
    // And the whole way, from the file to pieces.
    let run = play(&painted, &baked, &mut |_| {}).unwrap();
    let report = &run.break_of(0).unwrap().report;
    assert!(report.strength < 0.5 * asset.material().strength);
    let run = play(&bare, &baked, &mut |_| {}).unwrap();
    let report = run.break_of(0).map(|b| b.report.strength);
    assert!(report.is_none_or(|s| s == asset.material().strength));

    // Zones lie over paint.
    let patch = Patch::of_strength(Zone::Box([Vec3::NEG_ONE, Vec3::ONE]), 2.0);
    let over = weakness::from_paint(asset, &painted.bodies[0].paint).unwrap();
    let over = weakness::patched(over, asset, &[patch]).unwrap();
    assert!(over.of_tet.iter().all(|f| f.strength == 2.0));
    let bad = Paint::of_strength(Channel::Red, [1.0, 0.0]);
    let message = weakness::from_paint(asset, &[bad]).unwrap_err().to_string();
    assert!(
        message.contains("strength") && message.contains("red"),
        "{message}"
    );

    // A mesh without paint is refused before anything is baked, and so is an asset made of it.
    let bare = scene(&folder.0, "bare.obj", WEAK_WHERE_RED);
    let message = bake_with(&bare, |_| panic!("baked"))
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("bare.obj") && message.contains("vertex colours"),
        "{message}"
    );
    let mut plain = Asset::clone(asset);
    plain.parts_mut().render.as_mut().unwrap().colors.clear();
    let message = weakness::from_paint(&plain, &painted.bodies[0].paint).unwrap_err();
    assert!(message.to_string().contains("vertex colours"), "{message}");
}
