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
//! Options: `mesh` (seed of the fracture mesh), `tets` (how many, about), `modes`, `speed` (of cracks over the Rayleigh speed), `after` (seeds begin after this one), `spot` (the ball hits up to so far from the middle, m), `bend` (1:
//! bending instead of tension).

use std::collections::BTreeMap;
use std::error::Error;
use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::modal::Motion;
use frangible::internals::{
    CrackTiming, CrackTrace, Factors, Fields, follow_traced, impact_traced,
};
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeSpec, Shape, bake};
use rayon::prelude::*;

/// Sides of the pane, m.
const SIDE: f64 = 0.4;
const THICKNESS: f64 = 0.004;

/// Parts of a half turn.
const PARTS: usize = 12;

/// Parts that the symmetries of the square carry into each other.
const ALIKE: [[usize; 4]; 3] = [[0, 5, 6, 11], [1, 4, 7, 10], [2, 3, 8, 9]];

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

fn pane(options: &Options) -> Result<Asset> {
    let shape = Shape::plate(SIDE, SIDE, THICKNESS);
    let mut spec = BakeSpec::new("pane", shape, Material::preset("glass")?);
    spec.seed = options.get("mesh", 1.0) as u64;
    spec.modes = options.get("modes", 60.0) as usize;
    if let Some(&tets) = options.0.get("tets") {
        spec.fracture = Some(spec.shape.size_for(tets)?);
    }
    Ok(bake(&spec, &mut |_| {})?.0)
}

/// One cut of a crack through a tetrahedron.
struct Cut {
    /// Area, m².
    area: f64,
    /// Direction of its trace in the plane of the pane, rad, 0 to π.
    angle: f64,
    /// Middle of the cut, m.
    middle: Vec3,
    /// Time of the cut, s.
    time: f64,
}

/// All cuts of a trace.
fn cuts<'a>(asset: &'a Asset, trace: &'a CrackTrace) -> impl Iterator<Item = Cut> + 'a {
    trace.cracks.iter().flatten().filter_map(|element| {
        let x = asset.fracture.corners(element.tet as usize);
        let s = element.values;
        let mut points = Vec::new();
        for (i, j) in [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)] {
            if (s[i] < 0.0) != (s[j] < 0.0) {
                points.push(x[i] + (x[j] - x[i]) * (s[i] / (s[i] - s[j])));
            }
        }
        let middle = points.iter().sum::<Vec3>() / points.len().max(1) as f32;
        let edges = [1, 2, 3].map(|k| x[k] - x[0]);
        let [a, b, c] = edges;
        let normal =
            (b.cross(c) * (s[1] - s[0]) + c.cross(a) * (s[2] - s[0]) + a.cross(b) * (s[3] - s[0]))
                .try_normalize()?;
        let normal = if a.cross(b).dot(c) < 0.0 {
            -normal
        } else {
            normal
        };
        // The area of a convex polygon whose corners come in any order: by the angle about its middle.
        let u = normal.any_orthonormal_vector();
        let v = normal.cross(u);
        let turn = |p: &Vec3| (*p - middle).dot(v).atan2((*p - middle).dot(u));
        points.sort_by(|p, q| turn(p).total_cmp(&turn(q)));
        let area: f32 = (0..points.len())
            .map(|k| {
                (points[k] - middle)
                    .cross(points[(k + 1) % points.len()] - middle)
                    .dot(normal)
            })
            .sum();
        let angle = f64::from((-normal.x).atan2(normal.y)).rem_euclid(std::f64::consts::PI);
        Some(Cut {
            area: 0.5 * f64::from(area.abs()),
            angle,
            middle,
            time: element.time,
        })
    })
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

fn hit(seeds: u64, speed: f64, options: &Options) -> Result<()> {
    let asset = Arc::new(pane(options)?);
    let fields = Fields::of_material(&asset.material);
    let kind = Breakable::new(Arc::clone(&asset))?.with_fields(fields)?;
    let steel = Material::preset("steel")?;
    let mut config = FractureConfig::default();
    if let Some(&speed) = options.0.get("speed") {
        config.timing = CrackTiming::TimeResolved { speed };
    }
    let spot = options.get("spot", 0.0);
    let first = options.get("after", 0.0) as u64;
    let breaks: Vec<Break> = (1..=seeds)
        .into_par_iter()
        .map(|seed| {
            let seed = seed + first;
            let body = kind.body(seed);
            // Two sequences that fill a square evenly.
            let off = |share: f64| (spot * (2.0 * (seed as f64 * share).fract() - 1.0)) as f32;
            let at = Vec3::new(off(0.754_877_67), off(0.569_840_29), 0.5 * THICKNESS as f32);
            let striker = Striker::ball(&steel, 0.25, 0.02);
            let contact = Contact::collision(&asset, at, Vec3::NEG_Z, speed, striker);
            let (outcome, trace) = impact_traced(&body, &[contact], &config).expect("a blow");
            let mut parts = [0.0; PARTS];
            let (mut moments, mut area) = ([0.0; 4], 0.0);
            for cut in cuts(&asset, &trace) {
                let part = (cut.angle / std::f64::consts::PI * PARTS as f64) as usize;
                parts[part.min(PARTS - 1)] += cut.area;
                let (two, four) = ((2.0 * cut.angle).sin_cos(), (4.0 * cut.angle).sin_cos());
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
        .collect();
    let areas: Vec<f64> = breaks.iter().map(|b| b.area).collect();
    println!(
        "{} breaks at {speed} m/s, {} tetrahedra: pieces {:.1}, cracks {:.1}, area {:.4} m²",
        seeds,
        asset.fracture.tets.len(),
        mean(breaks.iter().map(|b| b.pieces)),
        mean(breaks.iter().map(|b| b.cracks)),
        mean(areas.iter().copied()),
    );
    let parts: [(f64, f64); PARTS] = std::array::from_fn(|k| {
        let (share, error) = ratio(breaks.iter().map(|b| b.parts[k]), &areas);
        (PARTS as f64 * share, PARTS as f64 * error)
    });
    for (k, (share, error)) in parts.iter().enumerate() {
        println!("{:4}–{:3}°  {share:.2} ± {error:.2}", 15 * k, 15 * (k + 1));
    }
    let mut squares = 0.0;
    for alike in ALIKE {
        let weight = |k: usize| parts[k].1.max(1e-3).powi(-2);
        let all: f64 = alike.iter().map(|&k| weight(k)).sum();
        let middle = alike.iter().map(|&k| weight(k) * parts[k].0).sum::<f64>() / all;
        squares += alike
            .iter()
            .map(|&k| weight(k) * (parts[k].0 - middle).powi(2))
            .sum::<f64>();
        println!(
            "folded {:3}–{:2}°  {middle:.2} ± {:.2}",
            15 * alike[0],
            15 * (alike[0] + 1),
            all.powf(-0.5)
        );
    }
    println!("χ² {squares:.1} of 9");
    for (k, name) in ["cos 2", "sin 2", "cos 4", "sin 4"].iter().enumerate() {
        let (value, error) = ratio(breaks.iter().map(|b| b.moments[k]), &areas);
        println!("{name}: {value:+.3} ± {error:.3}");
    }
    Ok(())
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

/// The pane with six motions of its own in place of its modes: stretched along x, along y and sheared, and bent the same ways, each by the
/// same strain of its face.
fn uniform(mut asset: Asset) -> Asset {
    let half = 0.5 * THICKNESS as f32;
    let shapes = |p: Vec3| {
        let (x, y, z) = (p.x, p.y, p.z);
        let stretch = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.5 * y, 0.5 * x, 0.0]];
        let bend = [
            [x * z, 0.0, -0.5 * x * x],
            [0.0, y * z, -0.5 * y * y],
            [0.5 * y * z, 0.5 * x * z, -0.5 * x * y],
        ];
        (stretch, bend.map(|u| u.map(|c| c / half)))
    };
    asset.modes.shapes.clear();
    for &node in &asset.analysis.nodes {
        let (stretch, bend) = shapes(node);
        for axis in 0..3 {
            asset
                .modes
                .shapes
                .extend(stretch.iter().chain(&bend).map(|u| u[axis]));
        }
    }
    asset.modes.eigenvalues = vec![1e6; 6];
    asset.modes.residual_modes = 0;
    asset.modes.peak_stress = vec![0.0; 6];
    asset.bounds = Default::default();
    asset
}

fn single(options: &Options) -> Result<()> {
    let mut asset = uniform(pane(options)?);
    asset.material.roughness_amplitude = options.get("rough", 0.0);
    let asset = Arc::new(asset);
    let bends = options.get("bend", 0.0) > 0.0;
    let starts = options.get("starts", 8.0) as usize;
    let over = options.get("over", 1.5);
    let mut config = FractureConfig::default();
    (config.branching, config.energy_ledger) = (false, false);
    if options.get("planar", 0.0) > 0.0 {
        config.path = frangible::internals::CrackPath::Planar;
    }
    let material = &asset.material;
    let rayleigh = material.rayleigh_speed();
    println!(
        "angle  turned: rms, most of a path; off the line, mm in 100 mm; speed over what it should be: mean, least, most; arrival scatter"
    );
    for step in 0..=6 {
        let angle = f64::from(step) * 15.0_f64.to_radians();
        let runs: Vec<Run> = (0..starts)
            .into_par_iter()
            .flat_map_iter(|number| {
                let place = Vec3::new(
                    (0.02 * ((number as f64 * 0.754_877_67).fract() - 0.5)) as f32,
                    (0.02 * ((number as f64 * 0.569_840_29).fract() - 0.5)) as f32,
                    0.002,
                );
                run(&asset, &config, place, angle, over, bends, 0.5 * rayleigh)
            })
            .collect();
        let count = runs.len().max(1) as f64;
        let turned = (runs.iter().map(|r| r.turned.powi(2)).sum::<f64>() / count).sqrt();
        let most = runs.iter().map(|r| r.turned).fold(0.0, f64::max);
        let off = (runs.iter().map(|r| r.off.powi(2)).sum::<f64>() / count).sqrt();
        let speeds = || runs.iter().map(|r| r.speed);
        println!(
            "{:3}°   {turned:.2}° {most:.2}°   {off:.2}   {:.3} {:.3} {:.3}  {:.3}  ({} paths, {:.1} mm)",
            15 * step,
            speeds().sum::<f64>() / count,
            speeds().fold(f64::INFINITY, f64::min),
            speeds().fold(0.0, f64::max),
            runs.iter().map(|r| r.scatter).sum::<f64>() / count,
            runs.len(),
            runs.iter().map(|r| r.length).sum::<f64>() / count,
        );
    }
    Ok(())
}

/// One arm of a single crack.
struct Run {
    /// Root of the mean square of its direction against where it should run, by area, degrees.
    turned: f64,
    /// Distance of its end from the line, over the length of the path, %.
    off: f64,
    /// Speed over the one it should have.
    speed: f64,
    /// Scatter of arrival times about the straight run, in those of a mean edge.
    scatter: f64,
    /// Length, mm.
    length: f64,
}

/// Follows both arms of the crack that starts at the flaw nearest to a place, across a tension at this angle.
fn run(
    asset: &Arc<Asset>,
    config: &FractureConfig,
    place: Vec3,
    angle: f64,
    over: f64,
    bends: bool,
    speed: f64,
) -> Vec<Run> {
    let mesh = &asset.fracture;
    let near = (0..mesh.tets.len()).min_by(|&a, &b| {
        mesh.centroid(a)
            .distance(place)
            .total_cmp(&mesh.centroid(b).distance(place))
    });
    let Some(start) = near else { return Vec::new() };
    let none = Factors {
        weak_points: 0.0,
        ..Factors::ONE
    };
    let mut of_tet = vec![none; mesh.tets.len()];
    of_tet[start] = Factors {
        weak_points: 1e9,
        ..Factors::ONE
    };
    let mut fields = Fields::default();
    fields.of_tet = of_tet;
    let kind = Breakable::new(Arc::clone(asset))
        .and_then(|kind| kind.with_fields(fields))
        .expect("a pane");
    let body = kind.body(1);
    let material = &asset.material;
    // Tension σ across the crack, which runs at the angle.
    let (young, poisson) = (material.youngs_modulus, material.poisson_ratio);
    let stress = over * material.strength;
    let (along, across) = (-poisson * stress / young, stress / young);
    let (sin, cos) = angle.sin_cos();
    let strain = [
        along * cos * cos + across * sin * sin,
        along * sin * sin + across * cos * cos,
        2.0 * (along - across) * sin * cos,
    ];
    let mut q = [0.0_f32; 6];
    for (k, e) in strain.iter().enumerate() {
        q[k + 3 * usize::from(bends)] = *e as f32;
    }
    let steps = 64;
    let time_step = 0.3 / speed / steps as f64;
    let motion = Motion::new(q.repeat(steps), 6, 1e9, 1e9);
    let (_, trace) = follow_traced(&body, &motion, &[], time_step, config).expect("a motion");
    let first = cuts(asset, &trace).min_by(|a, b| a.time.total_cmp(&b.time));
    let Some(first) = first else {
        return Vec::new();
    };
    let origin = first.middle;
    let direction = Vec3::new(cos as f32, sin as f32, 0.0);
    let mut arms = Vec::new();
    for arm in [1.0_f32, -1.0] {
        let along = arm * direction;
        let own: Vec<Cut> = cuts(asset, &trace)
            .filter(|cut| (cut.middle - origin).dot(along) > 0.01)
            .collect();
        if own.is_empty() {
            continue;
        }
        let area: f64 = own.iter().map(|c| c.area).sum();
        let off_angle = |c: &Cut| {
            let turned = (c.angle - angle).rem_euclid(std::f64::consts::PI);
            turned.min(std::f64::consts::PI - turned).to_degrees()
        };
        let turned = (own
            .iter()
            .map(|c| c.area * off_angle(c).powi(2))
            .sum::<f64>()
            / area)
            .sqrt();
        let far = |c: &Cut| f64::from((c.middle - origin).dot(along));
        let last = own.iter().max_by(|a, b| far(a).total_cmp(&far(b)));
        let Some(last) = last else { continue };
        let off =
            100.0 * f64::from((last.middle - origin).dot(Vec3::Z.cross(along)).abs()) / far(last);
        // Least squares of distance over time.
        let n = own.len() as f64;
        let (mt, mx) = (
            own.iter().map(|c| c.time).sum::<f64>() / n,
            own.iter().map(&far).sum::<f64>() / n,
        );
        let covariance: f64 = own.iter().map(|c| (c.time - mt) * (far(c) - mx)).sum();
        let variance: f64 = own.iter().map(|c| (c.time - mt).powi(2)).sum();
        let slope = covariance / variance;
        let rest: f64 = own
            .iter()
            .map(|c| (far(c) - mx - slope * (c.time - mt)).powi(2))
            .sum();
        arms.push(Run {
            turned,
            off,
            speed: slope / speed,
            scatter: (rest / n).sqrt() / f64::from(mesh.mean_edge()),
            length: 1e3 * far(last),
        });
    }
    arms
}
