//! Breaks of scenes, seed after seed, and how two such lists differ: what a change of rounding, or of a sampling, is judged by.
//!
//! The blow is that of a scene's first break; only the seed of the weak points and of the cracks' roughness changes.
//!
//!     cargo run --release -p frangible-scenes --example statistics -- 100 glass pane plate bowl brick > before.txt
//!     …                                                                                              > after.txt
//!     cargo run --release -p frangible-scenes --example statistics -- compare before.txt after.txt
//!
//!     cargo run --release -p frangible-scenes --example statistics -- resolutions 12500,25000,50000 50 glass pane
//!
//! The last prints a table of the outcomes on fracture meshes of these numbers of tetrahedra, with the modes that the finest of them follows.
//!
//! With `followed N` before the number of seeds the bodies' motion is followed by their lowest N modes, not by as many as their bake found to be
//! enough.
//!
//! Pairs are marked whose means differ by more than two standard errors of their difference, or that Kolmogorov and Smirnov's test takes
//! for one distribution at less than 1 %. Of twenty-five pairs of equal samples one is marked by chance.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use frangible::{ImpactReport, Outcome, impact};
use frangible_scenes::{BodySource, Scene, bake, breakable, first_break, read_scene, scene};

/// Figures of each break that are compared, in the order of the columns; a list with others names them in a line that begins with `#`.
const COLUMNS: [&str; 8] = [
    "pieces",
    "crack area, m²",
    "largest piece's share",
    "second piece's share",
    "first crack, s",
    "cracks",
    "crack over strain energy",
    "time, ms",
];

/// Samples differ if chance explains them less often than this, or if their means are this many standard errors apart.
const LEAST_P: f64 = 0.01;
const MOST_ERRORS: f64 = 2.0;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["compare", before, after] => compare(before, after),
        ["followed", modes, seeds, ref scenes @ ..] if !scenes.is_empty() => {
            list_all(scenes, seeds, Some(modes.parse()?))
        }
        ["resolutions", numbers, seeds, ref scenes @ ..] if !scenes.is_empty() => {
            let numbers: Result<Vec<usize>, _> = numbers.split(',').map(str::parse).collect();
            let (numbers, seeds) = (numbers?, seeds.parse()?);
            println!("{RESOLUTION_COLUMNS}");
            scenes
                .iter()
                .try_for_each(|name| resolutions(name, &numbers, seeds))
        }
        [seeds, ref scenes @ ..] if !scenes.is_empty() => list_all(scenes, seeds, None),
        _ => Err(
            "statistics [followed N] SEEDS SCENE|FILE.toml… | statistics resolutions N,N… SEEDS SCENE… | statistics compare BEFORE AFTER"
                .into(),
        ),
    }
}

fn list_all(scenes: &[&str], seeds: &str, followed: Option<usize>) -> Result<(), Box<dyn Error>> {
    let seeds = seeds.parse()?;
    let mut scenes = scenes.iter();
    scenes.try_for_each(|name| list(name, seeds, followed))
}

/// Figures of a break.
struct Row {
    /// Number of pieces, the first of [`COLUMNS`].
    pieces: usize,
    /// Shares of the volume, largest first.
    shares: Vec<f64>,
    report: ImpactReport,
    /// Duration of the computation, s.
    seconds: f64,
}

/// Bakes a scene and breaks its first body that breaks, once per seed. Returns the number of tetrahedra and of the modes that are followed.
fn each(
    scene: &Scene,
    seeds: u64,
    mut row: impl FnMut(u64, Row),
) -> Result<[usize; 2], Box<dyn Error>> {
    let bodies = bake(scene)?;
    let first = first_break(scene, &bodies, &mut |_| {})?.ok_or("nothing breaks")?;
    let number = scene.bodies.iter().position(|b| b.name == first.name);
    let spec = &scene.bodies[number.unwrap_or(0)];
    let asset = first.body.asset();
    let kind = breakable(spec, &Arc::clone(asset))?;
    for seed in 1..=seeds {
        let body = kind.body(seed);
        let begun = Instant::now();
        let outcome = impact(&body, &first.contacts, &first.config)?;
        let seconds = begun.elapsed().as_secs_f64();
        let (mut pieces, mut shares) = (1, vec![1.0, 0.0]);
        if let Outcome::Broke(fracture) = &outcome {
            pieces = fracture.fragments.len();
            shares = fracture.fragments.iter().map(|f| f.mass.volume).collect();
            shares.sort_unstable_by(|a, b| b.total_cmp(a));
            let all: f64 = shares.iter().sum();
            shares.iter_mut().for_each(|share| *share /= all);
        }
        let report = outcome.report().clone();
        row(
            seed,
            Row {
                pieces,
                shares,
                report,
                seconds,
            },
        );
    }
    Ok([asset.fracture().tets.len(), asset.modes().followed()])
}

/// A built-in scene, or that of a file.
fn scene_of(name: &str) -> Result<Scene, Box<dyn Error>> {
    Ok(match name.ends_with(".toml") {
        true => read_scene(Path::new(name))?,
        false => scene(name)?,
    })
}

/// Sets the number of followed modes of all bodies.
fn follow(scene: &mut Scene, modes: usize) {
    let bodies = scene.bodies.iter_mut();
    bodies.for_each(|body| body.followed = Some(modes.min(body.modes)));
}

/// Prints a line per break of a scene.
fn list(name: &str, seeds: u64, followed: Option<usize>) -> Result<(), Box<dyn Error>> {
    let mut scene = scene_of(name)?;
    if let Some(modes) = followed {
        follow(&mut scene, modes);
    }
    each(&scene, seeds, |seed, row| {
        let Row {
            pieces,
            shares,
            report,
            seconds,
        } = row;
        println!(
            "{name} {seed} {pieces} {:.6e} {:.6} {:.6} {:.6e} {} {:.4} {:.2}",
            report.crack_area,
            shares[0],
            shares.get(1).unwrap_or(&0.0),
            report.first_crack_time.unwrap_or(0.0),
            report.cracks,
            report.fracture_energy / report.peak_strain_energy,
            1e3 * seconds,
        );
    })?;
    Ok(())
}

/// Pieces of fewer tetrahedra of the coarsest mesh are not counted on any mesh.
const COUNTED: f64 = 30.0;

const RESOLUTION_COLUMNS: &str =
    "| scene | tetrahedra | pieces | largest piece | crack area, cm² | first crack, µs | time, ms |
| --- | ---: | ---: | ---: | ---: | ---: | ---: |";

/// Prints the outcomes of a scene on fracture meshes of these numbers of tetrahedra, coarsest first, with the modes that the finest follows.
/// Marks what differs from the finest by more than two standard errors.
fn resolutions(name: &str, numbers: &[usize], seeds: u64) -> Result<(), Box<dyn Error>> {
    let mut lines: Vec<(usize, [Vec<f64>; 5])> = Vec::new();
    let mut followed = None;
    let mut smallest = 0.0;
    let coarsest = *numbers.first().ok_or("no resolution")?;
    for &number in numbers.iter().rev() {
        let mut scene = scene_of(name)?;
        if let Some(modes) = followed {
            follow(&mut scene, modes);
        }
        for body in &mut scene.bodies {
            match &mut body.source {
                BodySource::Shape(_) => body.resolution = Some(number),
                BodySource::Ready { resolution, .. } | BodySource::Mesh { resolution, .. } => {
                    *resolution = Some(number);
                }
                BodySource::Asset(_) => return Err(format!("{name}: a baked body").into()),
            }
        }
        smallest = COUNTED / coarsest as f64;
        let mut columns: [Vec<f64>; 5] = Default::default();
        let [tets, modes] = each(&scene, seeds, |_, row| {
            let pieces = row.shares.iter().filter(|&&share| share > smallest).count();
            let figures = [
                pieces.max(1) as f64,
                row.shares[0],
                1e4 * row.report.crack_area,
                1e6 * row.report.first_crack_time.unwrap_or(f64::NAN),
                1e3 * row.seconds,
            ];
            let columns = columns.iter_mut().zip(figures);
            columns.for_each(|(column, figure)| column.push(figure));
        })?;
        // A body that holds has no first crack.
        columns[3].retain(|time| time.is_finite());
        followed = followed.or(Some(modes));
        lines.push((tets, columns));
    }
    let finest = lines[0].1.clone();
    for (tets, columns) in lines.iter().rev() {
        let cells = columns.iter().zip(&finest).map(|(column, finest)| {
            let ((value, error), (last, least)) = (mean(column), mean(finest));
            let apart = (value - last).abs() > MOST_ERRORS * error.hypot(least);
            let mark = if apart { " \\*" } else { "" };
            format!("{} ± {}{mark}", rounded(value), rounded(error))
        });
        let cells: Vec<String> = cells.collect();
        println!("| {name} | {tets} | {} |", cells.join(" | "));
    }
    eprintln!(
        "{name}: {} modes; counted are pieces above {:.2} % of the volume",
        followed.unwrap_or(0),
        100.0 * smallest
    );
    Ok(())
}

/// Three digits.
fn rounded(x: f64) -> String {
    match x.abs() {
        x if x < 0.01 => format!("{x:.4}"),
        x if x < 1.0 => format!("{x:.3}"),
        x if x < 10.0 => format!("{x:.2}"),
        x if x < 100.0 => format!("{x:.1}"),
        _ => format!("{x:.0}"),
    }
}

/// Columns of each scene.
type Scenes = BTreeMap<String, Vec<Vec<f64>>>;

/// Reads a list: the names of its columns, and these.
fn read(path: &str) -> Result<(Vec<String>, Scenes), Box<dyn Error>> {
    let mut scenes = Scenes::new();
    let mut names: Vec<String> = COLUMNS.map(String::from).to_vec();
    for line in std::fs::read_to_string(path)?.lines() {
        if let Some(own) = line.strip_prefix('#') {
            names = own.split(';').map(|name| name.trim().into()).collect();
            continue;
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        let [name, _, ref numbers @ ..] = words[..] else {
            continue;
        };
        let columns = scenes.entry(name.into()).or_default();
        columns.resize(names.len(), Vec::new());
        for (column, number) in columns.iter_mut().zip(numbers) {
            column.push(number.parse()?);
        }
    }
    Ok((names, scenes))
}

fn compare(before: &str, after: &str) -> Result<(), Box<dyn Error>> {
    let ((names, before), (_, after)) = (read(before)?, read(after)?);
    let (mut pairs, mut differ) = (0, 0);
    println!(
        "| scene | | before | after | standard errors apart | p |\n| --- | --- | ---: | ---: | ---: | ---: |"
    );
    for (name, columns) in &before {
        let Some(others) = after.get(name) else {
            continue;
        };
        for ((what, a), b) in names.iter().zip(columns).zip(others) {
            let [(mean_a, error_a), (mean_b, error_b)] = [a, b].map(|x| mean(x));
            let apart = (mean_b - mean_a).abs() / error_a.hypot(error_b).max(f64::MIN_POSITIVE);
            let p = kolmogorov_smirnov(a, b);
            let marked = apart > MOST_ERRORS || p < LEAST_P;
            (pairs, differ) = (pairs + 1, differ + usize::from(marked));
            let mark = if marked { " ←" } else { "" };
            println!(
                "| {name} × {} | {what} | {mean_a:.4e} ± {error_a:.0e} | {mean_b:.4e} | {apart:.2} | {p:.3}{mark} |",
                b.len()
            );
        }
    }
    println!("\n{differ} of {pairs} pairs differ.");
    Ok(())
}

/// Mean and its standard error.
fn mean(sample: &[f64]) -> (f64, f64) {
    let n = sample.len() as f64;
    let mean = sample.iter().sum::<f64>() / n;
    let squares: f64 = sample.iter().map(|x| (x - mean).powi(2)).sum();
    (mean, (squares / (n - 1.0).max(1.0) / n).sqrt())
}

/// Chance that two samples of one distribution differ as much: Kolmogorov's limit with Stephens' correction for small samples.
fn kolmogorov_smirnov(a: &[f64], b: &[f64]) -> f64 {
    let share = |sample: &[f64], x: f64| {
        sample.iter().filter(|&&y| y <= x).count() as f64 / sample.len() as f64
    };
    let places = a.iter().chain(b);
    let apart = places.map(|&x| (share(a, x) - share(b, x)).abs());
    let most = apart.fold(0.0, f64::max);
    let (n, m) = (a.len() as f64, b.len() as f64);
    let size = (n * m / (n + m)).sqrt();
    let x = (size + 0.12 + 0.11 / size) * most;
    if x < 0.2 {
        return 1.0;
    }
    let terms = (1..=100).map(|k| {
        let k = f64::from(k);
        (-1.0_f64).powf(k - 1.0) * (-2.0 * k * k * x * x).exp()
    });
    (2.0 * terms.sum::<f64>()).clamp(0.0, 1.0)
}
