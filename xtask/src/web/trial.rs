//! The page in a browser: scenes that break as they do without one, and a mesh that is baked there.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::bodies::example;
use super::program::{SESSION, packer, session};
use super::{Folders, folders, make, make_folder};
use crate::command::{Result, announced, output, root, run_keeping, shown, skipped, succeeds};
use crate::setup::browser;

/// Drives the browser; the version that the test is written for.
const DRIVER: &str = "playwright-core@1.65.1";
/// Renderers to draw the page with, one after the other.
const RENDERERS: [&str; 2] = ["webgpu", "webgl2"];

/// Scenes that are played in the browser and without one, and how: so many steps, so many times. In the second pieces break again.
const PLAYED: [(&str, u32, u32); 2] = [("pane", 100, 5), ("shards", 400, 10)];

/// Longest time for the browser before it counts as stuck, s.
const LONGEST: &str = "1500";

/// Makes the session's program and the bodies that are played, and compares the outcomes in Node with the native ones: a part of the page's trial
/// that needs no browser.
pub(crate) fn bits() -> Result {
    let folders = folders(None);
    let out = folders.target.join("bits");
    let baked = out.join("baked");
    make_folder(&baked)?;
    let built = session(&folders)?;
    let packer = packer(&folders)?;
    output(Command::new(packer).arg("package").arg(built).arg(&out))?;
    let scenes = PLAYED.map(|(scene, ..)| scene);
    announced(Command::new(example("bodies")?).arg(&baked).args(scenes))?;
    let native = native(&folders, &baked)?;
    let module = out.join(format!("{SESSION}_bg.wasm"));
    in_node(&out, &module, &baked, &native).map(drop)
}

/// Plays the scenes in Node.
fn in_node(scripts: &Path, program: &Path, baked: &Path, native: &Path) -> Result<Vec<String>> {
    let mut command = Command::new("node");
    command
        .arg(root().join("apps/web/test/session.test.mjs"))
        .arg(scripts.join(format!("{SESSION}.js")))
        .args([program, baked, native]);
    println!("$ {}", shown(&command));
    run_keeping(&mut command, |line| line.starts_with("node:"))
}

/// Makes the page and tries it, and returns the lines that sum it up; one of them says so where there is no browser.
pub(crate) fn trial() -> Result<Vec<String>> {
    let folders = folders(None);
    let (mut lines, baked) = make(&folders)?;
    let native = native(&folders, &baked)?;
    if succeeds("node", &["--version"]) {
        let program = folders.out.join(format!("{SESSION}.wasm.gz"));
        lines.extend(in_node(&folders.out, &program, &baked, &native)?);
    }
    let native = native.display().to_string();
    let last: Vec<&str> = [native.as_str()].into_iter().chain(RENDERERS).collect();
    let script = "apps/web/test/page.test.mjs";
    let keep = |line: &str| RENDERERS.iter().any(|renderer| line.starts_with(renderer));
    lines.extend(in_browser("web", script, &folders, &last, keep)?);
    Ok(lines)
}

/// Has a script of a page's test drive the browser, and returns the lines to keep; one says so where there is no browser.
pub(super) fn in_browser(
    step: &str,
    script: &str,
    folders: &Folders,
    last: &[&str],
    keep: fn(&str) -> bool,
) -> Result<Vec<String>> {
    let Some(browser) = browser() else {
        return skipped(step, "no browser or no Node was found");
    };
    let out = made_folder(folders)?;
    let mut command = Command::new("node");
    command
        .arg(root().join(script))
        .arg(&folders.out)
        .arg(browser_path(browser))
        .arg(driver(folders)?)
        .arg(&out)
        .args(last)
        .env("SECONDS", LONGEST);
    println!("$ {}", shown(&command));
    let lines = run_keeping(&mut command, keep)?;
    println!("pictures lie in {}", out.display());
    Ok(lines)
}

/// Folder of the pictures: `OUT`, or one within the target folder.
pub(super) fn made_folder(folders: &Folders) -> Result<PathBuf> {
    let out = std::env::var_os("OUT");
    let out = out.map_or_else(|| folders.target.join("artifacts"), PathBuf::from);
    make_folder(&out)?;
    Ok(out)
}

/// The browser's path, as its driver wants it.
pub(super) fn browser_path(name: &str) -> PathBuf {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let mut candidates = std::env::split_paths(&path).map(|folder| folder.join(name));
    candidates
        .find(|file| file.is_file())
        .unwrap_or_else(|| name.into())
}

/// The driver's package, fetched if it is not there: only that, no browser of its own.
pub(super) fn driver(folders: &Folders) -> Result<PathBuf> {
    let folder = folders.target.join(DRIVER);
    let there = folder.join("node_modules/playwright-core/package.json");
    if !there.is_file() {
        make_folder(&folder)?;
        let mut command = Command::new("npm");
        command
            .args(["install", "--no-audit", "--no-fund", "--ignore-scripts"])
            .args(["--save-exact", "--prefix"])
            .arg(&folder)
            .arg(DRIVER)
            .env("PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD", "1");
        announced(&mut command)?;
    }
    Ok(folder)
}

/// Plays the scenes on this machine, without a browser. Returns the path of the outcomes, a file for the test.
fn native(folders: &Folders, baked: &Path) -> Result<PathBuf> {
    let plays = example("plays")?;
    let mut all = Vec::new();
    for (scene, steps, times) in PLAYED {
        let counts = [steps, times].map(|count| count.to_string());
        let mut command = Command::new(&plays);
        command.arg(baked).arg(scene).args(counts);
        println!("$ {}", shown(&command));
        let seen = String::from_utf8_lossy(&output(&mut command)?).into_owned();
        // As it is: whoever reads numbers and writes them again may change their last bit.
        all.push(format!(
            "{{ \"scene\": \"{scene}\", \"steps\": {steps}, \"native\": {seen} }}"
        ));
    }
    let out = folders.target.join("native");
    make_folder(&out)?;
    let file = out.join("played.json");
    std::fs::write(&file, format!("[{}]\n", all.join(",\n")))
        .map_err(|error| format!("`{}` cannot be written: {error}", file.display()))?;
    Ok(file)
}
