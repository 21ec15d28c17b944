//! `cargo check` for platforms that this machine is not.

use crate::command::{Result, announced, cargo, root, skipped, succeeds, target};

/// Windows, macOS, and Linux on ARM.
const TARGETS: [&str; 3] = [
    "x86_64-pc-windows-gnu",
    "aarch64-apple-darwin",
    "aarch64-unknown-linux-gnu",
];

/// Packages with dependencies in C, which need a compiler for the platform: the laboratory writes WebP.
const IN_C: [&str; 1] = ["frangible-lab"];

/// Checks all packages without C for every platform that can be installed.
pub(crate) fn platforms() -> Result<Vec<String>> {
    let mut missing = Vec::new();
    for platform in TARGETS {
        if !succeeds("rustup", &["target", "add", platform]) {
            missing.extend(skipped(
                "platforms",
                &format!("rustup cannot install {platform}"),
            )?);
            continue;
        }
        let mut command = cargo(&["check", "--workspace", "--target", platform]);
        for package in IN_C {
            command.args(["--exclude", package]);
        }
        // Its own folder: the standard library and all dependencies are those of the platform.
        command.current_dir(root());
        command.env("CARGO_TARGET_DIR", target().join("platforms"));
        announced(&mut command)?;
    }
    Ok(missing)
}
