//! `frangible`: breaks things from the command line.

mod args;
mod baking;
mod benching;
mod breaking;
mod compare_page;
mod compare_report;
mod comparing;
#[cfg(feature = "draw")]
mod drawing;
mod experimenting;
mod list;
mod mode_files;
mod mode_report;
mod modes;
mod near_field;
mod pictures;
mod place;
mod progress;
mod report;
mod request;
mod say;
mod support;
mod truth;
mod verifying;
#[cfg(feature = "draw")]
mod viewing;

use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use frangible_scenes::FileKind;

use args::{Cli, Command, Verification};

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

fn main() -> ExitCode {
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
        Some(Command::Compare(args)) => comparing::run(&args),
        Some(Command::Bake(args)) => baking::run(&args),
        Some(Command::Modes(args)) => modes::run(&args),
        Some(Command::Verify(args))
            if args.count.is_some() && args.what != Some(Verification::Pieces) =>
        {
            Err("--count goes with `frangible verify pieces`".into())
        }
        Some(Command::Verify(args)) if args.what == Some(Verification::Experiments) => {
            experimenting::run(&args)
        }
        Some(Command::Verify(args)) if args.what == Some(Verification::Pieces) => truth::run(&args),
        Some(Command::Verify(args)) if args.what == Some(Verification::NearField) => {
            near_field::run(&args)
        }
        Some(Command::Verify(args)) => verifying::run(&args),
        Some(Command::Bench(args)) => benching::run(&args),
        #[cfg(feature = "draw")]
        Some(Command::Figures(args)) => drawing::run(&args),
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
