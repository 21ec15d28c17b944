//! The program `frangible`, run as a user runs it.

mod cli;
mod common;
mod files;
#[cfg(unix)]
mod hardship;
mod looks;
mod modes;
mod parts;
#[cfg(feature = "view")]
mod view;
