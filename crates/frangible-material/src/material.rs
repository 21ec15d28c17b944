//! Material of a body: elasticity, damping, strength, toughness.

use crate::error::{OutOfRange, not_negative, positive};
use crate::laminate::Laminate;

/// Material of a breakable body. SI units.
///
/// Presets with their sources are in [`Material::presets`]; every number may be changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name shown in reports.
    pub name: String,
    /// Young's modulus E, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio ν, in (−1, 0.5).
    pub poisson_ratio: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
    /// Rayleigh damping α, s: multiplies the **stiffness** and damps high frequencies most `[G12 Table 1]`.
    pub stiffness_damping: f64,
    /// Rayleigh damping β, 1/s: multiplies the **mass** `[G12 Table 1]`.
    pub mass_damping: f64,
    /// Tensile strength R_c, Pa: the principal tensile stress that starts a crack at a weak point `[G12 §4.4]`.
    pub strength: f64,
    /// Fracture energy G_c, J/m²: energy per crack area `[G12 Eq. 11]`.
    pub fracture_energy: f64,
    /// Depth γ of the layer whose strain energy drives a crack in the paper's model, m `[G12 Eq. 12]`. Not used by the default model.
    pub energy_depth: f64,
    /// Density of weak points, 1/m³; a higher value lets more cracks start.
    pub weak_point_density: f64,
    /// Branching constant in units of the toughness K_Ic, dimensionless: a crack that has run a distance r under the tension σ branches if
    /// σ √r reaches this multiple of K_Ic. Infinite if cracks never branch.
    pub branching_constant: f64,
    /// Amplitude of the roughness of crack surfaces, m.
    pub roughness_amplitude: f64,
    /// Wavelength of the roughness of crack surfaces, m.
    pub roughness_wavelength: f64,
    /// Crushing pressure p, Pa: the contact pressure, or hardness, at which the material crushes or flows. Infinite if it does neither.
    pub crushing_pressure: f64,
    /// Coefficient of restitution of the material against a hard surface, 0..=1.
    pub restitution: f64,
    /// Coulomb friction coefficient.
    pub friction: f64,
    /// Residual compression σ_s at the faces of a thermally tempered wall, Pa; 0 for none. Through the wall the stress is a parabola that sums
    /// to zero, with the tension σ_s/2 in the middle. A body that has one must be one wall.
    pub residual_stress: f64,
    /// Plies and films of a laminated wall; none of one plate. The [`density`](Self::density) is that of the whole wall. A body that has plies must be
    /// one wall.
    #[doc(hidden)]
    pub laminate: Option<Laminate>,
}

impl Material {
    /// Lowest allowed [`crushing_pressure`](Self::crushing_pressure), Pa. Contacts with softer materials, such as snow, outlast the simulated time of a
    /// blow.
    pub const LEAST_CRUSHING_PRESSURE: f64 = 1e4;

    /// Checks every number.
    ///
    /// # Errors
    /// The first field that is not finite or out of range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        positive("Young's modulus", self.youngs_modulus, "Pa")?;
        positive("density", self.density, "kg/m³")?;
        // Before the strength, which may have followed from it.
        positive("fracture energy", self.fracture_energy, "J/m²")?;
        positive("tensile strength", self.strength, "Pa")?;
        positive("energy depth", self.energy_depth, "m")?;
        positive("roughness wavelength", self.roughness_wavelength, "m")?;
        positive("weak point density", self.weak_point_density, "1/m³")?;
        let (must, branching) = ("above zero, and may be infinite", self.branching_constant);
        OutOfRange::unless(branching > 0.0, "branching constant", branching, must)?;
        for (what, value) in [
            ("stiffness damping", self.stiffness_damping),
            ("mass damping", self.mass_damping),
            ("roughness amplitude", self.roughness_amplitude),
            ("friction", self.friction),
            ("residual stress", self.residual_stress),
        ] {
            not_negative(what, value)?;
        }
        let (must, pressure) = (OutOfRange::CRUSHING_PRESSURE, self.crushing_pressure);
        let fits = pressure >= Self::LEAST_CRUSHING_PRESSURE;
        OutOfRange::unless(fits, "crushing pressure", pressure, must)?;
        let (nu, e) = (self.poisson_ratio, self.restitution);
        let must = "between -1 and 0.5 (glass 0.23, rubber just under 0.5)";
        OutOfRange::unless(nu > -1.0 && nu < 0.5, "Poisson's ratio", nu, must)?;
        let fits = (0.0..=1.0).contains(&e);
        OutOfRange::unless(fits, "restitution", e, OutOfRange::RESTITUTION)?;
        if let Some(laminate) = &self.laminate {
            laminate.validate()?;
        }
        let fits = self.middle_tension() < self.strength;
        OutOfRange::unless(fits, "residual stress", self.residual_stress, Self::TEMPER).map_err(
            |error| OutOfRange {
                unit: "Pa",
                ..error
            },
        )
    }

    /// Sets the tensile strength, Pa. Because the flaw size changes, the energy depth is derived again:
    /// `γ = 16 E G_c / R_c²`, at most 0.25 m, as for every [preset](Material::presets).
    #[must_use]
    pub fn with_strength(self, strength: f64) -> Self {
        let depth = energy_depth(self.youngs_modulus, self.fracture_energy, strength);
        Self {
            strength,
            energy_depth: depth,
            ..self
        }
    }

    /// Sets the fracture energy, J/m². The flaw size and the energy depth, which is proportional to it, stay the same. The strength of a flaw of
    /// given size grows with the square root of the fracture energy (Griffith), so the strength is multiplied by the square root of the ratio of
    /// the fracture energies.
    #[must_use]
    pub fn with_fracture_energy(self, fracture_energy: f64) -> Self {
        Self {
            strength: self.strength * (fracture_energy / self.fracture_energy).sqrt(),
            fracture_energy,
            ..self
        }
    }

    /// Returns the flaw depth for a strength R, Pa, and a fracture energy, J/m², in m: `a = (K_Ic / Y R)² / π` (Griffith 1921) for a long, shallow
    /// flaw, Y = 1.12.
    #[must_use]
    pub fn flaw_depth(&self, fracture_energy: f64, strength: f64) -> f64 {
        let toughness_squared = fracture_energy * self.contact_modulus();
        toughness_squared / (std::f64::consts::PI * (FLAW_SHAPE * strength).powi(2))
    }

    /// Mean distance between weak points, m.
    #[must_use]
    pub fn weak_point_spacing(&self) -> f64 {
        1.0 / self.weak_point_density.cbrt()
    }

    /// Lamé's first parameter λ, Pa.
    #[must_use]
    pub fn lame_lambda(&self) -> f64 {
        let nu = self.poisson_ratio;
        self.youngs_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }

    /// Shear modulus μ (Lamé's second parameter), Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }

    /// Rayleigh wave speed c_R ≈ 0.92 √(μ/ρ), m/s.
    #[must_use]
    pub fn rayleigh_speed(&self) -> f64 {
        0.92 * (self.shear_modulus() / self.density).sqrt()
    }

    /// Plane-strain modulus E/(1−ν²), Pa: the stiffness of the material in a Hertz contact.
    #[must_use]
    pub fn contact_modulus(&self) -> f64 {
        self.youngs_modulus / (1.0 - self.poisson_ratio * self.poisson_ratio)
    }
}

/// Y of a long, shallow flaw at a surface.
const FLAW_SHAPE: f64 = 1.12;

/// Energy depth over the depth whose strain energy pays for a crack at the strength: a crack stops where the tension is 1/√8 of
/// the strength.
const ENERGY_DEPTH_FACTOR: f64 = 8.0;

/// Largest energy depth, m.
const ENERGY_DEPTH_LIMIT: f64 = 0.25;

/// Energy depth of a material, m; [`presets`](crate::presets) say why.
pub(crate) const fn energy_depth(youngs_modulus: f64, fracture_energy: f64, strength: f64) -> f64 {
    let depth =
        ENERGY_DEPTH_FACTOR * 2.0 * youngs_modulus * fracture_energy / (strength * strength);
    if depth < ENERGY_DEPTH_LIMIT {
        depth
    } else {
        ENERGY_DEPTH_LIMIT
    }
}
