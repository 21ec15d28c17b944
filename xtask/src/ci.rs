//! Steps of the continuous integration, in order; `.ci/run` calls this.
//!
//! The gate depends neither on chance nor on the speed of the machine. The other steps run by hand, each before a change of its subject goes in; the
//! gate's last lines name them with the day on which they last passed.

use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

use crate::agree::features_agree;
use crate::bevy;
use crate::blender::blender;
use crate::book;
use crate::c;
use crate::check_output::check_output;
use crate::command::{
    Result, announced, cargo, is_skipped, output, read, root, run_keeping, shown, skipped,
    succeeds, target,
};
use crate::counts::counts;
use crate::fuzz::{USUAL_SECONDS, fuzz};
use crate::leaves;
use crate::packages::package_lists;
use crate::passed;
use crate::platforms::platforms;
use crate::python;
use crate::semver::semver;
use crate::surface;
use crate::test::{self, WITH_WINDOW, tested_program};
use crate::web;

/// The cargo-deny that `deny.toml` is written for.
const DENY_VERSION: &str = "0.20.2";

/// Paths that decide how bodies are made and broken.
const CORE: &[&str] = &[
    "Cargo.toml",
    "Cargo.lock",
    "crates/frangible",
    "crates/frangible-bake",
    "crates/frangible-geometry",
    "crates/frangible-material",
    "crates/frangible-mesh",
];
/// Worlds and scenes of them.
const SCENES: &[&str] = &[
    "crates/frangible-export",
    "crates/frangible-rapier",
    "crates/frangible-recording",
    "crates/frangible-scenes",
    "crates/frangible-sound",
];
const ALL: &[&str] = &["Cargo.toml", "Cargo.lock", "apps", "crates"];

/// Packages that can be built without some of their features, and with which.
const FEATURES: [&[&str]; 6] = [
    &["-p", "frangible-mesh", "--no-default-features"],
    &["-p", "frangible-bake", "--no-default-features"],
    &["-p", "frangible-rapier", "--features", "parallel"],
    &["-p", "frangible-scenes", "--no-default-features"],
    &["-p", "frangible-view", "--no-default-features"],
    &[
        "-p",
        "frangible-view",
        "--no-default-features",
        "--features",
        "window",
    ],
];

/// One step. Returns the lines worth repeating at the end.
type Check = fn() -> Result<Vec<String>>;

struct Step {
    name: &'static str,
    check: Check,
    /// The paths that a step by hand checks; none of the gate's has any.
    of: &'static [&'static [&'static str]],
}

const fn gate(name: &'static str, check: Check) -> Step {
    Step {
        name,
        check,
        of: &[],
    }
}

const fn by_hand(name: &'static str, of: &'static [&'static [&'static str]], check: Check) -> Step {
    Step { name, check, of }
}

const STEPS: &[Step] = &[
    gate("format", format),
    gate("features agree", features_agree),
    gate("clippy", clippy),
    gate("test", tests),
    gate("main job", main_job),
    gate("docs", docs),
    gate("licences", licences),
    gate("leaves", leaves::warm),
    by_hand(
        "all leaves",
        &[ALL, &["bevy_frangible", "fuzz"]],
        leaves::all,
    ),
    by_hand("long tests", &[ALL], || test::long().map(|()| Vec::new())),
    by_hand("first run", &[ALL], first_run),
    by_hand("packages", &[ALL], package_lists),
    by_hand("semver", &[ALL], || semver(None)),
    by_hand("features", &[ALL], features),
    by_hand("oldest rust", &[ALL], oldest_rust),
    by_hand("platforms", &[ALL], platforms),
    by_hand("counts", &[CORE, &["crates/frangible-lab"]], || {
        counts(false)
    }),
    by_hand("fuzz", &[CORE, SCENES, &["fuzz"]], || {
        fuzz(USUAL_SECONDS, &[])
    }),
    by_hand(
        "book",
        &[
            ALL,
            &["README.md", "bevy_frangible/README.md", "book", "docs"],
        ],
        || book::book(book::Wish::All),
    ),
    by_hand(
        "npm",
        &[CORE, &["apps/npm", "xtask/src/web", "xtask/web-pack"]],
        web::package,
    ),
    by_hand("c", &[CORE, &["apps/c", "apps/npm", "xtask/src/c"]], || {
        c::library(&c::Wish::Try)
    }),
    by_hand(
        "python",
        &[CORE, SCENES, &["apps/frangible", "apps/npm", "apps/python"]],
        python::wheel,
    ),
    by_hand(
        "blender",
        &[CORE, SCENES, &["apps/python", "tools/blender"]],
        blender,
    ),
    by_hand("bevy", &[CORE, SCENES, &["bevy_frangible"]], bevy::bevy),
    by_hand(
        "web",
        &[&[
            "Cargo.toml",
            "Cargo.lock",
            "apps/web",
            "crates",
            "xtask/src/web",
            "xtask/web-pack",
        ]],
        web::trial,
    ),
    by_hand(
        "bevy drawn",
        &[CORE, SCENES, &["bevy_frangible"]],
        bevy::drawn,
    ),
];

/// Runs the gate, with `all` also the steps by hand, or only the steps that are named. It stops at the first that fails. Its last lines
/// are the times, the tests' summary, and the days on which the steps by hand last passed.
pub(crate) fn ci(all: bool, named: &[&str]) -> Result {
    if let Some(unknown) = named
        .iter()
        .find(|name| STEPS.iter().all(|step| step.name != **name))
    {
        let names: Vec<&str> = STEPS.iter().map(|step| step.name).collect();
        return Err(format!(
            "there is no step `{unknown}`; the steps are {}",
            names.join(", ")
        ));
    }
    let begun = Instant::now();
    let mut times = Vec::new();
    let mut kept = Vec::new();
    let mut outcome = Ok(());
    for step in STEPS {
        let name = step.name;
        let wanted = match named {
            [] => all || step.of.is_empty(),
            _ => named.contains(&name),
        };
        if !wanted {
            continue;
        }
        println!(
            "\n=== {name}, {:.1} min after the start",
            begun.elapsed().as_secs_f64() / 60.0
        );
        let start = Instant::now();
        let result = run_step(step);
        times.push((name, start.elapsed(), result.is_ok()));
        match result {
            Ok(lines) => kept.extend(lines),
            Err(message) => {
                outcome = Err(format!("step `{name}`: {message}"));
                break;
            }
        }
    }
    println!();
    for (name, time, passed) in &times {
        println!(
            "{name:<14} {:>6.1} min  {}",
            time.as_secs_f64() / 60.0,
            if *passed { "ok" } else { "FAILED" }
        );
    }
    for line in kept {
        println!("{line}");
    }
    if named.is_empty() {
        println!("\nby hand, `cargo xtask ci --all` or `cargo xtask ci STEP`:");
        for step in STEPS.iter().filter(|step| !step.of.is_empty()) {
            println!(
                "{:<14} {}",
                step.name,
                passed::last(step.name, &step.of.concat())
            );
        }
    }
    outcome
}

fn run_step(step: &Step) -> Result<Vec<String>> {
    let lines = (step.check)()?;
    if !step.of.is_empty() && !lines.iter().any(|line| is_skipped(line)) {
        passed::note(step.name)?;
    }
    Ok(lines)
}

/// The workspace and those beside it.
fn format() -> Result<Vec<String>> {
    for manifest in [
        "Cargo.toml",
        "apps/python/Cargo.toml",
        "bevy_frangible/Cargo.toml",
        "fuzz/Cargo.toml",
        "xtask/web-pack/Cargo.toml",
    ] {
        let words = ["fmt", "--manifest-path", manifest, "--all", "--check"];
        announced(&mut cargo(&words))?;
    }
    Ok(Vec::new())
}

/// Checks each package alone, with the features that it can be used with, as its users build it.
fn features() -> Result<Vec<String>> {
    for words in FEATURES {
        // Code that one of them leaves unused is an error.
        let lints = ["--", "-D", "warnings"];
        announced(cargo(&["clippy", "--release"]).args(words).args(lints))?;
    }
    Ok(Vec::new())
}

/// The workspace compiles with the oldest compiler that it says it needs.
fn oldest_rust() -> Result<Vec<String>> {
    let manifest = read(&root().join("Cargo.toml"))?;
    let manifest = String::from_utf8_lossy(&manifest);
    let oldest = manifest
        .lines()
        .find_map(|line| line.strip_prefix("rust-version = \"")?.strip_suffix('"'))
        .ok_or("Cargo.toml has no `rust-version`")?;
    let used = output(&mut cargo(&["--version"]))?;
    let used = String::from_utf8_lossy(&used);
    let used = used.split_whitespace().nth(1).unwrap_or("");
    if used == oldest || used.starts_with(&format!("{oldest}.")) {
        println!("Rust {used} is the oldest supported version, so all steps check it");
        return Ok(Vec::new());
    }
    let toolchain = format!("+{oldest}");
    if !succeeds("cargo", &[&toolchain, "--version"]) {
        let why = format!(
            "this is Rust {used}, and Rust {oldest} is not installed; install it with `rustup toolchain install {oldest}`"
        );
        return skipped("oldest rust", &why);
    }
    let mut command = std::process::Command::new("cargo");
    command.args([&toolchain, "check", "--release", "--workspace"]);
    // Its own folder, lest every run builds all dependencies twice.
    command.current_dir(root());
    command.env("CARGO_TARGET_DIR", target().join("oldest"));
    announced(&mut command).map(|()| Vec::new())
}

/// The workspace, and the program as its first user compiles it, without the window.
fn clippy() -> Result<Vec<String>> {
    for words in [
        &[
            "--workspace",
            "--all-targets",
            WITH_WINDOW[0],
            WITH_WINDOW[1],
        ][..],
        &["--package", "frangible-cli", "--all-targets"],
    ] {
        let lints = ["--", "-D", "warnings"];
        announced(cargo(&["clippy", "--release"]).args(words).args(lints))?;
    }
    Ok(Vec::new())
}

/// The command of the README, word for word.
fn tests() -> Result<Vec<String>> {
    let mut command = cargo(&["xtask", "test"]);
    println!("$ {}", shown(&command));
    let keep = |line: &str| line.contains("test result:") || line.ends_with("... FAILED");
    let lines = run_keeping(&mut command, keep).map_err(|error| {
        let lines = error
            .lines()
            .filter(|line| !line.contains("test result: ok"));
        lines.collect::<Vec<_>>().join("\n")
    })?;
    let passed: u32 = lines.iter().filter_map(|line| passed_tests(line)).sum();
    Ok(vec![format!("{passed} tests passed")])
}

/// The number of tests that passed, by the last line of a test program.
fn passed_tests(line: &str) -> Option<u32> {
    let (before, _) = line.split_once(" passed")?;
    before.rsplit(' ').next()?.parse().ok()
}

fn docs() -> Result<Vec<String>> {
    announced(
        cargo(&["doc", "--release", "--no-deps", "--workspace"]).env("RUSTDOCFLAGS", "-D warnings"),
    )
    .and_then(|()| surface::check())
}

fn licences() -> Result<Vec<String>> {
    if !succeeds("cargo", &["deny", "--version"]) {
        let install = ["install", "cargo-deny", "--locked", "--version"];
        announced(cargo(&install).arg(DENY_VERSION))?;
    }
    announced(&mut cargo(&[
        "deny", "check", "licenses", "bans", "sources",
    ]))
    .map(|()| Vec::new())
}

/// Runs the program that the tests have built, without a command, on a machine without a graphics driver and without a display.
fn main_job() -> Result<Vec<String>> {
    let mut command = Command::new(tested_program()?);
    command.current_dir(root());
    for display in ["DISPLAY", "WAYLAND_DISPLAY"] {
        command.env_remove(display);
    }
    for drivers in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
        command.env(drivers, "/there/is/none.json");
    }
    run_and_look(command)
}

/// The first command of the README, word for word but for where it writes.
fn first_run() -> Result<Vec<String>> {
    run_and_look(cargo(&["run", "--release", "--"]))
}

/// Has the program write into an empty folder, and checks its files.
fn run_and_look(mut command: Command) -> Result<Vec<String>> {
    let folder: PathBuf = target().join("ci/run");
    let failed = |error| format!("`{}` cannot be made anew: {error}", folder.display());
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(failed)?;
    }
    std::fs::create_dir_all(&folder).map_err(failed)?;
    command.arg("--out").arg(&folder).arg("--json");
    println!("$ {}", shown(&command));
    let report = output(&mut command)?;
    std::fs::write(folder.join("report.json"), report).map_err(failed)?;
    check_output(&folder).map(|()| Vec::new())
}
