//! Prints how cheaply the impacts of bodies that tumble down stairs are refused: the table of `docs/culling.md`.

#[path = "../tests/common/tumble.rs"]
mod tumble;

use frangible_rapier::LoadCounts;
use tumble::{baked, tumble};

/// The whole way down, s.
const SECONDS: f32 = 6.0;

fn main() {
    println!(
        "| bodies | drop, m | what | asked | contacts | by impulses | by amplitudes | by clusters | by stresses | broke |"
    );
    println!("|---|---:|---|---:|---:|---:|---:|---:|---:|---:|");
    let names = ["brick", "glass block", "porcelain bowl", "drinking glass"];
    let kinds: Vec<_> = names.iter().map(|name| baked(name)).collect();
    let mut rows: Vec<(String, &[_], f32)> = names
        .iter()
        .enumerate()
        .map(|(i, name)| (format!("20 × {name}"), &kinds[i..=i], 0.02))
        .collect();
    rows.push(("5 of each".into(), &kinds[..], 0.02));
    rows.push(("5 of each".into(), &kinds[..], 0.5));
    for (name, kinds, height) in rows {
        let run = tumble(kinds, height, SECONDS);
        row(&name, height, "impacts", run.impacts);
        row(&name, height, "resting loads", run.rests);
        let rest = if run.at_rest { "" } else { "not " };
        eprintln!(
            "{name}: {} broken, {rest}at rest after {SECONDS} s",
            run.broken
        );
    }
}

fn row(name: &str, height: f32, what: &str, c: LoadCounts) {
    let share = |n: u64| format!("{:.1} %", 100.0 * n as f64 / c.asked.max(1) as f64);
    println!(
        "| {name} | {height} | {what} | {} | {} | {} | {} | {} | {} | {} |",
        c.asked,
        c.contacts,
        share(c.by_impulses),
        share(c.by_amplitudes),
        share(c.by_clusters),
        share(c.by_stresses),
        share(c.broke)
    );
}
