//! The viewer as a page: one static folder.

mod bodies;
mod library;
mod package;
mod program;
mod trial;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use crate::command::{Result, output, root, target};

pub(crate) use package::package;
pub(crate) use trial::trial;

/// All that the page may weigh, packed, bytes.
const MOST: u64 = 8_000_000;

/// Where things are. Nothing is written into the checkout but the folder that is asked for.
struct Folders {
    /// The checkout's `apps/web/page`: what is not made.
    page: PathBuf,
    /// Builds, sources of the standard library, baked bodies.
    target: PathBuf,
    /// The page.
    out: PathBuf,
}

/// Stops what takes longer than a limit.
#[derive(Clone, Copy)]
struct Clock {
    start: Instant,
    limit: Option<Duration>,
}

impl Clock {
    fn left(self) -> Duration {
        self.limit.map_or(Duration::MAX, |limit| {
            limit.saturating_sub(self.start.elapsed())
        })
    }
}

/// Makes the page in a folder, `target/web/page` if none is named, and returns the line that sums it up.
pub(crate) fn web(out: Option<&Path>, limit: Option<Duration>) -> Result<Vec<String>> {
    let clock = Clock {
        start: Instant::now(),
        limit,
    };
    make(&folders(out), clock).map(|(lines, _)| lines)
}

/// The lines that sum it up, and the scenes.
fn make(folders: &Folders, clock: Clock) -> Result<(Vec<String>, Vec<bodies::Packed>)> {
    make_folder(&folders.out)?;
    let program = program::program(folders, clock)?;
    let bodies = bodies::bodies(folders, &program.packer, clock)?;
    copy_folder(&folders.page, &folders.out)?;
    write_list(folders, &program, &bodies)?;
    let line = weigh(&folders.out, &program)?;
    println!("{line}");
    println!("serve {} with any web server", folders.out.display());
    Ok((vec![line], bodies))
}

fn folders(out: Option<&Path>) -> Folders {
    let target = target().join("web");
    Folders {
        page: root().join("apps/web/page"),
        out: out.map_or_else(|| target.join("page"), Path::to_path_buf),
        target,
    }
}

fn make_folder(folder: &Path) -> Result {
    fs::create_dir_all(folder)
        .map_err(|error| format!("`{}` cannot be made: {error}", folder.display()))
}

/// Copies the files of a folder into another, but for its folders.
fn copy_folder(from: &Path, to: &Path) -> Result {
    let name = from.display();
    let entries = fs::read_dir(from);
    for entry in entries.map_err(|error| format!("`{name}` cannot be listed: {error}"))? {
        let from = entry
            .map_err(|error| format!("`{name}` cannot be listed: {error}"))?
            .path();
        if from.is_dir() {
            continue;
        }
        let to = to.join(from.file_name().unwrap_or_default());
        fs::copy(&from, &to)
            .map_err(|error| format!("`{}` cannot be written: {error}", to.display()))?;
    }
    Ok(())
}

/// What the page's script fetches: the program, and files per scene, with their sizes for the bar.
fn write_list(folders: &Folders, program: &program::Program, bodies: &[bodies::Packed]) -> Result {
    let size = |name: &str| size_of(&folders.out.join(name));
    let mut scenes = serde_json::Map::new();
    for body in bodies {
        let files = serde_json::json!([{ "name": body.file, "size": size(&body.file)? }]);
        let scene = serde_json::json!({ "text": body.text, "bodies": files });
        scenes.insert(body.scene.into(), scene);
    }
    let list = serde_json::json!({
        "program": program.packed,
        "programBytes": size(&program.packed)?,
        // Objects have no order.
        "first": bodies.first().map(|body| body.scene),
        "scenes": scenes,
    });
    let path = folders.out.join("scenes.json");
    fs::write(&path, format!("{list:#}\n"))
        .map_err(|error| format!("`{}` cannot be written: {error}", path.display()))
}

fn size_of(path: &Path) -> Result<u64> {
    fs::metadata(path)
        .map(|data| data.len())
        .map_err(|error| format!("`{}` cannot be read: {error}", path.display()))
}

/// What the folder weighs as servers send it; an error above the limit. Program and bodies lie in it packed.
fn weigh(out: &Path, program: &program::Program) -> Result<String> {
    let packed = size_of(&out.join(&program.packed))?;
    let bodies = weight(&out.join("bodies"), &program.packer)?;
    let all = weight(out, &program.packer)?;
    let megabytes = |bytes: u64| bytes as f64 / 1e6;
    let line = format!(
        "web: {:.2} MB: program {:.2} (unpacked {:.2}), bodies {:.2}, the rest {:.2}",
        megabytes(all),
        megabytes(packed),
        megabytes(program.unpacked),
        megabytes(bodies),
        megabytes(all - packed - bodies)
    );
    match all <= MOST {
        true => Ok(line),
        false => Err(format!(
            "{line}; that is more than {} MB: offer fewer scenes (xtask/src/web/bodies.rs), or find what made the program grow",
            MOST / 1_000_000
        )),
    }
}

fn weight(folder: &Path, packer: &Path) -> Result<u64> {
    let entries = fs::read_dir(folder);
    let mut sum = 0;
    for entry in entries.map_err(|error| format!("`{}`: {error}", folder.display()))? {
        let path = entry
            .map_err(|error| format!("`{}`: {error}", folder.display()))?
            .path();
        sum += if path.is_dir() {
            weight(&path, packer)?
        } else if path.extension().is_some_and(|ending| ending == "gz") {
            size_of(&path)?
        } else {
            program::number_of(&output(Command::new(packer).arg("weigh").arg(path))?)?
        };
    }
    Ok(sum)
}
