//! Record of the steps that run by hand: the day and the commit with which each last passed, a line per step in `ci/passed` of the target folder, and
//! whether the files that it is built from have changed since.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::command::{Result, output, root, target};

/// Notes that the step has passed now. A state that is not committed is no commit that git finds again, so it counts as changed since.
pub(crate) fn note(step: &str) -> Result {
    let day = said(Command::new("date").args(["-u", "+%F"]))?;
    let mut commit = Command::new("git");
    commit.args(["describe", "--always", "--dirty", "--exclude=*"]);
    let commit = said(&mut commit)?;
    let file = file(step);
    fs::create_dir_all(target().join("ci/passed"))
        .and_then(|()| fs::write(&file, format!("{day} {commit}\n")))
        .map_err(|error| format!("`{}` cannot be written: {error}", file.display()))
}

/// The day and the commit with which the step last passed, and whether one of these paths has changed since.
pub(crate) fn last(step: &str, paths: &[&str]) -> String {
    let Ok(line) = fs::read_to_string(file(step)) else {
        return "never passed here".into();
    };
    let line = line.trim();
    let commit = line.rsplit(' ').next().unwrap_or_default();
    let mut difference = Command::new("git");
    difference.args(["diff", "--quiet", commit, "--"]);
    let same = difference.args(paths).current_dir(root()).output();
    match same.is_ok_and(|same| same.status.success()) {
        true => format!("{line}, unchanged since"),
        false => format!("{line}, CHANGED since"),
    }
}

fn said(command: &mut Command) -> Result<String> {
    let text = output(command.current_dir(root()))?;
    Ok(String::from_utf8_lossy(&text).trim().to_owned())
}

fn file(step: &str) -> PathBuf {
    target().join("ci/passed").join(step)
}
