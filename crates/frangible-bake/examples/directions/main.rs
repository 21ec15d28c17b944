//! Directions of cracks in a pane, and the bias that the mesh gives them.
//!
//!     cargo run --release -p frangible-bake --example directions -- hit SEEDS SPEED [OPTION=VALUE…]
//!     cargo run --release -p frangible-bake --example directions -- single [OPTION=VALUE…]
//!
//! `hit`: a square pane of glass is hit in its middle by a steel ball, seed after seed. It prints the directions of all crack area in twelve
//! parts of a half turn (1 is an equal share), and how they lie about the square's axes: means of the cosine and sine of twice and four times
//! the angle. By the symmetries of the square all but the cosine of four times the angle must vanish, and the parts that they
//! carry into each other must be equal (χ² of 9 degrees of freedom).
//!
//! `single`: one crack starts in the middle of the pane under a tension or a bending that is the same everywhere, at 0, 15, … 90° to the side
//! of the pane: how far its path turns from where it should run, and how fast it runs.
//!
//! Options: `mesh` (seed of the fracture mesh), `tets` (how many, about), `modes`, `after` (seeds begin
//! after this one), `spot` (the ball hits up to so far from the middle, m), `bend` (1: bending instead of tension), `round` (1: a round plate), `file`
//! (1: a mesh as from a file, in layers along one of its faces), `turned` (degrees by which the pane of a file is turned against the axes), `list` (1:
//! a line per break instead, which `statistics compare` of `frangible-scenes` compares with those on another mesh).

mod cuts;
mod pane;
mod single;

use std::collections::BTreeMap;
use std::error::Error;
use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::{Fields, impact_traced};
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Striker};
use rayon::prelude::*;

use cuts::cuts;
use pane::pane;
use single::single;

/// Sides of the pane, m.
const SIDE: f64 = 0.4;
const THICKNESS: f64 = 0.004;

/// Parts of a half turn.
const PARTS: usize = 12;

/// Parts that the symmetries of the square carry into each other.
const SQUARE: [&[usize]; 3] = [&[0, 5, 6, 11], &[1, 4, 7, 10], &[2, 3, 8, 9]];
/// Parts that the symmetries of a round plate carry into each other.
const CIRCLE: [&[usize]; 1] = [&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]];

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["hit", seeds, speed, ref options @ ..] => {
            hit(seeds.parse()?, speed.parse()?, &Options::of(options)?)
        }
        ["single", ref options @ ..] => single(&Options::of(options)?),
        _ => Err(
            "directions hit SEEDS SPEED [OPTION=VALUE…] | directions single [OPTION=VALUE…]".into(),
        ),
    }
}

/// Numbers by name.
struct Options(BTreeMap<String, f64>);

impl Options {
    fn of(words: &[&str]) -> Result<Self> {
        let pair = |word: &&str| -> Result<(String, f64)> {
            let (name, value) = word.split_once('=').ok_or("an option is NAME=VALUE")?;
            Ok((name.into(), value.parse()?))
        };
        Ok(Self(words.iter().map(pair).collect::<Result<_>>()?))
    }

    fn get(&self, name: &str, usual: f64) -> f64 {
        self.0.get(name).copied().unwrap_or(usual)
    }
}

/// Crack directions of one break.
struct Break {
    parts: [f64; PARTS],
    /// Σ area times the cosine and sine of twice and four times the angle, m².
    moments: [f64; 4],
    area: f64,
    cracks: f64,
    pieces: f64,
}

/// Breaks a pane once per seed.
fn breaks(asset: &Arc<Asset>, seeds: u64, speed: f64, options: &Options) -> Result<Vec<Break>> {
    let turned = options.get("turned", 0.0).to_radians();
    let fields = Fields::of_material(asset.material());
    let kind = Breakable::new(Arc::clone(asset))?.with_fields(fields)?;
    let steel = Material::preset("steel")?;
    let config = FractureConfig::default();
    let spot = options.get("spot", 0.0);
    let first = options.get("after", 0.0) as u64;
    Ok((1..=seeds)
        .into_par_iter()
        .map(|seed| {
            let seed = seed + first;
            let body = kind.body(seed);
            // Two sequences that fill a square evenly.
            let off = |share: f64| (spot * (2.0 * (seed as f64 * share).fract() - 1.0)) as f32;
            let at = Vec3::new(off(0.754_877_67), off(0.569_840_29), 0.5 * THICKNESS as f32);
            let striker = Striker::ball(&steel, 0.25, 0.02);
            let contact = Contact::collision(asset, at, Vec3::NEG_Z, speed, striker);
            let (outcome, trace) = impact_traced(&body, &[contact], &config).expect("a blow");
            let mut parts = [0.0; PARTS];
            let (mut moments, mut area) = ([0.0; 4], 0.0);
            for cut in cuts(asset, &trace) {
                let angle = (cut.angle - turned).rem_euclid(std::f64::consts::PI);
                let part = (angle / std::f64::consts::PI * PARTS as f64) as usize;
                parts[part.min(PARTS - 1)] += cut.area;
                let (two, four) = ((2.0 * angle).sin_cos(), (4.0 * angle).sin_cos());
                for (sum, of) in moments.iter_mut().zip([two.1, two.0, four.1, four.0]) {
                    *sum += cut.area * of;
                }
                area += cut.area;
            }
            let pieces = match outcome {
                frangible::Outcome::Broke(fracture) => fracture.fragments.len() as f64,
                _ => 1.0,
            };
            Break {
                parts,
                moments,
                area,
                cracks: trace.cracks.len() as f64,
                pieces,
            }
        })
        .collect())
}

fn hit(seeds: u64, speed: f64, options: &Options) -> Result<()> {
    let asset = Arc::new(pane(options)?);
    let breaks = breaks(&asset, seeds, speed, options)?;
    if options.get("list", 0.0) > 0.0 {
        println!("# pieces; crack area, m²; cos 2; sin 2; cos 4; sin 4");
        for (seed, b) in (1..).zip(&breaks) {
            let moments = b
                .moments
                .map(|m| format!("{:.5}", m / b.area.max(f64::MIN_POSITIVE)));
            println!(
                "pane {seed} {} {:.6e} {}",
                b.pieces,
                b.area,
                moments.join(" ")
            );
        }
        return Ok(());
    }
    let areas: Vec<f64> = breaks.iter().map(|b| b.area).collect();
    println!(
        "{} breaks at {speed} m/s, {} tetrahedra: pieces {:.1}, cracks {:.1}, area {:.4} m²",
        seeds,
        asset.fracture().tets.len(),
        mean(breaks.iter().map(|b| b.pieces)),
        mean(breaks.iter().map(|b| b.cracks)),
        mean(areas.iter().copied()),
    );
    let parts = shares(&breaks, &areas);
    for (k, (share, error)) in parts.iter().enumerate() {
        println!("{:4}–{:3}°  {share:.2} ± {error:.2}", 15 * k, 15 * (k + 1));
    }
    let (squares, freedom) = asymmetry(&parts, options);
    println!("χ² {squares:.1} of {freedom}");
    for (k, name) in ["cos 2", "sin 2", "cos 4", "sin 4"].iter().enumerate() {
        let (value, error) = ratio(breaks.iter().map(|b| b.moments[k]), &areas);
        println!("{name}: {value:+.3} ± {error:.3}");
    }
    Ok(())
}

/// Shares of the crack area by direction, 1 for an equal share, and their standard errors.
fn shares(breaks: &[Break], areas: &[f64]) -> [(f64, f64); PARTS] {
    std::array::from_fn(|k| {
        let (share, error) = ratio(breaks.iter().map(|b| b.parts[k]), areas);
        (PARTS as f64 * share, PARTS as f64 * error)
    })
}

/// χ² of the shares about the symmetries of the pane, and its degrees of freedom.
fn asymmetry(parts: &[(f64, f64); PARTS], options: &Options) -> (f64, usize) {
    let alike: &[&[usize]] = match options.get("round", 0.0) > 0.0 {
        true => &CIRCLE,
        false => &SQUARE,
    };
    let squares = alike.iter().map(|alike| {
        let weight = |k: usize| parts[k].1.max(1e-3).powi(-2);
        let all: f64 = alike.iter().map(|&k| weight(k)).sum();
        let middle = alike.iter().map(|&k| weight(k) * parts[k].0).sum::<f64>() / all;
        let squares = alike
            .iter()
            .map(|&k| weight(k) * (parts[k].0 - middle).powi(2));
        squares.sum::<f64>()
    });
    (squares.sum(), PARTS - alike.len())
}

fn mean(numbers: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = numbers.len() as f64;
    numbers.sum::<f64>() / count
}

/// The ratio of two sums, and its standard error.
fn ratio(parts: impl Iterator<Item = f64>, wholes: &[f64]) -> (f64, f64) {
    let parts: Vec<f64> = parts.collect();
    let whole: f64 = wholes.iter().sum();
    let ratio = parts.iter().sum::<f64>() / whole;
    let squares = parts
        .iter()
        .zip(wholes)
        .map(|(p, w)| (p - ratio * w).powi(2));
    (ratio, squares.sum::<f64>().sqrt() / whole)
}
