//! The npm package: the core for JavaScript, in a folder that can be published, and its trial in an empty project.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::program::{Kind, build, number_of, packer, same_generator};
use super::trial::{browser_path, driver, made_folder};
use super::{Folders, folders, make_folder};
use crate::command::{Result, announced, copy, output, root, run_keeping, shown, skipped};
use crate::setup::browser;

/// The modules, their purposes, and the size limit of each, packed, bytes.
const MODULES: [(&str, &str, u64); 2] = [
    ("frangible-js", "breaks", 1_000_000),
    // Finding parts and meshing walls take 90 kB of it. The dice of tempered walls, with their triangulation, take 45 kB of both modules.
    ("frangible-js-bake", "bakes", 1_150_000),
];
/// Packages that the examples in the browser need, and those that they are compared with, in the versions that they are written for.
const BESIDE: [&str; 7] = [
    "three@0.187.0",
    "react@19.3.1",
    "react-dom@19.3.1",
    "@react-three/fiber@9.8.2",
    "esbuild@0.28.2",
    "@dimforge/rapier3d-compat@0.21.0",
    "@dgreenheck/three-pinata@2.0.1",
];

/// Makes the package in `target/web/npm/frangible`, tries it in Node and in a browser, and returns the lines that sum it up.
pub(crate) fn package() -> Result<Vec<String>> {
    let folders = folders(None);
    let (out, mut lines) = make(&folders)?;
    let project = install(&folders, &out)?;
    let bits = native(&folders)?;
    lines.extend(test(
        Command::new("node")
            .arg("test/node.test.mjs")
            .arg(&bits)
            .current_dir(&project),
    )?);
    let Some(browser) = browser() else {
        lines.extend(skipped(
            "npm",
            "no browser was found for testing the examples",
        )?);
        return Ok(lines);
    };
    let pictures = made_folder(&folders)?;
    lines.extend(test(
        Command::new("node")
            .arg("test/browser.test.mjs")
            .arg(browser_path(browser))
            .arg(driver(&folders)?)
            .arg(&pictures)
            .current_dir(&project),
    )?);
    println!("pictures lie in {}", pictures.display());
    Ok(lines)
}

fn make(folders: &Folders) -> Result<(PathBuf, Vec<String>)> {
    same_generator(&root().join("Cargo.lock"))?;
    let packer = packer(folders)?;
    let from = root().join("apps/npm");
    let out = folders.target.join("npm/frangible");
    make_folder(&out)?;
    copy(&from.join("package"), &out)?;
    for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
        copy(&root().join(licence), &out.join(licence))?;
    }
    let mut lines = Vec::new();
    for (name, does, most) in MODULES {
        let built = build(folders, name, Kind::Library, "npm")?;
        let text = output(Command::new(&packer).arg("package").arg(built).arg(&out))?;
        let unpacked = number_of(&text)?;
        let module = out.join(format!("{}_bg.wasm", name.replace('-', "_")));
        let packed = number_of(&output(Command::new(&packer).arg("weigh").arg(&module))?)?;
        let line = format!(
            "npm: the module that {does} has {:.0} kB packed ({:.0} unpacked)",
            packed as f64 / 1e3,
            unpacked as f64 / 1e3
        );
        println!("{line}");
        if packed > most {
            return Err(format!(
                "{line}; this exceeds the limit of {most} bytes; find out what grew"
            ));
        }
        lines.push(line);
    }
    Ok((out, lines))
}

/// Packs the folder as npm does, and installs that in an empty project, with the packages that the examples need.
fn install(folders: &Folders, package: &Path) -> Result<PathBuf> {
    let project = folders.target.join("npm/project");
    make_folder(&project)?;
    let from = root().join("apps/npm");
    for name in ["test", "pages"] {
        copy(&from.join(name), &project.join(name))?;
    }
    make_folder(&project.join("bodies"))?;
    for body in ["pane", "block", "tile"] {
        let file = format!("{body}.frangible");
        let baked = root().join("crates/frangible/tests/bodies").join(&file);
        copy(&baked, &project.join("bodies").join(&file))?;
    }
    let file = project.join("package.json");
    fs::write(&file, "{ \"private\": true, \"type\": \"module\" }\n")
        .map_err(|error| format!("`{}` cannot be written: {error}", file.display()))?;
    // It says how the file is called.
    let packed = output(
        Command::new("npm")
            .args(["pack", "--silent", "--pack-destination"])
            .arg(&project)
            .current_dir(package),
    )?;
    let mut install = Command::new("npm");
    install
        .args(["install", "--no-audit", "--no-fund", "--ignore-scripts"])
        .arg(format!("./{}", String::from_utf8_lossy(&packed).trim()))
        .args(BESIDE)
        .current_dir(&project);
    announced(&mut install)?;
    bundle(&project)?;
    Ok(project)
}

/// Bundles the example in React, whose packages browsers cannot import as they are: React itself is no module of JavaScript.
fn bundle(project: &Path) -> Result {
    let mut command = Command::new("npx");
    command
        .args(["--no-install", "esbuild", "pages/fiber.jsx", "--bundle"])
        .args(["--format=esm", "--jsx=automatic", "--minify"])
        .arg("--define:process.env.NODE_ENV=\"production\"")
        .args(["three", "frangible", "frangible/three"].map(|name| format!("--external:{name}")))
        .arg("--outfile=pages/fiber.js")
        .current_dir(project);
    announced(&mut command)
}

/// Computes the effect of the same blows on the same bodies outside the browser, as hashes of all numbers. Returns the file's path.
fn native(folders: &Folders) -> Result<PathBuf> {
    let target = folders.target.join("hash");
    let mut command = crate::command::cargo(&[
        "run",
        "--release",
        "-p",
        "frangible-js",
        "--example",
        "hash",
    ]);
    command
        .arg("--target-dir")
        .arg(&target)
        .env_remove("CARGO_TARGET_DIR")
        .env("OUT", target.join("hash.json"));
    announced(&mut command)?;
    Ok(target.join("hash.json"))
}

fn test(command: &mut Command) -> Result<Vec<String>> {
    println!("$ {}", shown(command));
    run_keeping(command, |line| line.starts_with("npm:"))
}
