//! The viewer as a page: one static folder.

mod bevy;
mod bodies;
mod library;
mod package;
mod program;
mod trial;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{Result, copy, output, root, target};

use bodies::Bodies;
use program::Program;

pub(crate) use bevy::bevy_page;
pub(crate) use package::package;
pub(crate) use program::for_browsers;
pub(crate) use trial::{bits, trial};

/// Size limit of the first visit, packed, bytes: both programs, the body of the first scene, and the page itself. Bodies of the other scenes are
/// fetched when they are chosen.
const MOST: u64 = 8_000_000;

/// Folders in use. Nothing is written into the checkout but the folder that is asked for.
struct Folders {
    /// The checkout's `apps/web/page`: the part of the page that is not made.
    page: PathBuf,
    /// Builds, sources of the standard library, baked bodies.
    target: PathBuf,
    /// The page.
    out: PathBuf,
}

/// Makes the page in a folder, `target/web/page` if none is named, and returns the line that sums it up.
pub(crate) fn web(out: Option<&Path>) -> Result<Vec<String>> {
    make(&folders(out)).map(|(lines, _)| lines)
}

/// The lines that sum it up, and where the baked bodies lie.
fn make(folders: &Folders) -> Result<(Vec<String>, PathBuf)> {
    make_folder(&folders.out)?;
    let packer = program::packer(folders)?;
    let programs = program::programs(folders, &packer)?;
    let bodies = bodies::bodies(folders, &packer)?;
    copy(&folders.page, &folders.out)?;
    write_list(folders, &programs, &bodies)?;
    let lines = weigh(&folders.out, &packer, &programs, &bodies)?;
    for line in &lines {
        println!("{line}");
    }
    println!("serve {} with any web server", folders.out.display());
    Ok((lines, bodies.kept))
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

/// Writes the list of files that the page's scripts fetch: the programs, and files per scene, with their sizes for the progress bar.
fn write_list(folders: &Folders, programs: &[Program], bodies: &Bodies) -> Result {
    let mut listed = serde_json::Map::new();
    for program in programs {
        let size = size_of(&folders.out.join(&program.packed))?;
        let file = serde_json::json!({ "name": program.packed, "size": size });
        listed.insert(program.part.into(), file);
    }
    let list = serde_json::json!({
        "programs": listed,
        // Objects have no order.
        "first": bodies::FIRST,
        "scenes": bodies.list,
    });
    let path = folders.out.join("scenes.json");
    fs::write(&path, list.to_string())
        .map_err(|error| format!("`{}` cannot be written: {error}", path.display()))
}

fn size_of(path: &Path) -> Result<u64> {
    fs::metadata(path)
        .map(|data| data.len())
        .map_err(|error| format!("`{}` cannot be read: {error}", path.display()))
}

/// Weighs the page as servers send it, with programs and bodies packed. A first visit that fetches more than it may is an error.
fn weigh(out: &Path, packer: &Path, programs: &[Program], bodies: &Bodies) -> Result<Vec<String>> {
    let megabytes = |bytes: u64| bytes as f64 / 1e6;
    let mut parts = Vec::new();
    let mut first = 0;
    for program in programs {
        let size = size_of(&out.join(&program.packed))?;
        let [packed, unpacked] = [size, program.unpacked].map(megabytes);
        parts.push(format!("{} {packed:.2} ({unpacked:.2})", program.part));
        first += size;
    }
    let size_of_bodies = |about: &serde_json::Value| {
        let files = about["bodies"]["files"].as_array().into_iter().flatten();
        files.filter_map(|file| file["size"].as_u64()).sum::<u64>()
    };
    let (mut all, mut each) = (0, Vec::new());
    for (name, about) in &bodies.list {
        let size = size_of_bodies(about);
        each.push(format!("{name} {:.2}", megabytes(size)));
        all += size;
        if name == bodies::FIRST {
            parts.push(format!("{name}'s body {:.2}", megabytes(size)));
            first += size;
        }
    }
    let rest = weight_of_rest(out, packer)?;
    first += rest;
    let line = format!(
        "web: the first visit fetches {:.2} MB: {}, the rest {:.2}",
        megabytes(first),
        parts.join(", "),
        megabytes(rest)
    );
    if first > MOST {
        return Err(format!(
            "{line}; this exceeds the limit of {} MB; find out what grew",
            MOST / 1_000_000
        ));
    }
    let bodies = format!(
        "web: all bodies {:.2} MB, fetched on demand: {}",
        megabytes(all),
        each.join(", ")
    );
    Ok(vec![line, bodies])
}

/// The page and its scripts, packed as servers pack them.
fn weight_of_rest(out: &Path, packer: &Path) -> Result<u64> {
    let entries = fs::read_dir(out);
    let mut sum = 0;
    for entry in entries.map_err(|error| format!("`{}`: {error}", out.display()))? {
        let path = entry
            .map_err(|error| format!("`{}`: {error}", out.display()))?
            .path();
        if path.is_file() && path.extension().is_none_or(|ending| ending != "gz") {
            sum += program::number_of(&output(Command::new(packer).arg("weigh").arg(path))?)?;
        }
    }
    Ok(sum)
}
