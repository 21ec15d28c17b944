//! The plugin for Bevy, which is a workspace of its own: lints, tests, and a project made anew by the steps of its page; all without a window or a
//! renderer. Its examples with a window are a step of their own: they draw their pictures, which are compared.

use std::path::{Path, PathBuf};

use crate::command::{Result, announced, cargo, root, target};
use crate::setup::setup;

/// Runs cargo in the plugin's workspace.
fn in_workspace(commands: &[&[&str]]) -> Result<PathBuf> {
    let target = target().join("bevy");
    for words in commands {
        let mut command = cargo(words);
        command.current_dir(root().join("bevy_frangible"));
        command.env("CARGO_TARGET_DIR", &target);
        announced(&mut command)?;
    }
    Ok(target)
}

/// Lints the examples with a window, and has each draw its picture on a software driver.
pub(crate) fn drawn() -> Result<Vec<String>> {
    setup();
    let lints: &[&str] = &[
        "clippy",
        "--release",
        "--package=drawn",
        "--all-targets",
        "--",
        "-D",
        "warnings",
    ];
    let pictures: &[&str] = &["test", "--release", "--package=drawn"];
    in_workspace(&[lints, pictures])?;
    Ok(Vec::new())
}

/// Lints and tests the plugin.
pub(crate) fn bevy() -> Result<Vec<String>> {
    let lints: &[&str] = &[
        "clippy",
        "--release",
        "--all-features",
        "--all-targets",
        "--",
        "-D",
        "warnings",
    ];
    let tests: &[&str] = &["test", "--release", "--all-features"];
    let target = in_workspace(&[lints, tests])?;
    let project = fresh(&target)?;
    for program in ["bake", "game"] {
        let mut command = cargo(&["run", "--quiet", "--release", "--bin", program]);
        command.current_dir(&project);
        command.env("CARGO_TARGET_DIR", &target);
        announced(&mut command)?;
    }
    Ok(Vec::new())
}

/// Bakes the glass of the page into the assets of the project.
const BAKE: &str = r#"use frangible_bake::{BakeSpec, Shape, bake};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let glass = bevy_frangible::frangible::Material::preset("glass")?;
    let spec = BakeSpec::for_games("glass", Shape::drinking_glass(), glass)?;
    std::fs::create_dir_all("assets")?;
    bake(&spec)?.save("assets/glass.frangible")?;
    Ok(())
}
"#;

/// A new project whose program is the first lines of code of the plugin's page, but without a window and with an end.
fn fresh(target: &Path) -> Result<PathBuf> {
    let plugin = root().join("bevy_frangible");
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path);
        text.map_err(|error| format!("{}: {error}", path.display()))
    };
    let page = read(plugin.join("README.md"))?;
    let lines = page
        .split("```")
        .nth(1)
        .and_then(|code| code.split_once('\n'));
    let (_, lines) =
        lines.ok_or("the documentation of bevy_frangible does not begin with a code block")?;
    let without_window = "(bevy::log::LogPlugin::default(), MinimalPlugins, AssetPlugin::default(), TransformPlugin, \
                          bevy::mesh::MeshPlugin)";
    let end = ".add_observer(|_: On<Broke>, mut exit: MessageWriter<AppExit>| { exit.write(AppExit::Success); })
    .add_systems(Update, |time: Res<Time>| assert!(time.elapsed_secs() < 60.0, \"the glass is whole after a minute\"))
    .run();";
    let lines = lines
        .replace("DefaultPlugins", without_window)
        .replace(".run();", end);
    let program = format!(
        "use avian3d::prelude::*;\nuse bevy::prelude::*;\nuse bevy_frangible::prelude::*;\n\nfn main() {{\n{lines}}}\n"
    );
    // With the versions and features of the plugin's own tests, nothing is built twice.
    let manifest = read(plugin.join("Cargo.toml"))?;
    let engine = |name: &str| {
        let lines = manifest.lines();
        let mut line = lines.filter(|line| line.starts_with(&format!("{name} = {{")));
        line.next()
            .map(|line| line.replace(", optional = true", ""))
    };
    let (Some(avian), Some(bevy)) = (engine("avian3d"), engine("bevy")) else {
        return Err("bevy_frangible/Cargo.toml does not list avian3d or bevy".into());
    };
    let path = |name: &str| root().join(name).display().to_string();
    let manifest = format!(
        "[package]\nname = \"fresh\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\n{avian}\n{bevy}\nbevy_frangible = {{ path = {:?}, \
         features = [\"gizmos\", \"rapier\"] }}\nfrangible-bake = {{ path = {:?} }}\n",
        path("bevy_frangible"),
        path("crates/frangible-bake"),
    );
    let project = target.join("fresh");
    let files = [
        ("Cargo.toml", manifest),
        ("Cargo.lock", read(plugin.join("Cargo.lock"))?),
        ("src/bin/bake.rs", BAKE.into()),
        ("src/bin/game.rs", program),
    ];
    let failed = |error: std::io::Error| format!("{}: {error}", project.display());
    std::fs::create_dir_all(project.join("src/bin")).map_err(failed)?;
    for (name, text) in files {
        std::fs::write(project.join(name), text).map_err(failed)?;
    }
    Ok(project)
}
