//! `frangible scenes`.

use std::error::Error;

use frangible::Material;
use frangible_scenes::{Action, SCENE_NAMES, scene};

pub(crate) fn print() -> Result<(), Box<dyn Error>> {
    println!("Scenes (frangible break --scene NAME):");
    for name in SCENE_NAMES {
        let scene = scene(name)?;
        let action = match &scene.action {
            Action::Drop { height } => format!("drop {height} m"),
            Action::Ball(b) => format!(
                "ball {} kg, radius {} m, {} m/s, {}",
                b.mass, b.radius, b.speed, b.material
            ),
        };
        println!(
            "  {name:<10} {} ({}; {action})",
            scene.summary, scene.material.name
        );
    }
    println!("\nMaterials (--material M, or the last part of --ball):");
    for preset in Material::presets() {
        println!("  {:<22} {}", preset.name, preset.summary);
    }
    Ok(())
}
