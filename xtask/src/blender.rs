//! The extension for Blender, tried in Blender's own Python without a window.

use std::path::PathBuf;
use std::process::Command;

use crate::command::{
    Result, announced, output, root, run_keeping, shown, skipped, succeeds, target,
};
use crate::python::{self, only_file, program_in};

/// Blender as a Python module, of the version whose Python most machines have, and the tests' runner.
const TOOLS: [&str; 2] = ["bpy==4.5.*", "pytest>=9,<10"];

/// Tries the wheel in `target/python/wheels` in Blender, after making it where there is none. Returns the lines that sum it up; one of them
/// says so where Blender cannot be had here.
pub(crate) fn blender() -> Result<Vec<String>> {
    let Some(interpreter) = interpreter() else {
        return skipped(
            "blender",
            "Blender 4.5 as a module needs Python 3.11 with `venv`",
        );
    };
    let folder = target().join("blender");
    let python = program_in(&folder.join("environment"), "python");
    if !python.exists() {
        let mut venv = Command::new(interpreter);
        venv.args(["-m", "venv"]).arg(folder.join("environment"));
        output(&mut venv)?;
    }
    let pip = |words: &[&str]| {
        let mut pip = Command::new(&python);
        pip.args(["-m", "pip", "install", "--quiet"]);
        pip.arg("--disable-pip-version-check").args(words);
        pip
    };
    if announced(&mut pip(&TOOLS)).is_err() {
        return skipped("blender", "the `bpy` module cannot be installed here");
    }
    if !succeeds(&python.to_string_lossy(), &["-c", "import bpy"]) {
        return skipped(
            "blender",
            "the `bpy` module cannot be loaded here; `import bpy` reports the missing library",
        );
    }
    let wheels = target().join("python").join("wheels");
    if !wheels.exists() {
        python::wheel()?;
    }
    let wheel = only_file(&wheels)?;
    let mut install = pip(&["--force-reinstall", "--no-deps"]);
    output(install.arg(&wheel))?;
    let mut tests = Command::new(&python);
    tests.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider"]);
    tests
        .arg(root().join("tools/blender/tests"))
        .env("FRANGIBLE_WHEEL", &wheel)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .current_dir(&folder);
    println!("$ {}", shown(&tests));
    let mut lines = run_keeping(&mut tests, |line| line.contains(" passed"))?;
    for line in &mut lines {
        line.insert_str(0, "blender: ");
    }
    Ok(lines)
}

fn interpreter() -> Option<PathBuf> {
    const QUESTION: &str = "import sys, venv, ensurepip; sys.exit(sys.version_info[:2] != (3, 11))";
    let mut names = ["python3.11", "python3"].into_iter();
    let found = names.find(|name| succeeds(name, &["-c", QUESTION]));
    found.map(PathBuf::from)
}
