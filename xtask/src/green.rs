//! Which state of the files a step of the continuous integration has passed with, so that a step of a leaf runs only when something
//! that the leaf is built from has changed.
//!
//! The state is what git knows: the hashes of the folders and files concerned. Where some of them differ from the last commit there
//! is no such state, and the step runs. It is kept beside the build products where they are outside the checkout, else in the
//! user's cache.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::command::{Result, output, root};

/// The state of these paths, and the compiler; None where they have changes that are not committed.
pub(crate) fn state(paths: &[&str]) -> Result<Option<String>> {
    let git = |words: &[&str]| -> Result<String> {
        let mut command = Command::new("git");
        let text = output(command.args(words).args(paths).current_dir(root()))?;
        Ok(String::from_utf8_lossy(&text).into_owned())
    };
    if !git(&["status", "--porcelain", "--"])?.is_empty() {
        return Ok(None);
    }
    let compiler = output(Command::new("rustc").arg("-vV").current_dir(root()))?;
    let compiler = String::from_utf8_lossy(&compiler).into_owned();
    Ok(Some(git(&["ls-tree", "HEAD", "--"])? + &compiler))
}

/// Whether the step has passed with this state.
pub(crate) fn passed(step: &str, state: &str) -> bool {
    file(step).is_some_and(|path| fs::read_to_string(path).is_ok_and(|known| known == state))
}

/// Notes that the step has passed with this state. A note that cannot be written costs a run, no more.
pub(crate) fn note(step: &str, state: &str) {
    if let Some(path) = file(step) {
        let written = path
            .parent()
            .map_or(Ok(()), fs::create_dir_all)
            .and_then(|()| fs::write(&path, state));
        if let Err(error) = written {
            println!("note: `{}` cannot be written: {error}", path.display());
        }
    }
}

fn file(step: &str) -> Option<PathBuf> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(|target| root().join(target));
    let outside = target.filter(|target| !target.starts_with(root()));
    let folder = outside.or_else(|| {
        let cache = std::env::var_os("XDG_CACHE_HOME").map(PathBuf::from);
        let home = std::env::var_os("HOME").map(|home| PathBuf::from(home).join(".cache"));
        Some(cache.or(home)?.join("frangible-ci"))
    });
    Some(folder?.join("green").join(step))
}
