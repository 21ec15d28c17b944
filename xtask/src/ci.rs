//! What the continuous integration checks, in order; `.ci/run` calls this.

use std::path::Path;
use std::time::{Duration, Instant};

use crate::bevy;
use crate::blender;
use crate::book;
use crate::check_output::check_output;
use crate::command::{
    Result, announced, cargo, output, read, root, run_keeping, run_within, shown, skipped,
    succeeds, target,
};
use crate::counts::counts;
use crate::fuzz::{USUAL_SECONDS, fuzz};
use crate::green;
use crate::packages::package_lists;
use crate::python;
use crate::semver::semver;
use crate::web::{package, trial};

/// Building cargo-deny takes three minutes of one core; a machine that needs longer than this is stuck.
const INSTALL_LIMIT: Duration = Duration::from_secs(20 * 60);
/// Limit of the whole step of fuzzing; its first build with instrumentation takes most of it.
const FUZZ_LIMIT: Duration = Duration::from_secs(8 * 60);
/// Limit of the whole step of the page; its first build for browsers takes most of it, the bodies and the browser the rest.
const WEB_LIMIT: Duration = Duration::from_secs(28 * 60);
/// A step of a leaf begins within this time after the start, or is left to the next run. On a machine where nothing is built yet the first
/// builds of all leaves take an hour by themselves; the next run finds them there.
const LEAVES_BEGIN_WITHIN: Duration = Duration::from_secs(44 * 60);
/// The cargo-deny that `deny.toml` is written for.
const DENY_VERSION: &str = "0.20.2";

/// What the page in a browser is built from, and what tests it.
const PAGE: [&str; 20] = [
    ".cargo/config.toml",
    "Cargo.toml",
    "Cargo.lock",
    "apps/npm/test/serve.mjs",
    "apps/web",
    "crates/frangible",
    "crates/frangible-bake",
    "crates/frangible-compare",
    "crates/frangible-draw",
    "crates/frangible-export",
    "crates/frangible-geometry",
    "crates/frangible-material",
    "crates/frangible-mesh",
    "crates/frangible-rapier",
    "crates/frangible-scenes",
    "crates/frangible-sound",
    "crates/frangible-view",
    "xtask/src/command.rs",
    "xtask/src/web",
    "xtask/web-pack",
];

/// What the npm package is built from, and what tests it.
const NPM: [&str; 14] = [
    ".cargo/config.toml",
    "Cargo.toml",
    "Cargo.lock",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "apps/npm",
    "crates/frangible",
    "crates/frangible-bake",
    "crates/frangible-geometry",
    "crates/frangible-material",
    "crates/frangible-mesh",
    "xtask/src/command.rs",
    "xtask/src/web",
    "xtask/web-pack",
];

/// Packages that can be built without some of their features, and with which.
const FEATURES: [&[&str]; 7] = [
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
    &["-p", "frangible-cli", "--no-default-features"],
];

/// What one step does: it returns the lines worth repeating at the end.
type Check = fn() -> Result<Vec<String>>;

struct Step {
    name: &'static str,
    check: Check,
    when: When,
}

/// When a step runs.
enum When {
    Always,
    /// The step belongs to a leaf with heavy dependencies: it runs where one of these paths has changed since it last passed.
    Changed(&'static [&'static str]),
    /// Its first build takes a quarter of an hour: it runs with `--all` alone.
    Asked,
}

const fn step(name: &'static str, check: Check) -> Step {
    Step {
        name,
        check,
        when: When::Always,
    }
}

const STEPS: &[Step] = &[
    step("format", format),
    step("clippy", || {
        quiet(&[
            "clippy",
            "--release",
            "--workspace",
            "--all-targets",
            "--",
            "-D",
            "warnings",
        ])
    }),
    step("test", tests),
    step("docs", docs),
    step("licences", deny),
    step("packages", package_lists),
    step("semver", || semver(None)),
    step("features", features),
    step("oldest rust", oldest_rust),
    step("main job", main_job),
    step("counts", || counts(false)),
    step("fuzz", || fuzz(USUAL_SECONDS, Some(FUZZ_LIMIT))),
    Step {
        name: "book",
        check: || book::book(book::Wish::All),
        when: When::Changed(&book::PATHS),
    },
    Step {
        name: "npm",
        check: || package(Some(WEB_LIMIT)),
        when: When::Changed(&NPM),
    },
    Step {
        name: "python",
        check: python::wheel,
        when: When::Changed(&python::PATHS),
    },
    Step {
        name: "blender",
        check: blender::blender,
        when: When::Changed(&blender::PATHS),
    },
    Step {
        name: "bevy",
        check: bevy::bevy,
        when: When::Changed(&bevy::PATHS),
    },
    Step {
        name: "web",
        check: || trial(Some(WEB_LIMIT)),
        when: When::Changed(&PAGE),
    },
    Step {
        name: "bevy drawn",
        check: bevy::drawn,
        when: When::Asked,
    },
];

/// Runs all steps, or those named, stops at the first that fails, and ends with the times and the tests' summary. With `all` the steps
/// of leaves run even if nothing changed, and so does a step that is named.
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
        if !named.is_empty() && !named.contains(&name) {
            continue;
        }
        println!(
            "\n=== {name}, {:.1} min after the start",
            begun.elapsed().as_secs_f64() / 60.0
        );
        let start = Instant::now();
        let result = run_step(step, all || !named.is_empty(), begun);
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
            "{name:<11} {:>6.1} min  {}",
            time.as_secs_f64() / 60.0,
            if *passed { "ok" } else { "FAILED" }
        );
    }
    for line in kept {
        println!("{line}");
    }
    outcome
}

fn run_step(step: &Step, all: bool, begun: Instant) -> Result<Vec<String>> {
    let skipped = |why: &str| {
        let why = format!("{why}; `cargo xtask ci --all` runs it");
        skipped(step.name, &why)
    };
    let paths = match step.when {
        When::Always => return (step.check)(),
        When::Asked if all => return (step.check)(),
        When::Asked => return skipped("its first build takes long"),
        When::Changed(paths) => paths,
    };
    // Without git there is no state, and the step runs.
    let state = green::state(paths).ok().flatten();
    if let Some(state) = state.as_ref().filter(|_| !all)
        && green::passed(step.name, state)
    {
        return skipped("nothing it is built from has changed since it passed");
    }
    if !all && begun.elapsed() > LEAVES_BEGIN_WITHIN {
        return skipped("the run has taken its time, and the next one goes on from here");
    }
    let lines = (step.check)()?;
    if let Some(state) = state {
        green::note(step.name, &state);
    }
    Ok(lines)
}

/// The workspace and those beside it that no other step formats.
fn format() -> Result<Vec<String>> {
    for manifest in ["Cargo.toml", "fuzz/Cargo.toml", "xtask/web-pack/Cargo.toml"] {
        quiet(&["fmt", "--manifest-path", manifest, "--all", "--check"])?;
    }
    Ok(Vec::new())
}

/// Each package compiles with the features that it can be had with, alone, as its users have it.
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
        .ok_or("Cargo.toml names no `rust-version`")?;
    let used = output(&mut cargo(&["--version"]))?;
    let used = String::from_utf8_lossy(&used);
    let used = used.split_whitespace().nth(1).unwrap_or("");
    if used == oldest || used.starts_with(&format!("{oldest}.")) {
        println!("this is Rust {used}: all steps are checks of it");
        return Ok(Vec::new());
    }
    let toolchain = format!("+{oldest}");
    if !succeeds("cargo", &[&toolchain, "--version"]) {
        let why = format!(
            "this is Rust {used}, and Rust {oldest} is not installed; `rustup toolchain install {oldest}` gets it"
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

fn quiet(arguments: &[&str]) -> Result<Vec<String>> {
    announced(&mut cargo(arguments)).map(|()| Vec::new())
}

/// The command of the README, word for word.
fn tests() -> Result<Vec<String>> {
    let mut command = cargo(&["xtask", "test"]);
    println!("$ {}", shown(&command));
    run_keeping(&mut command, |line| {
        line.contains("Summary") && line.contains("run:")
            || line.contains("test result:") && !line.contains(" 0 passed")
    })
}

fn docs() -> Result<Vec<String>> {
    announced(
        cargo(&["doc", "--release", "--no-deps", "--workspace"]).env("RUSTDOCFLAGS", "-D warnings"),
    )
    .map(|()| Vec::new())
}

fn deny() -> Result<Vec<String>> {
    if !succeeds("cargo", &["deny", "--version"]) {
        println!("installing cargo-deny {DENY_VERSION}");
        run_within(
            &mut cargo(&[
                "install",
                "cargo-deny",
                "--locked",
                "--version",
                DENY_VERSION,
            ]),
            INSTALL_LIMIT,
        )
        .map_err(|error| format!("{error}; or install cargo-deny {DENY_VERSION} by hand"))?;
    }
    quiet(&["deny", "check", "licenses", "bans", "sources"])
}

/// One run of the program as the README shows it, and a look at what it wrote.
fn main_job() -> Result<Vec<String>> {
    let folder = std::env::temp_dir().join(format!("frangible-ci-{}", std::process::id()));
    std::fs::create_dir_all(&folder)
        .map_err(|error| format!("`{}` cannot be made: {error}", folder.display()))?;
    let result = run_into(&folder);
    // A folder that stays behind in the temporary directory is no reason to fail.
    let _ = std::fs::remove_dir_all(&folder);
    result
}

fn run_into(folder: &Path) -> Result<Vec<String>> {
    // Built first, so that the compiler's messages can be told from the program's.
    let built = run_keeping(
        &mut cargo(&["build", "--release", "--color", "never"]),
        |line| line.trim_start().starts_with("Compiling ") && !line.ends_with(')'),
    )?;
    let mut command = cargo(&["run", "--release", "--quiet", "--", "--out"]);
    command.arg(folder).arg("--json");
    println!("$ {}", shown(&command));
    let report = output(&mut command)?;
    if !report.trim_ascii().is_empty() {
        let path = folder.join("report.json");
        std::fs::write(&path, &report)
            .map_err(|error| format!("`{}` cannot be written: {error}", path.display()))?;
    }
    check_output(folder)?;
    Ok(match built.len() {
        0 => Vec::new(),
        count => vec![format!(
            "note: `cargo run --release` compiled {count} dependencies again after the tests, first `{}`: the features of the two builds differ",
            built[0].trim()
        )],
    })
}
