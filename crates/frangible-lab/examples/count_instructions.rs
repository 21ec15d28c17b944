//! One stage at a time, for valgrind to count: `cargo xtask counts` runs it.
//!
//! `count_instructions list | bake FILE | run FILE CASE`

use std::hint::black_box;

use frangible::Asset;
use frangible::internals::asset::SaveOptions;
use frangible_lab::bench::stages::{Bench, Depth, small_body};

/// Cases, each with its number of repetitions: enough for a million instructions.
const CASES: [(&str, usize); 8] = [
    ("first-bound", 50),
    ("refused-by-amplitudes", 5),
    ("looked-at", 1),
    ("response", 10),
    ("displacements", 1),
    ("stresses", 5),
    ("break-in-the-paper's-model", 1),
    ("break-in-our-model", 1),
];

fn main() -> frangible_lab::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["list"] => {
            for (name, _) in CASES {
                println!("{name}");
            }
            Ok(())
        }
        // In half precision: the last bits of a bake differ from processor to processor, and with them what breaks.
        ["bake", file] => {
            small_body()?.save_with(file, &SaveOptions::compact())?;
            Ok(Bench::new(Asset::load(file)?)?.check()?)
        }
        ["run", file, name] => {
            let case = CASES.iter().position(|(known, _)| *known == name);
            let case = case.ok_or_else(|| format!("`{name}` is no case; `list` names them"))?;
            let bench = Bench::new(Asset::load(file)?)?;
            let mut middle = bench.middle();
            for _ in 0..CASES[case].1 {
                counted_work(&bench, case, &mut middle);
            }
            Ok(())
        }
        _ => Err("count_instructions list | bake FILE | run FILE CASE".into()),
    }
}

/// Work whose instructions valgrind counts; it finds the function by this name.
#[inline(never)]
fn counted_work(
    bench: &Bench,
    case: usize,
    middle: &mut (frangible::internals::stress::DisplacementBatch, usize),
) {
    match case {
        0 => {
            black_box(bench.asked(Depth::Impulse));
        }
        1 => {
            black_box(bench.asked(Depth::Amplitudes));
        }
        2 => {
            black_box(bench.asked(Depth::Stresses));
        }
        3 => {
            black_box(bench.response());
        }
        4 => {
            bench.displacements();
        }
        5 => {
            black_box(bench.stresses(middle));
        }
        6 => {
            black_box(bench.broken(&bench.paper));
        }
        _ => {
            black_box(bench.broken(&bench.ours));
        }
    }
}
