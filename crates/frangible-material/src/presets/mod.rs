//! Materials by name: real ones with published numbers, and the paper's own parameter sets.
//!
//! # Which numbers are measured, which are chosen
//!
//! *Published*: Young's modulus, Poisson's ratio, density, tensile strength and toughness; each preset's
//! [`Preset::source`] says where they come from, and says so where a number is an estimate. Handbooks give a fracture
//! toughness K_Ic more often than a fracture energy; for plane strain `G_c = K_Ic² (1 − ν²) / E`. Both are in the source text.
//!
//! *Derived*: the stiffness damping α from the loss factor η of structural acoustics. A mode's loss factor is
//! `α ω + β/ω`; we ask for η at 10 kHz, the middle of the frequencies at which small brittle bodies ring: `α = η / (2π · 10 kHz)`.
//! Loss factors: Cremer, Heckl, Petersson, *Structure-Borne Sound*, 3rd ed. 2005 (steel 2e-4, glass 6e-4 … 2e-3,
//! dense concrete 4e-3 … 8e-3, oak 8e-3 … 1e-2, brick 1e-2 … 2e-2, acrylic 2e-2 … 4e-2), rounded; a material that the table lacks has
//! the value of its nearest relative there. The mass damping β = 5 1/s (paper: 3 … 10) only matters below 100 Hz.
//!
//! *Strength under a blow*: a slow test lets flaws grow while it lasts, with the water at their tips in glass. A blow that loads in microseconds
//! does not, and finds the material stronger. Presets state the strength under a blow where the increase was measured: glass and
//! concrete. A resting load is compared with the strength that [`Preset::fatigue`] leaves.
//!
//! *Model parameters, not measurable on a sample*:
//! - **energy depth** γ. An edge crack of length a under tension σ releases about `2π a · σ²/(2E)` per area, so γ stands for 2πa.
//!   `γ₁ = 2 E G_c / R_c²` is the depth at which a tension of just R_c pays for its crack. Eight times that lets a crack run on
//!   until the tension falls to 1/√8 = 0.35 R_c: 2 mm for glass. Quasi-brittle materials (concrete, brick, stone) get metres by
//!   that rule; γ is capped at 0.25 m, about the largest crack in the bodies meant here, so they need more than R_c to
//!   break, as they do under impact. γ is a length of the material's flaws: [`Material::with_strength`] derives it again,
//!   [`Material::with_fracture_energy`] keeps it and lets the strength follow.
//! - **weak points** per m³: one per grain or flaw that matters, spaced about 3 mm in glass, 5 mm in brick, 10 mm in concrete.
//! - **branching constant**: that of glass for all but acrylic. In glass the radius r at which the surface turns rough, where the crack is about
//!   to split, is 13 times the depth of the flaw from which the crack came, whatever the strength (J. J. Mecholsky, R. W. Rice, S. W.
//!   Freiman, J. Am. Ceram. Soc. 57 (1974) 440, read in its abstract). A flaw of depth a, half a penny at the surface, breaks at
//!   1.24 σ √a = K_Ic; so σ √r is √13 / 1.24 = 2.9 times K_Ic.
//! - **roughness**: grain-like amplitude and wavelength; glass breaks smooth and conchoidal, concrete follows its aggregate.
//! - **crushing pressure**: a hardness, as the pressure under a contact is what crushes. Where a text gives none at the rate of a blow, and where
//!   strikers are meant to stay whole, it is infinite.
//! - **restitution** and **friction**: for whole bodies meeting a hard floor at metres per second, dry. A polished glass
//!   sphere keeps 0.97 of its speed, a drinking glass does not: the vibration takes it.
//!
//! The strikers and floors (`steel`, `rubber`, `wood`, `stone`) are isotropic and elastic here and meant to hit, not to break.

mod table;

use thiserror::Error;

use crate::fatigue::Fatigue;
use crate::laminate::Laminate;
use crate::material::Material;
use table::PRESETS;

/// Frequency at which the published loss factor is met, Hz.
const LOSS_FREQUENCY: f64 = 10_000.0;
/// Mass damping β of every real material, 1/s: the middle of the paper's 3 … 10.
const MASS_DAMPING: f64 = 5.0;
/// A name longer than this is cut in the message, characters.
const LONGEST_NAME: usize = 48;

/// A named material and the source of its numbers.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Preset {
    /// Name, lower case.
    pub name: &'static str,
    /// Short description of the material.
    pub summary: &'static str,
    /// Source of the numbers, and which of them are estimates.
    pub source: &'static str,
    /// Fracture toughness K_Ic, Pa·√m; 0 where the source gives only the fracture energy.
    pub fracture_toughness: f64,
    /// Modulus of the scatter of its strength (`Fields::weibull_modulus` of `frangible`), 0 where every weak
    /// point has the same.
    pub weibull_modulus: f64,
    /// Volume of the specimen whose strength was measured (`Fields::specimen` of `frangible`), m³.
    pub specimen: f64,
    /// Dynamic increase factor: its strength under a blow, which is that of its [`material`](Self::material), over that of a slow test. 1 where
    /// no measurement was found.
    pub dynamic_increase: f64,
    /// Static fatigue: the loss of strength under loads that last; none where it was not measured.
    pub fatigue: Option<Fatigue>,
    numbers: Numbers,
}

/// Numbers from which [`Preset::material`] is built.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Numbers {
    youngs_modulus: f64,
    poisson_ratio: f64,
    density: f64,
    strength: f64,
    fracture_energy: f64,
    stiffness_damping: f64,
    mass_damping: f64,
    energy_depth: f64,
    weak_point_density: f64,
    branching_constant: f64,
    roughness: [f64; 2],
    crushing_pressure: f64,
    restitution: f64,
    friction: f64,
    residual_stress: f64,
    laminate: Option<Laminate>,
}

impl Preset {
    /// Volume of the specimen of a strength for which no other is given, m³: a pane of 4 mm with 240 cm² under load.
    pub const SPECIMEN: f64 = 1e-4;
    /// Structural steel: balls, anvils.
    pub const STEEL: Self = table::STEEL;
    /// Granite: floors, kerbs.
    pub const STONE: Self = table::STONE;
    /// White oak across the grain: floors, table tops.
    pub const WOOD: Self = table::WOOD;

    /// The preset of that name, if there is one; case does not matter, and `_` or a space may stand for `-`.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        let wanted: String = name.trim().to_lowercase().replace(['_', ' '], "-");
        PRESETS.iter().find(|preset| preset.name == wanted)
    }

    /// Plane-strain modulus E/(1−ν²), Pa; see [`Material::contact_modulus`].
    #[must_use]
    pub const fn contact_modulus(&self) -> f64 {
        self.numbers.youngs_modulus
            / (1.0 - self.numbers.poisson_ratio * self.numbers.poisson_ratio)
    }

    /// Pressure that crushes it, Pa; see [`Material::crushing_pressure`].
    #[must_use]
    pub const fn crushing_pressure(&self) -> f64 {
        self.numbers.crushing_pressure
    }

    /// Coefficient of restitution, 0 to 1.
    #[must_use]
    pub const fn restitution(&self) -> f64 {
        self.numbers.restitution
    }

    /// Coulomb friction coefficient.
    #[must_use]
    pub const fn friction(&self) -> f64 {
        self.numbers.friction
    }

    /// The material, every field of which may then be changed.
    #[must_use]
    pub fn material(&self) -> Material {
        let n = &self.numbers;
        Material {
            name: self.name.to_owned(),
            youngs_modulus: n.youngs_modulus,
            poisson_ratio: n.poisson_ratio,
            density: n.density,
            stiffness_damping: n.stiffness_damping,
            mass_damping: n.mass_damping,
            strength: n.strength,
            fracture_energy: n.fracture_energy,
            energy_depth: n.energy_depth,
            weak_point_density: n.weak_point_density,
            branching_constant: n.branching_constant,
            roughness_amplitude: n.roughness[0],
            roughness_wavelength: n.roughness[1],
            crushing_pressure: n.crushing_pressure,
            restitution: n.restitution,
            friction: n.friction,
            residual_stress: n.residual_stress,
            laminate: n.laminate,
        }
    }
}

/// A name that is no preset's.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("unknown material `{name}`; materials: {}", names().join(", "))]
#[non_exhaustive]
pub struct UnknownMaterial {
    /// The name that was asked for, cut if very long.
    pub name: String,
}

fn names() -> Vec<&'static str> {
    PRESETS.iter().map(|preset| preset.name).collect()
}

impl Material {
    /// All presets: breakables first, then strikers and floors, then the paper's sets.
    #[must_use]
    pub fn presets() -> &'static [Preset] {
        &PRESETS
    }

    /// The preset of that name; case does not matter, and `_` or a space may stand for `-`.
    ///
    /// # Errors
    /// [`UnknownMaterial`], with all names in its message.
    pub fn preset(name: &str) -> Result<Material, UnknownMaterial> {
        let unknown = || UnknownMaterial {
            name: name.chars().take(LONGEST_NAME).collect(),
        };
        let preset = Preset::named(name).ok_or_else(unknown)?;
        Ok(preset.material())
    }
}
