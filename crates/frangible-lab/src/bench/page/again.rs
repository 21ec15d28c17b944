//! Frame times of scenes whose pieces break again, and of a heap of pieces.

use std::fmt::Write;

use frangible_rapier::WorldConfig;
use frangible_scenes::GamePlan;

use super::{grouped, ms, table};
use crate::bench::again::{Findings, Found, HEAP, SIZE};

/// Frame times by scene.
#[must_use]
pub fn again(found: &Found, plan: GamePlan) -> String {
    let (found, heap) = (&found.scenes, &found.heap);
    let rows: Vec<Vec<String>> = found
        .iter()
        .map(|f| {
            vec![
                f.scene.clone(),
                f.breaks.to_string(),
                f.again.to_string(),
                f.bodies.to_string(),
                ms(f.frames.p50),
                ms(f.frames.p99),
                ms(f.frames.max),
                ms(f.rigid.p99),
                ms(f.rigid.max),
                format!("{} of {}", f.late, f.frames.calls),
                ms(f.fine.p99),
                ms(f.fine.max),
            ]
        })
        .collect();
    let detail = WorldConfig::for_games().fragment_collider;
    let mut text = format!(
        "Scenes of the gallery with bodies of about {} tetrahedra and {} modes, in steps of 1/{} s and frames of 1/60 s that begin when \
         they are due. Breaks come after the step: at most {} tetrahedra of work a step, each on other threads for {} steps. Pieces break \
         from {:.1} s after their birth on. They have modes of their own from {:.1} s on, or later where a thread that works {} % of \
         the time has not come to them. Colliders are those of `WorldConfig::for_games()`: one hull for a piece that fills at least a third \
         of it, else at most {} parts of {} points; the last columns have the default's, which have more. Pieces below 0.5 % of their \
         body's volume stay with a neighbour, and a blow has 4 samples per period. Bodies and steps are coarser than in the pictures, so \
         not the same breaks. A frame's time is its least over \
         {} equal runs.\n\n",
        grouped(SIZE[0] as f64),
        SIZE[1],
        60 * plan.steps_per_frame,
        grouped(plan.budget as f64),
        plan.delay,
        plan.pieces[0],
        plan.pieces[1],
        100.0 * plan.pace,
        detail.parts,
        detail.hull_points,
        found.first().map_or(0, |f| f.runs),
    );
    text += &table(
        &[
            "scene",
            "bodies broke",
            "pieces broke again",
            "bodies in the end",
            "median, ms",
            "p99, ms",
            "longest, ms",
            "Rapier's steps: p99, ms",
            "longest, ms",
            "over 1/60 s",
            "default colliders: p99, ms",
            "longest, ms",
        ],
        &rows,
    );
    let within = |spread: fn(&Findings) -> f64, frames: f64| {
        let within = found.iter().filter(|f| spread(f) <= frames / 60.0).count();
        format!("{within} of {}", found.len())
    };
    let _ = writeln!(
        text,
        "\nThe 99th percentile is within 1/60 s, its goal, in {} scenes, the longest frame within 1/30 s, its goal, in {} and within 1/60 s in {}; \
         with the default's colliders in {}, {} and {}.",
        within(|f| f.frames.p99, 1.0),
        within(|f| f.frames.max, 2.0),
        within(|f| f.frames.max, 1.0),
        within(|f| f.fine.p99, 1.0),
        within(|f| f.fine.max, 2.0),
        within(|f| f.fine.max, 1.0),
    );
    let _ = writeln!(
        text,
        "\nA heap: the scene `{HEAP}` at its own resolution with all pieces that its fracture leaves, {} bodies in the end, with the same colliders and \
         one step per frame. {:.0} s of it take {:.1} s, of which {:.1} are Rapier's (goal: faster than it plays).",
        heap.bodies, heap.seconds, heap.frames, heap.rigid,
    );
    text
}
