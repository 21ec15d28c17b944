//! Files of a session.

use std::path::Path;

use frangible::ImpactReport;
use frangible_export::write_glb;
use frangible_recording::write_atomically;
use frangible_scenes::scene_to_toml;
use serde::Serialize;

use crate::blow::Blow;
use crate::command::Target;
use crate::error::ViewError;
use crate::session::Session;

impl Session {
    pub(crate) fn write(&mut self, target: Target, path: &Path) -> Result<(), ViewError> {
        let bytes = self.file(target)?;
        match &self.host {
            Some(host) => host.save(path, &bytes),
            None => Ok(write_atomically(path, &bytes)?),
        }
    }

    /// Contents of a file.
    fn file(&mut self, target: Target) -> Result<Vec<u8>, ViewError> {
        Ok(match target {
            Target::Scene => {
                let scene = self.wanted_scene().ok_or_else(no_scene)?;
                scene_to_toml(&scene).into_bytes()
            }
            Target::Glb => {
                let camera = self.shown().home;
                let live = self.live().ok_or_else(no_scene)?;
                write_glb(&live.recording(camera))?
            }
            Target::Script => {
                let lines: Vec<String> = self.log().iter().map(ToString::to_string).collect();
                let head = "# Replays this session: frangible view --script FILE\n";
                format!("{head}{}\n", lines.join("\n")).into_bytes()
            }
            Target::Times => {
                let publishing = self.shown().publishing;
                json(&serde_json::json!({ "session_s": publishing }))
            }
            Target::Report => {
                let blow = self.blow().ok_or_else(|| {
                    ViewError::NotNow(
                        "there has been no contact yet, so there is nothing to report".into(),
                    )
                })?;
                json(&Report::of(blow))
            }
        })
    }
}

fn no_scene() -> ViewError {
    ViewError::NotNow("no scene is loaded; load one and wait until it is baked".into())
}

/// Numbers as JSON.
fn json(numbers: &impl Serialize) -> Vec<u8> {
    let text = serde_json::to_string_pretty(numbers).unwrap_or_default();
    (text + "\n").into_bytes()
}

/// Writes numbers as JSON.
#[cfg(feature = "window")]
pub(crate) fn write_json(path: &Path, numbers: &impl Serialize) -> Result<(), ViewError> {
    Ok(write_atomically(path, &json(numbers))?)
}

/// Numbers of a contact.
#[derive(Serialize)]
struct Report<'a> {
    body: &'a str,
    time_s: f64,
    impulse_n_s: f32,
    contact_duration_s: f64,
    pieces: usize,
    masses_kg: Vec<f64>,
    cracks: usize,
    crack_area_m2: f64,
    approach_energy_j: f64,
    peak_strain_energy_j: f64,
    fracture_energy_j: f64,
    peak_stress_pa: f64,
    strength_pa: f64,
    weak_points: usize,
}

impl<'a> Report<'a> {
    fn of(blow: &'a Blow) -> Self {
        let report: &ImpactReport = &blow.report;
        let fragments = blow.fracture.iter().flat_map(|f| &f.fragments);
        Self {
            body: &blow.name,
            time_s: blow.time,
            impulse_n_s: blow.impulse(),
            contact_duration_s: report.contact_duration,
            pieces: blow.pieces(),
            masses_kg: fragments.map(|fragment| fragment.mass.mass).collect(),
            cracks: report.cracks,
            crack_area_m2: report.crack_area,
            approach_energy_j: report.approach_energy,
            peak_strain_energy_j: report.peak_strain_energy,
            fracture_energy_j: report.fracture_energy,
            peak_stress_pa: report.peak_stress,
            strength_pa: report.strength,
            weak_points: report.weak_points,
        }
    }
}
