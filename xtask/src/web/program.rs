//! The page's two programs: built, and packed with the scripts that call them.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::library::{Library, library};
use super::{Folders, folders};
use crate::command::{Result, announced, cargo, output, root};

pub(super) const TARGET: &str = "wasm32-unknown-unknown";
/// The programs: their names in the page's list, their own names, and the profiles that they are built with. The one that computes is fast, the one
/// that only draws is small.
const PROGRAMS: [(&str, &str, &str); 2] = [
    ("window", "frangible-web", "web"),
    ("session", SESSION, "npm"),
];
/// The one that computes.
pub(super) const SESSION: &str = "frangible-web-session";
/// Generator of the bindings; both of its sides must be of one version.
const GENERATOR: &str = "wasm-bindgen";
/// The packer's name for the same.
const GENERATOR_OF_PACKER: &str = "wasm-bindgen-cli-support";

/// A program as it lies in the page's folder.
pub(super) struct Program {
    /// Name in the page's list.
    pub(super) part: &'static str,
    /// Name of the packed file.
    pub(super) packed: String,
    /// Bytes, unpacked.
    pub(super) unpacked: u64,
}

/// Builds the programs, and packs them.
pub(super) fn programs(folders: &Folders, packer: &Path) -> Result<Vec<Program>> {
    same_generator(&root().join("Cargo.lock"))?;
    let pack = |(part, name, profile)| {
        let built = build(folders, name, Kind::Program, profile)?;
        let text = output(
            Command::new(packer)
                .arg("page")
                .arg(built)
                .arg(&folders.out),
        )?;
        Ok(Program {
            part,
            packed: format!("{name}.wasm.gz"),
            unpacked: number_of(&text)?,
        })
    };
    PROGRAMS.into_iter().map(pack).collect()
}

/// Builds the one that computes.
pub(super) fn session(folders: &Folders) -> Result<PathBuf> {
    same_generator(&root().join("Cargo.lock"))?;
    build(folders, SESSION, Kind::Program, "npm")
}

/// A number that the packer wrote.
pub(super) fn number_of(text: &[u8]) -> Result<u64> {
    let text = String::from_utf8_lossy(text);
    text.trim()
        .parse()
        .map_err(|_| format!("the packer printed `{}` instead of a size", text.trim()))
}

/// Kind of a build for browsers.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Program,
    Library,
}

/// Builds a program or library, its standard library too where the toolchain has none for browsers.
pub(super) fn build(folders: &Folders, name: &str, kind: Kind, profile: &str) -> Result<PathBuf> {
    let is_library = kind == Kind::Library;
    let mut command = cargo(&[
        if is_library { "rustc" } else { "build" },
        "--profile",
        profile,
        "-p",
        name,
    ]);
    if is_library {
        command.args(["--lib", "--crate-type", "cdylib"]);
    }
    for_browsers(&mut command)?;
    announced(&mut command)?;
    let built = folders.target.join(TARGET).join(profile);
    // A program's file is named as its package, a library's with underscores.
    let file = match kind {
        Kind::Program => name.into(),
        Kind::Library => name.replace('-', "_"),
    };
    Ok(built.join(format!("{file}.wasm")))
}

/// Has a command of cargo build for browsers, into the folder of the page's builds, with the standard library where the toolchain has none.
pub(crate) fn for_browsers(command: &mut Command) -> Result {
    let folders = folders(None);
    command
        .args(["--target", TARGET])
        .arg("--target-dir")
        .arg(&folders.target)
        .env_remove("CARGO_TARGET_DIR");
    match library(&folders, TARGET)? {
        Library::Installed => {}
        Library::Sources(sources) => {
            command
                .arg("-Zbuild-std=std,panic_abort")
                // Building the standard library is no stable feature of cargo, but has been this way for years.
                .env("RUSTC_BOOTSTRAP", "1");
            if let Some(folder) = sources {
                command.env("__CARGO_TESTS_ONLY_SRC_ROOT", folder);
            }
        }
    }
    Ok(())
}

/// Builds the packer.
pub(super) fn packer(folders: &Folders) -> Result<PathBuf> {
    let target = folders.target.join("pack");
    let mut command = cargo(&["build", "--release", "--locked", "--manifest-path"]);
    command
        .arg(root().join("xtask/web-pack/Cargo.toml"))
        .arg("--target-dir")
        .arg(&target)
        .env_remove("CARGO_TARGET_DIR");
    announced(&mut command)?;
    Ok(target.join("release/web-pack"))
}

/// Refuses a packer of another version than the generator in the programs' lock file.
pub(super) fn same_generator(lock: &Path) -> Result {
    let versions = [
        (lock.to_path_buf(), GENERATOR),
        (
            root().join("xtask/web-pack/Cargo.lock"),
            GENERATOR_OF_PACKER,
        ),
    ]
    .map(|(lock, name)| locked(&lock, name));
    let [program, packer] = versions;
    let (program, packer) = (program?, packer?);
    if program == packer {
        return Ok(());
    }
    Err(format!(
        "the program is built with {GENERATOR} {program}, but the packer with {packer}; set {program} in xtask/web-pack/Cargo.toml"
    ))
}

/// The version of a package in a lock file.
fn locked(lock: &Path, name: &str) -> Result<String> {
    let text = std::fs::read_to_string(lock)
        .map_err(|error| format!("`{}` cannot be read: {error}", lock.display()))?;
    let head = format!("name = \"{name}\"\nversion = \"");
    text.split_once(&head)
        .and_then(|(_, rest)| rest.split_once('"'))
        .map(|(version, _)| version.to_owned())
        .ok_or_else(|| format!("`{}` has no {name}", lock.display()))
}
