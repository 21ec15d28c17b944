//! Settings of the fracture model.

use crate::error::InputError;
use crate::material::OutOfRange;

/// Settings of the fracture model. `Default` is the extended model; [`FractureConfig::as_in_the_paper`] is the paper's.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FractureConfig {
    /// Contact duration model. Default: [`DurationModel::Integrated`].
    pub duration: DurationModel,
    /// Lengthens a contact with given impulse and duration until the body's vibration has no more energy than the impact supplied.
    /// Default: off, because an integrated blow does not need it.
    pub admissible_duration: bool,
    /// Includes the static response of the modes that are not integrated through time, as the residual vector. Default: on. The paper
    /// omits these modes.
    pub residual: bool,
    /// Theory for the near field of contacts on walls: the local stress and compliance under a contact that the modes do not resolve
    /// ([`near_field`](crate::internals::near_field)). Default: elastic layer. The paper has no near field.
    pub near_field: Option<PlateTheory>,
    /// Limits the total energy of all cracks of an impact to its peak strain energy. Default: on.
    pub energy_ledger: bool,
    /// Skips time steps and places whose stress bound stays below the strength. Affects only speed: the result is bit-identical
    /// without it. Default: on.
    pub culling: bool,
    /// Time steps per period of the highest relevant mode; 2 is the Nyquist limit, 0.5 is `[G12 Eq. 3]` as printed.
    /// Above 0.1 and at most 1000. Default 8. Stress is interpolated linearly between time steps.
    pub samples_per_period: f64,
    /// Timing of the cracks. Default: [`CrackTiming::TimeResolved`].
    pub timing: CrackTiming,
    /// Path of the cracks. Default: [`CrackPath::Steered`].
    pub path: CrackPath,
    /// Uses the Green–Lagrange strain with its quadratic terms `[G12 §4.4]`. Default: off, strain is linear. Modes move every point along a
    /// straight line, so a rotation in a swinging thin body comes with a spurious stretch: a rotation of 0.03 stretches by 5e-4, the failure
    /// strain of glass. The quadratic terms include that stretch, the linear strain does not.
    pub green_lagrange: bool,
    /// Places a weak point on the free outer face of its tetrahedron, if it has one, where no traction acts, so that strengths are
    /// surface strengths. Default: on. In the paper it lies at the centre of the tetrahedron `[G12 §4.4]`.
    pub surface_flaws: bool,
    /// Gives each weak point the flaw size that follows from its strength by Griffith's criterion, and averages the stress over that flaw.
    /// Default: on. In the paper it is a point `[G12 §4.4]`.
    pub sized_flaws: bool,
    /// Assumes plane stress, without traction through the thickness, in walls that are one layer of tetrahedra thick. Default: on. The
    /// paper uses the stress of the analysis mesh, including its noise through the thickness.
    pub plane_stress_walls: bool,
    /// Applies the energy criterion also to the tetrahedron where a crack starts. Default: on. `[G12 Algorithm 2]` does not.
    pub first_element_pays: bool,
    /// Uses Griffith's energy release rate for the current size of a crack and the tension across it, so that a cracked body is weaker.
    /// Default: on. The paper uses the strain energy of a layer of depth γ for cracks of all sizes.
    pub griffith_fronts: bool,
    /// Lets cracks branch: at a fork, when a crack has run far enough under sufficient tension, and behind another crack that opens from the
    /// opposite face of a wall. Default: on. Cracks in the paper never branch.
    pub branching: bool,
    /// Extends a crack into the crack that it meets, so that no bridge of one tetrahedron connects the pieces. Default: on. In the paper
    /// it stops at the face `[G12 §5.2.4]`.
    pub ends_inside: bool,
    /// Assumed duration of sustained loads, s: with static fatigue, glass that holds for a second may fail within a year
    /// ([`Fields::fatigue`](crate::internals::Fields::fatigue)). Worlds add the time for which a load has lasted in them. Zero or more.
    /// Default 1. Has no effect on blows.
    pub load_duration: f64,
    /// Smallest volume of a piece as a share of the body's volume; a smaller piece stays with the neighbour with the largest common
    /// area. Default 2e-4.
    pub crumb_share: f64,
}

/// Plate theory for waves that are short against the wall's thickness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlateTheory {
    /// Kirchhoff's thin plate: no shear, stress linear through the thickness. For comparison with closed-form solutions.
    Kirchhoff,
    /// Mindlin's frequencies, and the stress on the far face of an elastic layer.
    #[default]
    Layer,
}

/// Models of the contact duration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum DurationModel {
    /// Integrates striker, Hertz contact spring and body vibration together; duration, force, impulse and restitution are results
    /// ([`blow`](crate::internals::blow)).
    Integrated,
    /// Hertz's law with the local curvatures and effective masses of the two bodies `[G12 Eq. 1]`.
    Hertz,
    /// Hertz's law for the most excited mode, with consistent dimensions `[G12 Eq. 2, corrected]`.
    ModalHertz,
    /// `[G12 Eq. 2]` as printed; `c` in m^(1/5) s^(2/5).
    AsPrinted {
        /// The constant c.
        c: f64,
    },
}

/// Timing of the cracks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CrackTiming {
    /// Each crack runs to its full length, breadth-first, at the moment it starts, without interaction between cracks `[G12 §5]`.
    /// Initiation ends with the contact.
    Instant,
    /// Cracks run at a finite speed and emit release waves that unload the adjacent material.
    TimeResolved {
        /// Crack speed over the Rayleigh wave speed. Default 0.5.
        speed: f64,
    },
}

/// Path of the cracks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CrackPath {
    /// A noisy plane, fixed when the crack starts `[G12 Eq. 6-10]`. The crack enters every neighbour that the plane crosses, even if
    /// it misses the face between them `[G12 §5.2.2]`.
    Planar,
    /// A plane that turns as the crack grows, until no shear acts across it.
    Steered {
        /// Length over which the crack turns completely, m. Default 0.0067.
        turning_length: f64,
    },
}

impl Default for FractureConfig {
    fn default() -> Self {
        Self {
            duration: DurationModel::Integrated,
            admissible_duration: false,
            residual: true,
            near_field: Some(PlateTheory::Layer),
            energy_ledger: true,
            culling: true,
            samples_per_period: 8.0,
            timing: CrackTiming::TimeResolved { speed: 0.5 },
            path: CrackPath::Steered {
                turning_length: 0.0067,
            },
            green_lagrange: false,
            surface_flaws: true,
            sized_flaws: true,
            plane_stress_walls: true,
            first_element_pays: true,
            griffith_fronts: true,
            branching: true,
            ends_inside: true,
            load_duration: 1.0,
            crumb_share: 2e-4,
        }
    }
}

impl FractureConfig {
    /// Checks every number. All load functions call it first.
    ///
    /// # Errors
    /// The first field that is out of range, with its range.
    pub fn validate(&self) -> Result<(), InputError> {
        let samples = self.samples_per_period;
        OutOfRange::unless(
            samples > 0.1 && samples <= 1000.0,
            "`samples_per_period` of the fracture configuration",
            samples,
            "above 0.1 and at most 1000",
        )?;
        let within = |field, value: f64, most: f64, must| {
            OutOfRange::unless(value > 0.0 && value <= most, field, value, must)
        };
        if let DurationModel::AsPrinted { c } = self.duration {
            within(
                "`duration: AsPrinted.c` of the fracture configuration",
                c,
                1000.0,
                "above 0 and at most 1000",
            )?;
        }
        if let CrackTiming::TimeResolved { speed } = self.timing {
            within(
                "`timing: TimeResolved.speed` of the fracture configuration",
                speed,
                1.0,
                "above 0 and at most 1",
            )?;
        }
        if let CrackPath::Steered { turning_length } = self.path {
            within(
                "`path: Steered.turning_length` of the fracture configuration",
                turning_length,
                10.0,
                "above 0 and at most 10 m",
            )?;
        }
        let duration = self.load_duration;
        OutOfRange::unless(
            duration.is_finite() && duration >= 0.0,
            "`load_duration` of the fracture configuration",
            duration,
            "a finite time, 0 s or more",
        )?;
        let share = self.crumb_share;
        let fits = (0.0..1.0).contains(&share);
        OutOfRange::unless(
            fits,
            "`crumb_share` of the fracture configuration",
            share,
            "0 or more and below 1",
        )?;
        Ok(())
    }

    /// Returns true if blows are integrated, or contacts have anything beside the modes that are followed: their forces are then followed with
    /// the body, substep by substep.
    pub(crate) fn has_complement(&self) -> bool {
        self.duration == DurationModel::Integrated || self.residual || self.near_field.is_some()
    }

    /// Settings for given impulses: the extended crack model under half-sine forces with the engine's impulses, whose duration follows Hertz's law
    /// and is lengthened if they supply too much energy. Only the modes integrated through time respond, and the stress is taken at the weak
    /// point instead of averaged over its flaw. Use it on the GPU, or when the contact itself need not be resolved.
    #[must_use]
    pub fn with_given_impulses() -> Self {
        Self {
            duration: DurationModel::Hertz,
            admissible_duration: true,
            residual: false,
            near_field: None,
            samples_per_period: 16.0,
            sized_flaws: false,
            ..Self::default()
        }
    }

    /// The paper's model: modal contact duration; instantaneous planar cracks that start at element centres and stop at the face of
    /// another crack; no energy correction.
    #[must_use]
    pub fn as_in_the_paper() -> Self {
        Self {
            duration: DurationModel::ModalHertz,
            residual: false,
            near_field: None,
            samples_per_period: 16.0,
            energy_ledger: false,
            timing: CrackTiming::Instant,
            path: CrackPath::Planar,
            green_lagrange: true,
            surface_flaws: false,
            sized_flaws: false,
            plane_stress_walls: false,
            first_element_pays: false,
            griffith_fronts: false,
            branching: false,
            ends_inside: false,
            ..Self::default()
        }
    }
}
