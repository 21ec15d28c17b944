//! `frangible`: breaks things from the command line.

mod args;
mod baking;
mod breaking;
#[cfg(feature = "draw")]
mod filming;
mod list;
mod mode_files;
mod mode_report;
mod modes;
mod pictures;
mod progress;
mod report;
mod request;
mod say;
mod support;
#[cfg(feature = "draw")]
mod viewing;

use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use frangible_scenes::FileKind;

use args::{Cli, Command};

/// A file given where a command should stand.
fn file_without_command(error: &clap::Error) -> Option<&str> {
    if error.kind() != ErrorKind::InvalidSubcommand {
        return None;
    }
    match error.get(ContextKind::InvalidSubcommand)? {
        ContextValue::String(word) if FileKind::of(Path::new(word)).is_ok() => Some(word),
        _ => None,
    }
}

/// The command of the laboratory that does what a former command of this program did.
fn of_the_lab(words: &[String]) -> Option<String> {
    let [first, rest @ ..] = words else {
        return None;
    };
    let (name, rest) = match (first.as_str(), rest) {
        ("verify", [what, rest @ ..])
            if ["experiments", "pieces", "near-field"].contains(&what.as_str()) =>
        {
            (what.as_str(), rest)
        }
        (name @ ("verify" | "bench" | "figures" | "compare"), rest) => (name, rest),
        _ => return None,
    };
    let words = [name].into_iter().chain(rest.iter().map(String::as_str));
    Some(words.collect::<Vec<_>>().join(" "))
}

/// Begins anew with `XDG_RUNTIME_DIR` set, where it is not: the graphics drivers' library for Wayland complains four times of its
/// absence before anything else is said. A folder that does not exist will do, since there is no Wayland then.
#[cfg(all(feature = "draw", target_os = "linux"))]
fn quiet_the_drivers() {
    use std::os::unix::process::CommandExt;
    use std::process::Command;

    const NAME: &str = "XDG_RUNTIME_DIR";
    let mut words = std::env::args_os();
    if let (None, Ok(program), Some(own)) = (
        std::env::var_os(NAME),
        std::env::current_exe(),
        words.next(),
    ) {
        let mut anew = Command::new(program);
        anew.arg0(own).args(words).env(NAME, "/nonexistent");
        // Only a failure comes back; then the lines are the lesser evil.
        let _ = anew.exec();
    }
}

fn main() -> ExitCode {
    #[cfg(all(feature = "draw", target_os = "linux"))]
    quiet_the_drivers();
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let Some(new) = of_the_lab(&words) {
        eprintln!(
            "error: `frangible {}` is a command of the laboratory: cargo run --release -p frangible-lab -- {new}",
            words[0]
        );
        return ExitCode::from(2);
    }
    let cli = Cli::try_parse().unwrap_or_else(|error| {
        if let Some(file) = file_without_command(&error) {
            eprintln!(
                "error: `{file}` is no command; to break that file: frangible break {file:?}"
            );
            std::process::exit(2);
        }
        error.exit()
    });
    let result = match cli.command {
        None => breaking::run(None, &cli.break_args),
        Some(Command::Break(command)) => breaking::run(command.file.as_deref(), &command.args),
        Some(Command::Bake(args)) => baking::run(&args),
        Some(Command::Modes(args)) => modes::run(&args),
        #[cfg(feature = "draw")]
        Some(Command::Film(args)) => filming::run(&args),
        #[cfg(feature = "draw")]
        Some(Command::View(args)) => viewing::run(&args),
        Some(Command::Scenes { name: None }) => list::print(),
        Some(Command::Scenes { name: Some(name) }) => list::print_scene(&name),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod tests {
    use super::of_the_lab;

    #[test]
    fn former_commands_are_answered_with_the_new_ones() {
        let new = |text: &str| {
            let words: Vec<String> = text.split_whitespace().map(String::from).collect();
            of_the_lab(&words)
        };
        assert_eq!(
            new("verify --write docs").as_deref(),
            Some("verify --write docs")
        );
        assert_eq!(
            new("verify pieces --count 9").as_deref(),
            Some("pieces --count 9")
        );
        assert_eq!(new("bench").as_deref(), Some("bench"));
        assert_eq!(new("break verify"), None);
        assert_eq!(new(""), None);
    }
}
