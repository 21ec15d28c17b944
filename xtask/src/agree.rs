//! The first build and the tests compile the same variants of external packages, so that the second command of the README compiles none
//! of them again.

use std::collections::{BTreeMap, BTreeSet};

use crate::command::{Result, cargo, output};
use crate::test::WITH_WINDOW;

/// Sets of features by package.
type Variants = BTreeMap<String, BTreeSet<String>>;

/// Compares the features that cargo chooses for the two builds.
pub(crate) fn features_agree() -> Result<Vec<String>> {
    let first = variants(&["--edges", "normal,build"])?;
    let [option, window] = WITH_WINDOW;
    let edges = "normal,build,dev";
    let tests = variants(&["--edges", edges, "--workspace", option, window])?;
    let twice: Vec<String> = first
        .iter()
        .filter_map(|(package, sets)| {
            let known = tests.get(package)?;
            let missing = sets.difference(known).next()?;
            let wanted: Vec<&str> = known.iter().map(String::as_str).collect();
            Some(format!(
                "{package} has `{missing}` in the first build, but `{}` in the tests",
                wanted.join("` or `")
            ))
        })
        .collect();
    if twice.is_empty() {
        return Ok(Vec::new());
    }
    Err(format!(
        "the tests recompile packages of the first build; give these packages the same features in apps/frangible/Cargo.toml:\n{}",
        twice.join("\n")
    ))
}

fn variants(words: &[&str]) -> Result<Variants> {
    let mut command = cargo(&["tree", "--prefix", "none", "--format", "{p}|{f}"]);
    let text = output(command.args(words))?;
    let mut found = Variants::new();
    for line in String::from_utf8_lossy(&text).lines() {
        let Some((package, features)) = line.trim_end_matches(" (*)").split_once('|') else {
            continue;
        };
        // Packages of the workspace stand with their folder; those are compiled with other settings anyway.
        if !package.contains(" (/") {
            let name = package.trim_end_matches(" (proc-macro)");
            let sets = found.entry(name.into()).or_default();
            sets.insert(features.trim().into());
        }
    }
    Ok(found)
}
