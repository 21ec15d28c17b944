//! Numbers of a contact for the panels, as plain data that reaches a window in any place.

use frangible::glam::Vec3;
use frangible_compare::Method;

use crate::blow::Blow;
use crate::command::Subject;
use crate::knobs::{KNOBS, Settings};
use crate::methods::Methods;
use crate::shown::Compared;

/// The last contact that mattered, in numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlowNumbers {
    /// Name of the body that was hit.
    pub name: String,
    /// Simulated time, s.
    pub time: f64,
    /// True if it broke.
    pub broke: bool,
    /// Pieces it left; 1 where it held.
    pub pieces: usize,
    /// Their masses, kg; none where it held.
    pub masses: Vec<f64>,
    /// Position of the first contact in the world, m.
    pub point: Option<Vec3>,
    /// Impulse of all contacts, N·s.
    pub impulse: f64,
    /// Speed of the fastest contact, m/s.
    pub speed: f64,
    /// Length of the contact, s.
    pub contact_duration: f64,
    /// Frequency of the mode that was excited most, Hz.
    pub most_excited_frequency: f64,
    /// R_c of the weakest weak point, Pa.
    pub strength: f64,
    /// No tension was larger, Pa.
    pub stress_bound: f64,
    /// Largest tension that was seen, Pa.
    pub peak_stress: f64,
    /// Cracks that started.
    pub cracks: usize,
    /// Area of the cracks, one side, m².
    pub crack_area: f64,
    /// Time at which the first crack started, s after the contact began; 0 without one.
    pub first_crack_time: f64,
    /// Kinetic energy of the approach, J.
    pub approach_energy: f64,
    /// Strain energy at its peak, J.
    pub peak_strain_energy: f64,
    /// Energy that the cracks took, J.
    pub fracture_energy: f64,
    /// Energy taken from the motion for them, J.
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
            tetrahedra: blow.body.asset().fracture.tets.len(),
        }
    }
}

/// A number over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Name of the quantity.
    pub name: String,
    /// Time, s, and value.
    pub points: Vec<[f64; 2]>,
}

/// A contact over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Course {
    /// The contact's force, N.
    pub force: Series,
    /// The modes that strain the body most: amplitude × the largest stress of a unit of it, Pa.
    pub modes: Vec<Series>,
    /// Largest principal tension anywhere in the body, Pa.
    pub tension: Series,
    /// R_c of the weakest weak point, Pa.
    pub strength: f64,
    /// Largest of [`Course::tension`], Pa.
    pub peak_tension: f64,
    /// Cracks that started.
    pub cracks: usize,
    /// Times at which the first of them started and the last one grew, s after the contact began; zeros without one.
    pub cracking: [f64; 2],
    /// Length of the motion, or until the last crack grew, s.
    pub duration: f64,
    /// Frequency, Hz, and damping, 1/s, of each mode of the body.
    pub swings: Vec<[f64; 2]>,
}

impl Course {
    /// Time of a share of the motion, s.
    #[must_use]
    pub fn time(&self, share: f64) -> f64 {
        share.clamp(0.0, 1.0) * self.duration
    }

    /// Time of a share of the subject's duration, s: the cracks are complete before the motion ends.
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

/// Numbers of one method's outcome for an impact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutcomeNumbers {
    /// The method.
    pub method: Method,
    /// Pieces, 1 where it held.
    pub pieces: usize,
    /// The largest piece's share of the volume.
    pub largest_share: f64,
    /// Area of its cracks, one side, m².
    pub crack_area: f64,
    /// Fracture energy of its cracks, J.
    pub energy: f64,
    /// Time from the contacts to the pieces, s.
    pub seconds: f64,
}

impl OutcomeNumbers {
    /// Numbers of the methods that are shown, as far as they have come.
    pub(crate) fn of(methods: &Methods) -> Vec<Self> {
        let outcomes = methods.chosen.iter().filter_map(|m| methods.outcome(*m));
        outcomes.map(|outcome| outcome.numbers.clone()).collect()
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
