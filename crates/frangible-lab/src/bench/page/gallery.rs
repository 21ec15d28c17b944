//! Whole breaks of the gallery's bodies beside their goals.

use super::{digits, grouped, ms, table};
use crate::bench::gallery::{Asked, Findings, Row};

/// The first break of a body that was made ready over the warm one, the goal.
const FIRST_GOAL: f64 = 1.3;
/// Names of [`Row::stages`].
const STAGES: [&str; 6] = ["blow", "stress", "cracks", "labels", "fragments", "drawing"];

/// A row for each body, one for each range of questions.
#[must_use]
pub fn gallery(found: &Findings) -> String {
    let mut text = String::from(
        "Each body of the gallery under the blow that breaks it first in its scene, one thread, everything in memory, surfaces and masses \
         of the pieces included; each figure is the median of its runs. Cut: tetrahedra that cracks cut; µs / cut: the whole break over their \
         number. Labels: which pieces cracks have parted, asked in the end, again \
         and again while the contact pushes, and when it no longer does. First / warm: the first break of a body that was made ready (`Body::prepare_for_blows`, as a game does \
         while it loads) over the median; cold / warm: the same without that.\n\n",
    );
    text += &table(
        &[
            "body",
            "weak points",
            "modes",
            "steps",
            "cracks",
            "cut",
            "pieces",
            "goal, ms",
            "whole, ms",
            "µs / cut",
            "first / warm",
            "cold / warm",
            "blow",
            "stress",
            "cracks, ms",
            "labels",
            "fragments",
            "drawing",
        ],
        &found.rows.iter().map(row).collect::<Vec<_>>(),
    );
    let within = found.rows.iter().filter(|r| r.whole <= r.goal).count();
    let slowest = found.rows.iter().map(|r| r.first / r.whole);
    text += &format!(
        "\n{within} of {} breaks are within their goals; the longest first break takes {:.2} times the warm one (goal: {FIRST_GOAL}).",
        found.rows.len(),
        slowest.fold(0.0, f64::max),
    );
    let missed = found.rows.iter().filter(|r| r.whole > r.goal);
    let held: Vec<String> = missed.map(held).collect();
    if !held.is_empty() {
        text += &format!(
            " The stage that takes most of each of the others: {}.",
            held.join(", ")
        );
    }
    text += "\n";
    if !found.asked.is_empty() {
        text +=
            "\n`would_break` on the glass, bodies of 20 seeds at eight speeds of each range:\n\n";
        text += &table(
            &[
                "speed, m/s",
                "questions",
                "answered yes",
                "goal, ms",
                "median, ms",
                "longest, ms",
            ],
            &found.asked.iter().map(asked).collect::<Vec<_>>(),
        );
    }
    text
}

/// The body, the stage that takes most of its break, and its share.
fn held(row: &Row) -> String {
    let stages = STAGES.iter().zip(row.stages);
    let most = stages.max_by(|a, b| a.1.total_cmp(&b.1));
    let (name, time) = most.unwrap_or((&"", 0.0));
    format!("{} {name} ({:.0} %)", row.scene, 100.0 * time / row.whole)
}

fn row(row: &Row) -> Vec<String> {
    let mut cells = vec![
        row.scene.clone(),
        grouped(row.points as f64),
        row.modes.to_string(),
        row.steps.to_string(),
        row.cracks.to_string(),
        grouped(row.cut as f64),
        row.pieces.to_string(),
        ms(row.goal),
        ms(row.whole),
        digits(1e6 * row.whole / row.cut.max(1) as f64),
        format!("{:.2}", row.first / row.whole),
        format!("{:.2}", row.cold / row.whole),
    ];
    cells.extend(row.stages.iter().map(|&time| ms(time)));
    cells
}

fn asked(asked: &Asked) -> Vec<String> {
    let [from, to] = asked.speeds;
    vec![
        format!("{from} to {to}"),
        asked.questions.to_string(),
        asked.breaks.to_string(),
        ms(asked.goal),
        ms(asked.median),
        ms(asked.longest),
    ]
}
