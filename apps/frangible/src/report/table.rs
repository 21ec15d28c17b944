//! The report as a table.

use std::fmt::Write;

use super::blows::blows_in_words;
use super::{BodyReport, Report};

impl BodyReport {
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
