//! The project's chores. `cargo xtask help` lists them.

mod agree;
mod bevy;
mod blender;
mod book;
mod check_output;
mod ci;
mod command;
mod counts;
mod dist;
mod fuzz;
mod glb;
mod leaves;
mod outcomes;
mod packages;
mod passed;
mod python;
mod semver;
mod setup;
mod test;
mod web;

use std::process::ExitCode;

use command::Result;
use outcomes::{Wish, outcomes};

const HELP: &str = "\
cargo xtask test [--fast]     setup, then all tests of the workspace in the release profile; --fast leaves out those over three seconds
cargo xtask test NAME…        those tests alone whose module and name contain one of these, in the same build
cargo xtask ci                the gate: what must hold before a change goes in, with the minutes per step
cargo xtask ci --all          the gate, then the steps that it only names with the day on which they last passed
cargo xtask ci STEP...        these steps alone: cargo xtask ci clippy 'oldest rust'
cargo xtask outcomes [--write FILE | --against FILE]
                              break all built-in scenes; print, store or compare pieces, areas, energies and bits
cargo xtask counts [--write]  count the instructions of each stage; fail where they grew by over 5 %, or store them
cargo xtask rebake            write the baked bodies and states in fuzz/corpus and those that the core's tests break anew
cargo xtask fuzz [SECONDS]    feed hostile bytes to each reader of files, and to blows, worlds and scenes, for so long, 30 s if not told
cargo xtask web [--out DIR]   make the viewer's page for browsers, one static folder: target/web/page if not told
cargo xtask web-test          make it, and break scenes and a mesh in it with Chromium, drawn by the processor
cargo xtask web-bits          play scenes in the part of it that computes, in Node, and compare every bit with a run without it
cargo xtask npm               make the npm package, install it in an empty project, and try it in Node and in Chromium
cargo xtask python            make the wheel for Python, and try it in an environment of its own
cargo xtask blender           try the extension with that wheel in Blender's Python, which is fetched, without a window
cargo xtask semver [REV]      compare what the published crates offer with the last version, or with another commit
cargo xtask bevy              lint and test the plugin for Bevy, in its own workspace
cargo xtask bevy-drawn        lint its examples with a window, and compare their pictures
cargo xtask bevy-web          make one of them as a page for browsers, target/web/bevy-page, and open it in Chromium, drawn by the processor
cargo xtask book [--write | --html | PAGE.md]
                              run what the book shows, check its links, and make it HTML where mdBook is installed; --write also
                              writes outputs that it shows whole, such as the reference of the command line; --html runs nothing;
                              with a page, such as book/src/start/rapier.md, run that alone
cargo xtask dist              pack the program as an archive, and try what comes out of it
cargo xtask setup             install the system packages that are missing, where that is allowed
cargo xtask check-output DIR  check what `cargo run --release -- --out DIR --json > DIR/report.json` wrote";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the tests that read checked-in files so that they write them.
fn rebake() -> Result {
    for (package, tests) in [
        ("frangible", &["fuzz_seeds::", "hostile_state::"][..]),
        ("frangible-bake", &["core_bodies::"][..]),
    ] {
        let mut cargo =
            command::cargo(&["test", "--release", "-p", package, "--test", "tests", "--"]);
        cargo.args(tests);
        command::run(cargo.env("FRANGIBLE_WRITE_SEEDS", "1"))?;
    }
    Ok(())
}

fn run(words: &[&str]) -> Result {
    match words {
        ["setup"] => {
            setup::setup();
            setup::cpp_compiler();
            setup::valgrind();
            setup::browser();
            setup::python();
            Ok(())
        }
        ["test"] => {
            setup::setup();
            test::test()
        }
        ["test", "--fast"] => test::fast(),
        ["test", names @ ..] => test::named(names),
        ["ci", "--all"] => ci::ci(true, &[]),
        ["ci", steps @ ..] => ci::ci(false, steps),
        ["rebake"] => rebake(),
        ["fuzz"] => fuzz::fuzz(fuzz::USUAL_SECONDS).map(drop),
        ["fuzz", seconds] => match seconds.parse() {
            Ok(seconds @ 1..) => fuzz::fuzz(seconds).map(drop),
            _ => Err(format!(
                "`{seconds}` is no whole number of seconds from 1; for example `cargo xtask fuzz 60`"
            )),
        },
        ["python"] => python::wheel().map(drop),
        ["blender"] => blender::blender().map(drop),
        ["semver"] => semver::semver(None).map(drop),
        ["semver", revision] => semver::semver(Some(revision)).map(drop),
        ["bevy"] => bevy::bevy().map(drop),
        ["bevy-drawn"] => bevy::drawn().map(drop),
        ["bevy-web"] => web::bevy_page().map(drop),
        ["book"] => book::book(book::Wish::All).map(drop),
        ["book", "--write"] => book::book(book::Wish::Write).map(drop),
        ["book", page] if page.ends_with(".md") => book::book(book::Wish::Page(page)).map(drop),
        ["book", "--html"] => book::book(book::Wish::Html).map(drop),
        ["dist"] => dist::dist().map(drop),
        ["counts"] => counts::counts(false).map(drop),
        ["counts", "--write"] => counts::counts(true).map(drop),
        ["outcomes"] => outcomes(&Wish::Print),
        ["outcomes", "--write", file] => outcomes(&Wish::Write(file.as_ref())),
        ["outcomes", "--against", file] => outcomes(&Wish::Against(file.as_ref())),
        ["web"] => web::web(None).map(drop),
        ["web", "--out", folder] => web::web(Some(folder.as_ref())).map(drop),
        ["npm"] => web::package().map(drop),
        ["web-test"] => web::trial().map(drop),
        ["web-bits"] => web::bits(),
        ["check-output", directory] => check_output::check_output(directory.as_ref()),
        [] | ["help" | "--help" | "-h"] => {
            println!("{HELP}");
            Ok(())
        }
        _ => Err(format!(
            "`{}` is not a chore; the chores are:\n{HELP}",
            words.join(" ")
        )),
    }
}
