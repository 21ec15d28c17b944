//! The plugin for Bevy, which is a workspace of its own: lints and tests, without a window.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::command::{Result, cargo, root, run_within, shown};

/// What the plugin and its tests are built from.
pub(crate) const PATHS: [&str; 5] = [
    "bevy_frangible",
    "crates/frangible",
    "crates/frangible-bake",
    "crates/frangible-mesh",
    "xtask/src/bevy.rs",
];

/// Limit of the whole step: a first build of Bevy takes most of it.
const LIMIT: Duration = Duration::from_secs(35 * 60);

/// Lints and tests the plugin.
pub(crate) fn bevy() -> Result<Vec<String>> {
    let start = Instant::now();
    let target = std::env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| "target".into());
    let target: PathBuf = root().join(target).join("bevy");
    let lints: &[&str] = &[
        "clippy",
        "--release",
        "--all-targets",
        "--",
        "-D",
        "warnings",
    ];
    for words in [&["fmt", "--check"], lints, &["test", "--release"]] {
        let mut command = cargo(words);
        command.current_dir(root().join("bevy_frangible"));
        command.env("CARGO_TARGET_DIR", &target);
        println!("$ {}", shown(&command));
        run_within(&mut command, LIMIT.saturating_sub(start.elapsed()))?;
    }
    Ok(Vec::new())
}
