//! A plate of glass under a hand, a thousand times a second: the force on the hand, and the break of the plate.
//!
//! `cargo run --release -p frangible-lab --example haptic -- [ticks] [--fast]`: 30 s of strokes that keep time with the clock,
//! or as fast as they go.

use frangible_lab::bench::cache::Cache;
use frangible_lab::bench::haptic::{Options, measure};
use frangible_lab::bench::page;
use frangible_lab::bench::subjects::chosen;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let paced = !arguments.iter().any(|a| a == "--fast");
    let mut options = Options {
        paced,
        ..Options::default()
    };
    if let Some(ticks) = arguments.iter().find(|a| *a != "--fast") {
        options.ticks = ticks.parse()?;
    }
    let cache = Cache {
        folder: "target/bench".into(),
        rebake: false,
    };
    let plate = chosen(&["slab-moderate".into()])?[0];
    let found = measure(plate, &cache, &options, &mut |_, _| {})?;
    print!("{}", page::haptic(&found));
    Ok(())
}
