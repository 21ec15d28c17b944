//! Prints what came of every built-in scene, one line per first break of a body and one per scene, with a number made of all bits.
//!
//! `cargo xtask outcomes` runs this program and compares its lines with stored ones. Names of scenes may be given; all are played
//! if there is none. The columns are: scene, body (or `whole` for the scene), pieces, area of the cracks in cm², energy of the
//! cracks in J, and the bits.

use std::error::Error;

use frangible::{Contact, ImpactReport};
use frangible_recording::Recording;
use frangible_scenes::{BreakRecord, Run, SCENE_NAMES, bake, play, scene};
use twox_hash::XxHash64;

/// Longest time for which scenes are played, s: by then every body that breaks has broken once.
const LONGEST: f64 = 1.0;

fn main() -> Result<(), Box<dyn Error>> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |name: &&&str| asked.is_empty() || asked.iter().any(|a| a == **name);
    for name in SCENE_NAMES.iter().filter(wanted) {
        let mut scene = scene(name)?;
        scene.duration = scene.duration.min(LONGEST);
        let bodies = bake(&scene)?;
        let run = play(&scene, &bodies, &mut |_| {})?;
        for body in 0..scene.bodies.len() {
            if let Some(record) = run.break_of(body) {
                let (area, energy) = spent([record]);
                let bits = bits_of_break(record);
                let pieces = record.masses.len();
                println!("{name} {body} {pieces} {area:.4} {energy:.6} {bits:016x}");
            }
        }
        let (area, energy) = spent(&run.breaks);
        let pieces: usize = run.breaks.iter().map(|b| b.masses.len()).sum();
        let bits = bits_of_run(&run);
        println!("{name} whole {pieces} {area:.4} {energy:.6} {bits:016x}");
    }
    Ok(())
}

/// Area of the cracks, cm², and their energy, J.
fn spent<'a>(breaks: impl IntoIterator<Item = &'a BreakRecord>) -> (f64, f64) {
    let reports = breaks.into_iter().map(|b| &b.report);
    reports.fold((0.0, 0.0), |(area, energy), r| {
        (area + 1e4 * r.crack_area, energy + r.fracture_energy)
    })
}

fn bits_of_break(record: &BreakRecord) -> u64 {
    let mut bytes = Vec::new();
    put_break(&mut bytes, record);
    XxHash64::oneshot(0, &bytes)
}

/// The breaks, everything that was withstood, every piece's surface and where it was in every frame.
fn bits_of_run(run: &Run) -> u64 {
    let mut bytes = Vec::new();
    for record in &run.breaks {
        put_break(&mut bytes, record);
    }
    for held in &run.held {
        numbers(&mut bytes, [held.time, held.margin]);
        put_report(&mut bytes, &held.report);
    }
    put_recording(&mut bytes, &run.recording);
    XxHash64::oneshot(0, &bytes)
}

fn numbers(bytes: &mut Vec<u8>, all: impl IntoIterator<Item = f64>) {
    bytes.extend(all.into_iter().flat_map(f64::to_le_bytes));
}

fn floats(bytes: &mut Vec<u8>, all: impl IntoIterator<Item = f32>) {
    bytes.extend(all.into_iter().flat_map(f32::to_le_bytes));
}

fn put_break(bytes: &mut Vec<u8>, record: &BreakRecord) {
    bytes.extend(record.contacts.iter().flat_map(Contact::to_bytes));
    numbers(bytes, record.masses.iter().copied());
    let energies = [
        record.time,
        record.volume,
        record.energy_paid,
        record.kinetic_before,
        record.kinetic_after,
        record.work,
    ];
    numbers(bytes, energies);
    put_report(bytes, &record.report);
}

/// All numbers but the times that the stages took. Names are left out, so that a renamed field changes nothing.
fn put_report(bytes: &mut Vec<u8>, r: &ImpactReport) {
    let of_the_impact = [
        r.contact_duration,
        r.unadjusted_duration,
        r.most_excited_frequency,
        r.time_step,
        r.time_steps as f64,
        r.peak_stress,
        r.stress_bound,
        r.strength,
        r.approach_energy,
        r.peak_elastic_energy,
        r.peak_strain_energy,
        r.fracture_energy,
        r.crack_area,
        r.cracks as f64,
        r.weak_points as f64,
        r.first_crack_time.unwrap_or(-1.0),
        r.volume_error,
        f64::from(r.looked_at as u8),
    ];
    numbers(bytes, of_the_impact);
    let points = [r.peak_point, r.first_crack_point];
    floats(
        bytes,
        points.into_iter().flatten().flat_map(|p| p.to_array()),
    );
    for (element, time) in r.arrivals.iter().flatten() {
        numbers(bytes, [f64::from(*element), *time]);
    }
    for contact in &r.contacts {
        floats(bytes, contact.point.to_array());
        floats(bytes, contact.normal.to_array());
        floats(bytes, contact.force.iter().copied());
        let numbers_of_it = [
            contact.impulse,
            contact.peak_force,
            contact.duration,
            contact.contact_radius,
            contact.departure_speed,
        ];
        numbers(bytes, numbers_of_it);
    }
}

fn put_recording(bytes: &mut Vec<u8>, recording: &Recording) {
    for mesh in &recording.meshes {
        let points = mesh.positions.iter().chain(&mesh.normals);
        floats(bytes, points.flat_map(|p| p.to_array()));
        let indices = mesh.parts.iter().flat_map(|part| &part.indices);
        bytes.extend(indices.flat_map(|i| i.to_le_bytes()));
    }
    for node in &recording.nodes {
        for pose in &node.poses {
            floats(bytes, pose.translation.to_array());
            floats(bytes, pose.rotation.to_array());
        }
    }
}
