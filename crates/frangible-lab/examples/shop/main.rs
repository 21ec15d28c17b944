//! A bull in a china shop: a thousand breakable things on planks, a ball of 400 kg at 7 m/s, frame times.
//!
//! `cargo run --release -p frangible-lab --example shop -- [RUNS] [SECONDS]` prints JSON, for `docs/data/shop.json`. Every run gives the same bits, so a
//! frame's time is its least over the runs, and percentiles are over frames. With the word `levers` in front it prints the table of settings in
//! `docs/engines.md` instead.

mod crockery;
mod furnish;
mod levers;
mod play;

use frangible_lab::Result;
use frangible_lab::bench::stats::Times;
use frangible_lab::data::{Measures, stored};
use serde_json::{Value, json};

use play::{BUDGET, DELAY, FRAME_RATE, Frame, Happened, PARTS, SPEED};

fn main() -> Result<()> {
    let mut words = std::env::args().skip(1).peekable();
    let levers = words.next_if(|word| word == "levers").is_some();
    let mut number = |default: usize| words.next().map_or(Ok(default), |word| word.parse());
    let (runs, seconds) = (number(5)?, number(4)?);
    if levers {
        print!("{}", levers::table(runs, seconds)?);
        return Ok(());
    }
    println!(
        "{:#}",
        stored(Measures::Scenes, true, &measure(runs, seconds)?)?
    );
    Ok(())
}

/// Bakes the things, furnishes the shop and lets the bull in.
fn measure(runs: usize, seconds: usize) -> Result<Value> {
    let count = seconds * FRAME_RATE as usize;
    let kinds = crockery::bake_all()?;
    let best = play::play_often(&kinds, count, &play::config(), SPEED, runs)?;
    let spread = |name: &str, times: Vec<f64>| json!({ "part": name, "seconds": Times::new(times).spread() });
    let of =
        |name, part: &dyn Fn(&Frame) -> f64| spread(name, best.frames.iter().map(part).collect());
    let mut frames = vec![
        of("whole frame", &|f| f.all),
        of("Rapier's step in it", &|f| f.rigid),
        of("ours", &|f| f.ours),
    ];
    frames.extend((0..PARTS.len()).map(|i| of(PARTS[i], &|f| f.parts[i])));
    let happened = best.happened.iter();
    let sum = |part: fn(&Happened) -> usize| happened.clone().map(part).sum::<usize>();
    let most = |part: fn(&Happened) -> usize| happened.clone().map(part).max();
    Ok(json!({
        "things": best.things,
        "breaks": sum(|h| h.breaks),
        "pieces": sum(|h| h.pieces),
        "most_bodies": most(|h| h.bodies),
        "most_awake": most(|h| h.awake),
        "budget": BUDGET,
        "delay": DELAY,
        "runs": runs,
        "frames": frames,
        "fingerprint": format!("{:016x}", best.print.value()),
    }))
}

#[cfg(test)]
mod tests {
    use super::measure;

    /// Runs that differ are an error.
    #[test]
    fn things_break_and_equal_runs_are_equal() {
        let found = measure(2, 1).unwrap();
        let number = |key: &str| found[key].as_u64().unwrap();
        assert_eq!(number("things"), 1000);
        let (broken, pieces) = (number("breaks"), number("pieces"));
        assert!(broken > 10 && pieces > 2 * broken, "{broken} into {pieces}");
        for row in found["frames"].as_array().unwrap() {
            assert_eq!(row["seconds"]["calls"], 60, "{row}");
            assert!(row["seconds"]["max_s"].as_f64() > Some(0.0), "{row}");
        }
    }
}
