//! Report of a run: a table for people, JSON for scripts. In SI units unless a name says otherwise.

mod blows;
mod table;

use frangible_scenes::{BakedBody, Run};
use serde::Serialize;

use self::blows::{Blow, Impact};
use crate::level::SoundReport;

/// Report of a run. If the scene has one body, its figures stand beside the scene's; of several they stand in a list.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Report {
    pub(crate) scene: String,
    pub(crate) seed: u64,
    #[serde(flatten)]
    pub(crate) only: Option<BodyReport>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) bodies: Vec<BodyReport>,
    /// Level of the sound file, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sound: Option<SoundReport>,
    pub(crate) at_rest: bool,
    pub(crate) simulated_s: f64,
    /// Wall-clock times of frames of 1/60 s: median, 99th percentile, longest.
    pub(crate) frames_ms: [f64; 3],
    pub(crate) stages_ms: Vec<(String, f64)>,
    pub(crate) files: Vec<String>,
    pub(crate) notes: Vec<String>,
}

/// Outcome of the run for one body.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct BodyReport {
    pub(crate) body: String,
    pub(crate) material: String,
    pub(crate) broke: bool,
    pub(crate) fracture_nodes: usize,
    pub(crate) fracture_tets: usize,
    pub(crate) analysis_nodes: usize,
    pub(crate) analysis_elements: usize,
    pub(crate) modes: usize,
    pub(crate) modes_followed: usize,
    pub(crate) first_frequencies_hz: Vec<f64>,
    /// Known of bodies baked in this run.
    pub(crate) largest_residual: Option<f64>,
    pub(crate) impact: Option<Impact>,
    /// Blows on the body or its pieces, in the order of time.
    pub(crate) blows: Vec<Blow>,
    pub(crate) fragments: usize,
    pub(crate) mass_kg: f64,
    pub(crate) fragment_mass_sum_kg: f64,
    pub(crate) volume_m3: f64,
    /// Volume inside the closed surface of the file, if the body was made from one.
    pub(crate) surface_volume_m3: Option<f64>,
    pub(crate) fragment_volume_sum_m3: f64,
    pub(crate) largest_fragments_kg: Vec<f64>,
    /// Pieces that broke again.
    pub(crate) breaks_again: usize,
    /// Pieces at the end.
    pub(crate) pieces_at_end: usize,
}

/// Median, 99th percentile and longest, ms.
pub(crate) fn frames_ms(run: &Run) -> [f64; 3] {
    let mut sorted = run.frame_seconds.clone();
    sorted.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let place = (share * (sorted.len().saturating_sub(1)) as f64).round();
        1e3 * sorted.get(place as usize).copied().unwrap_or(0.0)
    };
    [at(0.5), at(0.99), at(1.0)]
}

impl BodyReport {
    /// The report of the body of this number, from 0.
    pub(crate) fn new(name: &str, baked: &BakedBody, run: &Run, number: usize) -> Self {
        let asset = &*baked.asset;
        let broken = run.break_of(number);
        let held = run.held_by(number);
        let impact = broken
            .map(|b| Impact::new(b.time, &b.report, &b.contacts, None))
            .or_else(|| held.map(|h| Impact::new(h.time, &h.report, &h.contacts, Some(h.margin))));
        let blows = run.blows.iter().filter(|b| b.body == number);
        let modes = asset.modes().count();
        let breaks = || run.breaks.iter().filter(|b| b.body == number);
        Self {
            body: name.into(),
            material: asset.material().name.clone(),
            broke: broken.is_some(),
            fracture_nodes: asset.fracture().positions.len(),
            fracture_tets: asset.fracture().tets.len(),
            analysis_nodes: asset.analysis().nodes.len(),
            analysis_elements: asset.analysis().elements.len(),
            modes,
            modes_followed: asset.modes().followed(),
            first_frequencies_hz: (0..modes.min(4))
                .map(|i| asset.modes().frequency(i))
                .collect(),
            largest_residual: baked.report.as_ref().map(|r| r.max_residual),
            impact,
            blows: blows.map(Blow::new).collect(),
            fragments: broken.map_or(1, |b| b.masses.len()),
            mass_kg: asset.mass().mass,
            fragment_mass_sum_kg: broken.map_or(asset.mass().mass, |b| b.masses.iter().sum()),
            volume_m3: asset.mass().volume,
            surface_volume_m3: baked.report.as_ref().and_then(|r| r.closed_volume),
            fragment_volume_sum_m3: broken.map_or(asset.mass().volume, |b| b.volume),
            breaks_again: breaks().filter(|b| b.generation > 0).count(),
            pieces_at_end: 1 + breaks().map(|b| b.masses.len() - 1).sum::<usize>(),
            largest_fragments_kg: broken
                .map_or(Vec::new(), |b| b.masses.iter().copied().take(5).collect()),
        }
    }
}
