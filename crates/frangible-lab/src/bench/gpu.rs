//! Batches of impacts on the CPU and on a GPU, and which of the two [`Choice::Auto`] takes.

use std::time::Instant;

use frangible::glam::Vec3;
use frangible::internals::{Stage, Vibration};
use frangible::{Body, Breakable, Contact, FractureConfig, Material};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_gpu::{Choice, Gpu, Impact, RanOn, Solver, initiation_on_cpu};
use serde::Serialize;

use crate::bench::error::BenchError;
use crate::bench::subjects::{MODES, chosen, steel_ball};

/// Runs of a batch; the fastest counts.
const RUNS: usize = 3;
/// Most impacts of a batch with an adapter in software: they take a second each where it is busy.
const MOST_IN_SOFTWARE: usize = 16;
/// CPU time of a batch that hundredths of a second tell, s.
const LEAST_CPU: f64 = 0.05;
/// Weak points per m³ that leave hardly a tetrahedron without one.
const EVERYWHERE: f64 = 1e12;
/// Speeds of the blows, m/s: they come near the strength; most hold, some crack.
const SPEEDS: [(&str, f64); 2] = [("pane", 1.0), ("glass", 1.5)];

/// The adapter that computes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Adapter {
    /// Its name.
    pub name: String,
    /// True if it computes on the CPU.
    pub software: bool,
}

/// A time beside the processor's own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Wall-clock time per impact, s.
    pub wall: f64,
    /// CPU time of the whole process per impact, s, if the system reports it and the batch takes long enough.
    pub cpu: Option<f64>,
}

/// A batch.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Batch {
    /// Impacts, one contact each, each on a body of its own.
    pub impacts: usize,
    /// Impacts with cracks.
    pub cracked: usize,
    /// Cost on the CPU, all its threads.
    pub cpu: Cost,
    /// Cost on the GPU, and on the CPU for the impacts that the GPU leaves.
    pub gpu: Option<Cost>,
    /// The passes alone by the GPU's own clock, per impact, s, where it has one.
    pub passes: Option<f64>,
    /// Processor that `Choice::Auto` chose.
    pub auto: &'static str,
}

/// A kind of body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OfBody {
    /// Its name.
    pub name: &'static str,
    /// Its tetrahedra.
    pub tets: usize,
    /// Its weak points.
    pub weak_points: usize,
    /// Nodes of its analysis mesh.
    pub analysis_nodes: usize,
    /// Mean number of time steps of an impact.
    pub steps: usize,
    /// Rising batches.
    pub batches: Vec<Batch>,
    /// Reason of the choice by `Choice::Auto` for the largest batch, with the threshold that its trial found.
    pub why: String,
}

/// Results of the benchmark.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Findings {
    /// The adapter, or why there is none.
    pub adapter: Result<Adapter, String>,
    /// Modes of each body.
    pub modes: usize,
    /// The bodies.
    pub bodies: Vec<OfBody>,
    /// Stress everywhere in a large one, where there is a GPU.
    pub everywhere: Option<Everywhere>,
}

/// Stress at every tetrahedron of a large body at every time step of a blow.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Everywhere {
    /// Its name.
    pub name: &'static str,
    /// Tetrahedra, all of which are weak points.
    pub tets: usize,
    /// Nodes of its analysis mesh.
    pub analysis_nodes: usize,
    /// Time steps.
    pub steps: usize,
    /// One thread of the CPU, wall clock, s.
    pub cpu: f64,
    /// The GPU with all that comes and goes, wall clock, s.
    pub gpu: f64,
    /// Time of each pass by the GPU's own clock: its name, s.
    pub passes: Vec<(&'static str, f64)>,
    /// Largest difference of the two peak stresses, over the CPU's.
    pub difference: f64,
}

/// Times batches of 1, 4, 16 … impacts, up to `largest`. Without a GPU the CPU alone.
///
/// # Errors
/// A body that does not bake, a GPU that fails.
pub fn measure(
    largest: usize,
    progress: &mut dyn FnMut(&str, f64),
) -> Result<Findings, BenchError> {
    let adapter = match Gpu::new() {
        Ok(gpu) => Ok(Adapter {
            name: gpu.adapter().into(),
            software: gpu.is_software(),
        }),
        Err(problem) => Err(problem.to_string()),
    };
    let largest = match &adapter {
        Ok(adapter) if adapter.software => largest.min(MOST_IN_SOFTWARE),
        _ => largest,
    };
    let mut bodies = Vec::new();
    for (name, speed) in SPEEDS {
        progress(&format!("baking {name}"), 0.0);
        let shape = match name {
            "pane" => Shape::plate(0.3, 0.3, 0.004),
            _ => Shape::drinking_glass(),
        };
        let spec = BakeSpec {
            modes: MODES,
            // The GPU knows no others.
            followed: Some(MODES),
            ..BakeSpec::new(name, shape, Material::preset("glass")?)
        };
        let kind = Breakable::uniform(bake(&spec)?)?;
        bodies.push(of_body(
            name,
            &kind,
            speed,
            largest,
            adapter.is_ok(),
            progress,
        )?);
    }
    let everywhere = match &adapter {
        Ok(adapter) => Some(everywhere(adapter.software, progress)?),
        Err(_) => None,
    };
    Ok(Findings {
        adapter,
        modes: MODES,
        bodies,
        everywhere,
    })
}

/// The largest slab of Table 1, each of whose tetrahedra is a weak point; a coarse one for an adapter in software.
fn everywhere(
    software: bool,
    progress: &mut dyn FnMut(&str, f64),
) -> Result<Everywhere, BenchError> {
    let name = if software {
        "slab-moderate"
    } else {
        "slab-very-high"
    };
    progress(&format!("baking {name}"), 0.0);
    let subject = chosen(&[name.into()])?[0];
    let (shape, analysis, fracture) = subject.geometry()?;
    let mut material = Material::preset(subject.material)?;
    material.weak_point_density = EVERYWHERE;
    let spec = BakeSpec {
        modes: MODES,
        followed: Some(MODES),
        analysis,
        fracture,
        ..BakeSpec::new(name, shape, material)
    };
    let kind = Breakable::uniform(bake(&spec)?)?;
    let body = kind.body(0);
    let contacts = [subject.contact(kind.asset(), 1.0)?];
    let mut config = FractureConfig::with_given_impulses();
    config.culling = false;
    let gpu = Gpu::new()?;
    let loaded = gpu.load(&kind)?;
    let batch = [Impact::new(&loaded, &body, &contacts)];
    progress(&format!("{name}: stress everywhere"), 0.5);
    let Stage::Vibrates(vibration) = Vibration::begin(&body, &contacts, &config)? else {
        return Err(BenchError::NotAsMeant(
            "without culling a blow was refused".into(),
        ));
    };
    let start = Instant::now();
    let expected = initiation_on_cpu(&body, &vibration, &config, 0);
    let cpu = start.elapsed().as_secs_f64();
    let (mut best, mut peak) = (f64::INFINITY, f32::NAN);
    for _ in 0..=RUNS {
        let start = Instant::now();
        let found = gpu.initiation(&batch, &config)?;
        best = best.min(start.elapsed().as_secs_f64());
        peak = found[0].as_ref().map_or(f32::NAN, |f| f.peak_stress);
    }
    let passes = gpu.pass_times(&batch, &config)?;
    Ok(Everywhere {
        name,
        tets: body.weak_tets().len(),
        analysis_nodes: kind.asset().analysis().nodes.len(),
        steps: vibration.report.time_steps,
        cpu,
        gpu: best,
        passes: passes.iter().map(|p| (p.pass, p.seconds)).collect(),
        difference: f64::from((peak / expected.peak_stress - 1.0).abs()),
    })
}

fn of_body(
    name: &'static str,
    kind: &Breakable,
    speed: f64,
    largest: usize,
    gpu: bool,
    progress: &mut dyn FnMut(&str, f64),
) -> Result<OfBody, BenchError> {
    let asset = kind.asset();
    let config = FractureConfig::with_given_impulses();
    let bodies: Vec<Body> = (0..largest as u64).map(|seed| kind.body(seed)).collect();
    let contacts: Vec<[Contact; 1]> = (0..largest)
        .map(|k| Ok([blow(kind, k, speed)?]))
        .collect::<Result<_, BenchError>>()?;
    let mut steps = 0;
    for (body, contacts) in bodies.iter().zip(&contacts) {
        if let Stage::Vibrates(vibration) = Vibration::begin(body, contacts, &config)? {
            steps += vibration.report.time_steps;
        }
    }
    let mut cpu = Solver::new(Choice::Cpu)?;
    let mut on_gpu = gpu.then(|| Solver::new(Choice::Gpu)).transpose()?;
    let mut auto = Solver::new(Choice::Auto)?;
    let clock = gpu.then(Gpu::new).transpose()?;
    let (mut batches, mut why) = (Vec::new(), String::new());
    let sizes = std::iter::successors(Some(1), |n| Some(4 * n));
    for size in sizes.take_while(|&n| n <= largest) {
        progress(
            &format!("{name}: {size} impacts"),
            size as f64 / largest as f64,
        );
        let batch = |solver: &mut Solver| time(solver, kind, &bodies[..size], &contacts, &config);
        let (of_cpu, cracked) = batch(&mut cpu)?;
        let of_gpu = on_gpu.as_mut().map(batch).transpose()?;
        let loaded = auto.load(kind)?;
        let impacts = impacts(&loaded, &bodies[..size], &contacts);
        let (_, ran) = auto.impacts(&impacts, &config)?;
        why.clone_from(&ran.why);
        batches.push(Batch {
            impacts: size,
            cracked,
            cpu: of_cpu,
            gpu: of_gpu.map(|(cost, _)| cost),
            passes: clock
                .as_ref()
                .map(|gpu| passes(gpu, kind, &bodies[..size], &contacts, &config))
                .transpose()?,
            auto: match ran.on {
                RanOn::Cpu => "CPU",
                RanOn::Gpu => "GPU",
            },
        });
    }
    Ok(OfBody {
        name,
        tets: asset.fracture().tets.len(),
        weak_points: bodies.first().map_or(0, |body| body.weak_tets().len()),
        analysis_nodes: asset.analysis().nodes.len(),
        steps: steps / largest.max(1),
        batches,
        why,
    })
}

fn impacts<'a>(
    kind: &'a frangible_gpu::Loaded,
    bodies: &'a [Body],
    contacts: &'a [[Contact; 1]],
) -> Vec<Impact<'a>> {
    let each = bodies.iter().zip(contacts);
    each.map(|(body, contacts)| Impact::new(kind, body, contacts))
        .collect()
}

/// Time per impact of the passes on the GPU, by its own clock, s.
fn passes(
    gpu: &Gpu,
    kind: &Breakable,
    bodies: &[Body],
    contacts: &[[Contact; 1]],
    config: &FractureConfig,
) -> Result<f64, BenchError> {
    let loaded = gpu.load(kind)?;
    let times = gpu.pass_times(&impacts(&loaded, bodies, contacts), config)?;
    Ok(times.iter().map(|t| t.seconds).sum::<f64>() / bodies.len() as f64)
}

/// Cost per impact of the fastest run, and number of impacts that cracked. The first run warms up.
fn time(
    solver: &mut Solver,
    kind: &Breakable,
    bodies: &[Body],
    contacts: &[[Contact; 1]],
    config: &FractureConfig,
) -> Result<(Cost, usize), BenchError> {
    let loaded = solver.load(kind)?;
    let impacts = impacts(&loaded, bodies, contacts);
    let (outcomes, _) = solver.impacts(&impacts, config)?;
    let cracked = outcomes.iter().filter(|o| o.report().cracks > 0).count();
    let each = 1.0 / impacts.len() as f64;
    let mut best: Option<Cost> = None;
    for _ in 0..RUNS {
        let (wall, cpu) = (Instant::now(), cpu_seconds());
        solver.impacts(&impacts, config)?;
        let cost = Cost {
            wall: wall.elapsed().as_secs_f64() * each,
            cpu: cpu_seconds()
                .zip(cpu)
                .map(|(b, a)| b - a)
                .filter(|&spent| spent >= LEAST_CPU)
                .map(|spent| spent * each),
        };
        best = Some(match best {
            Some(best) if best.wall <= cost.wall => best,
            _ => cost,
        });
    }
    let none = Cost {
        wall: 0.0,
        cpu: None,
    };
    Ok((best.unwrap_or(none), cracked))
}

/// A steel ball of 60 g on a place of the surface, from outside.
fn blow(kind: &Breakable, k: usize, speed: f64) -> Result<Contact, BenchError> {
    let asset = kind.asset();
    let triangle = (k * 7919 + 13) % asset.surface().triangles.len();
    let corner = asset.surface().triangles[triangle][0];
    let point = asset.fracture().positions[corner as usize];
    let inward: Vec3 = -asset.surface().normals[triangle][0];
    let ball = steel_ball(0.06)?;
    Ok(Contact::collision(asset, point, inward, speed, ball))
}

/// CPU time of this process so far, s, if the system reports it in hundredths.
fn cpu_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = fields.get(11)?.parse::<f64>().ok()? + fields.get(12)?.parse::<f64>().ok()?;
    Some(ticks / 100.0)
}
