//! An example of the plugin for Bevy as a page: built, and opened in a browser.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use super::program::{TARGET, for_browsers, number_of, packer, same_generator};
use super::trial::in_browser;
use super::{Folders, folders, make_folder};
use crate::command::{Result, announced, cargo, copy, output, program, root};

/// The example that the page shows.
const EXAMPLE: &str = "glass";

/// Makes the page in `target/web/bevy-page`, opens it in a browser, and returns the lines that sum it up.
pub(crate) fn bevy_page() -> Result<Vec<String>> {
    let mut folders = folders(None);
    folders.page = root().join("bevy_frangible/drawn/page");
    folders.out = folders.target.join("bevy-page");
    let mut lines = make(&folders)?;
    let script = "bevy_frangible/drawn/tests/page.test.mjs";
    let keep = |line: &str| line.starts_with("bevy page:");
    lines.extend(in_browser("bevy page", script, &folders, &[], keep)?);
    Ok(lines)
}

/// Builds the program and puts it into the page's folder, with the body that it fetches.
fn make(folders: &Folders) -> Result<Vec<String>> {
    make_folder(&folders.out)?;
    same_generator(&root().join("bevy_frangible/Cargo.lock"))?;
    let packer = packer(folders)?;
    let began = Instant::now();
    let built = build(folders)?;
    let seconds = began.elapsed().as_secs();
    let unpacked = number_of(&output(
        Command::new(&packer)
            .arg("package")
            .arg(&built)
            .arg(&folders.out),
    )?)?;
    copy(&folders.page, &folders.out)?;
    bake(&folders.out.join("assets"))?;
    let line = format!(
        "bevy page: the program has {:.1} MB; it was built in {seconds} s",
        unpacked as f64 / 1e6
    );
    println!("{line}");
    println!("serve {} with any web server", folders.out.display());
    Ok(vec![line])
}

/// Bakes the body that the example fetches, with the command line's program.
fn bake(folder: &Path) -> Result {
    make_folder(folder)?;
    let file = folder.join("glass.frangible");
    if file.is_file() {
        return Ok(());
    }
    announced(&mut cargo(&["build", "--release", "-p", "frangible-cli"]))?;
    let mut command = Command::new(program());
    command.args([
        "bake",
        "--scene",
        "glass",
        "--resolution",
        "20000",
        "--compact",
        "-o",
    ]);
    announced(command.arg(&file))
}

fn build(folders: &Folders) -> Result<PathBuf> {
    let mut command = cargo(&["build", "--profile", "web"]);
    command
        .args(["--package", "drawn", "--bin", EXAMPLE])
        .current_dir(root().join("bevy_frangible"));
    for_browsers(&mut command)?;
    announced(&mut command)?;
    let built = folders.target.join(TARGET).join("web");
    Ok(built.join(format!("{EXAMPLE}.wasm")))
}
