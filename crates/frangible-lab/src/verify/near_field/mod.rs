//! Accuracy of the near field, the residual vector and the integrated blow, in tables: `frangible-lab near-field`.
//!
//! Here nothing passes or fails; the cases `near-field` and `blow` do that.

mod edges;
mod page;
mod residual;

use frangible::internals::near_field::PlateTheory;
use frangible::{Contact, FractureConfig, glam::Vec3};
use frangible_bake::BakeError;

use crate::verify::VerifyError;
use crate::verify::blows::plate::Terms;
use crate::verify::blows::probe::{self, PLATE, Place, about, body, felt, following, places};
use crate::verify::cases::blow::{force_on_plate, restitution_at, thin};
use edges::EdgeRow;
use residual::ResidualRow;

/// Peak of the half-sine of the stress table, N, and its duration, s.
const FORCE: f64 = 100.0;
const DURATION: f64 = 54e-6;

/// Distances of the table, and of the picture, m.
const COLUMNS: [f64; 5] = [1e-3, 2e-3, 4e-3, 8e-3, 16e-3];

/// Times at which Zener's force is compared, s.
const TIMES: [f64; 5] = [5e-6, 10e-6, 30e-6, 60e-6, 100e-6];

/// Results of the page.
#[derive(Clone, Debug)]
pub struct NearField {
    /// Radius of the contact of the half-sine, m.
    radius: f64,
    /// Hoop stress at the middle of a half-sine.
    stress: Vec<StressRow>,
    /// Force on the plate, N: computed and Zener's, at `TIMES`, and the peaks.
    force: Vec<[f64; 2]>,
    peak: [f64; 2],
    /// λ, restitution computed and Zener's.
    restitution: Vec<[f64; 3]>,
    edges: Vec<EdgeRow>,
    residual: Vec<ResidualRow>,
}

/// Hoop stress over the distance, MPa.
#[derive(Clone, Debug)]
struct StressRow {
    name: String,
    /// Distance, m, and stress, MPa.
    points: Vec<(f64, f64)>,
}

impl NearField {
    /// Computes everything: half a minute. `hear` receives the share done, 0..=1.
    ///
    /// # Errors
    /// An error of the bake or of the fracture code.
    pub fn compute(hear: &mut dyn FnMut(f64)) -> Result<Self, VerifyError> {
        Self::computed(hear).map_err(|source| VerifyError::Bake {
            case: "near-field",
            source,
        })
    }

    fn computed(hear: &mut dyn FnMut(f64)) -> Result<Self, BakeError> {
        let plate = probe::plate()?;
        hear(0.15);
        let (radius, stress) = stress(&plate)?;
        let wide = probe::wide_plate()?;
        hear(0.3);
        let (force, peak) = force_on_plate(&wide, &thin(), &TIMES)?;
        let mut restitution = Vec::new();
        for inelasticity in [0.1, 0.25, 0.5, 1.0, 2.0] {
            let [found, exact] = restitution_at(&wide, inelasticity, &thin())?;
            restitution.push([inelasticity, found, exact]);
        }
        hear(0.4);
        let edges = edges::compute(&plate)?;
        hear(0.7);
        let residual = residual::compute()?;
        hear(1.0);
        Ok(Self {
            radius,
            stress,
            force,
            peak,
            restitution,
            edges,
            residual,
        })
    }
}

/// Hoop stress of the plate of the tables in the middle of a half-sine: of the series, of modes and of modes with their near field.
fn stress(plate: &frangible::Asset) -> Result<(f64, Vec<StressRow>), BakeError> {
    let impulse = 2.0 / std::f64::consts::PI * FORCE * DURATION;
    let top = Vec3::new(0.0, 0.0, 0.5 * PLATE.thickness as f32);
    let contact = Contact::push(top, impulse as f32 * Vec3::NEG_Z, DURATION as f32);
    let fine: Vec<f64> = (0..48).map(|i| 1e-3 * 1.065_f64.powi(i)).collect();
    let mut rows: Vec<StressRow> = Vec::new();
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
                let points = seen
                    .iter()
                    .zip(exact)
                    .map(|(p, s)| (p.distance, hoop(p, *s)));
                rows.insert(
                    0,
                    StressRow {
                        name: "all modes (series)".into(),
                        points: points.collect(),
                    },
                );
            }
            let points = seen
                .iter()
                .map(|p| (p.distance, hoop(p, felt(&body, &blow, p, step, &config))));
            rows.push(StressRow {
                name: format!("{modes} {label}"),
                points: points.collect(),
            });
        }
    }
    Ok((radius, rows))
}
