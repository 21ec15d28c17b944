//! Another material or size of a baked body.

use std::path::Path;

use frangible::glam::Vec3;
use frangible::internals::Laminate;
use frangible::{Asset, Material};
use frangible_bake::{RescaleError, scaled, with_material};

use crate::error::SceneError;

/// Changes to a baked body that need no other bake. Default: nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rescale {
    /// Longest side, m.
    pub size: Option<f64>,
    /// Material, or numbers of it; Poisson's ratio must stay.
    pub material: Option<MaterialEdit>,
}

/// Numbers of a material that differ from a preset, or from the material at hand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialEdit {
    /// Preset to start from, else the material at hand.
    pub preset: Option<String>,
    /// Its name, if another.
    pub name: Option<String>,
    /// The numbers of [`MaterialEdit::KEYS`] that are changed.
    pub numbers: [Option<f64>; 16],
    /// The numbers of its [`Laminate`] that are changed, by [`Laminate::KEYS`], if it is to have one.
    pub laminate: Option<[Option<f64>; 6]>,
}

impl MaterialEdit {
    /// Names of the numbers: the fields of [`Material`] in their order.
    pub const KEYS: [&'static str; 16] = [
        "youngs_modulus",
        "poisson_ratio",
        "density",
        "stiffness_damping",
        "mass_damping",
        "strength",
        "fracture_energy",
        "energy_depth",
        "weak_point_density",
        "branching_constant",
        "roughness_amplitude",
        "roughness_wavelength",
        "crushing_pressure",
        "restitution",
        "friction",
        "residual_stress",
    ];

    /// A preset as it is.
    #[must_use]
    pub fn preset(name: impl Into<String>) -> Self {
        Self {
            preset: Some(name.into()),
            ..Self::default()
        }
    }

    /// The material with this changed. A strength alone derives the energy depth again ([`Material::with_strength`]); a fracture energy
    /// alone is that of a tougher material with the same flaws, whose strength follows ([`Material::with_fracture_energy`]).
    ///
    /// # Errors
    /// An unknown preset.
    pub fn apply(&self, at_hand: &Material) -> Result<Material, SceneError> {
        let mut m = match &self.preset {
            Some(preset) => Material::preset(preset)?,
            None => at_hand.clone(),
        };
        if let Some(name) = &self.name {
            m.name.clone_from(name);
        }
        // First the numbers that follow from a given one, then all given ones.
        let [youngs_modulus, _, _, _, _, strength, fracture_energy, ..] = self.numbers;
        m.youngs_modulus = youngs_modulus.unwrap_or(m.youngs_modulus);
        if let Some(fracture_energy) = fracture_energy {
            m = m.with_fracture_energy(fracture_energy);
        }
        if let Some(strength) = strength {
            m = m.with_strength(strength);
        }
        let places = [
            &mut m.youngs_modulus,
            &mut m.poisson_ratio,
            &mut m.density,
            &mut m.stiffness_damping,
            &mut m.mass_damping,
            &mut m.strength,
            &mut m.fracture_energy,
            &mut m.energy_depth,
            &mut m.weak_point_density,
            &mut m.branching_constant,
            &mut m.roughness_amplitude,
            &mut m.roughness_wavelength,
            &mut m.crushing_pressure,
            &mut m.restitution,
            &mut m.friction,
            &mut m.residual_stress,
        ];
        for (place, number) in places.into_iter().zip(self.numbers) {
            *place = number.unwrap_or(*place);
        }
        if let Some(given) = self.laminate {
            let mut numbers = m.laminate.unwrap_or(Laminate::PVB).numbers();
            for (place, number) in numbers.iter_mut().zip(given) {
                *place = number.unwrap_or(*place);
            }
            m.laminate = Some(Laminate::of_numbers(numbers));
        }
        Ok(m)
    }
}

/// The asset of a file with these changes.
pub(crate) fn rescaled(asset: Asset, rescale: &Rescale, path: &Path) -> Result<Asset, SceneError> {
    let wrong = |source: RescaleError| SceneError::Rescale {
        path: path.to_path_buf(),
        hint: hint(&source),
        source: Box::new(source),
    };
    let mut asset = asset;
    if let Some(edit) = &rescale.material {
        let material = edit.apply(asset.material())?;
        asset = with_material(&asset, &material).map_err(wrong)?;
    }
    if let Some(size) = rescale.size {
        let points = &asset.fracture().positions;
        let low = points.iter().fold(Vec3::INFINITY, |l, &p| l.min(p));
        let high = points.iter().fold(Vec3::NEG_INFINITY, |h, &p| h.max(p));
        let longest = f64::from((high - low).max_element());
        asset = scaled(&asset, size / longest).map_err(wrong)?;
    }
    Ok(asset)
}

/// Command to type, and the presets that need no bake.
fn hint(error: &RescaleError) -> String {
    let RescaleError::PoissonRatio {
        baked,
        wanted_material,
        ..
    } = error
    else {
        return String::new();
    };
    let same: Vec<&str> = Material::presets()
        .iter()
        .filter(|p| (p.material().poisson_ratio - baked).abs() < 1e-9)
        .map(|p| p.name)
        .collect();
    let mut hint = match Material::preset(wanted_material) {
        Ok(_) => format!(" (frangible bake MESH --material {wanted_material} -o FILE)"),
        Err(_) => " (frangible bake SCENE.toml -o FILE, with this material in the scene)".into(),
    };
    if !same.is_empty() {
        hint += &format!("; presets of its ratio: {}", same.join(", "));
    }
    hint
}
