//! The extension for Blender, tried in Blender's own Python without a window.

use std::path::PathBuf;
use std::process::Command;
use std::time::{Duration, Instant};

use crate::command::{
    Result, output, root, run_keeping, shown, skipped, status_within, succeeds, target,
};
use crate::python::{self, only_file, program_in};

/// What the extension is made of, and the wheel in it.
pub(crate) const PATHS: [&str; 14] = [
    "apps/python",
    "crates/frangible",
    "crates/frangible-bake",
    "crates/frangible-export",
    "crates/frangible-geometry",
    "crates/frangible-material",
    "crates/frangible-mesh",
    "crates/frangible-rapier",
    "crates/frangible-scenes",
    "tools/LICENSE",
    "tools/blender",
    "xtask/src/blender.rs",
    "xtask/src/command.rs",
    "xtask/src/python.rs",
];

/// Limit of fetching Blender, which has 350 MB.
const LIMIT: Duration = Duration::from_secs(8 * 60);

/// Blender as a Python module, of the version whose Python most machines have, and what runs the tests.
const TOOLS: [&str; 2] = ["bpy==4.5.*", "pytest>=9,<10"];

/// Tries the wheel in `target/python/wheels` in Blender, after making it where there is none. Returns the lines that sum it up; one of them
/// says so where Blender cannot be had here.
pub(crate) fn blender() -> Result<Vec<String>> {
    let start = Instant::now();
    let left = || LIMIT.saturating_sub(start.elapsed());
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
    let mut fetch = pip(&TOOLS);
    println!("$ {}", shown(&fetch));
    match status_within(&mut fetch, left())? {
        Some(status) if status.success() => {}
        _ => return skipped("blender", "its module cannot be installed here"),
    }
    if !succeeds(&python.to_string_lossy(), &["-c", "import bpy"]) {
        return skipped(
            "blender",
            "its module does not start here; `import bpy` says which library it misses",
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
