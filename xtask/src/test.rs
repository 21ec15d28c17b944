//! All tests of the workspace, in the profile that also builds the program.

use serde_json::Value;

use crate::command::{Result, cargo, output, run, succeeds};

/// The workspace's own packages: name, and whether it is published.
pub(crate) fn packages() -> Result<Vec<(String, bool)>> {
    let text = output(&mut cargo(&[
        "metadata",
        "--no-deps",
        "--format-version",
        "1",
    ]))?;
    let metadata: Value = serde_json::from_slice(&text)
        .map_err(|error| format!("`cargo metadata` wrote no JSON ({error}); update cargo"))?;
    let packages = metadata["packages"]
        .as_array()
        .map_or(&[][..], Vec::as_slice);
    Ok(packages
        .iter()
        .filter_map(|package| {
            // `publish = false` reads as an empty list of registries, its absence as null.
            let published = package["publish"]
                .as_array()
                .is_none_or(|registries| !registries.is_empty());
            Some((package["name"].as_str()?.to_owned(), published))
        })
        .collect())
}

/// Runs the tests, then the doctests.
pub(crate) fn test() -> Result {
    let assertions = assertions()?;
    let options: Vec<&str> = ["--release", "--workspace"]
        .into_iter()
        .chain(assertions.iter().map(String::as_str))
        .collect();
    if succeeds("cargo", &["nextest", "--version"]) {
        run(cargo(&["nextest", "run"]).args(&options))?;
        run(cargo(&["test", "--doc"]).args(&options))
    } else {
        run(cargo(&["test"]).args(&options))
    }
}

/// Runs the tests that take no more than a few seconds each; `.config/nextest.toml` says which those are.
pub(crate) fn fast() -> Result {
    if !succeeds("cargo", &["nextest", "--version"]) {
        return Err(
            "the fast tests are chosen by cargo-nextest: `cargo install cargo-nextest --locked` gets it"
                .into(),
        );
    }
    let words = [
        "nextest",
        "run",
        "--profile",
        "fast",
        "--release",
        "--workspace",
    ];
    run(cargo(&words).args(assertions()?))
}

/// Debug assertions for our own packages only: dependencies keep the profile they have in `cargo run --release`, and
/// so are built once. This running xtask is left out, it would be rebuilt for nothing.
fn assertions() -> Result<Vec<String>> {
    Ok(packages()?
        .iter()
        .filter(|(name, _)| name != "xtask")
        .flat_map(|(name, _)| {
            [
                "--config".to_owned(),
                format!("profile.release.package.{name}.debug-assertions=true"),
            ]
        })
        .collect())
}
