//! The findings as tables, for the terminal and for `docs/performance.md`.

mod again;
mod gallery;
mod gpu;
mod haptic;
mod memory;
pub mod sections;
mod shop;

use std::collections::BTreeMap;
use std::fmt::Write;

pub use again::again;
pub use gallery::gallery;
pub use gpu::gpu;
pub use haptic::haptic;
pub use memory::memory;
pub use shop::shop;

use crate::bench::contacts::{self, Class, Findings, Timed};
use crate::bench::stats::Times;
use crate::bench::table1::{InModel, Row, Stages};

/// The paper's GPU time over ours, the goal.
const PAPER_GOAL: f64 = 2.5;
/// The word-for-word reference's time over ours, the goal of the median.
const MEDIAN_GOAL: f64 = 60.0;
/// The goal of each large slab.
const SLAB_GOAL: f64 = 25.0;
/// The large slabs.
const LARGE_SLABS: [&str; 2] = ["slab-high", "slab-very-high"];

/// A Markdown table whose columns are as wide as their cells.
pub(crate) fn table(header: &[&str], rows: &[Vec<String>]) -> String {
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        let widest = cells.map(|c| c.chars().count()).max().unwrap_or(0);
        widest.max(header[column].chars().count())
    };
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    let mut text = String::new();
    let mut line = |cells: &mut dyn Iterator<Item = &str>| {
        for (i, (cell, &width)) in cells.zip(&widths).enumerate() {
            // Names to the left, numbers to the right.
            let _ = match i {
                0 => write!(text, "| {cell:<width$} |"),
                _ => write!(text, " {cell:>width$} |"),
            };
        }
        text.push('\n');
    };
    line(&mut header.iter().copied());
    let rules: Vec<String> = widths.iter().map(|&w| "-".repeat(w)).collect();
    line(&mut rules.iter().map(String::as_str));
    for row in rows {
        line(&mut row.iter().map(String::as_str));
    }
    text
}

/// Milliseconds to three digits.
pub(crate) fn ms(seconds: f64) -> String {
    digits(1e3 * seconds)
}

/// Microseconds to three digits.
fn us(seconds: f64) -> String {
    digits(1e6 * seconds)
}

/// Three digits, none of them lost before the point.
pub(crate) fn digits(x: f64) -> String {
    let places = match x.abs() {
        a if a >= 100.0 => 0,
        a if a >= 10.0 => 1,
        a if a >= 1.0 => 2,
        _ => 3,
    };
    format!("{x:.places$}")
}

/// Thousands apart.
fn grouped(n: f64) -> String {
    let all = format!("{n:.0}");
    let mut text = String::new();
    for (i, digit) in all.chars().enumerate() {
        if i > 0 && (all.len() - i) % 3 == 0 {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// A number beside the paper's.
fn beside(own: usize, paper: usize) -> String {
    format!(
        "{own} ({:+.1} %)",
        100.0 * (own as f64 / paper as f64 - 1.0)
    )
}

/// The bodies, the times of whole impacts, the times of their stages.
#[must_use]
pub fn table1(rows: &[Row]) -> String {
    let mut text = String::from("### The bodies\n\n");
    text += &bodies(rows);
    for (title, pick, first) in [
        (
            "The paper's model",
            (|r| &r.paper) as fn(&Row) -> &InModel,
            true,
        ),
        (
            "The paper's model at two samples per period",
            |r| &r.two_samples,
            false,
        ),
        ("Our model", |r| &r.ours, false),
    ] {
        let _ = write!(text, "\n### {title}: whole impacts, ms\n\n");
        text += &whole(rows, pick, first);
        text += &goals(rows, pick, first);
        let _ = write!(text, "\n### {title}: stages, ms\n\n");
        text += &stages(rows, pick);
    }
    text
}

fn bodies(rows: &[Row]) -> String {
    let cells = |r: &Row| {
        vec![
            r.subject.name.to_string(),
            beside(r.nodes, r.subject.paper.nodes),
            beside(r.tets, r.subject.paper.tets),
            r.weak_points.to_string(),
            format!("{} / {}", r.analysis_elements, r.analysis_nodes),
            digits(r.bake),
            digits(r.file_size as f64 * 1e-6),
            ms(r.load),
            ms(r.ready),
            speeds(r),
        ]
    };
    let header = [
        "body",
        "nodes (to paper's)",
        "tetrahedra (to paper's)",
        "weak points",
        "analysis elements / nodes",
        "bake, s",
        "file, MB",
        "load, ms",
        "make ready, ms",
        "blow, m/s (ours)",
    ];
    let mut text = table(&header, &rows.iter().map(cells).collect::<Vec<_>>());
    text.push('\n');
    for row in rows {
        let _ = writeln!(text, "- {}: {}.", row.subject.name, row.subject.about);
    }
    text
}

fn speeds(r: &Row) -> String {
    let (paper, ours) = (r.subject.blow.speed, r.subject.blow.speed_ours);
    if paper == ours {
        format!("{paper}")
    } else {
        format!("{paper} ({ours})")
    }
}

fn whole(rows: &[Row], pick: fn(&Row) -> &InModel, reference: bool) -> String {
    let mut header = vec![
        "body",
        "paper CPU",
        "paper GPU",
        "ours, warm",
        "ours, cold",
        "paper GPU / ours",
    ];
    if reference {
        header.extend(["word for word", "word for word / ours"]);
    }
    header.extend(["steps", "crossed", "cracks", "fragments"]);
    let cells = |r: &Row| {
        let (m, paper) = (pick(r), &r.subject.paper);
        let warm = m.warm.total;
        let mut cells = vec![
            r.subject.name.to_string(),
            digits(paper.cpu()),
            digits(paper.gpu()),
            ms(warm),
            ms(m.cold.total),
            digits(1e-3 * paper.gpu() / warm),
        ];
        if reference {
            cells.push(m.reference.map_or("–".into(), ms));
            cells.push(m.reference.map_or("–".into(), |t| digits(t / warm)));
        }
        cells.extend([m.steps, m.crossed, m.cracks, m.fragments].map(|n| n.to_string()));
        cells
    };
    table(&header, &rows.iter().map(cells).collect::<Vec<_>>())
}

/// Table of the goals of whole impacts beside the results, with the stage that takes most where the first goal is missed.
fn goals(rows: &[Row], pick: fn(&Row) -> &InModel, reference: bool) -> String {
    let (mut missed, mut stages) = (0, BTreeMap::<&str, usize>::new());
    for row in rows {
        let warm = &pick(row).warm;
        if 1e-3 * row.subject.paper.gpu() < PAPER_GOAL * warm.total {
            missed += 1;
            *stages.entry(warm.longest()).or_default() += 1;
        }
    }
    let mut text = format!(
        "\nThe paper's GPU time is at least {PAPER_GOAL} times ours, the goal, for {} of {} bodies.",
        rows.len() - missed,
        rows.len()
    );
    if missed > 0 {
        let held: Vec<String> = stages.iter().map(|(s, n)| format!("{s} {n}")).collect();
        let _ = write!(text, " What takes the others longest: {}.", held.join(", "));
    }
    text.push('\n');
    let faster = |row: &Row| Some(pick(row).reference? / pick(row).warm.total);
    let factors: Vec<f64> = rows.iter().filter_map(faster).collect();
    if reference && !factors.is_empty() {
        let _ = write!(
            text,
            "\nWord for word takes {} times as long in the median (goal: {MEDIAN_GOAL})",
            digits(Times::new(factors).median())
        );
        for slab in LARGE_SLABS {
            let row = rows.iter().find(|row| row.subject.name == slab);
            if let Some(factor) = row.and_then(faster) {
                let _ = write!(text, ", {slab} {} (goal: {SLAB_GOAL})", digits(factor));
            }
        }
        text += ".\n";
    }
    text
}

fn stages(rows: &[Row], pick: fn(&Row) -> &InModel) -> String {
    let header = [
        "body",
        "paper: initiation CPU / GPU",
        "propagation",
        "fragments",
        "ours: response",
        "displacements",
        "stresses, cracks",
        "fragments",
        "colliders, apart",
    ];
    let cells = |r: &Row| {
        let (m, paper) = (pick(r), &r.subject.paper);
        let Stages {
            response,
            displacements,
            cracks,
            fragments,
            ..
        } = m.warm;
        vec![
            r.subject.name.to_string(),
            format!("{} / {}", paper.initiation_cpu, paper.initiation_gpu),
            paper.propagation.to_string(),
            paper.fragments.to_string(),
            ms(response),
            ms(displacements),
            ms(cracks),
            ms(fragments),
            ms(m.colliders),
        ]
    };
    table(&header, &rows.iter().map(cells).collect::<Vec<_>>())
}

/// Rates and latencies of refused contacts.
#[must_use]
pub fn contacts(found: &Findings) -> String {
    let header = [
        "`would_break`",
        "share",
        "contacts",
        "per second and core",
        "calls",
        "p50, µs",
        "p99, µs",
        "p99.9, µs",
        "max, µs",
    ];
    let row = |title: &str, share: String, timed: &Timed| {
        let l = &timed.latency;
        vec![
            title.to_string(),
            share,
            timed.contacts.to_string(),
            grouped(timed.per_second),
            l.calls.to_string(),
            us(l.p50),
            us(l.p99),
            us(l.p999),
            us(l.max),
        ]
    };
    let share_of = |kind: Class| {
        let share = found.game_shares.iter().find(|(k, _)| *k == kind);
        share.map_or(String::new(), |(_, s)| format!("{:.2} %", 100.0 * s))
    };
    let mut rows = vec![row("game-like, all", "100 %".into(), &found.game)];
    rows.extend(
        found
            .classes
            .iter()
            .map(|(k, t)| row(k.title(), share_of(*k), t)),
    );
    let mut text = table(&header, &rows);
    let _ = write!(
        text,
        "\nThe body: the pig of porcelain, {} nodes, {} tetrahedra, {} weak points, {} modes; our model. Game-like contacts: {}. \
         The share is that of each class among them. The classes are filled from the same distribution at {}. \
         Rates are taken without a clock between calls; a single call holds {} µs for reading the clock. Where a class has \
         fewer than 1 000 calls its p99.9 is its maximum.\n",
        found.nodes,
        found.tets,
        found.weak_points,
        found.modes,
        contacts::GAME_DISTRIBUTION,
        contacts::CLASS_SPEEDS,
        us(found.clock),
    );
    text
}

/// The bodies of Table 1, in words and tables.
#[must_use]
pub fn table1_section(rows: &[Row]) -> String {
    format!(
        "One thread is used; each figure is the median of its runs.

The bodies of Table 1 of `[G12]` with {} modes: the paper's parameters (presets `paper-…`), nodes and tetrahedra. The paper gives no
sizes, densities, Poisson's ratios, speeds or weak points: those are ours. Its times are of one thread of a 2.3 GHz Core2, and of a
Quadro FX 3700M for initiation.

- Warm: the same blow again and again. Cold: the first blow on a body just read from its file, after 64 MiB were written elsewhere.
- The paper's initiation is our response, displacements and the stresses at weak points, its propagation our cracks. One clock holds
  stresses and cracks, since each step of time looks at stresses and lets cracks run.
- Stages are medians for themselves and need not sum to the whole.
- Word for word: `frangible_lab::reference`, f64, without the fragments' surfaces; one run.
- In the paper's model time is sampled 16 times per period of the highest mode that matters, in ours 8 times; Eq. 3 as printed takes a
  sample every two periods. Two samples per period, the limit that the paper names, are measured apart.
- Colliders are what `frangible-rapier` makes for the fragments, no part of the impact.

{}",
        crate::bench::subjects::MODES,
        table1(rows),
    )
}

#[cfg(test)]
mod tests {
    use super::{beside, digits, grouped, table};

    #[test]
    fn numbers_keep_three_digits() {
        let shown = [1234.5, 123.4, 12.34, 1.234, 0.1234].map(digits);
        assert_eq!(shown, ["1234", "123", "12.3", "1.23", "0.123"]);
        assert_eq!(grouped(1_234_567.0), "1 234 567");
        assert_eq!(beside(95, 100), "95 (-5.0 %)");
    }

    #[test]
    fn columns_line_up() {
        let text = table(&["a", "bb"], &[vec!["é".into(), "1".into()]]);
        assert_eq!(text, "| a | bb |\n| - | -- |\n| é |  1 |\n");
    }
}
