//! The program as an archive: for those who want to run it and not to build it.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::command::{Result, cargo, copy, host, output, root, run, target};

/// Files in the archive beside the program.
const BESIDE: [&str; 4] = ["README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE"];

/// Builds the program, packs it with its licences, unpacks the archive elsewhere and breaks something with the unpacked program. Returns lines that
/// describe the archive.
pub(crate) fn dist() -> Result<Vec<String>> {
    run(&mut cargo(&["build", "--release", "--features", "view"]))?;
    let target = target();
    let name = format!("frangible-{}-{}", version()?, host()?);
    let out = target.join("dist");
    let folder = out.join(&name);
    if out.exists() {
        fs::remove_dir_all(&out).map_err(|error| problem(&out, &error))?;
    }
    fs::create_dir_all(&folder).map_err(|error| problem(&folder, &error))?;
    let program = format!("frangible{}", std::env::consts::EXE_SUFFIX);
    copy(
        &target.join("release").join(&program),
        &folder.join(&program),
    )?;
    for file in BESIDE {
        copy(&root().join(file), &folder.join(file))?;
    }
    let archive = out.join(format!("{name}.tar.gz"));
    run(Command::new("tar")
        .arg("-C")
        .arg(&out)
        .arg("-czf")
        .arg(&archive)
        .arg(&name))?;
    fs::remove_dir_all(&folder).map_err(|error| problem(&folder, &error))?;

    let trial = out.join("trial");
    fs::create_dir_all(&trial).map_err(|error| problem(&trial, &error))?;
    run(Command::new("tar")
        .arg("-C")
        .arg(&trial)
        .arg("-xzf")
        .arg(&archive))?;
    let unpacked = trial.join(&name).join(&program);
    run(Command::new(unpacked)
        .args([
            "break",
            "--scene",
            "cantilever",
            "--no-pictures",
            "--resolution",
            "3000",
        ])
        .current_dir(&trial))?;
    if !trial.join("out/cantilever.glb").is_file() {
        return Err("the packed program wrote no out/cantilever.glb".into());
    }
    fs::remove_dir_all(&trial).map_err(|error| problem(&trial, &error))?;
    let size = fs::metadata(&archive).map_err(|error| problem(&archive, &error))?;
    let line = format!(
        "dist: {} ({:.1} MB) runs after unpacking",
        archive.display(),
        size.len() as f64 / 1e6
    );
    println!("{line}");
    Ok(vec![line])
}

/// The version of the workspace.
fn version() -> Result<String> {
    let id = output(&mut cargo(&["pkgid", "-p", "frangible-cli"]))?;
    let id = String::from_utf8_lossy(&id);
    let version = id.trim().rsplit(['#', '@']).next();
    version
        .map(str::to_owned)
        .ok_or_else(|| format!("the package id `{id}` of the program has no version"))
}

fn problem(path: &Path, error: &std::io::Error) -> String {
    format!("`{}`: {error}", path.display())
}
