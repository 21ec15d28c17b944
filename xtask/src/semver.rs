//! Compares the interfaces of the published crates with the last version: can its users take this one unchanged?

use std::process::Command;

use crate::command::{Result, announced, cargo, output, root, succeeds};
use crate::test::packages;

/// The version whose options are used here.
const VERSION: &str = "0.51.0";

/// Compares the published crates with those of a revision, or of the last tag of a version; a line says so where there is none.
///
/// Removing something that the version still promises is an error. `frangible::internals` promises nothing.
pub(crate) fn semver(revision: Option<&str>) -> Result<Vec<String>> {
    let Some(revision) = revision.map(String::from).or_else(last_version) else {
        let line = "semver: there is no version tag yet, so there is nothing to compare with";
        println!("{line}");
        return Ok(vec![line.into()]);
    };
    if !succeeds("cargo", &["semver-checks", "--version"]) {
        let install = ["install", "cargo-semver-checks", "--locked", "--version"];
        announced(cargo(&install).arg(VERSION))?;
    }
    let mut words = vec!["semver-checks", "--baseline-rev", &revision];
    let all = packages()?;
    for (name, _) in all.iter().filter(|(_, published)| *published) {
        words.extend(["--package", name.as_str()]);
    }
    announced(&mut cargo(&words))?;
    Ok(vec![format!("semver: compatible with {revision}")])
}

/// The last tag of a version before the current commit.
fn last_version() -> Option<String> {
    let mut tags = Command::new("git");
    tags.args(["tag", "--merged", "HEAD", "--sort=-version:refname"]);
    tags.args(["--list", "v[0-9]*"]);
    let tags = output(tags.current_dir(root())).ok()?;
    let tags = String::from_utf8_lossy(&tags);
    tags.lines().next().map(String::from)
}
