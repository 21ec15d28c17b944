//! Breaks a baked body by the number of pieces that are wanted.
//!
//! - `hit surface BODY.frangible OUT.obj`: its outer surface;
//! - `hit pieces BODY.frangible FOLDER RUNS PIECES…`: for each number of pieces the slowest blow that comes within a tenth of it, or the
//!   one that comes nearest, timed; a line of JSON, and the pieces as FOLDER/PIECES.obj, one object each (FOLDER/PIECES-drawn.obj: as its author drew it).
//!
//! A blow is a flat stone that does not give way, at one of the six outermost points of the body: side -z, z, -y, y, -x or x. Our model
//! throughout.

use std::error::Error;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use frangible::glam::Vec3;
use frangible::{
    Asset, Body, Breakable, Contact, Fracture, FractureConfig, Material, Outcome, Striker, impact,
};

const USAGE: &str = "usage: hit surface BODY OUT.obj | hit pieces BODY FOLDER RUNS PIECES…";

/// Speeds that are tried, m/s: from the first, each so much faster, up to the last.
const SPEEDS: (f64, f64, f64) = (1.0, 1.08, 3000.0);

/// The stone comes from these sides.
const SIDES: [(&str, Vec3); 6] = [
    ("-z", Vec3::NEG_Z),
    ("z", Vec3::Z),
    ("-y", Vec3::NEG_Y),
    ("y", Vec3::Y),
    ("-x", Vec3::NEG_X),
    ("x", Vec3::X),
];

/// A blow is repeated for so long in each run: the system counts processor time in steps of some milliseconds.
const RUN: Duration = Duration::from_millis(300);

/// Seed of the weak points.
const SEED: u64 = 1;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["surface", body, out] => surface(&Asset::load(body)?, Path::new(out)),
        ["pieces", body, folder, runs, ref wanted @ ..] if !wanted.is_empty() => {
            let wanted: Vec<usize> = wanted.iter().map(|n| n.parse()).collect::<Result<_, _>>()?;
            fs::create_dir_all(folder)?;
            pieces(body, Path::new(folder), runs.parse()?, &wanted)
        }
        _ => Err(USAGE.into()),
    }
}

fn surface(asset: &Asset, path: &Path) -> Result<(), Box<dyn Error>> {
    let mut to = BufWriter::new(File::create(path)?);
    let triangles = asset.surface().triangles.iter().copied();
    write_object(
        &mut to,
        "surface",
        &asset.fracture().positions,
        triangles,
        &mut 0,
    )?;
    Ok(to.flush()?)
}

fn pieces(path: &str, folder: &Path, runs: usize, wanted: &[usize]) -> Result<(), Box<dyn Error>> {
    let body = ready(path)?;
    let tried = try_all(&body, *wanted.iter().max().ok_or(USAGE)?)?;
    for &number in wanted {
        let nearest = tried.iter().min_by(|a, b| {
            // Within a tenth they are as good, and the slowest counts.
            let off = |t: &Tried| t.pieces.abs_diff(number).saturating_sub(number / 10);
            off(a).cmp(&off(b)).then(a.speed.total_cmp(&b.speed))
        });
        let Some(nearest) = nearest else {
            return Err(format!("no blow below {} m/s breaks {path}", SPEEDS.2).into());
        };
        println!("{}", measure(&body, nearest, number, runs, folder)?);
    }
    Ok(())
}

fn ready(path: &str) -> Result<Body, Box<dyn Error>> {
    Ok(Breakable::uniform(Asset::load(path)?)?.body(SEED))
}

/// Processor time of this thread where the system tells it (Linux), so that other work on the machine counts less; else
/// wall-clock time.
struct Clock {
    wall: Instant,
    processor: Option<f64>,
}

impl Clock {
    fn start() -> Self {
        Self {
            processor: processor_seconds(),
            wall: Instant::now(),
        }
    }

    fn seconds(&self) -> f64 {
        let wall = self.wall.elapsed().as_secs_f64();
        match (self.processor, processor_seconds()) {
            (Some(before), Some(now)) => now - before,
            _ => wall,
        }
    }
}

/// What this thread has used so far, s: the first number of its `schedstat`, ns.
fn processor_seconds() -> Option<f64> {
    let about = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = about.split_whitespace().next()?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}

/// A blow and what came of it.
struct Tried {
    name: &'static str,
    side: Vec3,
    speed: f64,
    pieces: usize,
}

/// All blows that break the body into no more than twice as many pieces as wanted at most.
fn try_all(body: &Body, most: usize) -> Result<Vec<Tried>, Box<dyn Error>> {
    let mut tried = Vec::new();
    let (first, factor, last) = SPEEDS;
    for (name, side) in SIDES {
        let mut speed = first;
        while speed <= last {
            let contact = blow(body, side, speed)?;
            let pieces = count(&impact(body, &[contact], &FractureConfig::default())?);
            if pieces > 1 {
                tried.push(Tried {
                    name,
                    side,
                    speed,
                    pieces,
                });
            }
            if pieces > 2 * most {
                break;
            }
            speed *= factor;
        }
    }
    Ok(tried)
}

/// The stone at the outermost point of a side, at this speed, m/s.
fn blow(body: &Body, side: Vec3, speed: f64) -> Result<Contact, Box<dyn Error>> {
    let asset = body.asset();
    let point = asset
        .fracture()
        .positions
        .iter()
        .copied()
        .max_by(|a, b| a.dot(side).total_cmp(&b.dot(side)))
        .ok_or("a body without nodes")?;
    let stone = Striker::fixed(&Material::preset("stone")?);
    Ok(Contact::strike(point, -side, speed as f32, stone))
}

fn count(outcome: &Outcome) -> usize {
    match outcome {
        Outcome::Broke(fracture) => fracture.fragments.len(),
        _ => 1,
    }
}

/// Runs a blow some times and writes its pieces; a line of JSON, times in s.
fn measure(
    body: &Body,
    blow_of: &Tried,
    wanted: usize,
    runs: usize,
    folder: &Path,
) -> Result<String, Box<dyn Error>> {
    let contact = blow(body, blow_of.side, blow_of.speed)?;
    let mut all = Vec::new();
    let mut last = None;
    for _ in 0..runs.max(1) {
        let (clock, mut times) = (Clock::start(), 0.0);
        while clock.wall.elapsed() < RUN {
            let outcome = impact(
                body,
                std::slice::from_ref(&contact),
                &FractureConfig::default(),
            )?;
            last = Some(outcome);
            times += 1.0;
        }
        all.push(clock.seconds() / times);
    }
    let Some(Outcome::Broke(fracture)) = last else {
        return Err("a blow that broke the body does so no more".into());
    };
    write_pieces(&fracture, &folder.join(format!("{wanted}.obj")), false)?;
    let drawn = fracture.fragments.iter().any(|f| f.render.is_some());
    if drawn {
        write_pieces(&fracture, &folder.join(format!("{wanted}-drawn.obj")), true)?;
    }
    let report = &fracture.report;
    Ok(format!(
        "{{\"wanted\": {wanted}, \"pieces\": {}, \"speed\": {:.3}, \"side\": \"{}\", \"seconds\": {all:?}, \"drawing\": {:e}, \
         \"drawn\": {drawn}, \"tets\": {}, \"modes\": {}, \"steps\": {}, \"cracks\": {}, \"crack_area\": {:e}, \"volume\": {:e}}}",
        fracture.fragments.len(),
        blow_of.speed,
        blow_of.name,
        report.timings.drawing,
        body.asset().fracture().tets.len(),
        body.asset().modes().count(),
        report.time_steps,
        report.cracks,
        report.crack_area,
        fracture
            .fragments
            .iter()
            .map(|f| f.mass.volume)
            .sum::<f64>(),
    ))
}

/// Each piece an object of its own, in its own frame: moving it would round its corners.
fn write_pieces(fracture: &Fracture, path: &Path, drawn: bool) -> Result<(), Box<dyn Error>> {
    let mut to = BufWriter::new(File::create(path)?);
    let mut before = 0;
    for (number, fragment) in fracture.fragments.iter().enumerate() {
        let name = format!("piece{number}");
        match &fragment.render {
            Some(mesh) if drawn => {
                let triangles = mesh.triangles.iter().copied();
                write_object(&mut to, &name, &mesh.positions, triangles, &mut before)?;
            }
            _ => {
                let mesh = &fragment.mesh;
                let triangles = mesh.triangles.iter().copied();
                write_object(&mut to, &name, &mesh.positions, triangles, &mut before)?;
            }
        }
    }
    Ok(to.flush()?)
}

/// Full digits: what is read back is the same number. `before`: vertices of the file so far.
fn write_object(
    to: &mut impl Write,
    name: &str,
    positions: &[Vec3],
    triangles: impl Iterator<Item = [u32; 3]>,
    before: &mut u32,
) -> std::io::Result<()> {
    writeln!(to, "o {name}")?;
    for p in positions {
        writeln!(to, "v {} {} {}", p.x, p.y, p.z)?;
    }
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| v + *before + 1);
        writeln!(to, "f {a} {b} {c}")?;
    }
    *before += positions.len() as u32;
    Ok(())
}
