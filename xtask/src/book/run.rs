//! Runs the commands of a page, and compares their output with the output on the page.

use std::ffi::OsString;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::fresh;
use super::page::{Block, Page, text};
use super::shown::{commands, compare, last_of, whole};
use crate::command::{Result, root, status_within, target};

/// A command that needs longer is stuck; the first build of an example takes most of it.
const LIMIT: Duration = Duration::from_secs(15 * 60);

/// Runs a page's commands with this program on the path. Returns their number. With `write`, outputs that are shown whole are written into the page.
pub(super) fn page(page: &Page, program: &Path, write: bool) -> Result<usize> {
    let shells = |block: &Block<'_>| block.language == "console" && !block.is("wheel");
    let blocks = page.blocks();
    if !blocks.iter().any(shells) {
        return Ok(0);
    }
    let place = Place::new(page, program.parent())?;
    let start = Instant::now();
    let (mut count, mut edits) = (0, Vec::new());
    for block in &blocks {
        place.save(block)?;
        if !shells(block) {
            continue;
        }
        for one in commands(block) {
            count += 1;
            let printed = place.run(one.command, one.line)?;
            if write && block.is("whole") {
                edits.push((one.line, one.output.len(), printed));
            } else {
                compare(page, block, &one, &printed)?;
            }
        }
    }
    rewrite(page, edits)?;
    println!(
        "{}: {count} commands, {:.0} s",
        page.path,
        start.elapsed().as_secs_f64()
    );
    Ok(count)
}

/// Runs the Python of a page, and the commands that need the wheel, with the programs of this folder. Returns the number of parts.
pub(super) fn wheel(page: &Page, programs: &Path) -> Result<usize> {
    let place = Place::new(page, Some(programs))?;
    let mut count = 0;
    for block in page.blocks() {
        place.save(&block)?;
        if block.language == "python" {
            let text: Vec<&str> = block.lines.iter().map(|(_, line)| line.as_str()).collect();
            place.write("block.py", &text)?;
            place.run("python block.py", block.line)?;
            count += 1;
        } else if block.language == "console" && block.is("wheel") {
            for one in commands(&block) {
                let printed = place.run(one.command, one.line)?;
                compare(page, &block, &one, &printed)?;
                count += 1;
            }
        }
    }
    Ok(count)
}

/// Folder and environment in which the commands of a page run.
struct Place<'a> {
    page: &'a str,
    folder: PathBuf,
    path: OsString,
}

impl<'a> Place<'a> {
    fn new(page: &'a Page, programs: Option<&Path>) -> Result<Self> {
        let usual = std::env::var_os("PATH").unwrap_or_default();
        let folders = programs.map(Path::to_owned).into_iter();
        let path = std::env::join_paths(folders.chain(std::env::split_paths(&usual)));
        let path = path.map_err(|error| format!("the PATH cannot be extended: {error}"))?;
        let name = page.path.trim_end_matches(".md").replace('/', "-");
        Ok(Self {
            page: &page.path,
            folder: fresh(&format!("run/{name}"))?,
            path,
        })
    }

    /// Saves a block that has a file's name.
    fn save(&self, block: &Block<'_>) -> Result {
        let Some(name) = block.file() else {
            return Ok(());
        };
        let lines: Vec<&str> = block.lines.iter().map(|(_, line)| line.as_str()).collect();
        self.write(name, &lines)
    }

    fn write(&self, name: &str, lines: &[&str]) -> Result {
        let path = self.folder.join(name);
        fs::write(&path, lines.join("\n") + "\n")
            .map_err(|error| format!("`{}` cannot be written: {error}", path.display()))
    }

    /// Runs a command of this line. Returns its output on both streams.
    fn run(&self, words: &str, line: usize) -> Result<String> {
        println!("{}:{line}$ {words}", self.page);
        let log = self.folder.with_extension("log");
        let failed = |error| format!("`{}` cannot be written: {error}", log.display());
        let stream = File::create(&log).map_err(failed)?;
        let mut command = Command::new("sh");
        command.arg("-c").arg(words).current_dir(&self.folder);
        command
            .env("PATH", &self.path)
            .env("CARGO_TARGET_DIR", target())
            .env("REPOSITORY", root());
        command.stdin(Stdio::null());
        command
            .stdout(stream.try_clone().map_err(failed)?)
            .stderr(stream);
        let status = status_within(&mut command, LIMIT)?;
        let printed = fs::read(&log).map_err(failed)?;
        let printed = String::from_utf8_lossy(&printed).into_owned();
        match status {
            Some(status) if status.success() => Ok(printed),
            status => {
                let what = match status {
                    Some(_) => "failed",
                    None => "exceeded its time limit and was stopped",
                };
                Err(format!(
                    "{}:{line}: `{words}` {what}; it printed\n{}",
                    self.page,
                    last_of(&printed)
                ))
            }
        }
    }
}

/// Writes whole outputs into the page. Each edit: the line before it, the number of lines that it replaces, and the output.
fn rewrite(page: &Page, edits: Vec<(usize, usize, String)>) -> Result {
    if edits.is_empty() {
        return Ok(());
    }
    let before = text(&page.path)?;
    let mut lines: Vec<&str> = before.lines().collect();
    // From the end, so that the numbers of the earlier lines stay.
    for (line, count, printed) in edits.iter().rev() {
        lines.splice(*line..line + count, whole(printed));
    }
    let path = root().join(&page.path);
    fs::write(&path, lines.join("\n") + "\n")
        .map_err(|error| format!("`{}` cannot be written: {error}", path.display()))
}
