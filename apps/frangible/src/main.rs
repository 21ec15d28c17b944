//! `frangible`: breaks things from the command line.

mod args;
mod breaking;
mod list;
mod progress;
mod report;
mod request;

use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};

fn main() -> ExitCode {
    let cli = Cli::parse();
    let result = match cli.command {
        None => breaking::run(&cli.break_args),
        Some(Command::Break(args)) => breaking::run(&args),
        Some(Command::Scenes) => list::print(),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
