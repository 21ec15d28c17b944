//! Prints how cheaply the impacts of bodies that tumble down stairs are refused: the table of `docs/culling.md`.

#[path = "../tests/common/tumble.rs"]
mod tumble;

use frangible_rapier::LoadCounts;
use tumble::{BODIES, baked, tumble};

/// The whole way down, s.
const SECONDS: f32 = 6.0;

/// Height from which they fall on the first step, m.
const DROP: f32 = 0.02;

fn main() {
    println!(
        "| bodies | what | asked | contacts | by impulses | by amplitudes | by clusters | by stresses | broke |"
    );
    println!("|---|---|---:|---:|---:|---:|---:|---:|---:|");
    let names = ["brick", "glass block", "porcelain bowl", "drinking glass"];
    for name in names {
        let run = tumble(&[baked(name)], DROP, SECONDS);
        row(name, "impacts", run.impacts);
        row(name, "resting loads", run.rests);
        let rest = if run.at_rest { "" } else { "not " };
        eprintln!(
            "{name}: {} broken, {rest}at rest after {SECONDS} s",
            run.broken
        );
    }
}

fn row(name: &str, what: &str, c: LoadCounts) {
    let share = |n: u64| format!("{:.1} %", 100.0 * n as f64 / c.asked.max(1) as f64);
    println!(
        "| {BODIES} × {name} | {what} | {} | {} | {} | {} | {} | {} | {} |",
        c.asked,
        c.contacts,
        share(c.by_impulses),
        share(c.by_amplitudes),
        share(c.by_clusters),
        share(c.by_stresses),
        share(c.broke)
    );
}
