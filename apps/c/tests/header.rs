//! The header that is checked in.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use frangible_c::{FRANGIBLE_VERSION, frangible_version};

fn read(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Words that follow this text, as far as they are of a name.
fn names_after<'a>(text: &'a str, before: &str) -> BTreeSet<&'a str> {
    let name = |rest: &'a str| {
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
        &rest[..end.unwrap_or(rest.len())]
    };
    text.split(before).skip(1).map(name).collect()
}

#[test]
fn the_header_declares_every_exported_function_and_no_other() {
    let mut exported = BTreeSet::new();
    for module in [
        "blow",
        "body",
        "breakable",
        "entry",
        "looks",
        "outcome",
        "registry",
        "types",
    ] {
        let code = read(&format!("src/{module}.rs"));
        let of_module = names_after(&code, "extern \"C\" fn ");
        exported.extend(of_module.into_iter().map(str::to_owned));
    }
    let header = read("include/frangible.h");
    let declared: BTreeSet<String> = header
        .lines()
        .filter(|line| !line.starts_with([' ', '#', '/', '}']))
        .filter_map(|line| line.split_once('(')?.0.rsplit([' ', '*']).next())
        .map(str::to_owned)
        .collect();
    assert_eq!(declared, exported, "run `cargo xtask c --write`");
    assert!(exported.iter().all(|name| name.starts_with("frangible_")));
}

#[test]
fn the_version_is_that_of_the_package() {
    let mut numbers = env!("CARGO_PKG_VERSION").split('.');
    let mut next = || numbers.next().and_then(|n| n.parse::<u32>().ok());
    let [Some(major), Some(minor), Some(patch)] = [next(), next(), next()] else {
        panic!("three numbers");
    };
    assert_eq!(FRANGIBLE_VERSION, 1_000_000 * major + 1000 * minor + patch);
    assert_eq!(frangible_version(), FRANGIBLE_VERSION);
}
