//! Measurements as data: each is one JSON file in `docs/data`.
//!
//! A file has the commit of the code that was measured, the crates that the numbers depend on, the machine if the numbers are times, and the numbers.
//! It has no date, so the same code gives the same file. The commit is the last one that changed those crates: a commit that touches nothing else
//! leaves a measurement up to date.

use std::path::{Path, PathBuf};
use std::process::Command;

use frangible_recording::{make_folder, write_atomically};
use serde::Serialize;
use serde_json::{Value, json};

use crate::Result;
use crate::bench::machine::Machine;

/// Crates that a measurement depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measures {
    /// The fracture model and the bake.
    Model,
    /// Also the rigid bodies and the scenes.
    Scenes,
    /// Also the synthesiser.
    Sound,
}

impl Measures {
    const CRATES: [&str; 8] = [
        "frangible",
        "frangible-bake",
        "frangible-geometry",
        "frangible-material",
        "frangible-mesh",
        "frangible-rapier",
        "frangible-scenes",
        "frangible-sound",
    ];

    /// Names of the crates.
    #[must_use]
    pub fn crates(self) -> &'static [&'static str] {
        &Self::CRATES[..match self {
            Self::Model => 5,
            Self::Scenes => 7,
            Self::Sound => 8,
        }]
    }
}

/// A measurement as its file holds it. `machine`: true if the numbers are times.
///
/// # Errors
/// Numbers that JSON cannot hold.
pub fn stored(measures: Measures, machine: bool, found: &impl Serialize) -> Result<Value> {
    let crates = measures.crates();
    let mut stored = json!({ "commit": commit_of(crates), "crates": crates });
    if machine {
        stored["machine"] = json!(Machine::this());
    }
    stored["measured"] = serde_json::to_value(found)?;
    round(&mut stored);
    Ok(stored)
}

/// Writes `docs/data/NAME.json`, with `docs` for the given folder.
///
/// # Errors
/// A folder or file that cannot be written.
pub fn write(docs: &Path, name: &str, stored: &Value) -> Result<PathBuf> {
    let (folder, file) = (docs.join("data"), format!("{name}.json"));
    make_folder(&folder, std::slice::from_ref(&file), "--write")?;
    let path = folder.join(file);
    write_atomically(&path, (compact(stored, 0) + "\n").as_bytes())?;
    Ok(path)
}

/// The data of a name, from a folder such as `docs`.
///
/// # Errors
/// A file that is missing, or no JSON.
pub fn read(docs: &Path, name: &str) -> Result<Value> {
    let path = docs.join("data").join(format!("{name}.json"));
    let text = std::fs::read_to_string(&path)
        .map_err(|e| format!("`{}` cannot be read: {e}", path.display()))?;
    Ok(
        serde_json::from_str(&text)
            .map_err(|e| format!("`{}` is not JSON: {e}", path.display()))?,
    )
}

/// Keeps six digits of every number: those beyond are rounding, which differs between machines.
fn round(value: &mut Value) {
    match value {
        Value::Number(number) if number.is_f64() => {
            let text = format!("{:.5e}", number.as_f64().unwrap_or(0.0));
            *value = json!(text.parse::<f64>().unwrap_or(0.0));
        }
        Value::Array(items) => items.iter_mut().for_each(round),
        Value::Object(items) => items.values_mut().for_each(round),
        _ => {}
    }
}

/// JSON with one line for each innermost list or object.
fn compact(value: &Value, depth: usize) -> String {
    let flat = |value: &Value| !value.is_array() && !value.is_object();
    let (open, close, items): (_, _, Vec<String>) = match value {
        Value::Array(items) if !items.iter().all(flat) => {
            let items = items.iter().map(|item| compact(item, depth + 1));
            ("[", "]", items.collect())
        }
        Value::Object(items) if !items.values().all(flat) => {
            let items = items.iter();
            let item = |(key, item)| format!("{}: {}", json!(key), compact(item, depth + 1));
            ("{", "}", items.map(item).collect())
        }
        inner => return inner.to_string(),
    };
    let (inner, outer) = (" ".repeat(depth + 1), " ".repeat(depth));
    format!(
        "{open}\n{inner}{}\n{outer}{close}",
        items.join(&format!(",\n{inner}"))
    )
}

/// Last commit that changed the sources of these crates, with `+` if there are changes since; `unknown` without a history.
#[must_use]
pub fn commit_of(crates: &[&str]) -> String {
    let git = |words: &[&str]| -> Option<String> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let mut command = Command::new("git");
        command.current_dir(root).args(words).arg("--");
        command.args(crates.iter().map(|name| format!("crates/{name}/src")));
        let output = command.output().ok().filter(|o| o.status.success())?;
        Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let commit = git(&["log", "-1", "--format=%h", "--abbrev=8"]).filter(|c| !c.is_empty());
    let Some(commit) = commit else {
        return "unknown".into();
    };
    let changed = git(&["status", "--porcelain"]).is_some_and(|changes| !changes.is_empty());
    commit + if changed { "+" } else { "" }
}

#[cfg(test)]
mod tests {
    use super::{Measures, compact, stored};
    use serde_json::json;

    #[test]
    fn a_file_has_its_crates_and_six_digits() {
        let found = stored(Measures::Model, false, &json!({ "x": 1.0 / 3.0, "n": 7 }));
        let found = found.unwrap();
        assert_eq!(found["measured"], json!({ "x": 0.333_333, "n": 7 }));
        assert_eq!(found["crates"].as_array().map(Vec::len), Some(5));
        assert!(found.get("machine").is_none());
    }

    #[test]
    fn innermost_lists_stand_on_one_line_and_nothing_is_lost() {
        let value = json!({ "a": [[1, 2.5], [3, 4]], "b": { "c": "d", "e": null } });
        let text = compact(&value, 0);
        assert_eq!(text.lines().count(), 7, "{text}");
        assert_eq!(
            serde_json::from_str::<serde_json::Value>(&text).unwrap(),
            value
        );
    }
}
