//! The settings of a shop with more pieces than a frame has time for, one after the other, and what each brings.

use std::fmt::Write;

use frangible_lab::Result;
use frangible_rapier::{Breaking, ColliderDetail, WorldConfig};

use crate::crockery;
use crate::play::{FRAME_RATE, Frame, Run, config, play_often};

/// Speed of the bull, m/s: with all settings more than two thousand pieces are born.
const SPEED: f32 = 12.0;

/// A setting, and its name.
type Lever = (&'static str, fn(&mut WorldConfig));

/// In the order in which they are set, each beside those before it.
const LEVERS: [Lever; 7] = [
    ("colliders of `for_games`, 8 000 tetrahedra a step", |_| {}),
    ("1 000 tetrahedra a step, 12 steps of delay", |c| {
        c.breaking = Breaking::AfterStep {
            budget: 1000,
            delay: 12,
        };
    }),
    ("pieces below 20 g: one hull of 10 points", |c| {
        (c.small_pieces.mass, c.small_pieces.hull_points) = (0.02, 10);
    }),
    ("all pieces: one hull of 10 points", |c| {
        c.hull_volume_ratio = 1e6;
        c.fragment_collider = ColliderDetail {
            parts: 1,
            hull_points: 10,
        };
    }),
    ("pieces below 5 g are debris, 100 at most", |c| {
        (c.debris_mass, c.max_debris) = (5e-3, 100);
    }),
    ("dust below 2 g in place of 1 g", |c| c.dust_mass = 2e-3),
    ("2 iterations of the solver in place of 4", |c| {
        c.solver_iterations = 2;
    }),
];

/// The table: the least times of so many equal runs of so many seconds.
pub(crate) fn table(runs: usize, seconds: usize) -> Result<String> {
    let kinds = crockery::bake_all()?;
    let frames = seconds * FRAME_RATE as usize;
    let mut page = String::from(
        "| settings, each beside those above | broke | pieces | most awake | median | p99 | longest | Rapier's p99 | ours, p99 |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    let mut set = config();
    let mut row = |name: &str, config: &WorldConfig| -> Result<()> {
        let run = play_often(&kinds, frames, config, SPEED, runs)?;
        let sum = |part: fn(&crate::play::Happened) -> usize| -> usize {
            run.happened.iter().map(part).sum()
        };
        let awake = run.happened.iter().map(|h| h.awake).max();
        let time = |part: fn(&Frame) -> f64, share| percentile(&run, part, share);
        writeln!(
            page,
            "| {name} | {} | {} | {} | {:.1} | {:.1} | {:.1} | {:.1} | {:.1} |",
            sum(|h| h.breaks),
            sum(|h| h.pieces),
            awake.unwrap_or(0),
            time(|f| f.all, 0.5),
            time(|f| f.all, 0.99),
            time(|f| f.all, 1.0),
            time(|f| f.rigid, 0.99),
            time(|f| f.ours, 0.99),
        )?;
        Ok(())
    };
    for (name, lever) in LEVERS {
        lever(&mut set);
        row(name, &set)?;
    }
    set.breaking = Breaking::InsideStep;
    row("all these, and breaks inside the step", &set)?;
    Ok(page)
}

/// A time of the frames that this share of them keeps, ms.
fn percentile(run: &Run, part: fn(&Frame) -> f64, share: f64) -> f64 {
    let mut times: Vec<f64> = run.frames.iter().map(|f| 1e3 * part(f)).collect();
    times.sort_by(f64::total_cmp);
    let last = times.len().saturating_sub(1);
    let at = (last as f64 * share).round() as usize;
    times.get(at).copied().unwrap_or_default()
}
