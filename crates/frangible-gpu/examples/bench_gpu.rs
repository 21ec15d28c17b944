//! Milliseconds per impact on the CPU and on the GPU against the batch size: `cargo run --release -p frangible-gpu
//! --example bench_gpu -- [modes] [largest batch]`. The CPU uses all its threads in both.
//!
//! On Linux the CPU time of the process stands beside the wall clock: on a busy machine, and with an adapter in
//! software, it is the better measure.

use std::time::Instant;

use frangible::glam::Vec3;
use frangible::{
    Asset, Body, Breakable, Contact, FractureConfig, Material, Stage, Striker, Vibration,
};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_gpu::{Choice, Gpu, Impact, Solver};

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: usize| arguments.next().map_or(Ok(default), |a| a.parse());
    let (modes, largest) = (number(100)?, number(64)?);
    let gpu = Gpu::new()?;
    println!(
        "adapter: {}{}",
        gpu.adapter(),
        if gpu.is_software() {
            ", in software"
        } else {
            ""
        }
    );
    drop(gpu);
    for (name, shape, speed) in [
        ("pane", Shape::plate(0.3, 0.3, 0.004), 1.0),
        ("glass", Shape::drinking_glass(), 1.5),
    ] {
        let material = Material::preset("glass")?;
        let spec = BakeSpec {
            modes,
            ..BakeSpec::new(name, shape, material)
        };
        let kind = Breakable::new(bake(&spec, &mut |_| {})?.0)?;
        bench(name, &kind, speed, largest)?;
    }
    Ok(())
}

/// Blows that come near the strength: most hold, some break.
fn bench(name: &str, kind: &Breakable, speed: f64, largest: usize) -> Result<(), Failure> {
    let asset = kind.asset();
    let steel = Material::preset("steel")?;
    let config = FractureConfig::default();
    let bodies: Vec<Body> = (0..largest as u64).map(|seed| kind.body(seed)).collect();
    let contacts: Vec<[Contact; 1]> = (0..largest)
        .map(|k| [blow(asset, &steel, k, speed)])
        .collect();
    let mut steps = 0;
    for (body, contacts) in bodies.iter().zip(&contacts) {
        if let Stage::Vibrates(vibration) = Vibration::begin(body, contacts, &config)? {
            steps += vibration.pulse.total_steps;
        }
    }
    println!(
        "{name}: {} tetrahedra, {} weak, {} analysis nodes, {} modes, {} steps per impact",
        asset.fracture.tets.len(),
        bodies[0].weak_tets().len(),
        asset.analysis.nodes.len(),
        asset.modes.count(),
        steps / largest,
    );
    println!(
        "{:>6} {:>8} {:>20} {:>20}",
        "batch", "open", "CPU ms (of CPU)", "GPU ms (of CPU)"
    );
    let mut solvers = [Solver::new(Choice::Cpu)?, Solver::new(Choice::Gpu)?];
    let mut batch = 1;
    while batch <= largest {
        let mut line = Vec::new();
        let mut cracked = 0;
        for solver in &mut solvers {
            let loaded = solver.load(kind)?;
            let impacts: Vec<Impact<'_>> = (bodies.iter().zip(&contacts))
                .take(batch)
                .map(|(body, contacts)| Impact::new(&loaded, body, contacts))
                .collect();
            // The first run warms up.
            solver.impacts(&impacts, &config)?;
            let (wall, cpu) = (Instant::now(), cpu_seconds());
            let (outcomes, _) = solver.impacts(&impacts, &config)?;
            let each = 1e3 / batch as f64;
            let wall = wall.elapsed().as_secs_f64() * each;
            let cpu = cpu_seconds().zip(cpu).map(|(b, a)| (b - a) * each);
            let cpu = cpu.map_or_else(|| "?".into(), |ms| format!("{ms:.1}"));
            line.push(format!("{wall:.1} ({cpu})"));
            cracked = outcomes.iter().filter(|o| o.report().cracks > 0).count();
        }
        println!("{batch:>6} {cracked:>8} {:>20} {:>20}", line[0], line[1]);
        batch *= 4;
    }
    Ok(())
}

/// A steel ball of 60 g on a place of the surface, from outside.
fn blow(asset: &Asset, steel: &Material, k: usize, speed: f64) -> Contact {
    let count = asset.surface.triangles.len();
    let triangle = (k * 7919 + 13) % count;
    let corner = asset.surface.triangles[triangle][0];
    let point = asset.fracture.positions[corner as usize];
    let normal: Vec3 = -asset.surface.normals[triangle][0];
    let striker = Striker {
        restitution: 0.5,
        ..Striker::ball(steel, 0.06, 0.0122)
    };
    let own = asset
        .mass
        .inverse_effective_mass(point.as_dvec3(), normal.as_dvec3());
    let impulse = 1.5 * speed / (own + f64::from(striker.inverse_effective_mass));
    Contact::new(point, normal, impulse as f32, speed as f32, striker)
}

/// CPU time of this process so far, s, where the system tells in hundredths.
fn cpu_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = fields.get(11)?.parse::<f64>().ok()? + fields.get(12)?.parse::<f64>().ok()?;
    Some(ticks / 100.0)
}
