//! Which state of the files a step of the continuous integration has passed with, so that a step of a leaf runs only when something
//! that the leaf is built from has changed.
//!
//! The state is what git knows: the hashes of the folders and files concerned. Where some of them differ from the last commit there
//! is no such state, and the step runs. It is kept beside the build products where they are outside the checkout, else in the
//! user's cache.

use std::fs;
use std::path::{Path, PathBuf};
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
    file(step).is_some_and(|file| holds(&file, state))
}

/// Notes that the step has passed with this state. A note that cannot be written costs a run, no more.
pub(crate) fn note(step: &str, state: &str) {
    if let Some(file) = file(step)
        && let Err(error) = write(&file, state)
    {
        println!("note: `{}` cannot be written: {error}", file.display());
    }
}

fn holds(file: &Path, state: &str) -> bool {
    fs::read_to_string(file).is_ok_and(|known| known == state)
}

fn write(file: &Path, state: &str) -> std::io::Result<()> {
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(file, state)
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

#[cfg(test)]
mod tests {
    use super::{holds, write};

    #[test]
    fn only_the_state_that_was_noted_counts_as_passed() {
        let name = format!("frangible-green-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let file = folder.join("green").join("web");
        assert!(!holds(&file, "a"));
        write(&file, "a").unwrap();
        assert!(holds(&file, "a") && !holds(&file, "b"));
        write(&file, "b").unwrap();
        assert!(holds(&file, "b") && !holds(&file, "a"));
        std::fs::remove_dir_all(folder).unwrap();
    }
}
