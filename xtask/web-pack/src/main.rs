//! `web-pack package LIBRARY.wasm FOLDER` writes `LIBRARY.js` and `LIBRARY_bg.wasm` into a folder and prints the bytes of the latter;
//! `web-pack page PROGRAM.wasm FOLDER` writes `PROGRAM.js` and `PROGRAM.wasm.gz` into a folder and prints the bytes of the latter
//! unpacked; `web-pack body FILE PACKED` packs a baked body; `web-pack weigh FILE` prints the bytes of a file as servers pack it.

use std::error::Error;
use std::num::NonZeroU64;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["package", library, folder] => {
            bindings(library.as_ref(), folder.as_ref()).map(|bytes| println!("{bytes}"))
        }
        ["page", program, folder] => page(program.as_ref(), folder.as_ref()),
        ["body", file, packed] => body(file.as_ref(), packed.as_ref()),
        ["weigh", file] => weigh(file.as_ref()),
        _ => Err("`web-pack package LIBRARY.wasm FOLDER`, `web-pack page PROGRAM.wasm FOLDER`, `web-pack body FILE PACKED` or `web-pack weigh FILE`".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("web-pack: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Writes the module and the script that calls it. Returns the module's size in bytes.
fn bindings(program: &Path, folder: &Path) -> Result<usize, Box<dyn Error>> {
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(program)
        .web(true)?
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true);
    bindgen.generate(folder)?;
    Ok(std::fs::read(module(program, folder))?.len())
}

fn module(program: &Path, folder: &Path) -> PathBuf {
    let name = program.file_stem().unwrap_or_default().to_string_lossy();
    folder.join(format!("{name}_bg.wasm"))
}

fn page(program: &Path, folder: &Path) -> Result<(), Box<dyn Error>> {
    let bytes = bindings(program, folder)?;
    let name = program.file_stem().unwrap_or_default().to_string_lossy();
    let plain = module(program, folder);
    let wasm = std::fs::read(&plain)?;
    std::fs::write(
        folder.join(format!("{name}.wasm.gz")),
        packed(&wasm, ROUNDS)?,
    )?;
    println!("{bytes}");
    std::fs::remove_file(plain)?;
    Ok(())
}

/// The first bytes of all words of four, then the second, third and fourth ones: numbers that lie side by side are alike in
/// their upper bytes. A fifth less than the file as it is.
fn body(file: &Path, to: &Path) -> Result<(), Box<dyn Error>> {
    let bytes = std::fs::read(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let planes: Vec<u8> = (0..4)
        .flat_map(|plane| bytes.iter().skip(plane).step_by(4).copied())
        .collect();
    std::fs::write(to, packed(&planes, NonZeroU64::MIN)?)
        .map_err(|error| format!("{}: {error}", to.display()))?;
    Ok(())
}

fn weigh(file: &Path) -> Result<(), Box<dyn Error>> {
    let bytes = std::fs::read(file).map_err(|error| format!("{}: {error}", file.display()))?;
    println!("{}", packed(&bytes, ROUNDS)?.len());
    Ok(())
}

/// Rounds of looking for a shorter way to say the same, for programs; more than a few gain nothing, and for the many bodies one will do.
const ROUNDS: NonZeroU64 = NonZeroU64::new(3).expect("3 is not 0");

/// Bytes that gzip unpacks, a twentieth smaller than gzip itself makes them; packing the program takes a minute.
fn packed(bytes: &[u8], rounds: NonZeroU64) -> Result<Vec<u8>, Box<dyn Error>> {
    let options = zopfli::Options {
        iteration_count: rounds,
        ..zopfli::Options::default()
    };
    let mut packed = Vec::new();
    zopfli::compress(options, zopfli::Format::Gzip, bytes, &mut packed)?;
    Ok(packed)
}
