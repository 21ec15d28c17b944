//! A scene whose text is accepted runs without a panic, and its breaks lose no mass.
//!
//! Its bodies stand for small baked ones, since baking would take most of the time, and it ends after 0.06 s: a projectile
//! flies 0.05 s before it hits.

use std::path::Path;
use std::sync::Arc;

use frangible_scenes::{BakedBody, parse_scene, play};

use crate::bodies::assets;

/// Most bodies and projectiles of a scene that is run.
const MOST: usize = 3;
/// Simulated time, s.
const DURATION: f64 = 0.06;

/// Runs the scene that the text describes.
pub fn run_scene(bytes: &[u8]) {
    let Ok(mut scene) = parse_scene(crate::text(bytes), Path::new("")) else {
        return;
    };
    if scene.bodies.len() > MOST || scene.projectiles.len() > MOST {
        return;
    }
    scene.duration = scene.duration.min(DURATION);
    // More samples only take longer, and pieces that break again are the target `world`'s.
    scene.fracture.samples_per_period = scene.fracture.samples_per_period.min(32.0);
    scene.pieces.generations = 0;
    let first = scene.seed as usize % MOST;
    let baked: Vec<BakedBody> = (0..scene.bodies.len())
        .map(|i| BakedBody {
            asset: Arc::clone(&assets()[(first + i) % MOST]),
            report: None,
        })
        .collect();
    let Ok(run) = play(&scene, &baked, &mut |_| {}) else {
        return;
    };
    for broke in &run.breaks {
        let whole = baked[broke.body].asset.mass().mass;
        let mass: f64 = broke.masses.iter().sum();
        assert!((mass / whole - 1.0).abs() < 1e-6, "{mass} kg of {whole}");
        assert!(!format!("{:?}", broke.report).contains("NaN"));
        let energies = [broke.kinetic_before, broke.kinetic_after, broke.energy_paid];
        assert!(energies.iter().all(|e| e.is_finite()), "{energies:?}");
    }
    let said = format!("{:?}", run.recording.nodes);
    assert!(!said.contains("NaN") && !said.contains("inf"), "a pose");
}
