//! Runs all tests of the workspace, in the profile that also builds the program.

use std::path::PathBuf;

use serde_json::Value;

use crate::command::{Result, cargo, output, program, run, succeeds};

/// Packages that the program has in one unit for speed: in the tests it matters more that they compile soon.
const IN_ONE_UNIT: [&str; 2] = ["frangible", "frangible-geometry"];
/// The program with its window, which is not in its default features.
pub(crate) const WITH_WINDOW: [&str; 2] = ["--features", "frangible-cli/view"];
/// Examples of `frangible-rapier` that its tests run.
const RUN_EXAMPLES: [&str; 7] = [
    "ask",
    "explosion",
    "glass",
    "painted",
    "pots",
    "replay",
    "window",
];
/// Neither (other) examples nor benchmarks: clippy compiles those.
const TESTED: [&str; 3] = ["--lib", "--bins", "--tests"];

/// The workspace's own packages: name, and true if it is published.
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
    let options = options()?;
    run(cargo(&["build"]).args(run_examples()).args(&options))?;
    // The tests of a crate share a process, and with it the bodies that they bake.
    run(cargo(&["test", "--no-fail-fast"])
        .args(TESTED)
        .args(&options))?;
    run(cargo(&["test", "--doc"]).args(&options))
}

/// Runs the tests that are left out of every other run, since they take minutes or write hundreds of megabytes.
pub(crate) fn long() -> Result {
    run(cargo(&["test"])
        .args(TESTED)
        .args(options()?)
        .args(["--", "--ignored"]))
}

/// The examples that a test runs as a user would.
fn run_examples() -> impl Iterator<Item = &'static str> {
    RUN_EXAMPLES.iter().flat_map(|name| ["--example", name])
}

/// Runs the tests that take no more than a few seconds each; `.config/nextest.toml` says which those are.
pub(crate) fn fast() -> Result {
    if !has_nextest() {
        return Err(
            "the fast tests need cargo-nextest; install it with `cargo install cargo-nextest --locked`"
                .into(),
        );
    }
    let options = options()?;
    run(cargo(&["build"]).args(run_examples()).args(&options))?;
    run(cargo(&["nextest", "run", "--profile", "fast"])
        .args(TESTED)
        .args(&options))
}

/// Runs the tests whose module and name contain one of these names.
pub(crate) fn named(names: &[&str]) -> Result {
    let options = options()?;
    run(cargo(&["build"]).args(run_examples()).args(&options))?;
    run(cargo(&["test", "--no-fail-fast"])
        .args(TESTED)
        .args(&options)
        .arg("--")
        .args(names))
}

/// The command line's program as the tests have built it, with assertions; nothing is compiled behind a run of the tests.
pub(crate) fn tested_program() -> Result<PathBuf> {
    run(cargo(&["test", "--no-run", "--quiet"])
        .args(TESTED)
        .args(options()?))?;
    Ok(program())
}

fn has_nextest() -> bool {
    succeeds("cargo", &["nextest", "--version"])
}

/// The build of the tests: the workspace in the release profile, with debug assertions and checks of overflow in our own packages only.
/// Dependencies keep the profile they have in `cargo run --release`, and so are built once. This running xtask is left out, it would be rebuilt for nothing.
fn options() -> Result<Vec<String>> {
    let packages = packages()?;
    let names = packages.iter().map(|(name, _)| name.as_str());
    let assertions = names.filter(|name| *name != "xtask").flat_map(|name| {
        ["debug-assertions", "overflow-checks"]
            .map(|check| format!("profile.release.package.{name}.{check}=true"))
    });
    let units = IN_ONE_UNIT.map(|name| format!("profile.release.package.{name}.codegen-units=16"));
    let settings = assertions.chain(units);
    Ok(["--release", "--workspace", WITH_WINDOW[0], WITH_WINDOW[1]]
        .map(String::from)
        .into_iter()
        .chain(settings.flat_map(|setting| ["--config".into(), setting]))
        .collect())
}
