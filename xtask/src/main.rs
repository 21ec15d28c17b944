//! Development tasks of the project. `cargo xtask help` lists them.

mod agree;
mod bevy;
mod blender;
mod book;
mod c;
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
mod platforms;
mod python;
mod semver;
mod setup;
mod surface;
mod test;
mod web;

use std::process::ExitCode;

use command::Result;
use outcomes::{Wish, outcomes};

const HELP: &str = "\
cargo xtask test [--fast]     install what is missing, then run all tests of the workspace in the release profile; --fast skips tests of over three seconds
cargo xtask test NAME…        run only the tests whose module and name contain one of these words, in the same build
cargo xtask ci                run the checks that a change must pass, with the minutes per step
cargo xtask ci --all          run these checks, then the steps that `ci` only lists with the day on which they last passed
cargo xtask ci STEP...        run only these steps, for example cargo xtask ci clippy 'oldest rust'
cargo xtask outcomes [--write FILE | --against FILE]
                              break all built-in scenes, and print, store or compare pieces, areas, energies and bit patterns
cargo xtask counts [--write]  count the instructions of each stage; fail if one grew by over 5 %, or store the counts with --write
cargo xtask rebake            regenerate the baked bodies and states in fuzz/corpus and in the tests of the core crate
cargo xtask fuzz [SECONDS [TARGET...]]
                              fuzz each file reader, blows, worlds and scenes for this long each [default: 30], or only these targets
cargo xtask web [--out DIR]   build the web viewer as a static folder [default: target/web/page]
cargo xtask web-test          build the web viewer, and test scenes and a mesh in Chromium with software rendering
cargo xtask web-bits          run scenes in the simulation module of the web viewer in Node, and compare every bit with a native run
cargo xtask npm               build the npm package, install it in an empty project, and test it in Node and in Chromium
cargo xtask c [--write | --engines]
                              build the library for C and C++, install it in target/c/install, and try it; --write makes its header
                              anew; --engines plays scenes in Bullet and writes their section and pictures of docs/engines.md
cargo xtask python            build the Python wheel, and test it in a virtual environment
cargo xtask blender           test the Blender extension with that wheel in the downloaded `bpy` module, without a window
cargo xtask semver [REV]      compare the public interface of the published crates with the last version, or with another commit
cargo xtask surface           list the public names at the root of `frangible`; fail if there are over 120, or one names a type of `internals`
cargo xtask bevy              lint and test the Bevy plugin, in its own workspace
cargo xtask bevy-drawn        lint the examples of the Bevy plugin, and compare their pictures
cargo xtask bevy-web          build one of these examples as a web page, target/web/bevy-page, and open it in Chromium with software rendering
cargo xtask book [--write | --html | PAGE.md]
                              run the commands in the book, check its links, and make it HTML if mdBook is installed; --write also
                              updates the outputs that it shows in full, such as the command-line reference; --html runs nothing;
                              with a page, such as book/src/start/rapier.md, run only that page
cargo xtask dist              pack the program as an archive, and test the archive
cargo xtask setup             install missing system packages, if permitted
cargo xtask check-output DIR  check the output of `cargo run --release -- --out DIR --json > DIR/report.json`";

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
        ["fuzz"] => fuzz::fuzz(fuzz::USUAL_SECONDS, &[]).map(drop),
        ["fuzz", seconds, targets @ ..] => match seconds.parse() {
            Ok(seconds @ 1..) => fuzz::fuzz(seconds, targets).map(drop),
            _ => Err(format!(
                "`{seconds}` is not a whole number of seconds from 1, as in `cargo xtask fuzz 60`"
            )),
        },
        ["c"] => c::library(&c::Wish::Try).map(drop),
        ["c", "--write"] => c::library(&c::Wish::Header).map(drop),
        ["c", "--engines"] => c::library(&c::Wish::Engines).map(drop),
        ["surface"] => surface::surface().map(drop),
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
            "unknown command `{}`; the commands are:\n{HELP}",
            words.join(" ")
        )),
    }
}
