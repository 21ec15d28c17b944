//! Frame times of the china shop.

use std::fmt::Write;

use super::{grouped, ms, table};
use crate::bench::shop::{Findings, Frame, PARTS};
use crate::bench::stats::Spread;

/// Targets, s: our share and whole frames at the 99th percentile, the worst frame.
const TARGETS: [f64; 3] = [6e-3, 1.0 / 60.0, 33e-3];

/// Table of frame times and their parts, and of the targets.
#[must_use]
pub fn shop(found: &Findings) -> String {
    let row = |title: String, s: Spread| vec![title, ms(s.p50), ms(s.p99), ms(s.max), ms(s.mean)];
    let of = |part: &dyn Fn(&Frame) -> f64| found.spread(part);
    let (all, ours) = (of(&|f| f.all), of(&|f| f.ours));
    let mut rows = vec![
        row("whole frame".into(), all),
        row("Rapier's step in it".into(), of(&|f| f.rigid)),
        row("ours".into(), ours),
    ];
    for (i, part) in PARTS.iter().enumerate() {
        rows.push(row(format!("ours: {part}"), of(&|f| f.parts[i])));
    }
    rows.push(row("Rapier alone".into(), found.spread_alone()));
    let (breaks, pieces) = found
        .happened
        .iter()
        .fold((0, 0), |(b, p), h| (b + h.breaks, p + h.pieces));
    let most = |part: fn(&crate::bench::shop::Happened) -> usize| {
        found.happened.iter().map(part).max().unwrap_or(0)
    };
    let mut text = format!(
        "{} things on loose planks, a ball of 400 kg at 7 m/s, {:.0} s at 60 steps per second: {breaks} things break into {pieces} pieces, up to {} \
         bodies in the world, {} of them moving. Breaks come after the step, at most {} tetrahedra of work put in per step, each on other threads \
         for {} steps while the whole body goes on. A contact is a blow from 1 m/s on, and has 4 samples per period. \
         Pieces below 0.5 % of a thing's volume stay with a neighbour; those below 3 g are debris, those below 1 g dust.\n\n",
        found.things,
        found.frames.len() as f64 / 60.0,
        most(|h| h.bodies),
        most(|h| h.awake),
        grouped(found.budget[0] as f64),
        found.budget[1],
    );
    text += &table(&["per frame, ms", "median", "p99", "worst", "mean"], &rows);
    let _ = write!(
        text,
        "\nEvery run gives the same bits ({}), so a frame's time is its least over {} runs; percentiles are over {} frames, which begin \
         1/60 s apart where they can. Rapier alone: the \
         same shop with its {} lasting pieces lying in their things from the beginning, the same bull and frames, no code of ours.\n\n",
        found.fingerprint,
        found.runs,
        found.frames.len(),
        found.pieces,
    );
    let verdict = |what: &str, found: f64, target: f64| {
        let met = if found <= target { "met" } else { "missed" };
        format!(
            "- {what}: {} ms, target {} ms, {met}.\n",
            ms(found),
            ms(target)
        )
    };
    text += &verdict("Our share, p99", ours.p99, TARGETS[0]);
    text += &verdict("Whole frame, p99", all.p99, TARGETS[1]);
    text += &verdict("Worst frame", all.max, TARGETS[2]);
    text.push('\n');
    text += &kinds(found);
    if let Some(bytes) = found.bytes_per_thing {
        let _ = write!(
            text,
            "\nA thing more in the shop takes {:.1} kB, by the process's memory: its weak points, its rigid body, its collider.\n",
            1e-3 * bytes
        );
    }
    text
}

fn kinds(found: &Findings) -> String {
    let rows: Vec<Vec<String>> = (found.kinds.iter())
        .map(|kind| {
            vec![
                kind.name.clone(),
                kind.tets.to_string(),
                found.modes.to_string(),
                format!("{:.2}", kind.mass),
                format!("{:.2}", 1e-6 * kind.file_size as f64),
            ]
        })
        .collect();
    table(
        &[
            "kind",
            "tetrahedra",
            "modes",
            "mass, kg",
            "shared asset's file, MB",
        ],
        &rows,
    )
}
