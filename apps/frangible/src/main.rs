//! `frangible`: breaks things from the command line.

mod args;
mod baking;
mod breaking;
mod list;
mod pictures;
mod place;
mod progress;
mod report;
mod request;

use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};

fn main() -> ExitCode {
    let cli = Cli::parse();
    let result = match cli.command {
        None => breaking::run(None, &cli.break_args),
        Some(Command::Break(command)) => breaking::run(command.file.as_deref(), &command.args),
        Some(Command::Bake(args)) => baking::run(&args),
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
