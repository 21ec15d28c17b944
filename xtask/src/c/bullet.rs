//! The examples in C++ with the physics engine Bullet, and the section of docs/engines.md that one of them writes.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::{PANE, SANITIZERS, compiler, packages};
use crate::command::{Result, announced, cargo, output, read, root, shown, skipped, succeeds};
use crate::setup::cpp_compiler;

const FLAGS: [&str; 6] = [
    "-std=c++11",
    "-pedantic",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Werror",
];
/// Where the section of the page begins. It goes on to the page's end.
const SECTION: &str = "## Bullet\n";

/// Runs the example, as it is and with sanitizers.
pub(super) fn example(folder: &Path, prefix: &Path) -> Result<Vec<String>> {
    if let Some(why) = missing() {
        return skipped("c: Bullet", why);
    }
    let glass = glass(folder)?;
    // The one that writes the page compiles too.
    compiled("engines", "engines", &[], folder, prefix)?;
    for (name, flags) in [
        ("bullet", &[][..]),
        ("bullet-sanitized", &["-g", SANITIZERS]),
    ] {
        let program = compiled("bullet", name, flags, folder, prefix)?;
        announced(Command::new(program).arg(root().join(PANE)).arg(&glass))?;
    }
    Ok(vec![
        "c: bodies broke in Bullet, also with sanitizers".into(),
    ])
}

/// Bakes a glass as a game would, and returns its file.
fn glass(folder: &Path) -> Result<PathBuf> {
    let file = folder.join("glass.frangible");
    let mut bake = cargo(&["run", "--release", "--quiet", "--", "bake"]);
    bake.args(["--scene=glass", "--modes=40", "--resolution=2000"]);
    announced(bake.arg("-o").arg(&file))?;
    Ok(file)
}

/// Writes the section of docs/engines.md.
pub(super) fn section(folder: &Path, prefix: &Path) -> Result<Vec<String>> {
    if let Some(why) = missing() {
        return Err(why.into());
    }
    let mut program = Command::new(compiled("engines", "engines", &[], folder, prefix)?);
    program.arg(root().join(PANE));
    println!("$ {}", shown(&program));
    let made = output(&mut program)?;
    let made = String::from_utf8_lossy(&made);
    let path = root().join("docs/engines.md");
    let page = read(&path)?;
    let page = String::from_utf8_lossy(&page);
    let before = page
        .split_once(SECTION)
        .map_or(&*page, |(before, _)| before);
    let whole = format!("{}\n\n{SECTION}\n{made}", before.trim_end());
    std::fs::write(&path, whole)
        .map_err(|error| format!("`{}` cannot be written: {error}", path.display()))?;
    Ok(vec!["c: docs/engines.md is written".into()])
}

fn missing() -> Option<&'static str> {
    if !cpp_compiler() {
        return Some("there is no C++ compiler");
    }
    let there = succeeds("pkg-config", &["--exists", "bullet"]);
    (!there).then_some("Bullet is not installed (Debian, Ubuntu: `libbullet-dev`)")
}

/// Compiles an example, and returns the program.
fn compiled(
    source: &str,
    name: &str,
    flags: &[&str],
    folder: &Path,
    prefix: &Path,
) -> Result<PathBuf> {
    let program = folder.join(name);
    let mut compile = compiler("CXX", "c++");
    compile.args(FLAGS).args(flags);
    compile.arg(root().join(format!("apps/c/examples/{source}.cpp")));
    for word in packages(prefix, &["--cflags", "--libs", "frangible", "bullet"])? {
        // The warnings of Bullet's headers are not ours.
        match word.strip_prefix("-I") {
            Some(headers) => compile.arg("-isystem").arg(headers),
            None => compile.arg(word),
        };
    }
    compile.arg(format!("-Wl,-rpath,{}", prefix.join("lib").display()));
    announced(compile.arg("-o").arg(&program))?;
    Ok(program)
}
