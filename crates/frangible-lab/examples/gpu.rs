//! Batches of impacts on a GPU and on the CPU, and stress everywhere in a large body.
//!
//! `cargo run --release -p frangible-lab --example gpu` prints JSON, for `docs/data/gpu.json`. An adapter in software computes on the same processor: its
//! times say that the path works, and nothing of a graphics card.

use std::time::Instant;

use frangible::glam::Vec3;
use frangible::internals::{Stage, Vibration};
use frangible::{Body, Breakable, Contact, FractureConfig, Material, impact};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_lab::Result;
use frangible_lab::bench::subjects::{MODES, chosen, steel_ball};
use frangible_lab::data::{Measures, stored};
use frangible_lab::gpu::{Gpu, Impact, initiation_on_cpu};
use rayon::prelude::*;
use serde_json::{Value, json};

/// Runs of a batch; the fastest counts.
const RUNS: usize = 3;
/// Impacts of the largest batch, and of that of an adapter in software.
const LARGEST: [usize; 2] = [64, 16];
/// Weak points per m³ that leave hardly a tetrahedron without one.
const EVERYWHERE: f64 = 1e12;
/// Speeds of the blows, m/s: they come near the strength; most hold, some crack.
const SPEEDS: [(&str, f64); 2] = [("pane", 1.0), ("glass", 1.5)];

fn main() -> Result<()> {
    let gpu = Gpu::new()?;
    let mut rows = Vec::new();
    for (name, speed) in SPEEDS {
        rows.extend(of_body(&gpu, name, speed)?);
    }
    let found = json!({
        "adapter": gpu.adapter(),
        "in_software": gpu.is_software(),
        "modes": MODES,
        "batches": rows,
        "everywhere": everywhere(&gpu)?,
    });
    println!("{:#}", stored(Measures::Model, true, &found)?);
    Ok(())
}

/// Batches of 1, 4, 16 … impacts, each on a body of its own.
fn of_body(gpu: &Gpu, name: &str, speed: f64) -> Result<Vec<Value>> {
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
    let loaded = gpu.load(&kind)?;
    let config = FractureConfig::with_given_impulses();
    let largest = LARGEST[usize::from(gpu.is_software())];
    let bodies: Vec<Body> = (0..largest as u64).map(|seed| kind.body(seed)).collect();
    let contacts = (0..largest).map(|k| Ok([blow(&kind, k, speed)?]));
    let contacts: Vec<[Contact; 1]> = contacts.collect::<Result<_>>()?;
    let all = bodies.iter().zip(&contacts);
    let all: Vec<Impact<'_>> = all
        .map(|(body, contacts)| Impact::new(&loaded, body, contacts))
        .collect();
    let sizes = std::iter::successors(Some(1), |n| Some(4 * n)).take_while(|&n| n <= largest);
    sizes
        .map(|size| {
            let batch = &all[..size];
            let hit = |i: &Impact<'_>| impact(i.body, i.contacts, &config).map(drop);
            let on_cpu = fastest(|| Ok(batch.par_iter().try_for_each(hit)?))?;
            let on_gpu = fastest(|| Ok(gpu.impacts(batch, &config).map(drop)?))?;
            let passes = gpu.pass_times(batch, &config)?;
            let cracked = gpu.impacts(batch, &config)?;
            Ok(json!({
                "body": name,
                "impacts": size,
                "cracked": cracked.iter().filter(|o| o.report().cracks > 0).count(),
                "cpu_s": on_cpu / size as f64,
                "gpu_s": on_gpu / size as f64,
                "passes_s": passes.iter().map(|p| p.seconds).sum::<f64>() / size as f64,
            }))
        })
        .collect()
}

/// Time of the fastest run, s; the first warms up.
fn fastest(run: impl Fn() -> Result<()>) -> Result<f64> {
    run()?;
    let mut best = f64::INFINITY;
    for _ in 0..RUNS {
        let start = Instant::now();
        run()?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    Ok(best)
}

/// The largest slab of Table 1, each of whose tetrahedra is a weak point; a coarse one for an adapter in software.
fn everywhere(gpu: &Gpu) -> Result<Value> {
    let name = if gpu.is_software() {
        "slab-moderate"
    } else {
        "slab-very-high"
    };
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
    let loaded = gpu.load(&kind)?;
    let batch = [Impact::new(&loaded, &body, &contacts)];
    let Stage::Vibrates(vibration) = Vibration::begin(&body, &contacts, &config)? else {
        return Err("without culling a blow was refused".into());
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
    let passes = passes
        .iter()
        .map(|p| json!({ "pass": p.pass, "seconds": p.seconds }));
    Ok(json!({
        "body": name,
        "tets": body.weak_tets().len(),
        "analysis_nodes": kind.asset().analysis().nodes.len(),
        "steps": vibration.report.time_steps,
        "cpu_s": cpu,
        "gpu_s": best,
        "passes": passes.collect::<Vec<_>>(),
        "difference": (peak / expected.peak_stress - 1.0).abs(),
    }))
}

/// A steel ball of 60 g on a place of the surface, from outside.
fn blow(kind: &Breakable, k: usize, speed: f64) -> Result<Contact> {
    let asset = kind.asset();
    let triangle = (k * 7919 + 13) % asset.surface().triangles.len();
    let corner = asset.surface().triangles[triangle][0];
    let point = asset.fracture().positions[corner as usize];
    let inward: Vec3 = -asset.surface().normals[triangle][0];
    let ball = steel_ball(0.06)?;
    Ok(Contact::collision(asset, point, inward, speed, ball))
}
