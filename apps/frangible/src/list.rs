//! `frangible scenes`.

use std::error::Error;
use std::fmt::Write;

use frangible::Material;
use frangible_bake::READY_SHAPES;
use frangible_scenes::{Place, SCENE_NAMES, Scene, scene, scene_to_toml};

use crate::say::say;

pub(crate) fn print() -> Result<(), Box<dyn Error>> {
    let mut text = String::from("Scenes (frangible break --scene NAME):\n");
    for name in SCENE_NAMES {
        let scene = scene(name)?;
        let material = scene.bodies.first().map_or("", |b| &b.material.name);
        let action = action(&scene);
        writeln!(
            text,
            "  {name:<10} {} ({material}; {action})",
            scene.summary
        )?;
    }
    writeln!(
        text,
        "\nReady solids for scene files (shape = NAME): {}",
        READY_SHAPES.join(", ")
    )?;
    text.push_str("\nMaterials (--material M, or the last part of --ball):\n");
    for preset in Material::presets() {
        writeln!(text, "  {:<22} {}", preset.name, preset.summary)?;
    }
    Ok(say(&text)?)
}

/// Prints a built-in scene as a scene file.
pub(crate) fn print_scene(name: &str) -> Result<(), Box<dyn Error>> {
    Ok(say(&scene_to_toml(&scene(name)?))?)
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
