//! The wheel for Python: the bindings, linted and built in their own workspace, installed in an empty environment, and tried there.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::book;
use crate::command::{Result, announced, cargo, root, run_keeping, shown, target};
use crate::setup::python;

/// Tools that build the wheel and try it, in the versions that they are written for.
const TOOLS: [&str; 11] = [
    "h5py>=3.10,<4",
    "ipykernel>=6,<8",
    "maturin>=1.16,<1.17",
    "matplotlib>=3.9,<4",
    "nbclient>=0.10,<1",
    "numpy>=2,<3",
    "pytest>=9,<10",
    "scipy>=1.11,<2",
    "trimesh>=5,<6",
    "mypy>=2,<3",
    "ray>=2.40,<3",
];

/// Makes the wheel in `target/python/wheels`, tries it, and returns the lines that sum it up.
pub(crate) fn wheel() -> Result<Vec<String>> {
    let Some(interpreter) = python() else {
        return Err(
            "Python 3.10 or later with `venv` was not found; install python3 and python3-venv"
                .into(),
        );
    };
    let from = root().join("apps/python");
    let target = target();
    let folder = target.join("python");
    let (environment, wheels) = (folder.join("environment"), folder.join("wheels"));
    for command in [
        &["fmt", "--check"][..],
        &[
            "clippy",
            "--release",
            "--all-targets",
            "--",
            "-D",
            "warnings",
        ],
    ] {
        let mut lint = cargo(command);
        lint.current_dir(&from).env("CARGO_TARGET_DIR", &target);
        announced(&mut lint)?;
    }
    let program = |name: &str| program_in(&environment, name);
    if !program("python").exists() {
        announced(
            Command::new(interpreter)
                .args(["-m", "venv"])
                .arg(&environment),
        )?;
    }
    let pip = |words: &[&str]| {
        let mut pip = Command::new(program("python"));
        pip.args([
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
        ]);
        pip.args(words);
        pip
    };
    announced(&mut pip(&TOOLS))?;
    // Wheels of earlier versions are not this one.
    if wheels.exists() {
        std::fs::remove_dir_all(&wheels)
            .map_err(|error| format!("`{}` cannot be emptied: {error}", wheels.display()))?;
    }
    let mut build = Command::new(program("maturin"));
    build
        .args(["build", "--release", "--quiet", "--out"])
        .arg(&wheels);
    build.arg("--interpreter").arg(program("python"));
    build.current_dir(&from).env("CARGO_TARGET_DIR", &target);
    announced(&mut build)?;
    let wheel = only_file(&wheels)?;
    announced(&mut pip(&[
        "--force-reinstall",
        "--no-deps",
        &wheel.to_string_lossy(),
    ]))?;
    announced(
        Command::new(program("mypy"))
            .args(["--strict", "--no-error-summary", "python/frangible"])
            .current_dir(&from),
    )?;
    // Outside of the checkout, so that the installed package is tried.
    let mut tests = Command::new(program("python"));
    tests.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider"]);
    tests.arg(from.join("tests")).current_dir(&folder);
    println!("$ {}", shown(&tests));
    let mut lines = run_keeping(&mut tests, |line| line.contains(" passed"))?;
    lines.extend(book::wheel(&programs_in(&environment))?);
    let size = std::fs::metadata(&wheel).map_or(0, |data| data.len());
    let name = wheel.file_name().unwrap_or_default().to_string_lossy();
    lines.insert(0, format!("python: {name} has {:.1} MB", size as f64 / 1e6));
    println!("{}", lines[0]);
    Ok(lines)
}

/// The folder of an environment that has its programs.
fn programs_in(environment: &Path) -> PathBuf {
    environment.join(if cfg!(windows) { "Scripts" } else { "bin" })
}

/// A program of an environment.
pub(crate) fn program_in(environment: &Path, name: &str) -> PathBuf {
    programs_in(environment).join(format!("{name}{}", std::env::consts::EXE_SUFFIX))
}

/// The one file of a folder.
pub(crate) fn only_file(folder: &Path) -> Result<PathBuf> {
    let unreadable = |error| format!("`{}` cannot be read: {error}", folder.display());
    let entries = std::fs::read_dir(folder).map_err(unreadable)?;
    let files: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    match &files[..] {
        [file] => Ok(file.clone()),
        _ => Err(format!(
            "`{}` contains {} wheels instead of one",
            folder.display(),
            files.len()
        )),
    }
}
