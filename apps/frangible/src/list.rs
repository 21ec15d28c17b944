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
            "  {name:<11} {} ({material}; {action})",
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
        writeln!(text, "  {:<23} {}", preset.name, preset.summary)?;
    }
    Ok(say(&text)?)
}

/// Prints a built-in scene as a scene file.
pub(crate) fn print_scene(name: &str) -> Result<(), Box<dyn Error>> {
    Ok(say(&scene_to_toml(&scene(name)?))?)
}

/// Short description of the events in a scene: drops and throws.
fn action(scene: &Scene) -> String {
    let drops = scene.bodies.iter().filter_map(|body| match body.place {
        Place::Above { height, .. } => Some(format!("drop {} m", four_digits(height))),
        _ => None,
    });
    let throws = scene.projectiles.iter().map(|p| {
        format!(
            "{} {} kg, radius {} m, {} m/s, {}",
            p.kind.name(),
            four_digits(p.mass),
            four_digits(p.radius),
            four_digits(p.speed),
            p.material
        )
    });
    let mut counted: Vec<(String, usize)> = Vec::new();
    for action in drops.chain(throws) {
        match counted.iter_mut().find(|(known, _)| *known == action) {
            Some((_, count)) => *count += 1,
            None => counted.push((action, 1)),
        }
    }
    let texts = counted.into_iter().map(|(action, count)| match count {
        1 => action,
        _ => format!("{count} × {action}"),
    });
    texts.collect::<Vec<_>>().join("; ")
}

/// Formats a number with four digits at most. A number that was f32 has many more as f64.
fn four_digits(value: f64) -> String {
    let rounded: Result<f64, _> = format!("{value:.3e}").parse();
    rounded.unwrap_or(value).to_string()
}
