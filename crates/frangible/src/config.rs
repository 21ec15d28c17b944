//! Switches and numbers of the fracture model.

use crate::error::InputError;
use crate::material::OutOfRange;

/// Settings for turning an impact into cracks. `Default` is our model; [`FractureConfig::as_in_the_paper`] is the paper's.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FractureConfig {
    /// Contact duration model. Default: [`DurationModel::Integrated`].
    pub duration: DurationModel,
    /// Lengthens a contact whose impulse and duration are given until the body's vibration holds no more energy than the impact
    /// brought. Default: off; a blow that is integrated has no need of it.
    pub admissible_duration: bool,
    /// Lets modes that are not followed through time answer the force statically, as the residual vector. Default: on; in the paper
    /// they are left out.
    pub residual: bool,
    /// Near field of contacts on walls: the stress right under them that no mode shows, and the wall's compliance there
    /// ([`near_field`](crate::internals::near_field)). Default: that of an elastic layer; in the paper there is none.
    pub near_field: Option<PlateTheory>,
    /// Limits the energy that all cracks of an impact spend together to its peak strain energy. Default: on.
    pub energy_ledger: bool,
    /// Passes over times and places whose stress bound stays below the strength; what breaks, and how, is the same bit for
    /// bit without, only slower. Default: on.
    pub culling: bool,
    /// Samples per period of the highest mode that matters; 2 is Nyquist's limit, 0.5 is `[G12 Eq. 3]` as printed.
    /// Above 0.1 and at most 1000. Default 8: between samples stress is taken as linear.
    pub samples_per_period: f64,
    /// Timing of the cracks. Default: [`CrackTiming::TimeResolved`].
    pub timing: CrackTiming,
    /// Path of the cracks. Default: [`CrackPath::Steered`].
    pub path: CrackPath,
    /// Takes Green and Lagrange's strain, with its quadratic terms `[G12 §4.4]`. Default: off, strain is linear. Modes move every point along
    /// a straight line, so where a thin body swings they turn it and stretch it at once: a turn of 0.03 is a stretch of 5e-4, which is
    /// the strength of glass. The quadratic terms count that stretch, the linear strain does not.
    pub green_lagrange: bool,
    /// Puts a weak point whose tetrahedron has a free outer face on that face, where no traction acts; strengths are then those of
    /// surfaces. Default: on; in the paper it lies at the tetrahedron's centre `[G12 §4.4]`.
    pub surface_flaws: bool,
    /// Lets a weak point stand for a flaw of the size that Griffith's criterion gives for its strength, and feel the mean stress over it. Default:
    /// on; in the paper it is a point `[G12 §4.4]`.
    pub sized_flaws: bool,
    /// Assumes plane stress in walls of one layer of tetrahedra: no traction acts through them. Default: on; in the paper stress is
    /// what the modes' mesh says, noise across the wall included.
    pub plane_stress_walls: bool,
    /// Makes the tetrahedron where a crack starts pay for its own area. Default: on; `[G12 Algorithm 2]` does not ask.
    pub first_element_pays: bool,
    /// Feeds a crack's front by Griffith's energy for the crack's present size and the tension across it: a cracked body is weaker.
    /// Default: on; in the paper a front is fed by the strain energy of a layer of depth γ, for cracks of all sizes.
    pub griffith_fronts: bool,
    /// Lets cracks branch: at a fork, where a crack has run far enough under enough tension, and behind a crack that another one has met and that
    /// opens from the other face of a wall. Default: on; the paper's never do.
    pub branching: bool,
    /// Ends a crack also inside what it meets, so that no bridge of one tetrahedron holds pieces together. Default: on;
    /// in the paper it stops at the face `[G12 §5.2.4]`.
    pub ends_inside: bool,
    /// Time for which a resting load has lasted, s: glass that holds for a second may not hold for a year
    /// ([`Fields::fatigue`](crate::internals::Fields::fatigue)). Zero or more. Default 1. Blows are over before it matters.
    pub load_duration: f64,
    /// Share of the body's volume below which a piece stays with the neighbour it shares most area with. Default 2e-4.
    pub crumb_share: f64,
}

/// Plate theory for waves that are short against the wall's thickness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlateTheory {
    /// Thin plates: no shear, stress linear through the wall. For comparison with closed forms.
    Kirchhoff,
    /// Mindlin's frequencies, and the stress of an elastic layer's far face.
    #[default]
    Layer,
}

/// Contact duration models, theory in `contact/duration.rs`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum DurationModel {
    /// None: striker, Hertz' spring and the body's vibration are integrated together, and duration, force, impulse and
    /// restitution are outcomes ([`blow`](crate::internals::blow)).
    Integrated,
    /// Hertz' law for the two bodies, local curvatures and effective masses `[G12 Eq. 1]`.
    Hertz,
    /// The most excited mode in Hertz' law, with consistent dimensions `[G12 Eq. 2, corrected]`.
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
    /// A crack runs its whole length the moment it starts, breadth-first, and no crack feels another `[G12 §5]`; ends with
    /// the contact.
    Instant,
    /// Cracks run at a finite speed, and release waves that they send out unload the material beside them.
    TimeResolved {
        /// Crack speed over the Rayleigh wave speed. Default 0.5.
        speed: f64,
    },
}

/// Path of the cracks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CrackPath {
    /// A plane with noise, fixed when the crack starts `[G12 Eq. 6-10]`; it enters every neighbour that it crosses, even
    /// where it misses the face between them `[G12 §5.2.2]`.
    Planar,
    /// A plane that turns as it goes until no shear acts across it.
    Steered {
        /// Length over which the crack turns fully, m. Default 0.0067.
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
    /// Checks that every number can be used. All loads ask it first.
    ///
    /// # Errors
    /// Names the first field that is out of its range, and the range.
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

    /// Settings for given impulses: our cracks under half-sines of the engine's impulses, which last as long as Hertz' law says and longer where they
    /// brought in too much energy. Only the modes that are followed answer, and a weak point feels the stress there in place of the mean over its
    /// flaw. For what a GPU can take over, and where the blow itself is not the question.
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

    /// The paper's model: modal duration, instant planar cracks that start freely at the centres of elements and stop at the
    /// face of another, no energy correction.
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
