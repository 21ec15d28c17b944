//! Outcomes of impacts, and their reports.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::fragment::Breakup;
use crate::state::BodyState;

pub use crate::contact::ContactReport;
pub use crate::fragment::Fragment;

/// Outcome of an impact on a body.
#[derive(Clone, Debug)]
#[non_exhaustive]
#[expect(
    clippy::large_enum_variant,
    reason = "a refused contact must not allocate"
)]
pub enum Outcome {
    /// The body stays one piece.
    Held {
        /// Strength over the bound of the stress: above 1 nothing happened, and the larger it is, the farther the body was from cracking. At or
        /// below 1 the stress passed the strength at a weak point; cracks that part nothing may have run.
        margin: f64,
        /// Report of the impact.
        report: ImpactReport,
        /// All cracks of the body so far, if some ran that part nothing: for [`Body::set_state`](crate::Body::set_state).
        state: Option<Box<BodyState>>,
    },
    /// The body is now these fragments.
    Broke(Box<Fracture>),
}

impl Outcome {
    /// The report of the impact, whatever came of it.
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
}

impl Fracture {
    /// A break whose pieces came about elsewhere: they do not break again.
    #[must_use]
    pub fn new(fragments: Vec<Fragment>, report: ImpactReport) -> Self {
        Self {
            fragments,
            report,
            breakup: None,
        }
    }

    /// Returns true if the fragments have [velocities of their own](crate::Fragment::velocity): pieces parted while the blow was followed.
    #[must_use]
    pub fn moves_apart(&self) -> bool {
        let mut fragments = self.fragments.iter();
        fragments.any(|f| f.velocity != DVec3::ZERO || f.angular_velocity != DVec3::ZERO)
    }
}

/// Level of detail at which an impact was decided, from the cheapest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum LookedAt {
    /// Places, sizes and durations of its impulses: one number per place was enough to refuse it.
    Sizes,
    /// Largest effect of its impulses, as long as they act, on each mode: a bound free of time refused it, of the whole body or
    /// of all its parts.
    #[default]
    Impulses,
    /// The amplitudes of the modes over time: a bound of the whole body refused every time step.
    Amplitudes,
    /// The amplitudes, and bounds of parts of the body: they refused every time step.
    Clusters,
    /// Stresses at weak points.
    Stresses,
}

/// Numbers of one impact, SI units.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ImpactReport {
    /// Contact duration t_d used, s.
    pub contact_duration: f64,
    /// Hertz' duration of the contact on a rigid, free body, s; in the models that lengthen it, the duration before that.
    pub unadjusted_duration: f64,
    /// Frequency of the most excited mode, Hz.
    pub most_excited_frequency: f64,
    /// Time step Δt, s.
    pub time_step: f64,
    /// Number of time steps evaluated.
    pub time_steps: usize,
    /// Largest principal tension met at a weak point, Pa. Points whose bound stays below the strength are not looked
    /// at: 0 when that is all of them; see `stress_bound`.
    pub peak_stress: f64,
    /// Place of that tension, m, body frame: the centre of the weak point's tetrahedron.
    pub peak_point: Option<Vec3>,
    /// Upper bound of the tension at each weak point, Pa, before a crack cut it or its piece came to rest.
    pub stress_bound: f64,
    /// Level of detail at which the impact was decided.
    pub looked_at: LookedAt,
    /// Tensile strength R_c it is compared with, Pa: where it varies over the body, that of the weakest weak point.
    pub strength: f64,
    /// Largest kinetic energy that the contacts can take from the bodies' motion against each other, J. If a bound refused the impact,
    /// or impulses are given: the energy that these impulses take, Σ ½ φ v / (1 + e).
    pub approach_energy: f64,
    /// Largest modal (kinetic + elastic) energy at a time step, J.
    pub peak_elastic_energy: f64,
    /// Largest strain energy at a time step, J: with the ledger, the most that all cracks together may spend.
    pub peak_strain_energy: f64,
    /// Fracture energy Σ A G_c, J.
    pub fracture_energy: f64,
    /// Area of new cracks and of the growth of old ones (one side), m².
    pub crack_area: f64,
    /// Number of cracks that started.
    pub cracks: usize,
    /// Number of these that branched off another crack at a fork.
    pub forks: usize,
    /// Number of weak points of the body.
    pub weak_points: usize,
    /// Time of the first crack after the contact began, s.
    pub first_crack_time: Option<f64>,
    /// Place where the first crack began, m, body frame.
    pub first_crack_point: Option<Vec3>,
    /// Volume of all fragments over the volume of the body, minus one.
    pub volume_error: f64,
    /// Fractured tetrahedra, and the times at which the crack reached them, s after the contact began: crack after crack of those that this
    /// impact moved, each in the order of its growth.
    pub arrivals: Vec<Vec<(u32, f64)>>,
    /// Report of each contact, where the blow was integrated.
    pub contacts: Vec<ContactReport>,
    /// Energy that the blow brought into the body, where the blow was integrated.
    pub blow_energy: BlowEnergy,
    /// Wall-clock time of each stage.
    pub timings: StageTimings,
}

/// Energy that a blow brings into a body, and what becomes of it, J. The work less what damping takes is kept: as strain and vibration, and as motion
/// of pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct BlowEnergy {
    /// Work of the contacts on the vibration of the body and on its pieces, friction included.
    pub work: f64,
    /// Energy that damping takes while contacts push.
    pub damped: f64,
    /// Energy that the faces of pieces lose when they close and press while contacts push.
    pub faces: f64,
    /// Energy that is lost when pieces part while contacts push: of those that are too small, by then, to move on their own.
    pub released: f64,
    /// Energy of the vibration and of the pieces when the contacts part.
    pub kept: f64,
    /// Kinetic energy of the pieces that have parted, against the rigid motion of the whole body, at the end.
    pub pieces: f64,
}

/// Wall-clock times of the stages of one impact, s. Not deterministic; all else is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StageTimings {
    /// The blow: duration, force, modal response.
    pub response: f64,
    /// Displacements and stresses at weak points.
    pub stress: f64,
    /// Crack initiation and growth.
    pub cracks: f64,
    /// Search for connected pieces, in the end and at times during the motion of a blow.
    pub labels: f64,
    /// Partition, surfaces, masses.
    pub fragments: f64,
    /// Render meshes, for a body with a surface of its author's.
    pub drawing: f64,
}

impl StageTimings {
    /// Sum of all stages, s.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.response + self.stress + self.cracks + self.labels + self.fragments + self.drawing
    }
}
