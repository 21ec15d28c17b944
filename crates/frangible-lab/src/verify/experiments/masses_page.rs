//! Part of the page on the masses of the pieces.

use std::fmt::Write;

use super::masses::{LEAST, MassRun, Masses};
use super::page::{Figure, apart, with_error};
use crate::page::table;
use crate::plot::{Axis, Chart, Marker, Series};

/// Points along a curve of the chart.
const POINTS: i32 = 24;

pub(crate) fn figures(masses: &Masses) -> Vec<Figure> {
    let mut figures = Vec::new();
    for run in &masses.runs {
        if let Some(law) = run.law {
            figures.push(Figure {
                name: format!("masses, {}: exponent τ", run.name),
                value: law.exponent,
                error: law.exponent_error,
                published: run.published.first().map(|p| p.exponent),
            });
        }
    }
    figures
}

pub(crate) fn text(masses: &Masses, folder: &str) -> String {
    let crumb = frangible::FractureConfig::default().crumb_share;
    let mut text = format!(
        "## Masses of the pieces\n\nBroken with the default model, {} of each kind, which differ in their weak points:\n\n",
        masses.plan.seeds
    );
    for run in &masses.runs {
        let _ = writeln!(text, "- *{}*: {};", run.name, run.about);
    }
    let _ = write!(
        text,
        "\nThe law N(> m) ∝ m^−(τ−1) exp(−m/m₀), a power law with an exponential cut-off, by maximum likelihood. All pieces above {LEAST} \
         crumb limits count, {:.0e} of the body's mass (below the limit pieces join their neighbours, as far as these let them), but not the largest of each body, \
         which is what the others leave. The pieces of a body depend on each other: the standard error is from the spread between bodies. \
         *Distance*: the largest difference between the counted and the fitted share of heavier pieces; below 1.36/√n a sample of n independent pieces \
         would not tell the two apart.\n\n",
        LEAST * crumb
    );
    text += &results(masses);
    text.push('\n');
    for run in &masses.runs {
        text += &comparison(run);
    }
    let _ = write!(
        text,
        "\n![Masses of the pieces]({folder}/masses.png)\n\nMean number of pieces per body that are heavier than a mass, without the largest piece, and \
         the fitted laws.\n"
    );
    text + REFERENCES
}

const REFERENCES: &str = "\nReferences: J. A. Åström, R. P. Linna, J. Timonen, P. F. Møller, L. Oddershede, Phys. Rev. E 70, 026104 (2004): \
    τ = (2D − 1)/D from cracks that branch and merge, with an exponential part, and gypsum discs; R. P. Linna, J. A. Åström, J. Timonen, Phys. Rev. E 72, 015601 \
    (2005): about 1.17 for plates that break in space; L. Oddershede, P. Dimon, J. Bohr, Phys. Rev. Lett. 71, 3107 (1993): the exponent depends on the \
    body's shape, not on its material. All were read in their abstracts. Both laws are of violent breaks, with many more pieces than here.\n";

fn results(masses: &Masses) -> String {
    let head = [
        "body",
        "broke",
        "pieces (median)",
        "largest (median)",
        "counted",
        "τ",
        "m₀",
        "distance",
        "1.36/√n",
    ]
    .map(String::from);
    let row = |run: &MassRun| {
        let pieces = median(run.masses.iter().map(|m| m.len() as f64).collect());
        let largest = median(run.masses.iter().map(|m| m[0]).collect());
        let mut cells = vec![
            run.name.to_string(),
            format!("{} of {}", run.masses.len(), run.hit),
            pieces.to_string(),
            format!("{:.0} %", 100.0 * largest),
        ];
        cells.extend(run.law.map_or_else(
            || vec!["–".to_string(); 5],
            |law| {
                let cut_off = if law.cut_off.is_finite() {
                    format!("{:.1e}", law.cut_off)
                } else {
                    "none".into()
                };
                vec![
                    law.masses.to_string(),
                    with_error(law.exponent, law.exponent_error),
                    cut_off,
                    format!("{:.3}", law.distance),
                    format!("{:.3}", 1.36 / (law.masses as f64).sqrt()),
                ]
            },
        ));
        cells
    };
    let rows: Vec<Vec<String>> = masses.runs.iter().map(row).collect();
    table(&head, &rows)
}

/// The middle of some numbers; of none, zero.
fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let n = numbers.len();
    match n {
        0 => 0.0,
        _ if n % 2 == 1 => numbers[n / 2],
        _ => 0.5 * (numbers[n / 2 - 1] + numbers[n / 2]),
    }
}

fn comparison(run: &MassRun) -> String {
    let Some(law) = run.law else {
        return format!("- {}: too few pieces for a fit.\n", run.name);
    };
    let mut text = String::new();
    for published in run.published {
        let _ = writeln!(
            text,
            "- {}: τ is {} {:.2}: {}.",
            run.name,
            apart(law.exponent, law.exponent_error, published.exponent),
            published.exponent,
            published.source
        );
    }
    text
}

/// Pieces per body heavier than some masses, without the largest of each.
fn heavier(run: &MassRun) -> Vec<(f64, f64)> {
    let mut all: Vec<f64> = run.masses.iter().flat_map(|m| &m[1..]).copied().collect();
    all.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (all.first(), all.last()) else {
        return Vec::new();
    };
    let mass = |k: i32| first * (last / first).powf(f64::from(k) / f64::from(POINTS));
    (0..POINTS)
        .map(|k| {
            let above = all.len() - all.partition_point(|m| *m <= mass(k));
            (mass(k), above as f64 / run.masses.len() as f64)
        })
        .collect()
}

/// The fitted law, scaled to the pieces per body that it was fitted to.
fn fitted(run: &MassRun) -> Vec<(f64, f64)> {
    let Some(law) = run.law else {
        return Vec::new();
    };
    let per_body = law.masses as f64 / run.masses.len() as f64;
    let last = heavier(run).last().map_or(law.least, |p| p.0);
    (0..=POINTS)
        .map(|k| {
            let mass = law.least * (last / law.least).powf(f64::from(k) / f64::from(POINTS));
            (mass, per_body * law.share_above(mass))
        })
        .collect()
}

pub(crate) fn chart(masses: &Masses) -> Chart {
    let mut series = Vec::new();
    for (run, marker) in masses.runs.iter().zip([Marker::Square, Marker::Disc]) {
        series.push(Series {
            name: run.name.into(),
            points: heavier(run),
            marker,
            line: false,
        });
        series.push(Series {
            name: format!("{}, fitted", run.name),
            points: fitted(run),
            marker: Marker::Nothing,
            line: true,
        });
    }
    Chart {
        title: "Pieces heavier than a mass".into(),
        x: Axis::log("mass (masses of the body)"),
        y: Axis::log("pieces per body"),
        series,
    }
}
