//! Outcomes of impacts, and their reports.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::blow::Blow;
use crate::body::Body;
use crate::crack::{CrackMark, CrackSystem, Peak};
use crate::fragment::Breakup;
use crate::motion::Motion;
use crate::state::BodyState;

pub use crate::blow::BlowEnergy;
pub use crate::contact::ContactReport;
pub use crate::dice::Clump;
pub use crate::fragment::{FilmBond, Fragment};

/// Outcome of an impact on a body.
#[derive(Clone, Debug)]
#[non_exhaustive]
#[expect(
    clippy::large_enum_variant,
    reason = "a refused contact must not allocate"
)]
pub enum Outcome {
    /// The body did not break.
    Held {
        /// Strength over an upper bound of the stress. Above 1 no crack started, with more reserve the larger it is. At or below 1 the stress
        /// exceeded the strength at a weak point, and cracks may have run without separating any piece.
        margin: f64,
        /// Report of the impact.
        report: ImpactReport,
        /// All cracks of the body so far, if this impact added any; pass it to [`Body::set_state`](crate::Body::set_state).
        state: Option<Box<BodyState>>,
    },
    /// The body broke into these fragments.
    Broke(Box<Fracture>),
}

impl Outcome {
    /// Report of the impact.
    #[must_use]
    pub fn report(&self) -> &ImpactReport {
        match self {
            Self::Held { report, .. } => report,
            Self::Broke(fracture) => &fracture.report,
        }
    }
}

/// A break: the pieces, and the report of the impact.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Fracture {
    /// The pieces, largest first; together they tile the body.
    pub fragments: Vec<Fragment>,
    /// Report of the impact.
    pub report: ImpactReport,
    /// Data for pieces that are to break again; none for pieces that came about elsewhere.
    pub(crate) breakup: Option<Arc<Breakup>>,
    /// The dice of each piece, where the pieces are clumps of dice.
    pub(crate) clumps: Vec<Arc<Clump>>,
    /// The films that hold the pieces of a laminated wall together.
    pub(crate) film: Vec<FilmBond>,
}

impl Fracture {
    /// Makes a break from pieces that were computed elsewhere. They cannot break again.
    #[doc(hidden)]
    #[must_use]
    pub fn new(fragments: Vec<Fragment>, report: ImpactReport) -> Self {
        Self {
            fragments,
            report,
            breakup: None,
            clumps: Vec::new(),
            film: Vec::new(),
        }
    }

    /// The films that hold the pieces of a laminated wall together; none of other bodies. A world that follows the pieces keeps two of them together until
    /// the film between them tears.
    #[doc(hidden)]
    #[must_use]
    pub fn film(&self) -> &[FilmBond] {
        &self.film
    }

    /// The dice that a piece consists of, if it is a clump of dice. Such a piece holds by nothing but its shape, and a world that follows it may
    /// [part](Clump::part) it where it is hit.
    #[doc(hidden)]
    #[must_use]
    pub fn clump(&self, piece: usize) -> Option<&Arc<Clump>> {
        self.clumps.get(piece)
    }

    /// Returns true if the fragments have [velocities of their own](crate::Fragment::velocity), because pieces separated during an integrated blow.
    #[doc(hidden)]
    #[must_use]
    pub fn moves_apart(&self) -> bool {
        let mut fragments = self.fragments.iter();
        fragments.any(|f| f.velocity != DVec3::ZERO || f.angular_velocity != DVec3::ZERO)
    }
}

impl Clump {
    /// The break into so many clumps, or single dice where it has fewer.
    #[must_use]
    pub fn parted(&self, into: usize) -> Fracture {
        let (fragments, clumps) = self.part(into);
        Fracture {
            clumps,
            ..Fracture::new(fragments, ImpactReport::default())
        }
    }
}

/// Stage at which an impact was decided, from the cheapest to the most expensive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum LookedAt {
    /// A bound from the positions, sizes and durations of the impulses ruled out cracks.
    Sizes,
    /// A time-independent bound from the largest effect of the impulses on each mode ruled out cracks, in the whole body or in each part.
    #[default]
    Impulses,
    /// A bound for the whole body from the modal amplitudes ruled out cracks in every time step.
    Amplitudes,
    /// Bounds for the clusters of the body from the modal amplitudes ruled out cracks in every time step.
    Clusters,
    /// Stresses at weak points were computed.
    Stresses,
}

/// Results of an impact, in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ImpactReport {
    /// Contact duration t_d, s.
    pub contact_duration: f64,
    /// Hertz contact duration for a rigid, free body, s; in models that lengthen the duration, the value before lengthening.
    #[doc(hidden)]
    pub unadjusted_duration: f64,
    /// Frequency of the most excited mode, Hz.
    #[doc(hidden)]
    pub most_excited_frequency: f64,
    /// Time step Δt, s.
    #[doc(hidden)]
    pub time_step: f64,
    /// Number of time steps evaluated.
    #[doc(hidden)]
    pub time_steps: usize,
    /// Largest principal tensile stress computed at a weak point, Pa. Points whose bound stays below the strength are skipped, so it is 0 if
    /// all are; see `stress_bound`.
    pub peak_stress: f64,
    /// Position of that stress, m, body frame: the centre of the weak point's tetrahedron.
    pub peak_point: Option<Vec3>,
    /// Upper bound of the tensile stress at all weak points, Pa, until a crack cuts the point or its piece comes to rest.
    #[doc(hidden)]
    pub stress_bound: f64,
    /// Level of detail at which the impact was decided.
    #[doc(hidden)]
    pub looked_at: LookedAt,
    /// Tensile strength R_c, Pa; if it varies over the body, that of the weakest weak point.
    pub strength: f64,
    /// Largest kinetic energy that the contacts can take from the relative motion of the bodies, J. If a bound decided the impact, or impulses
    /// are given, the energy that these impulses take, Σ ½ φ v / (1 + e).
    #[doc(hidden)]
    pub approach_energy: f64,
    /// Largest modal (kinetic + elastic) energy at a time step, J.
    #[doc(hidden)]
    pub peak_elastic_energy: f64,
    /// Largest strain energy at a time step, J; with the energy ledger, the limit of the total energy of all cracks.
    #[doc(hidden)]
    pub peak_strain_energy: f64,
    /// Fracture energy Σ A G_c, J. The cracks between dice are not counted: the residual stress pays for them, not the blow.
    pub fracture_energy: f64,
    /// Area of new cracks and of the growth of old cracks (one side), m².
    pub crack_area: f64,
    /// Number of cracks that started.
    pub cracks: usize,
    /// Number of cracks that branched off another crack at a fork.
    #[doc(hidden)]
    pub forks: usize,
    /// Number of weak points of the body.
    #[doc(hidden)]
    pub weak_points: usize,
    /// Time of the first crack since the start of the contact, s.
    #[doc(hidden)]
    pub first_crack_time: Option<f64>,
    /// Position where the first crack started, m, body frame.
    pub first_crack_point: Option<Vec3>,
    /// Volume of all fragments over the volume of the body, minus one.
    #[doc(hidden)]
    pub volume_error: f64,
    /// Fractured tetrahedra and their arrival times, s since the start of the contact: one list per crack that this impact extended, in the
    /// order of growth.
    #[doc(hidden)]
    pub arrivals: Vec<Vec<(u32, f64)>>,
    /// Marks on the faces of the new cracks, in the order of `arrivals`; none in materials other than glass.
    #[doc(hidden)]
    pub marks: Vec<CrackMark>,
    /// Report of each contact, if the blow was integrated.
    pub contacts: Vec<ContactReport>,
    /// Energy balance of the blow, if it was integrated.
    #[doc(hidden)]
    pub blow_energy: BlowEnergy,
    /// Wall-clock time of each stage.
    #[doc(hidden)]
    pub timings: StageTimings,
}

impl ImpactReport {
    /// A report with what is known of every load.
    pub(crate) fn of(body: &Body) -> Self {
        Self {
            strength: body.resistance.weakest,
            weak_points: body.weak_tets().len(),
            ..Self::default()
        }
    }

    /// Takes over the contacts of a blow.
    pub(crate) fn take_blow(&mut self, blow: &Blow) {
        self.contacts = blow.reports();
        self.blow_energy = blow.accounts();
        self.contact_duration = blow.duration();
        self.time_steps = blow.motion().steps();
    }

    /// Takes over the energies of the motion.
    pub(crate) fn take_motion(&mut self, motion: &Motion) {
        self.peak_elastic_energy = motion.peak_energy;
        self.peak_strain_energy = motion.peak_strain_energy;
    }

    /// Takes over the largest stress.
    pub(crate) fn take_peak(&mut self, peak: Peak, body: &Body) {
        self.peak_stress = f64::from(peak.tension);
        if peak.tension > 0.0 {
            let place = body.prepared.centroids[peak.tet as usize].as_dvec3();
            self.peak_point = Some((place - body.origin()).as_vec3());
        }
    }

    /// Takes over the cracks.
    pub(crate) fn take_cracks(&mut self, system: &CrackSystem, body: &Body) {
        if let Some(first) = system.cracks.get(system.old_cracks) {
            self.first_crack_time = first.elements.first().map(|cut| cut.time);
            self.first_crack_point = Some(first.frame.origin - body.origin().as_vec3());
        }
        self.cracks = system.cracks.len() - system.old_cracks;
        self.forks = system.forks;
        self.crack_area = system.area;
        self.fracture_energy = system.ledger.spent();
        self.arrivals = system.arrivals();
        self.marks = system.marks(body);
    }
}

/// Wall-clock times of the stages of an impact, s. The only non-deterministic output.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StageTimings {
    /// The blow: duration, force, modal response.
    pub response: f64,
    /// Displacements and stresses at weak points.
    pub stress: f64,
    /// Crack initiation and growth.
    pub cracks: f64,
    /// Search for connected pieces, at the end and at intervals during the blow.
    pub labels: f64,
    /// Partition, surfaces and masses of the fragments.
    pub fragments: f64,
    /// Render meshes, for a body with an authored surface.
    pub drawing: f64,
}

impl StageTimings {
    /// Sum of all stages, s.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.response + self.stress + self.cracks + self.labels + self.fragments + self.drawing
    }
}
