//! Settings of the fracture model.

use crate::error::InputError;
use crate::material::OutOfRange;
use crate::mesh::Threads;

/// Settings of the fracture model. `Default` is the extended model; [`FractureConfig::as_in_the_paper`] is the paper's.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FractureConfig {
    /// The cracks. Default: [`Model::Ours`].
    #[doc(hidden)]
    pub model: Model,
    /// Contact duration model. Default: [`DurationModel::Integrated`].
    #[doc(hidden)]
    pub duration: DurationModel,
    /// Lengthens a contact with given impulse and duration until the body's vibration has no more energy than the impact supplied.
    /// Default: off, because an integrated blow does not need it.
    #[doc(hidden)]
    pub admissible_duration: bool,
    /// Includes the static response of the modes that are not integrated through time, as the residual vector, in integrated blows, blasts and
    /// sustained loads. Default: on. The paper omits these modes.
    #[doc(hidden)]
    pub residual: bool,
    /// Theory for the near field of contacts on walls: the local stress and compliance under a contact that the modes do not resolve
    /// ([`near_field`](crate::internals::near_field)). Default: elastic layer. The paper has no near field.
    #[doc(hidden)]
    pub near_field: Option<PlateTheory>,
    /// Skips time steps and places whose stress bound stays below the strength. Affects only speed: the result is bit-identical
    /// without it. Default: on.
    #[doc(hidden)]
    pub culling: bool,
    /// Time steps per period of the highest relevant mode; 2 is the Nyquist limit, 0.5 is `[G12 Eq. 3]` as printed.
    /// Above 0.1 and at most 1000. Default 8. Stress is interpolated linearly between time steps.
    pub samples_per_period: f64,
    /// Gives each weak point the flaw size that follows from its strength by Griffith's criterion, and averages the stress over that flaw.
    /// Default: on. In the paper it is a point `[G12 §4.4]`.
    #[doc(hidden)]
    pub sized_flaws: bool,
    /// Assumed duration of sustained loads, s: with static fatigue, glass that holds for a second may fail within a year
    /// ([`Fields::fatigue`](crate::internals::Fields::fatigue)). Worlds add the time for which a load has lasted in them. Zero or more.
    /// Default 1. Has no effect on blows.
    pub load_duration: f64,
    /// Smallest volume of a piece as a share of the body's volume; a smaller piece stays with the neighbour with the largest common
    /// area. Default 2e-4.
    pub crumb_share: f64,
    /// Number of pieces into which a tempered wall falls at first: clumps of dice that move together until something parts them. 1 to 10,000; never
    /// more than there are dice. Default 60.
    pub clumps: usize,
    /// Threads that compute a break. Affects only speed: the result is bit-identical for any number. Default: the caller's alone.
    #[doc(hidden)]
    pub threads: Threads,
}

/// Model of the cracks.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// Cracks start at flaws on the free surface, where no traction acts, and in walls under plane stress. They run at a finite speed, steered until no
    /// shear acts across them, fork, pass one another in walls and end inside the tetrahedron of a crack that they meet. Griffith's energy release
    /// rate feeds them, and together they spend no more than the peak strain energy. Strain is linear, as modes are: they move every point along a
    /// straight line, so quadratic strain takes a rotation of 0.03 in a swinging thin body for a stretch of 5e-4, the failure strain of glass.
    #[default]
    Ours,
    /// The cracks of `[G12 §4.4-5]`, for comparison: Green and Lagrange's strain at centres of tetrahedra; each crack runs at once, breadth-first
    /// over a noisy plane, into every neighbour that the plane crosses; the strain energy of a layer of depth γ feeds it, but for its first
    /// tetrahedron, and it stops at the face of another one.
    Paper,
}

/// Speed of cracks over that of Rayleigh waves.
pub(crate) const CRACK_SPEED: f64 = 0.5;

/// Length over which a crack turns completely, m.
const TURNING_LENGTH: f64 = 0.0067;

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

impl Default for FractureConfig {
    fn default() -> Self {
        Self {
            model: Model::Ours,
            duration: DurationModel::Integrated,
            admissible_duration: false,
            residual: true,
            near_field: Some(PlateTheory::Layer),
            culling: true,
            samples_per_period: 8.0,
            sized_flaws: true,
            load_duration: 1.0,
            crumb_share: 2e-4,
            clumps: 60,
            threads: Threads::default(),
        }
    }
}

impl FractureConfig {
    /// Checks every number. All load functions call it first.
    ///
    /// # Errors
    /// The first field that is out of range, with its range.
    #[doc(hidden)]
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
        let duration = self.load_duration;
        OutOfRange::unless(
            duration.is_finite() && duration >= 0.0,
            "`load_duration` of the fracture configuration",
            duration,
            "a finite time, 0 s or more",
        )?;
        let clumps = self.clumps;
        OutOfRange::unless(
            (1..=10_000).contains(&clumps),
            "`clumps` of the fracture configuration",
            clumps as f64,
            "between 1 and 10000",
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

    /// Returns true if the cracks are those of the paper.
    #[doc(hidden)]
    #[must_use]
    pub fn is_paper(&self) -> bool {
        self.model == Model::Paper
    }

    /// Speed of cracks over that of Rayleigh waves; none where they run at once.
    #[doc(hidden)]
    #[must_use]
    pub fn crack_speed(&self) -> Option<f64> {
        (!self.is_paper()).then_some(CRACK_SPEED)
    }

    /// Length over which a crack turns completely, m; none where it is planar.
    pub(crate) fn turning_length(&self) -> Option<f64> {
        (!self.is_paper()).then_some(TURNING_LENGTH)
    }

    /// Settings for given impulses: the extended crack model under half-sine forces with the engine's impulses, whose duration follows Hertz's law
    /// and is lengthened if they supply too much energy. Only the modes integrated through time respond, and the stress is taken at the weak
    /// point instead of averaged over its flaw. Use it on the GPU, or when the contact itself need not be resolved.
    #[doc(hidden)]
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
            model: Model::Paper,
            duration: DurationModel::ModalHertz,
            residual: false,
            near_field: None,
            samples_per_period: 16.0,
            sized_flaws: false,
            ..Self::default()
        }
    }
}
