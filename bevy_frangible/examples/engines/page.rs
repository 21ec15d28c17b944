//! Page that shows the outcomes of the scenes.

use std::fmt::Write;

use crate::scenes::{Break, Outcome, Scene};
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
        let values: Vec<f64> = played[k].iter().filter_map(&of).collect();
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
    let count = |k: usize| breaks(&played[k]).count();
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
        row(out, "what it has lost, m/s", played, |o| {
            Some(f64::from((before - o.striker).dot(direction)))
        });
    }
    let pairs = played[0].iter().zip(&played[1]);
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
        for b in breaks(&outcomes[engine]) {
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

/// The whole page.
pub fn page(played: &[(Scene, Played)]) -> String {
    let mut out = String::from(
        "# Three physics engines\n\nThe same bodies, strikers and speeds in Rapier 0.36 (`frangible-rapier`, which undoes the step of a break and takes it \
         again) and in Avian 0.7\n(`bevy_frangible`, which asks before the contacts are solved), 240 steps per second, a hundred seeds each: means with \
         their standard errors. The\nfracture is the same library in both; what differs is where and when an engine says that bodies touch, \
         and how the pieces meet the striker\nafterwards. Made by `cargo run --release --example engines -- --write` in `bevy_frangible`. The third \
         engine is [Bullet](#bullet), at the end.\n\n",
    );
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
