//! Runs the program and checks its messages.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of its own for each test, gone afterwards.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new(test: &str) -> Self {
        let path =
            std::env::temp_dir().join(format!("frangible-cli-{}-{test}", std::process::id()));
        // Left over from a killed run that had the same number.
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("a folder for the test");
        Self(path)
    }

    pub(crate) fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).expect("the test's folder");
        entries
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

pub(crate) fn frangible(args: &[&str], out: Option<&Path>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_frangible"));
    command.args(args);
    if let Some(out) = out {
        command.arg("--out").arg(out);
    }
    command.output().expect("the program starts")
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Runs with bad arguments: it must fail, print nothing but an error with all
/// of these parts, and leave no file, not even a temporary one.
pub(crate) fn refused(test: &str, args: &[&str], parts: &[&str]) -> String {
    let folder = Folder::new(test);
    let output = frangible(args, Some(&folder.0));
    let message = text(&output.stderr);
    assert!(!output.status.success(), "{args:?} was accepted");
    assert!(
        output.status.code().is_some_and(|code| code != 101),
        "{args:?} panicked: {message}"
    );
    assert!(message.starts_with("error: "), "{args:?}: {message}");
    assert!(
        output.stdout.is_empty(),
        "{args:?} printed {}",
        text(&output.stdout)
    );
    for part in parts {
        assert!(
            message.contains(part),
            "{args:?}: no `{part}` in: {message}"
        );
    }
    assert_eq!(folder.files(), [""; 0], "{args:?} left files");
    message
}

/// Checks the same as [`refused`], and that the message is a single line.
pub(crate) fn refused_in_a_sentence(test: &str, args: &[&str], parts: &[&str]) {
    let message = refused(test, args, parts);
    assert_eq!(message.trim_end().lines().count(), 1, "{args:?}: {message}");
}
