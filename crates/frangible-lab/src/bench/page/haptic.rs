//! Ticks of 1 ms.

use std::fmt::Write;

use super::{table, us};
use crate::bench::haptic::Findings;

/// Table of the ticks' times, by kind.
#[must_use]
pub fn haptic(found: &Findings) -> String {
    let clock = found.kept.is_some();
    let mut header = vec![
        "tick",
        "ticks",
        "p50, µs",
        "p99, µs",
        "p99.9, µs",
        "worst, µs",
    ];
    if clock {
        header.extend([
            "with the clock: p50, µs",
            "p99, µs",
            "p99.9, µs",
            "worst, µs",
        ]);
    }
    let rows: Vec<Vec<String>> = (found.taps.iter())
        .map(|taps| {
            let mut cells = vec![taps.title.to_string(), taps.work.calls.to_string()];
            for l in [Some(taps.work), taps.paced].iter().flatten() {
                cells.extend([l.p50, l.p99, l.p999, l.max].map(us));
            }
            cells
        })
        .collect();
    let mut text = format!(
        "A hammer's head of 130 g taps plates of {}, 100 × 100 × 5 mm, {} tetrahedra, {} modes, at 0.1 to 7 m/s, and slides on them. The blows are \
         half-sines of given impulses, with 4 samples per period. Every tick of 1 ms takes the head's position and velocity and gives the contact's force and the displacement of the surface, by all modes, \
         exact over the tick. At the first tick of a contact the impact begins, and is mostly refused; else cracks, pieces and surfaces are \
         made on another thread, which is woken after the tick, and taken {} ticks later.\n\n",
        found.material,
        found.tets,
        found.modes,
        crate::bench::haptic::touch::DELAY,
    );
    text += &table(&header, &rows);
    let _ = write!(
        text,
        "\n{} plates broke into {} pieces. Largest force {:.0} N, largest displacement {:.1} µm, at most {:.2} µm from its quasi-static part. \
         All forces, displacements and pieces of all runs are the same bits: {}. The least time of each tick over {} equal runs, one tick \
         after the other",
        found.broken,
        found.pieces,
        found.largest_force,
        1e6 * found.largest_displacement,
        1e6 * found.largest_swing,
        found.fingerprint,
        found.runs,
    );
    text += &match found.kept {
        Some(kept) => format!(
            "; beside it one run that keeps time with the clock and sleeps between ticks: {} of its ticks began more than 1 ms late, {} waited for \
             their pieces.\n",
            kept.late, kept.waited
        ),
        None => ".\n".into(),
    };
    text
}
