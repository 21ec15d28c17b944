//! The program `frangible-lab`, run as a user runs it.

mod bench;
mod compare;
mod figures;
mod verify;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of its own for each test, gone afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let name = format!("frangible-lab-{}-{test}", std::process::id());
        let path = std::env::temp_dir().join(name);
        // Left over from a killed run that had the same number.
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("a folder for the test");
        Self(path)
    }

    fn path(&self) -> &Path {
        &self.0
    }

    fn text(&self) -> &str {
        self.0.to_str().expect("a plain path")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn lab(words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_frangible-lab"));
    command.args(words).output().expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Runs with bad arguments: the program must fail, print nothing but an error that has all of these parts, and not panic.
fn refused(words: &[&str], parts: &[&str]) {
    let output = lab(words);
    let message = text(&output.stderr);
    assert!(!output.status.success(), "{words:?} was accepted");
    assert_ne!(output.status.code(), Some(101), "{words:?}: {message}");
    assert!(message.starts_with("error: "), "{words:?}: {message}");
    assert!(output.stdout.is_empty(), "{words:?}");
    for part in parts {
        assert!(
            message.contains(part),
            "{words:?}: no `{part}` in: {message}"
        );
    }
}
