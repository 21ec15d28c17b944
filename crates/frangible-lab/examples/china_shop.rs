//! A bull in a china shop: a thousand breakable things, a ball of 400 kg, frame times.
//!
//! `cargo run --release -p frangible-lab --example china_shop -- [runs] [seconds]`: 5 equal runs of 4 s. It prints the table of `frangible-lab bench
//! shop`, and the course of the run.

use frangible_lab::bench::page;
use frangible_lab::bench::shop::{Options, measure};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut asked = std::env::args().skip(1);
    let mut number = |default: usize| asked.next().map_or(Ok(default), |a| a.parse());
    let options = Options {
        runs: number(5)?,
        seconds: number(4)?,
    };
    let found = measure(&options, &mut |_, _| {})?;
    let (mut breaks, mut pieces) = (0, 0);
    for (i, (frame, happened)) in found.frames.iter().zip(&found.happened).enumerate() {
        breaks += happened.breaks;
        pieces += happened.pieces;
        if i % 20 == 19 {
            println!(
                "{:.2} s: {} wait, {breaks} broken into {pieces}, {} bodies, {} awake, {:.1} ms, of it ours {:.1} ms, Rapier alone {:.1} ms",
                (i + 1) as f64 / 60.0,
                happened.waiting,
                happened.bodies,
                happened.awake,
                1e3 * frame.all,
                1e3 * frame.ours,
                1e3 * found.alone[i],
            );
        }
    }
    println!("\n{}", page::shop(&found));
    Ok(())
}
