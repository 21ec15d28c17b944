//! `frangible`: breaks things from the command line. A library, so that the Python wheel offers the same commands.

mod args;
mod baking;
mod breaking;
mod filming;
mod level;
mod list;
#[cfg(feature = "view")]
mod microseconds;
mod mode_files;
mod mode_report;
mod modes;
mod pictures;
mod progress;
mod report;
mod request;
mod say;
mod soundtrack;
mod support;
mod viewing;

use std::ffi::OsString;
use std::path::Path;

use clap::Parser;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use frangible_scenes::FileKind;

use args::{Cli, Command};
pub use support::parse_support;

/// The file name that was given in place of a command.
fn file_without_command(error: &clap::Error) -> Option<&str> {
    if error.kind() != ErrorKind::InvalidSubcommand {
        return None;
    }
    match error.get(ContextKind::InvalidSubcommand)? {
        ContextValue::String(word) if FileKind::of(Path::new(word)).is_ok() => Some(word),
        _ => None,
    }
}

/// Returns the command of `frangible-lab` that replaces a former command of this program.
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

/// Runs a command line, whose first word is the program's name. Returns the exit status: 0 on success, 1 after a failure, 2 if the command
/// line is invalid.
#[must_use]
pub fn run(words: &[OsString]) -> u8 {
    let texts: Vec<String> = (words.iter().skip(1))
        .map(|word| word.to_string_lossy().into_owned())
        .collect();
    if let Some(new) = of_the_lab(&texts) {
        eprintln!(
            "error: `frangible {}` has moved to frangible-lab; run: cargo run --release -p frangible-lab -- {new}",
            texts[0]
        );
        return 2;
    }
    let cli = match Cli::try_parse_from(words) {
        Ok(cli) => cli,
        Err(error) => {
            if let Some(file) = file_without_command(&error) {
                eprintln!(
                    "error: `{file}` is not a command; to break that file, run: frangible break {file:?}"
                );
                return 2;
            }
            // To a closed pipe nothing can be said.
            let _ = error.print();
            return u8::try_from(error.exit_code()).unwrap_or(2);
        }
    };
    let result = match cli.command {
        None => breaking::run(None, &cli.break_args),
        Some(Command::Break(command)) => breaking::run(command.file.as_deref(), &command.args),
        Some(Command::Bake(args)) => baking::run(&args),
        Some(Command::Modes(args)) => modes::run(&args),
        Some(Command::Film(args)) => filming::run(&args),
        Some(Command::View(args)) => viewing::run(&args),
        Some(Command::Scenes { name: None }) => list::print(),
        Some(Command::Scenes { name: Some(name) }) => list::print_scene(&name),
    };
    match result {
        Ok(()) => 0,
        Err(error) => {
            eprintln!("error: {error}");
            1
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
