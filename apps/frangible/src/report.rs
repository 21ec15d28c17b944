//! Report of a run: a table for people, JSON for scripts. In SI units unless a name says otherwise.

use std::fmt::Write;

use frangible::ImpactReport;
use frangible_scenes::{BakedBody, BlowRecord, Run};
use serde::Serialize;

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

/// Numbers of the impact that broke the body, or of the hardest that did not.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Impact {
    /// Simulated time.
    pub(crate) time_s: f64,
    pub(crate) approach_speed_m_s: f64,
    pub(crate) impulse_n_s: f64,
    pub(crate) contact_duration_s: f64,
    pub(crate) unadjusted_duration_s: f64,
    pub(crate) most_excited_hz: f64,
    pub(crate) time_step_s: f64,
    pub(crate) time_steps: usize,
    /// None where a bound showed that no stress had to be computed.
    pub(crate) peak_stress_pa: Option<f64>,
    pub(crate) stress_bound_pa: f64,
    /// Strength over the stress or its bound, at the point where it is least: each has a strength of its own. Known of a body that held.
    pub(crate) margin: Option<f64>,
    pub(crate) peak_strain_energy_j: f64,
    /// Strength of the weakest point.
    pub(crate) strength_pa: f64,
    pub(crate) weak_points: usize,
    pub(crate) cracks: usize,
    pub(crate) crack_area_m2: f64,
    pub(crate) approach_energy_j: f64,
    pub(crate) fracture_energy_j: f64,
    /// Energy spent on crushing at the contacts, and the crushed volume.
    pub(crate) crushing_energy_j: f64,
    pub(crate) crushed_volume_m3: f64,
    pub(crate) first_crack_s: Option<f64>,
    pub(crate) volume_error: f64,
}

/// One of the blows on a body.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Blow {
    /// Simulated time.
    pub(crate) time_s: f64,
    /// 0 where it hit the body itself, 1 for a piece of it.
    pub(crate) generation: u32,
    pub(crate) broke: bool,
    pub(crate) approach_speed_m_s: f64,
    pub(crate) approach_energy_j: f64,
    /// Strength over the stress or its bound. Known of a body that held.
    pub(crate) margin: Option<f64>,
}

impl Blow {
    fn new(record: &BlowRecord) -> Self {
        Self {
            time_s: record.time,
            generation: record.generation,
            broke: record.broke,
            approach_speed_m_s: record.approach_speed,
            approach_energy_j: record.approach_energy,
            margin: record.margin.filter(|m| m.is_finite()),
        }
    }
}

impl Impact {
    fn new(
        time: f64,
        report: &ImpactReport,
        contacts: &[frangible::Contact],
        margin: Option<f64>,
    ) -> Self {
        Self {
            time_s: time,
            approach_speed_m_s: approach_speed(contacts),
            impulse_n_s: contacts.iter().map(|c| f64::from(c.impulse)).sum(),
            contact_duration_s: report.contact_duration,
            unadjusted_duration_s: report.unadjusted_duration,
            most_excited_hz: report.most_excited_frequency,
            time_step_s: report.time_step,
            time_steps: report.time_steps,
            peak_stress_pa: Some(report.peak_stress).filter(|peak| *peak > 0.0),
            stress_bound_pa: report.stress_bound,
            margin: margin.filter(|m| m.is_finite()),
            peak_strain_energy_j: report.peak_strain_energy,
            strength_pa: report.strength,
            weak_points: report.weak_points,
            cracks: report.cracks,
            crack_area_m2: report.crack_area,
            approach_energy_j: report.approach_energy,
            fracture_energy_j: report.fracture_energy,
            crushing_energy_j: report.contacts.iter().map(|c| c.crushing_energy).sum(),
            crushed_volume_m3: report.contacts.iter().map(|c| c.crushed_volume).sum(),
            first_crack_s: report.first_crack_time,
            volume_error: report.volume_error,
        }
    }

    fn contact_in_words(&self) -> String {
        if self.time_steps == 0 {
            return "not simulated, because a bound on the stress rules out any crack".into();
        }
        format!(
            "{:.3} ms (Hertz on a rigid body: {:.3} ms), {} steps of {:.2} µs",
            1e3 * self.contact_duration_s,
            1e3 * self.unadjusted_duration_s,
            self.time_steps,
            1e6 * self.time_step_s
        )
    }

    /// The largest stress need not be where the margin is least, so that their quotient is no margin.
    fn stress_in_words(&self) -> String {
        let largest = match self.peak_stress_pa {
            Some(peak) => format!("largest {:.1} MPa", peak / 1e6),
            None => format!("at most {:.1} MPa", self.stress_bound_pa / 1e6),
        };
        let weakest = self.strength_pa / 1e6;
        let margin = self.margin.map_or(String::new(), |margin| {
            format!("; strength over stress at least {margin:.2} at the most critical point")
        });
        format!("{largest}, the weakest point withstands {weakest:.1} MPa{margin}")
    }
}

/// Blows that the table lists; all stand in the JSON.
const LISTED_BLOWS: usize = 6;

fn blows_in_words(blows: &[Blow]) -> String {
    let listed = blows.iter().take(LISTED_BLOWS).map(|blow| {
        let (time, speed) = (blow.time_s, blow.approach_speed_m_s);
        let what = match (blow.generation, blow.broke) {
            (0, true) => " broke it",
            (0, false) => "",
            (_, true) => " broke a piece",
            (_, false) => " hit a piece",
        };
        format!("{time:.3} s {speed:.2} m/s{what}")
    });
    let listed: Vec<String> = listed.collect();
    let more = if blows.len() > LISTED_BLOWS {
        ", …"
    } else {
        ""
    };
    format!("{}: {}{more}", blows.len(), listed.join(", "))
}

/// The fastest of the contacts, m/s.
fn approach_speed(contacts: &[frangible::Contact]) -> f64 {
    let speeds = contacts.iter().map(|c| c.approach_speed);
    f64::from(speeds.fold(0.0_f32, f32::max))
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

    fn rows(&self, row: &mut dyn FnMut(&str, String)) {
        row(
            "mesh",
            format!(
                "{} tetrahedra for cracks, {} quadratic elements for the modes ({} nodes)",
                self.fracture_tets, self.analysis_elements, self.analysis_nodes
            ),
        );
        let frequencies: Vec<String> = self
            .first_frequencies_hz
            .iter()
            .map(|f| format!("{f:.0}"))
            .collect();
        row(
            "modes",
            format!(
                "{}, {} of them integrated through time, from {} … Hz{}",
                self.modes,
                self.modes_followed,
                frequencies.join(", "),
                self.largest_residual
                    .map_or(String::new(), |r| format!(" (residual {r:.0e})"))
            ),
        );
        if let Some(closed) = self.surface_volume_m3 {
            let off = 100.0 * (self.volume_m3 / closed - 1.0);
            let closed = 1e6 * closed;
            row(
                "volume",
                format!("{off:+.3} % beside the {closed:.2} cm³ inside the surface"),
            );
        }
        if let Some(i) = &self.impact {
            row(
                "impact",
                format!(
                    "{} after {:.3} s: {:.2} m/s, {:.3} N·s, {:.3} J",
                    if self.broke {
                        "that broke it"
                    } else {
                        "the hardest"
                    },
                    i.time_s,
                    i.approach_speed_m_s,
                    i.impulse_n_s,
                    i.approach_energy_j
                ),
            );
            row("contact", i.contact_in_words());
            if i.crushing_energy_j > 0.0 {
                row(
                    "crushed",
                    format!(
                        "{:.3} mm³ under the contact, which took {:.3} J",
                        1e9 * i.crushed_volume_m3,
                        i.crushing_energy_j
                    ),
                );
            }
            row("stress", i.stress_in_words());
            row(
                "cracks",
                format!(
                    "{}, {:.1} cm², {:.3} J; {} weak points to start from",
                    i.cracks,
                    1e4 * i.crack_area_m2,
                    i.fracture_energy_j,
                    i.weak_points
                ),
            );
        } else {
            row("impact", "none hard enough to be tested for cracks".into());
        }
        if self.blows.len() > 1 {
            row("blows", blows_in_words(&self.blows));
        }
        if self.broke {
            let masses: Vec<String> = self
                .largest_fragments_kg
                .iter()
                .map(|m| format!("{:.1}", 1e3 * m))
                .collect();
            row(
                "fragments",
                format!("{} (largest {} … g)", self.fragments, masses.join(", ")),
            );
            if self.breaks_again > 0 {
                let (again, end) = (self.breaks_again, self.pieces_at_end);
                row(
                    "again",
                    format!("{again} pieces broke again, {end} at the end"),
                );
            }
            let check = |sum: f64, whole: f64| (sum / whole - 1.0).abs();
            row(
                "check",
                format!(
                    "mass {:.4} kg, off by {:.0e}; volume {:.2} cm³, off by {:.0e}",
                    self.fragment_mass_sum_kg,
                    check(self.fragment_mass_sum_kg, self.mass_kg),
                    1e6 * self.fragment_volume_sum_m3,
                    check(self.fragment_volume_sum_m3, self.volume_m3)
                ),
            );
        } else {
            row("fragments", "none: the body did not break".into());
        }
    }
}

impl Report {
    /// The report as a short table.
    pub(crate) fn table(&self) -> String {
        let mut t = String::new();
        let mut row = |name: &str, value: String| {
            // Writing to a string cannot fail.
            let _ = writeln!(t, "  {name:<15} {value}");
        };
        let material = self
            .only
            .as_ref()
            .map_or(String::new(), |body| format!(", {}", body.material));
        row(
            "scene",
            format!("{}{material}, seed {}", self.scene, self.seed),
        );
        if let Some(body) = &self.only {
            body.rows(&mut row);
        }
        for body in &self.bodies {
            row("body", format!("{}, {}", body.body, body.material));
            body.rows(&mut row);
        }
        row(
            "end",
            format!(
                "{} after {:.2} s",
                if self.at_rest {
                    "at rest"
                } else {
                    "still moving"
                },
                self.simulated_s
            ),
        );
        let [median, high, longest] = self.frames_ms;
        row(
            "frames",
            format!("median {median:.1} ms, 99th percentile {high:.1} ms, longest {longest:.0} ms"),
        );
        let stages: Vec<String> = self
            .stages_ms
            .iter()
            .map(|(name, ms)| format!("{name} {ms:.0}"))
            .collect();
        row("milliseconds", stages.join(", "));
        for file in &self.files {
            row("wrote", file.clone());
        }
        for note in &self.notes {
            row("note", note.clone());
        }
        t
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_margin_is_told_apart_from_the_largest_stress_over_the_least_strength() {
        let mut report = ImpactReport::default();
        (report.strength, report.stress_bound) = (22.1e6, 24e6);
        let refused = Impact::new(0.1, &report, &[], Some(1.003));
        assert!(refused.contact_in_words().starts_with("not simulated"));
        assert_eq!(
            refused.stress_in_words(),
            "at most 24.0 MPa, the weakest point withstands 22.1 MPa; strength over stress at least 1.00 at the most critical point"
        );
        (report.time_steps, report.peak_stress) = (40, 62e6);
        let broke = Impact::new(0.1, &report, &[], None);
        assert!(broke.contact_in_words().contains("40 steps"));
        assert_eq!(
            broke.stress_in_words(),
            "largest 62.0 MPa, the weakest point withstands 22.1 MPa"
        );
    }
}
