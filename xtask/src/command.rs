//! Running other programs.

use std::ffi::OsString;
use std::io::{BufRead, BufReader, IsTerminal};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A chore's outcome: the error is one message that says how to mend it.
pub(crate) type Result<T = ()> = std::result::Result<T, String>;

/// The cargo that runs this xtask, so that a toolchain override holds for its children, at the workspace's root.
pub(crate) fn cargo(arguments: &[&str]) -> Command {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
    let mut command = Command::new(cargo);
    command.args(arguments).current_dir(root());
    command
}

/// The workspace's root.
pub(crate) fn root() -> PathBuf {
    // As cargo says when it runs this program: a program that another checkout has left in a shared build folder was built elsewhere.
    let now = std::env::var_os("CARGO_MANIFEST_DIR");
    let xtask = now.map_or_else(|| env!("CARGO_MANIFEST_DIR").into(), PathBuf::from);
    xtask.parent().map_or(xtask.clone(), PathBuf::from)
}

/// Target folder of cargo.
pub(crate) fn target() -> PathBuf {
    root().join(std::env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| "target".into()))
}

/// Path of the command line's program once the workspace is built.
pub(crate) fn program() -> PathBuf {
    target()
        .join("release")
        .join(format!("frangible{}", std::env::consts::EXE_SUFFIX))
}

/// The machine as rustc names it.
pub(crate) fn host() -> Result<String> {
    let about = output(Command::new("rustc").arg("-vV").current_dir(root()))?;
    String::from_utf8_lossy(&about)
        .lines()
        .find_map(|line| line.strip_prefix("host: ").map(String::from))
        .ok_or_else(|| "`rustc -vV` does not name its host; update Rust".into())
}

/// The command as one would type it.
pub(crate) fn shown(command: &Command) -> String {
    let program = PathBuf::from(command.get_program());
    let name = program
        .file_name()
        .unwrap_or(command.get_program())
        .to_string_lossy()
        .into_owned();
    let words = command
        .get_args()
        .map(|word| word.to_string_lossy().into_owned());
    std::iter::once(name)
        .chain(words)
        .collect::<Vec<_>>()
        .join(" ")
}

/// Runs with the terminal's streams.
pub(crate) fn run(command: &mut Command) -> Result {
    let status = command
        .status()
        .map_err(|error| start_failed(command, &error))?;
    if status.success() {
        Ok(())
    } else {
        Err(failed(command))
    }
}

/// Runs silently; true if it started and succeeded.
pub(crate) fn succeeds(program: &str, arguments: &[&str]) -> bool {
    Command::new(program)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

/// Runs a command. Returns its standard output.
pub(crate) fn output(command: &mut Command) -> Result<Vec<u8>> {
    let result = command
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| start_failed(command, &error))?;
    if result.status.success() {
        Ok(result.stdout)
    } else {
        Err(failed(command))
    }
}

/// Runs, shows both streams as they come, and returns the lines `keep` wants (of each stream, in order).
pub(crate) fn run_keeping(command: &mut Command, keep: fn(&str) -> bool) -> Result<Vec<String>> {
    if std::io::stderr().is_terminal() {
        command.env("CARGO_TERM_COLOR", "always");
    }
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| start_failed(command, &error))?;
    let errors = child
        .stderr
        .take()
        .map(|stream| std::thread::spawn(move || echo(stream, keep, |line| eprintln!("{line}"))));
    let mut kept = child.stdout.take().map_or_else(Vec::new, |stream| {
        echo(stream, keep, |line| println!("{line}"))
    });
    if let Some(Ok(lines)) = errors.map(std::thread::JoinHandle::join) {
        kept.splice(0..0, lines);
    }
    let status = child
        .wait()
        .map_err(|error| start_failed(command, &error))?;
    if status.success() {
        Ok(kept)
    } else {
        Err([&[failed(command)], kept.as_slice()].concat().join("\n"))
    }
}

fn echo(stream: impl std::io::Read, keep: fn(&str) -> bool, show: fn(&str)) -> Vec<String> {
    let mut kept = Vec::new();
    for line in BufReader::new(stream)
        .split(b'\n')
        .map_while(std::result::Result::ok)
    {
        let line = String::from_utf8_lossy(&line).into_owned();
        show(&line);
        if keep(&line) {
            kept.push(line);
        }
    }
    kept
}

/// Runs for at most `limit`, then ends it and all that it started: None.
pub(crate) fn status_within(command: &mut Command, limit: Duration) -> Result<Option<ExitStatus>> {
    // Its own group, as ending cargo alone would leave the compilers running.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    let mut child = command
        .spawn()
        .map_err(|error| start_failed(command, &error))?;
    let start = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(Some(status)),
            Ok(None) if start.elapsed() < limit => sleep(Duration::from_millis(200)),
            Ok(None) => {
                end(&mut child);
                return Ok(None);
            }
            Err(error) => {
                end(&mut child);
                return Err(start_failed(command, &error));
            }
        }
    }
}

fn end(child: &mut Child) {
    if cfg!(unix) {
        let group = format!("kill -s KILL -- -{}", child.id());
        succeeds("sh", &["-c", &group]);
    }
    // Failing to end a child that has just ended by itself is no failure.
    let _ = child.kill();
    let _ = child.wait();
}

fn failed(command: &Command) -> String {
    format!("`{}` failed; see its output above", shown(command))
}

fn start_failed(command: &Command, error: &std::io::Error) -> String {
    format!(
        "`{}` could not be run: {error}; is it installed and on the PATH?",
        shown(command)
    )
}

/// Runs a command and shows it first.
pub(crate) fn announced(command: &mut Command) -> Result {
    println!("$ {}", shown(command));
    run(command)
}

/// Says why a step, or a part of it, did not run, and returns the line for the end.
pub(crate) fn skipped(step: &str, why: &str) -> Result<Vec<String>> {
    let line = format!("{step}: skipped: {why}");
    println!("{line}");
    Ok(vec![line])
}

/// Returns true if a line says that something did not run.
pub(crate) fn is_skipped(line: &str) -> bool {
    line.contains(": skipped: ")
}

/// Copies a file, or a folder and all that is in it.
pub(crate) fn copy(from: &Path, to: &Path) -> Result {
    let failed = |error| {
        format!(
            "`{}` cannot be copied to `{}`: {error}",
            from.display(),
            to.display()
        )
    };
    if from.is_dir() {
        for entry in std::fs::read_dir(from).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            copy(&entry.path(), &to.join(entry.file_name()))?;
        }
        return Ok(());
    }
    std::fs::create_dir_all(to.parent().unwrap_or(to))
        .and_then(|()| std::fs::copy(from, to).map(drop))
        .map_err(failed)
}

/// The bytes of a file.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).map_err(|error| format!("`{}` cannot be read: {error}", path.display()))
}
