//! Passages of the paper that can be read in two ways, or where its print and its text disagree.

/// Reading of the paper. `Default` is what `frangible::FractureConfig::as_in_the_paper` computes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Contact duration. Default: [`Duration::ModalHertz`].
    pub duration: Duration,
    /// Time step. Default: 16 samples per period.
    pub time_step: TimeStep,
    /// Elements that start cracks. Default: [`Initiation::WeakElements`].
    pub initiation: Initiation,
    /// Condition for an element to join a crack. Default: [`EnergyTest::Text`].
    pub energy_test: EnergyTest,
    /// Rule by which nodes belong together. Default: [`Marks::Elements`].
    pub marks: Marks,
    /// Beyond the paper: the duration grows by 5 % at a time until the vibration's energy, at 40 instants of the contact, is at most the energy of
    /// the approach. Default: off.
    pub admissible: bool,
    /// Beyond the paper: the waves go on after the contact, for 1.5 periods of the lowest mode that is excited to 5 % of
    /// the most excited one. Default: off.
    pub after_contact: bool,
    /// Beyond the paper: a weak element with a free outer face is tested on the largest one, where its flaw lies and no traction acts; in a thin wall
    /// none acts across the wall. Default: off.
    pub surface_flaws: bool,
    /// Beyond the paper: of the elements that pass R_c between two steps the first to do so, stress taken as linear there,
    /// starts first, and not the most stressed one. Default: off.
    pub between_steps: bool,
    /// Strain. Default: [`Strain::GreenLagrange`].
    pub strain: Strain,
}

/// `[G12 §4.4]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strain {
    /// ½(∇u + ∇uᵀ + ∇uᵀ∇u).
    GreenLagrange,
    /// Beyond the paper: ½(∇u + ∇uᵀ).
    Linear,
}

/// `[G12 §4.1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Duration {
    /// Eq. 1 with the most excited mode's λ, so that the dimensions agree: `2.868 (r / (λ² v))^(1/5)`.
    ModalHertz,
    /// Eq. 1 for the two bodies, with their effective masses, moduli and radii.
    Hertz,
    /// Eq. 2 as printed: `c ((2π / Im ω)² / v)^(1/5)`, c in m^(1/5) s^(2/5).
    AsPrinted {
        /// The constant c.
        c: f64,
    },
}

/// `[G12 §4.2]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// Eq. 3 as printed: `4π / Im ω_high`, two whole periods.
    AsPrinted,
    /// The largest step that the sampling theorem allows: `π / Im ω_high`, half a period.
    Nyquist,
    /// A whole number of steps, at least 16, per contact, with this many per period of the highest mode that matters: beside their answer to a slow
    /// force, the modes above it contribute together at most 2 % of the sum of all modes' stress bounds.
    Sampled {
        /// Steps per period.
        per_period: f64,
    },
}

/// `[G12 §4.4]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Initiation {
    /// Weak elements alone are tested and start cracks: the timings of the paper's Table 1 do not grow with the mesh.
    WeakElements,
    /// The text: all elements are tested, and the weak element nearest to the most stressed one starts a crack.
    NearestWeak,
}

/// `[G12 §5.2.3]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyTest {
    /// The text: with the candidate, `E_f + A_n G_c < E_s + A_n γ η_n`.
    Text,
    /// Algorithm 2 as printed: without it, `E_f < E_s`, and sums of the elements taken out of the queue so far.
    AsPrinted,
}

/// `[G12 §6.2]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marks {
    /// Two nodes are parted where a fractured element that has both lies between them.
    Elements,
    /// The text: two nodes of one element are parted where both bear the mark of one crack, one of each side. That
    /// also parts nodes whose common elements are whole, at the tip of a crack.
    Nodes,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            duration: Duration::ModalHertz,
            time_step: TimeStep::Sampled { per_period: 16.0 },
            initiation: Initiation::WeakElements,
            energy_test: EnergyTest::Text,
            marks: Marks::Elements,
            admissible: false,
            after_contact: false,
            surface_flaws: false,
            between_steps: false,
            strain: Strain::GreenLagrange,
        }
    }
}

impl Options {
    /// Every equation and algorithm as it is printed; `c` is Eq. 2's constant, m^(1/5) s^(2/5).
    #[must_use]
    pub fn as_printed(c: f64) -> Self {
        Self {
            duration: Duration::AsPrinted { c },
            time_step: TimeStep::AsPrinted,
            initiation: Initiation::NearestWeak,
            energy_test: EnergyTest::AsPrinted,
            marks: Marks::Nodes,
            ..Self::default()
        }
    }

    /// The model of `frangible::FractureConfig::default` up to its first crack. What follows it is not the paper's.
    #[must_use]
    pub fn first_crack_of_ours() -> Self {
        Self {
            duration: Duration::Hertz,
            admissible: true,
            after_contact: true,
            surface_flaws: true,
            between_steps: true,
            strain: Strain::Linear,
            ..Self::default()
        }
    }
}
