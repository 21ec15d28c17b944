//! Numbers of a contact for the panels, as plain data that can be sent to the window's thread.

use frangible::glam::Vec3;

use crate::blow::Blow;
use crate::command::Subject;
use crate::knobs::{KNOBS, Settings};
use crate::shown::Compared;

/// Numbers of the last significant contact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlowNumbers {
    /// Name of the struck body.
    pub name: String,
    /// Simulated time, s.
    pub time: f64,
    /// True if it broke.
    pub broke: bool,
    /// Number of pieces; 1 if the body did not break.
    pub pieces: usize,
    /// Masses of the pieces, kg; empty if the body did not break.
    pub masses: Vec<f64>,
    /// Position of the first contact in the world, m.
    pub point: Option<Vec3>,
    /// Impulse of all contacts, N·s.
    pub impulse: f64,
    /// Largest approach speed of the contacts, m/s.
    pub speed: f64,
    /// Duration of the contact, s.
    pub contact_duration: f64,
    /// Frequency of the most excited mode, Hz.
    pub most_excited_frequency: f64,
    /// R_c of the weakest weak point, Pa.
    pub strength: f64,
    /// Upper bound of the tensile stress, Pa.
    pub stress_bound: f64,
    /// Largest computed tensile stress, Pa.
    pub peak_stress: f64,
    /// Number of cracks that started.
    pub cracks: usize,
    /// Area of the cracks, one side, m².
    pub crack_area: f64,
    /// Time at which the first crack started, s after the contact began; 0 without one.
    pub first_crack_time: f64,
    /// Kinetic energy of the approach, J.
    pub approach_energy: f64,
    /// Peak strain energy, J.
    pub peak_strain_energy: f64,
    /// Energy absorbed by the cracks, J.
    pub fracture_energy: f64,
    /// Energy removed from the motion to pay for the cracks, J.
    pub energy_paid: f64,
    /// Computing times of initiation, cracks and pieces, s.
    pub seconds: [f64; 3],
    /// Tetrahedra of the fracture mesh.
    pub tetrahedra: usize,
}

impl From<&Blow> for BlowNumbers {
    fn from(blow: &Blow) -> Self {
        let report = &blow.report;
        let times = &report.timings;
        let fragments = blow.fracture.iter().flat_map(|f| &f.fragments);
        let speeds = blow.contacts.iter().map(|c| c.approach_speed);
        Self {
            name: blow.name.clone(),
            time: blow.time,
            broke: blow.fracture.is_some(),
            pieces: blow.pieces(),
            masses: fragments.map(|fragment| fragment.mass.mass).collect(),
            point: blow
                .contacts
                .first()
                .map(|contact| blow.pose.rotation * contact.point + blow.pose.translation),
            impulse: f64::from(blow.impulse()),
            speed: f64::from(speeds.fold(0.0, f32::max)),
            contact_duration: report.contact_duration,
            most_excited_frequency: report.most_excited_frequency,
            strength: report.strength,
            stress_bound: report.stress_bound,
            peak_stress: report.peak_stress,
            cracks: report.cracks,
            crack_area: report.crack_area,
            first_crack_time: report.first_crack_time.unwrap_or_default(),
            approach_energy: report.approach_energy,
            peak_strain_energy: report.peak_strain_energy,
            fracture_energy: report.fracture_energy,
            energy_paid: blow.energy_paid,
            seconds: [
                times.response + times.stress,
                times.cracks,
                times.labels + times.fragments + times.drawing,
            ],
            tetrahedra: blow.body.asset().fracture().tets.len(),
        }
    }
}

/// Time series of a quantity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Name of the quantity.
    pub name: String,
    /// Time, s, and value.
    pub points: Vec<[f64; 2]>,
}

/// Time series of a contact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Course {
    /// Contact force, N.
    pub force: Series,
    /// The modes with the largest stresses: amplitude times the peak stress at unit amplitude, Pa.
    pub modes: Vec<Series>,
    /// Largest first principal stress in the body, Pa.
    pub tension: Series,
    /// R_c of the weakest weak point, Pa.
    pub strength: f64,
    /// Largest of [`Course::tension`], Pa.
    pub peak_tension: f64,
    /// Number of cracks that started.
    pub cracks: usize,
    /// Start of the first crack and end of the growth of the last one, s after the start of contact; zeros without cracks.
    pub cracking: [f64; 2],
    /// Time to the end of the motion or of the last crack's growth, s.
    pub duration: f64,
    /// Frequency, Hz, and damping, 1/s, of each mode of the body.
    pub swings: Vec<[f64; 2]>,
}

impl Course {
    /// Returns the time at a fraction of the motion, s.
    #[must_use]
    pub fn time(&self, share: f64) -> f64 {
        share.clamp(0.0, 1.0) * self.duration
    }

    /// Returns the time at a fraction of the subject's duration, s; the cracks are complete before the motion ends.
    #[must_use]
    pub fn moment(&self, subject: Subject, share: f64) -> f64 {
        match subject {
            Subject::Cracks => share.clamp(0.0, 1.0) * self.cracking[1],
            _ => self.time(share),
        }
    }
}

/// Two outcomes of one impact, in numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ComparedNumbers {
    /// The impact, and the same impact with the knobs as they are.
    pub blows: [BlowNumbers; 2],
    /// Knobs that differ: label, both values, unit.
    pub differences: Vec<(String, [f64; 2], String)>,
}

impl From<&Compared> for ComparedNumbers {
    fn from(compared: &Compared) -> Self {
        Self {
            blows: compared.blows.each_ref().map(|blow| (&**blow).into()),
            differences: compared.differences.clone(),
        }
    }
}

/// Positions of the knobs, as they are and as the scene has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KnobValues {
    /// Names of the materials.
    pub materials: [String; 2],
    /// A value for each of [`KNOBS`], in its unit.
    pub values: [Vec<f64>; 2],
}

impl From<&[Settings; 2]> for KnobValues {
    fn from(settings: &[Settings; 2]) -> Self {
        let values = |settings: &Settings| KNOBS.iter().map(|k| k.value(settings)).collect();
        Self {
            materials: settings.each_ref().map(|s| s.material.name.clone()),
            values: settings.each_ref().map(values),
        }
    }
}
