//! Instructions of the stages, counted by valgrind, beside those that are stored.
//!
//! Times on shared machines swing by tens of per cent, instruction counts by less than one. They depend on the compiler and
//! a little on valgrind, so the stored ones name both and are compared with nothing else. Plain callgrind and a small program
//! of ours: gungraun would add a runner that must be installed in the very version of the library.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::command::{Result, cargo, output, root, run, skipped, target};
use crate::setup::valgrind;

/// More than this above the stored count is a failure.
const MOST: f64 = 1.05;
/// The function whose instructions are counted, in `examples/count_instructions.rs`.
const COUNTED: &str = "*counted_work*";
const PROGRAM: &str = "count_instructions";
const STORED: &str = "crates/frangible-lab/counts.txt";

/// Tools that the counts depend on, a line each.
type Tools = [String; 3];

/// A case and its instructions.
type Count = (String, u64);

/// Counts and compares; with `write` stores instead. Returns the lines that sum it up, one of which says so where nothing can
/// be compared.
pub(crate) fn counts(write: bool) -> Result<Vec<String>> {
    let path = root().join(STORED);
    if !valgrind() {
        return skipped(
            "counts",
            "valgrind was not found; install it (Debian, Ubuntu: `apt-get install valgrind`)",
        );
    }
    let tools = tools()?;
    let stored = match (write, fs::read_to_string(&path)) {
        (true, _) => Vec::new(),
        (false, Err(error)) => {
            return Err(format!(
                "`{STORED}` cannot be read: {error}; create it with `cargo xtask counts --write`"
            ));
        }
        (false, Ok(text)) => {
            let (made_with, counts) = parse(&text)?;
            if let Some((there, here)) = made_with.iter().zip(&tools).find(|(a, b)| a != b) {
                return skipped(
                    "counts",
                    &format!(
                        "the stored counts are for {there}, but this is {here}; update them with `cargo xtask counts --write`"
                    ),
                );
            }
            counts
        }
    };
    // All of the workspace, so that the features are those of every other build.
    let arguments = ["build", "--release", "--workspace", "--example", PROGRAM];
    run(&mut cargo(&arguments))?;
    let target = target();
    let program = target.join("release/examples").join(PROGRAM);
    let folder = target.join("counts");
    fs::create_dir_all(&folder)
        .map_err(|error| format!("`{}` cannot be made: {error}", folder.display()))?;
    let body = folder.join("pane.frangible");
    run(Command::new(&program).arg("bake").arg(&body))?;
    let list = output(Command::new(&program).arg("list"))?;
    let list = String::from_utf8_lossy(&list);
    let cases: Vec<&str> = list.lines().collect();
    let mut found = Vec::new();
    let at_once = std::thread::available_parallelism().map_or(1, usize::from);
    for round in cases.chunks(at_once) {
        let results: Vec<Result<Count>> = std::thread::scope(|scope| {
            let runs: Vec<_> = round
                .iter()
                .map(|case| scope.spawn(|| count(&program, &body, case)))
                .collect();
            runs.into_iter()
                .map(|run| {
                    run.join()
                        .unwrap_or_else(|_| Err("a thread panicked".into()))
                })
                .collect()
        });
        for result in results {
            found.push(result?);
        }
    }
    if write {
        fs::write(&path, text(&tools, &found))
            .map_err(|error| format!("`{STORED}` cannot be written: {error}"))?;
    }
    compare(&found, &stored)
}

fn tools() -> Result<Tools> {
    let said = |program: &str, argument: &str| -> Result<String> {
        let said = output(Command::new(program).arg(argument).current_dir(root()))?;
        Ok(String::from_utf8_lossy(&said).trim().to_owned())
    };
    let system = format!("{} {}", std::env::consts::OS, std::env::consts::ARCH);
    Ok([
        said("rustc", "--version")?,
        said("valgrind", "--version")?,
        system,
    ])
}

/// Runs one case under callgrind and reads its count.
fn count(program: &Path, body: &Path, case: &str) -> Result<Count> {
    let out: PathBuf = body.with_file_name(format!("{case}.callgrind"));
    let mut command = Command::new("valgrind");
    command
        .args(["--tool=callgrind", "--quiet", "--collect-atstart=no"])
        .arg(format!("--toggle-collect={COUNTED}"))
        .arg(format!("--callgrind-out-file={}", out.display()))
        .arg(program)
        .arg("run")
        .args([body.as_os_str(), case.as_ref()])
        .stdout(Stdio::null());
    run(&mut command)?;
    let text = fs::read_to_string(&out)
        .map_err(|error| format!("`{}` cannot be read: {error}", out.display()))?;
    match total(&text) {
        Some(count @ 1..) => Ok((case.to_owned(), count)),
        _ => Err(format!(
            "callgrind counted nothing for `{case}`: was `{COUNTED}` inlined or renamed?"
        )),
    }
}

/// The sum that callgrind writes at the end of its file.
fn total(text: &str) -> Option<u64> {
    let line = text
        .lines()
        .rev()
        .find_map(|line| line.strip_prefix("totals: "))?;
    line.split_whitespace().next()?.parse().ok()
}

fn text(tools: &Tools, counts: &[Count]) -> String {
    let mut text = String::from(
        "# Instructions of each stage (crates/frangible-lab/examples/count_instructions.rs); `cargo xtask counts --write` makes this.\n",
    );
    for tool in tools {
        text += &format!("# {tool}\n");
    }
    for (case, count) in counts {
        text += &format!("{case} {count}\n");
    }
    text
}

fn parse(text: &str) -> Result<(Tools, Vec<Count>)> {
    let wrong =
        || format!("`{STORED}` is damaged; create it again with `cargo xtask counts --write`");
    let mut lines = text.lines().skip(1);
    let mut tool = || Some(lines.next()?.strip_prefix("# ")?.to_owned());
    let (Some(rustc), Some(valgrind), Some(system)) = (tool(), tool(), tool()) else {
        return Err(wrong());
    };
    let counts = lines.map(|line| {
        let (case, count) = line.split_once(' ').ok_or_else(wrong)?;
        Ok((case.to_owned(), count.parse().map_err(|_| wrong())?))
    });
    Ok(([rustc, valgrind, system], counts.collect::<Result<_>>()?))
}

/// A line per case; an error names those that grew.
fn compare(found: &[Count], stored: &[Count]) -> Result<Vec<String>> {
    let mut lines = Vec::new();
    let mut grown = Vec::new();
    for (case, count) in found {
        let before = stored.iter().find(|(name, _)| name == case);
        let mut line = format!("counts: {case}: {count} instructions");
        if let Some((_, before)) = before {
            let ratio = *count as f64 / *before as f64;
            line += &format!(" ({:+.1} %)", 100.0 * (ratio - 1.0));
            if ratio > MOST {
                grown.push(line.clone());
            }
        }
        println!("{line}");
        lines.push(line);
    }
    if let Some((gone, _)) = stored
        .iter()
        .find(|(name, _)| !found.iter().any(|(n, _)| n == name))
    {
        lines.push(format!("counts: {gone} is stored but no longer a case"));
    }
    if grown.is_empty() {
        return Ok(lines);
    }
    Err(format!(
        "over 5 % more instructions than stored in {STORED}:\n{}\nif this is intended, run cargo xtask counts --write",
        grown.join("\n")
    ))
}

#[cfg(test)]
mod tests {
    use super::{compare, parse, text, total};

    fn count(case: &str, n: u64) -> super::Count {
        (case.into(), n)
    }

    #[test]
    fn what_is_written_is_read() {
        let tools = [
            "rustc 1".to_owned(),
            "valgrind-3".to_owned(),
            "linux".to_owned(),
        ];
        let counts = vec![count("a", 100), count("b", 7)];
        assert_eq!(parse(&text(&tools, &counts)), Ok((tools, counts)));
        assert!(parse("# counts\n# rustc\n").is_err());
    }

    #[test]
    fn growth_beyond_a_twentieth_fails() {
        let stored = [count("a", 1000), count("gone", 1)];
        assert!(compare(&[count("a", 1050), count("new", 5)], &stored).is_ok());
        assert!(compare(&[count("a", 1051)], &stored).is_err());
    }

    #[test]
    fn the_total_is_found() {
        assert_eq!(
            total("events: Ir\nfn=(1)\n0 5\n\ntotals: 1234\n"),
            Some(1234)
        );
        assert_eq!(total("events: Ir\n"), None);
    }
}
