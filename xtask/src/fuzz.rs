//! Hostile bytes for the readers of files, and for blows, worlds and scenes that run: the targets in `fuzz/`, each for a short while.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use crate::command::{
    Result, announced, cargo, host, output, root, skipped, status_within, succeeds, target,
};
use crate::setup::cpp_compiler;

/// Running time of each target unless told otherwise, s.
pub(crate) const USUAL_SECONDS: u64 = 30;
/// The cargo-fuzz whose options and folders are used here.
const VERSION: &str = "0.13.2";
/// Time that a target may take beyond its own before it counts as stuck: for starting, reading the corpus, one slow input.
const SLACK: Duration = Duration::from_secs(60);
/// Longest input, bytes: several times the largest seed. More memory, MiB, is a finding.
const BOUNDS: [&str; 2] = ["-max_len=32768", "-rss_limit_mb=2048"];
/// Longest time for one input, s; a slower one is a finding.
const TIMEOUT: u64 = 10;
/// Targets that break bodies, and longest time for one of their inputs, s: hundreds of pieces take seconds on a busy machine.
const BREAKING: ([&str; 6], u64) = (
    [
        "c_interface",
        "impact",
        "impact_small",
        "run_scene",
        "world",
        "world_small",
    ],
    45,
);

/// Inputs up to so many bytes are printed whole where they are found, and as many letters of each line of a panic.
const SHOWN: usize = 2048;

/// Folders in use. Nothing is written into the checkout.
struct Folders {
    /// The checkout's `fuzz`: targets, seeds, a dictionary.
    fuzz: PathBuf,
    /// Builds, grown corpora, findings and logs.
    target: PathBuf,
    /// Programs of the targets.
    programs: PathBuf,
}

/// Builds the targets of these names, or all if there is none, and runs each for `seconds`. Returns the lines that sum it up; one of them says so if
/// there is no C++ compiler.
///
/// An input that breaks a target is an error that names the file and how to try it again.
pub(crate) fn fuzz(seconds: u64, wanted: &[&str]) -> Result<Vec<String>> {
    if !cfg!(unix) || !cpp_compiler() {
        return skipped("fuzz", "no C++ compiler that libFuzzer supports was found");
    }
    if !succeeds("cargo", &["fuzz", "--version"]) {
        let install = ["install", "cargo-fuzz", "--locked", "--version", VERSION];
        announced(&mut cargo(&install))?;
    }
    let host = host()?;
    let folders = folders(&host);
    let mut names = names(&folders.fuzz)?;
    if let Some(unknown) = wanted.iter().find(|name| !names.iter().any(|n| n == *name)) {
        return Err(format!(
            "there is no fuzz target `{unknown}`; the targets are {}",
            names.join(", ")
        ));
    }
    names.retain(|name| wanted.is_empty() || wanted.contains(&name.as_str()));
    build(&folders, &host, wanted)?;
    let at_once = std::thread::available_parallelism().map_or(1, usize::from);
    let mut lines = Vec::new();
    for round in names.chunks(at_once) {
        let results: Vec<Result<String>> = std::thread::scope(|scope| {
            let folders = &folders;
            let runs: Vec<_> = round
                .iter()
                .map(|name| scope.spawn(move || run_target(folders, name, seconds)))
                .collect();
            runs.into_iter()
                .map(|run| {
                    run.join()
                        .unwrap_or_else(|_| Err("a thread panicked".into()))
                })
                .collect()
        });
        for result in results {
            let line = result?;
            println!("{line}");
            lines.push(line);
        }
    }
    Ok(lines)
}

fn folders(host: &str) -> Folders {
    let target = target().join("fuzz");
    Folders {
        fuzz: root().join("fuzz"),
        programs: target.join(host).join("release"),
        target,
    }
}

/// Names of the targets, sorted.
fn names(fuzz: &Path) -> Result<Vec<String>> {
    let list = output(cargo(&["fuzz", "list", "--fuzz-dir"]).arg(fuzz))?;
    let mut names: Vec<String> = String::from_utf8_lossy(&list)
        .lines()
        .map(|line| line.trim().to_string())
        .filter(|line| !line.is_empty())
        .collect();
    names.sort();
    Ok(names)
}

/// Builds one target after the other if some are wanted: cargo-fuzz takes one name, or builds all.
fn build(folders: &Folders, host: &str, wanted: &[&str]) -> Result {
    if wanted.is_empty() {
        return announced(&mut build_command(folders, host));
    }
    for name in wanted {
        announced(build_command(folders, host).arg(name))?;
    }
    Ok(())
}

fn build_command(folders: &Folders, host: &str) -> Command {
    // Without a sanitizer: the stable compiler has none, and there is no unsafe code in the readers. Overflow checks
    // and debug assertions are on. One code generation unit, cargo-fuzz's default, would leave cores idle.
    let mut command = cargo(&["fuzz", "build", "--sanitizer", "none"]);
    command
        .args(["--codegen-units", "16", "--target", host, "--fuzz-dir"])
        .arg(&folders.fuzz)
        .arg("--target-dir")
        .arg(&folders.target)
        .env_remove("CARGO_TARGET_DIR");
    command
}

fn run_target(folders: &Folders, name: &str, seconds: u64) -> Result<String> {
    let made = |kind: &str| {
        let folder = folders.target.join(kind).join(name);
        fs::create_dir_all(&folder)
            .map_err(|error| format!("`{}` cannot be made: {error}", folder.display()))?;
        Ok::<_, String>(folder)
    };
    let (grown, findings) = (made("corpus")?, made("artifacts")?);
    let log = folders.target.join(format!("{name}.log"));
    let file = File::create(&log)
        .map_err(|error| format!("`{}` cannot be written: {error}", log.display()))?;
    let (breaking, longer) = BREAKING;
    let timeout = if breaking.contains(&name) {
        longer
    } else {
        TIMEOUT
    };
    let program = folders.programs.join(name);
    let mut command = Command::new(&program);
    // New inputs go into the first corpus; the others are only read.
    command
        .arg(grown)
        .arg(folders.fuzz.join("corpus").join(name));
    if name.ends_with("_scene") {
        let dictionary = folders.fuzz.join("scene.dict");
        command.arg(format!("-dict={}", dictionary.display()));
    }
    command
        .args(BOUNDS)
        .arg(format!("-timeout={timeout}"))
        .arg(format!("-max_total_time={seconds}"))
        .arg("-print_final_stats=1")
        .arg(format!("-artifact_prefix={}/", findings.display()))
        .stderr(file);
    let status = status_within(&mut command, Duration::from_secs(seconds) + SLACK)?;
    let said =
        fs::read(&log).map_err(|error| format!("`{}` cannot be read: {error}", log.display()))?;
    let said = String::from_utf8_lossy(&said);
    let after = |mark: &str| {
        said.lines()
            .find_map(|line| line.split_once(mark))
            .map(|(_, rest)| rest.trim())
    };
    match status {
        Some(status) if status.success() => {
            let inputs = after("number_of_executed_units:").unwrap_or("an unknown number of");
            Ok(format!(
                "fuzz: {name}: {inputs} inputs in {seconds} s, nothing found"
            ))
        }
        None => Err(format!(
            "fuzz target `{name}` did not stop; see its log {}",
            log.display()
        )),
        Some(_) => Err(finding(
            name,
            &program,
            &log,
            after("Test unit written to "),
            &said,
        )),
    }
}

/// Describes a finding, and how to reproduce it.
///
/// The input itself comes last: often the end of this text is all that is left of a machine on which a target failed.
fn finding(name: &str, program: &Path, log: &Path, input: Option<&str>, said: &str) -> String {
    let mut lines = vec![format!(
        "fuzz target `{name}` failed; see its log {}",
        log.display()
    )];
    let panic = said
        .lines()
        .skip_while(|line| !line.contains("panicked at"))
        .take_while(|line| !line.starts_with("stack backtrace"))
        .take(3);
    lines.extend(panic.map(|line| line.chars().take(SHOWN).collect()));
    if let Some(input) = input {
        lines.push(format!("reproduce: {} {input}", program.display()));
        lines.push(format!(
            "keep:      cp {input} fuzz/corpus/{name}/, where the tests replay it"
        ));
        if let Ok(bytes) = fs::read(input)
            && bytes.len() <= SHOWN
        {
            let hexadecimal: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
            lines.push(format!(
                "elsewhere: echo {hexadecimal} | xxd -r -p > {name}-input"
            ));
        }
    }
    lines.join("\n")
}
