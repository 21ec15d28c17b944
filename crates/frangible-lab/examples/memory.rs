//! Size of the bodies of Table 1 in files and in memory, counted by the allocator.
//!
//! `cargo run --release -p frangible-lab --example memory -- [BODY …]` prints JSON, for `docs/data/memory.json`.

use allocation_counter::measure;
use frangible_lab::bench::cache::Cache;
use frangible_lab::bench::memory::{self, Counted};
use frangible_lab::bench::subjects::chosen;
use frangible_lab::data::{Measures, stored};

fn main() -> frangible_lab::Result<()> {
    let names: Vec<String> = std::env::args().skip(1).collect();
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
    println!("{:#}", stored(Measures::Model, false, &bodies)?);
    Ok(())
}
