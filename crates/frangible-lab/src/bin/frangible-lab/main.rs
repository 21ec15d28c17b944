//! `frangible-lab`: runs the evidence and writes the pages of `docs`.

mod args;
mod bench;
mod compare;
mod experiments;
mod figures;
mod gallery;
mod near_field;
mod output;
mod pieces;
mod sound;
mod verify;

use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};

fn main() -> ExitCode {
    frangible_draw::quiet_the_drivers();
    let result = match Cli::parse().command {
        Command::Verify(args) => verify::run(&args),
        Command::Experiments(args) => experiments::run(&args),
        Command::Pieces(args) => pieces::run(&args),
        Command::NearField(args) => near_field::run(&args),
        Command::Sound(args) => sound::run(&args),
        Command::Figures(args) => figures::run(&args),
        Command::Gallery(args) => gallery::run(&args),
        Command::Bench(args) => bench::run(&args),
        Command::Compare(args) => compare::run(&args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
