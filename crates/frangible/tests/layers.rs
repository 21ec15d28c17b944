//! The modules of the crate stand one above the other: each imports only from those below it.

use std::fs;
use std::path::{Path, PathBuf};

/// From the lowest to the highest. `mesh` and `material` are crates of their own, below all of them.
const ORDER: [&str; 27] = [
    "error",
    "rng",
    "vectors",
    "state",
    "modal",
    "asset",
    "config",
    "fields",
    "stress",
    "near_field",
    "motion",
    "tips",
    "bounds",
    "body",
    "contact",
    "crack",
    "blow",
    "fragment",
    "dice",
    "outcome",
    "piece",
    "refuse",
    "trace",
    "cracking",
    "impact",
    "loads",
    "rigid",
];

/// Those that import nothing, or all: what the crate shows to others.
const SHOWN: [&str; 2] = ["lib", "internals"];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else {
            found.push(path);
        }
    }
}

/// Names after `crate::` in a line of code.
fn imported(line: &str) -> impl Iterator<Item = &str> {
    let parts = line.split("crate::").skip(1);
    parts.map(|part| {
        let end = part.find(|c: char| !(c.is_alphanumeric() || c == '_'));
        &part[..end.unwrap_or(part.len())]
    })
}

#[test]
fn modules_import_only_from_below() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    assert!(files.len() > ORDER.len());
    let (mut upward, mut imports) = (Vec::new(), 0);
    for file in files {
        let inside = file.strip_prefix(&root).unwrap();
        let module = inside.iter().next().unwrap().to_str().unwrap();
        let module = module.trim_end_matches(".rs");
        if SHOWN.contains(&module) || inside.to_str().unwrap().ends_with("tests.rs") {
            continue;
        }
        let own = ORDER.iter().position(|name| *name == module);
        let own = own.unwrap_or_else(|| panic!("`{module}` has no place in the order"));
        let text = fs::read_to_string(&file).unwrap();
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
        for line in code.lines().filter(|line| !line.trim().starts_with("//")) {
            for name in imported(line) {
                if let Some(other) = ORDER.iter().position(|module| *module == name) {
                    imports += 1;
                    if other > own {
                        upward.push(format!("{}: {}", inside.display(), line.trim()));
                    }
                }
            }
        }
    }
    assert!(imports > 100, "only {imports} imports were found");
    assert!(upward.is_empty(), "{}", upward.join("\n"));
}
