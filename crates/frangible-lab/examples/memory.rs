//! Size of the bodies of Table 1 in files and in memory, counted by the allocator.
//!
//! `cargo run --release -p frangible-lab --example memory -- [--write FOLDER] [body …]`: with `--write` also into
//! `performance.md` in the folder.

use std::path::Path;

use allocation_counter::measure;
use frangible_lab::bench::cache::Cache;
use frangible_lab::bench::machine::Machine;
use frangible_lab::bench::memory::{self, Counted};
use frangible_lab::bench::page::{
    self,
    sections::{MEMORY, Section, with_sections},
};
use frangible_lab::bench::subjects::chosen;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut names: Vec<String> = std::env::args().skip(1).collect();
    let folder = match names.iter().position(|name| name == "--write") {
        Some(at) if at + 1 < names.len() => names.drain(at..=at + 1).nth(1),
        Some(_) => return Err("--write needs a folder".into()),
        None => None,
    };
    let cache = Cache {
        folder: "target/bench".into(),
        rebake: false,
    };
    let mut count = |run: &mut dyn FnMut()| {
        let counted = measure(run);
        Counted {
            kept: counted.bytes_current.max(0) as u64,
            most: counted.bytes_max,
        }
    };
    let mut bodies = Vec::new();
    for subject in chosen(&names)? {
        // The pig stands twice in the table.
        if subject.file() == subject.name {
            bodies.push(memory::measure(subject, &cache, &mut count)?);
        }
    }
    let text = page::memory(&bodies);
    print!("{text}");
    if let Some(folder) = folder {
        let path = Path::new(&folder).join("performance.md");
        let known = std::fs::read_to_string(&path).ok();
        // The number of bytes does not depend on other load of the machine.
        let machine = Machine {
            busy: None,
            ..Machine::this()
        };
        let section = Section::new(MEMORY, &machine, &text);
        std::fs::write(path, with_sections(known.as_deref(), &[section]))?;
    }
    Ok(())
}
