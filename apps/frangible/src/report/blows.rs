//! Blows on a body, as numbers and in words.

use frangible::ImpactReport;
use frangible_scenes::BlowRecord;
use serde::Serialize;

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
    pub(super) fn new(record: &BlowRecord) -> Self {
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
    pub(super) fn new(
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

    pub(super) fn contact_in_words(&self) -> String {
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
    pub(super) fn stress_in_words(&self) -> String {
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

pub(super) fn blows_in_words(blows: &[Blow]) -> String {
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
