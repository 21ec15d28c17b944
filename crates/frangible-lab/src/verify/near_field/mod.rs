//! Accuracy of the near field, the residual vector and the integrated blow, in tables: `frangible-lab near-field`.
//!
//! Here nothing passes or fails; the cases `near-field` and `blow` do that.

mod edges;
mod residual;

use frangible::internals::near_field::PlateTheory;
use frangible::{Contact, FractureConfig, glam::Vec3};
use serde_json::{Value, json};

use crate::verify::blows::plate::Terms;
use crate::verify::blows::probe::{self, PLATE, Place, about, body, felt, following, places};
use crate::verify::cases::blow::{force_on_plate, restitution_at, thin};
use crate::{Progress, Result};

/// Peak of the half-sine of the stress table, N, and its duration, s.
const FORCE: f64 = 100.0;
const DURATION: f64 = 54e-6;

/// Distances of the table, m.
const COLUMNS: [f64; 5] = [1e-3, 2e-3, 4e-3, 8e-3, 16e-3];

/// Times at which Zener's force is compared, s.
const TIMES: [f64; 5] = [5e-6, 10e-6, 30e-6, 60e-6, 100e-6];

/// Measures everything: half a minute.
///
/// # Errors
/// An error of the bake or of the fracture code.
pub fn compute(hear: Progress<'_>) -> Result<Value> {
    let plate = probe::plate()?;
    hear(0.15);
    let (radius, stress) = stress(&plate)?;
    let wide = probe::wide_plate()?;
    hear(0.3);
    let (force, peak) = force_on_plate(&wide, &thin(), &TIMES)?;
    let force = TIMES.iter().zip(force).map(|(time, [computed, zener])| {
        json!({ "time_s": time, "computed_n": computed, "zener_n": zener })
    });
    let mut restitution = Vec::new();
    for inelasticity in [0.1, 0.25, 0.5, 1.0, 2.0] {
        let [computed, zener] = restitution_at(&wide, inelasticity, &thin())?;
        restitution
            .push(json!({ "inelasticity": inelasticity, "computed": computed, "zener": zener }));
    }
    hear(0.4);
    let edges = edges::compute(&plate)?;
    hear(0.7);
    Ok(json!({
        "radius_m": radius,
        "stress": stress,
        "force": force.collect::<Vec<_>>(),
        "peak_n": peak,
        "restitution": restitution,
        "edges": edges,
        "residual": residual::compute()?,
    }))
}

/// A row of hoop stress: all points, m and MPa, and those next to the distances of the table.
fn row(name: &str, points: &[[f64; 2]]) -> Value {
    let off = |p: &&[f64; 2], r: f64| (p[0] - r).abs();
    let nearest = |r: f64| points.iter().min_by(|a, b| off(a, r).total_cmp(&off(b, r)));
    json!({ "name": name, "points": points, "columns": COLUMNS.map(nearest) })
}

/// Hoop stress of the plate of the tables in the middle of a half-sine: of the series, of modes and of modes with their near field.
fn stress(plate: &frangible::Asset) -> Result<(f64, Vec<Value>)> {
    let impulse = 2.0 / std::f64::consts::PI * FORCE * DURATION;
    let top = Vec3::new(0.0, 0.0, 0.5 * PLATE.thickness as f32);
    let contact = Contact::push(top, impulse as f32 * Vec3::NEG_Z, DURATION as f32);
    let fine: Vec<f64> = (0..48).map(|i| 1e-3 * 1.065_f64.powi(i)).collect();
    let mut rows: Vec<Value> = Vec::new();
    let mut radius = 0.0;
    for (near, label) in [
        (None, "modes"),
        (Some(PlateTheory::Kirchhoff), "modes and near field"),
    ] {
        for modes in [50, 100] {
            let body = body(following(plate.clone(), modes))?;
            let mut config = FractureConfig::default();
            (config.near_field, config.residual) = (near, false);
            // Fine enough that a step falls on the middle.
            config.samples_per_period = 64.0;
            let blow = probe::blow(&body, contact.clone(), &config)?;
            let report = &blow.reports()[0];
            let step = (0.5 * DURATION / blow.time_step()).round() as usize - 1;
            let along = places(&body, [0.0; 2], [1.0, 0.0], &fine);
            let mut seen: Vec<Place> = Vec::new();
            for place in along {
                if seen
                    .last()
                    .is_none_or(|last| place.distance > last.distance)
                {
                    seen.push(place);
                }
            }
            let hoop = |place: &Place, s| about([0.0; 2], place.at, s)[1] / 1e6;
            if near.is_some() && modes == 50 {
                radius = report.contact_radius;
                let points: Vec<[f64; 2]> = seen.iter().map(|p| p.at).collect();
                let load = (&report.force[..], blow.time_step(), radius);
                let exact = &PLATE.stress(Terms::Thin, [0.0; 2], load, &points, &[step])[0];
                let points = seen.iter().zip(exact);
                let points = points.map(|(p, s)| [p.distance, hoop(p, *s)]);
                let points: Vec<_> = points.collect();
                rows.insert(0, row("all modes (series)", &points));
            }
            let felt = |p: &Place| [p.distance, hoop(p, felt(&body, &blow, p, step, &config))];
            let points: Vec<_> = seen.iter().map(felt).collect();
            rows.push(row(&format!("{modes} {label}"), &points));
        }
    }
    Ok((radius, rows))
}
