//! `frangible scenes`.

use std::error::Error;

use frangible::Material;
use frangible_scenes::{Place, SCENE_NAMES, Scene, scene, scene_to_toml};

pub(crate) fn print() -> Result<(), Box<dyn Error>> {
    println!("Scenes (frangible break --scene NAME):");
    for name in SCENE_NAMES {
        let scene = scene(name)?;
        let material = scene.bodies.first().map_or("", |b| &b.material.name);
        let action = action(&scene);
        println!("  {name:<10} {} ({material}; {action})", scene.summary);
    }
    println!("\nMaterials (--material M, or the last part of --ball):");
    for preset in Material::presets() {
        println!("  {:<22} {}", preset.name, preset.summary);
    }
    Ok(())
}

/// Prints a built-in scene as a scene file.
pub(crate) fn print_scene(name: &str) -> Result<(), Box<dyn Error>> {
    print!("{}", scene_to_toml(&scene(name)?));
    Ok(())
}

/// What happens in a scene, in a few words.
fn action(scene: &Scene) -> String {
    let drops = scene.bodies.iter().filter_map(|body| match body.place {
        Place::Above { height, .. } => Some(format!("drop {height} m")),
        _ => None,
    });
    let throws = scene.projectiles.iter().map(|p| {
        format!(
            "{} {} kg, radius {} m, {} m/s, {}",
            p.kind.name(),
            p.mass,
            p.radius,
            p.speed,
            p.material
        )
    });
    drops.chain(throws).collect::<Vec<_>>().join("; ")
}
