//! Page that shows the outcomes of the scenes.

use std::fmt::Write;

use crate::scenes::{Break, Outcome, RATES, Scene};
use crate::{Played, SEEDS};

/// Mean and standard error of the mean.
fn mean(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (mean, (squares / (n * (n - 1.0))).sqrt())
}

fn breaks(outcomes: &[Outcome]) -> impl Iterator<Item = &Break> {
    outcomes.iter().filter_map(|o| o.broke.as_ref())
}

/// Three figures of a number, with its standard error where it has one.
fn shown((mean, error): (f64, f64)) -> String {
    let digits = |x: f64| (2 - x.abs().log10().floor() as i32).clamp(0, 6) as usize;
    match mean {
        m if m.is_nan() => "–".into(),
        0.0 => "0".into(),
        m if error > 0.0 => format!("{m:.0$} ± {error:.0$}", digits(m)),
        m => format!("{m:.0$}", digits(m)),
    }
}

/// A row: name of the quantity, its value in both engines, and the share by which Avian's is larger.
fn row(out: &mut String, what: &str, played: &Played, of: impl Fn(&Outcome) -> Option<f64>) {
    let [rapier, avian] = [0, 1].map(|k: usize| {
        let values: Vec<f64> = played.engines[k].iter().filter_map(&of).collect();
        mean(&values)
    });
    let more = 100.0 * (avian.0 / rapier.0 - 1.0);
    let more = match more.is_finite() {
        // Nothing has no sign.
        true => format!("{more:+.1} %")
            .replace("-0.0 ", "0.0 ")
            .replace("+0.0 ", "0.0 "),
        false => "–".into(),
    };
    let (rapier, avian) = (shown(rapier), shown(avian));
    let _ = writeln!(out, "| {what} | {rapier} | {avian} | {more} |");
}

fn scene(out: &mut String, scene: &Scene, played: &Played) {
    let _ = writeln!(
        out,
        "## {}\n\n| | Rapier | Avian | difference |\n|---|---|---|---|",
        scene.name
    );
    let count = |k: usize| breaks(&played.engines[k]).count();
    let _ = writeln!(out, "| broke, of {SEEDS} | {} | {} | |", count(0), count(1));
    let of = |f: fn(&Break) -> f64| move |o: &Outcome| o.broke.as_ref().map(f);
    row(out, "pieces", played, of(|b| b.pieces as f64));
    row(out, "first crack, µs", played, of(|b| 1e6 * b.first_crack));
    row(out, "energy of the cracks, J", played, of(|b| b.cracks));
    row(out, "impulse of the blow, N·s", played, of(|b| b.impulse));
    row(
        out,
        "kinetic energy that goes in its step, J",
        played,
        of(|b| b.energy[0] - b.energy[1]),
    );
    if let Some(striker) = &scene.striker {
        let before = striker.start.velocity;
        let direction = before.normalize();
        row(out, "speed of the striker at the end, m/s", played, |o| {
            Some(f64::from(o.striker.dot(direction)))
        });
        row(out, "what it has lost, m/s", played, |o| scene.lost(o));
    }
    let pairs = played.engines[0].iter().zip(&played.engines[1]);
    let same = pairs.filter(|(a, b)| match (&a.broke, &b.broke) {
        (Some(a), Some(b)) => a.pieces == b.pieces && a.first_crack == b.first_crack,
        (None, None) => true,
        _ => false,
    });
    let _ = writeln!(
        out,
        "\nThe same pieces and first crack, to the bit, in {} of {SEEDS} seeds.\n",
        same.count()
    );
}

/// The largest change of momentum over a break in scenes without gravity, relative to what there is, and the largest rise of kinetic energy
/// together with the cracks', relative to the kinetic energy.
fn conservation(played: &[(Scene, Played)], engine: usize) -> (f64, f64) {
    let (mut momentum, mut energy) = (0.0_f64, f64::NEG_INFINITY);
    for (scene, outcomes) in played {
        for b in breaks(&outcomes.engines[engine]) {
            let [before, after] = b.momentum;
            if scene.floor.is_some() {
                continue;
            }
            momentum = momentum.max((after - before).length() / before.length());
            let [before, after] = b.energy;
            energy = energy.max((after + b.cracks - before) / before);
        }
    }
    (momentum, energy)
}

/// Table of the speeds that balls lose, without an engine and in both, with each number of steps per second.
fn losses(out: &mut String, played: &[(Scene, Played)]) {
    out.push_str(
        "## What the ball loses\n\nThe loss of speed a quarter of a second after the throw, m/s, of all seeds, whether the pane broke or not. *The blow \
         alone* is\nthat of the same blow, and of the ball's way through the pieces, without an engine. In the second row of each speed are the \
         differences\nof the same seeds from it. For a quarter of a second after a blow the engines leave out contacts between the ball and the pieces in \
         its way,\nunless one of them touches anything else. What the engines do when the ball meets pieces after that is not in this table.\n\n\
         | | the blow alone |",
    );
    for engine in ["Rapier", "Avian"] {
        for rate in RATES {
            let _ = write!(out, " {engine}, {rate} steps per second |");
        }
    }
    let _ = writeln!(out, "\n|{}", "---|".repeat(2 + 2 * RATES.len()));
    for (scene, played) in played.iter().filter(|(_, p)| !p.alone.is_empty()) {
        let (mean_alone, error) = mean(&played.alone);
        let _ = write!(out, "| {} | {mean_alone:.2} ± {error:.2} |", scene.name);
        for lost in played.lost.iter().flatten() {
            let (mean, error) = mean(lost);
            let _ = write!(out, " {mean:.2} ± {error:.2} |");
        }
        out.push_str("\n| | |");
        for lost in played.lost.iter().flatten() {
            let pairs = lost.iter().zip(&played.alone);
            let (mean, error) = mean(&pairs.map(|(a, b)| a - b).collect::<Vec<_>>());
            let _ = write!(out, " {mean:+.3} ± {error:.3} |");
        }
        out.push('\n');
    }
    out.push('\n');
}

/// The whole page.
pub fn page(played: &[(Scene, Played)]) -> String {
    let mut out = format!(
        "# Three physics engines\n\nThe same bodies, strikers and speeds in Rapier 0.36 (`frangible-rapier`, which undoes the step of a break and takes it \
         again) and in Avian 0.7\n(`bevy_frangible`, which asks before the contacts are solved), 240 steps per second, {SEEDS} seeds each: means with \
         their standard errors. The\nfracture is the same library in both, and so are the velocities after a blow. What differs is where and when an \
         engine says that bodies touch, and\nhow the pieces meet each other and anything else afterwards. Made by `cargo run --release --example engines -- --write` in \
         `bevy_frangible`.\nThe third engine is [Bullet](#bullet), at the end.\n\n",
    );
    losses(&mut out, played);
    for (s, outcomes) in played {
        scene(&mut out, s, outcomes);
    }
    out.push_str("## Momentum and energy over a break\n\n| | Rapier | Avian |\n|---|---|---|\n");
    let [(p, e), (q, f)] = [0, 1].map(|engine| conservation(played, engine));
    let _ = writeln!(
        out,
        "| largest change of momentum of ball and pane, relative | {p:.1e} | {q:.1e} |\n| largest gain of kinetic energy and the cracks' \
         together, relative (negative: always a loss) | {e:.1e} | {f:.1e} |"
    );
    out
}
