//! Strength, toughness and weak points that vary over a body: factors on its material's numbers, one per fracture
//! tetrahedron.
//!
//! They come from a function of the place ([`Fields::from_function`]), or from what a surface holds ([`Fields::from_surface`]). Zones,
//! scored lines and painted vertices are made into them by the module `weakness` of `frangible-bake`.
//!
//! Weakness is not baked. The factors belong to a [`Breakable`](crate::Breakable), so that one asset serves scored and plain
//! bodies; culling compares each cluster with its weakest point.

mod kink;
mod resistance;
mod scatter;

use glam::Vec3;

use crate::asset::Asset;
use crate::error::InputError;
use crate::material::{Fatigue, Material, Preset};
use crate::mesh::TriangleTree;

pub(crate) use kink::Tip;
pub(crate) use resistance::{Resistance, Toughness};

/// Factors on the material's numbers at a place; 1 leaves them as they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// Factor on the tensile strength R_c, above 0.
    pub strength: f32,
    /// Factor on the fracture energy G_c, above 0.
    pub toughness: f32,
    /// Factor on the density of weak points, 0 or above; where it is 0 no crack starts.
    pub weak_points: f32,
}

impl Factors {
    /// Factors that leave the material as it is.
    pub const ONE: Self = Self {
        strength: 1.0,
        toughness: 1.0,
        weak_points: 1.0,
    };

    /// This share of the strength, with the toughness of flaws of the same size: G_c ∝ K_Ic² ∝ R_c².
    ///
    /// A crack also has to pay for its area: where the strength alone is low, it is the energy that decides.
    #[must_use]
    pub fn of_strength(strength: f32) -> Self {
        Self {
            strength,
            toughness: strength * strength,
            weak_points: 1.0,
        }
    }
}

/// Factors on a material's numbers over a body, and the scatter of its strength. `Default` is none: the same everywhere.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Fields {
    /// Factors of each fracture tetrahedron; an empty list means one everywhere.
    pub of_tet: Vec<Factors>,
    /// Modulus m of a Weibull scatter of the strength from one weak point to another, another one for every body's seed. Real glass
    /// 5 to 10, fine ceramics 10 to 20; lower scatters more. Default 0: no scatter, every weak point has R_c.
    ///
    /// A tested specimen is as strong as the weakest of its many flaws, so a single flaw is usually much stronger. With a scatter
    /// R_c is the strength that 63 % of specimens do not survive, and 63 % of single weak points do not survive R_c times the m-th root
    /// of the number of weak points in a [`specimen`](Self::specimen).
    pub weibull_modulus: f64,
    /// Volume of the specimen whose strength R_c is, where strength scatters, m³. Default 1e-4: a pane of 4 mm with 240 cm² under load.
    pub specimen: f64,
    /// Fall of the strength with the time that a load lasts. Default: none.
    pub fatigue: Option<Fatigue>,
}

impl Default for Fields {
    fn default() -> Self {
        Self {
            of_tet: Vec::new(),
            weibull_modulus: 0.0,
            specimen: Preset::SPECIMEN,
            fatigue: None,
        }
    }
}

impl Fields {
    /// Fields that are one everywhere, with the scatter and the fatigue of the strength that the preset of this material's name has
    /// ([`Preset::weibull_modulus`], [`Preset::fatigue`]); none where no preset has its name.
    #[must_use]
    pub fn of_material(material: &Material) -> Self {
        Self::default().scattered_as(material)
    }

    /// Sets the scatter and the fatigue of the strength to those of the preset of this material's name.
    #[must_use]
    pub fn scattered_as(self, material: &Material) -> Self {
        match Preset::named(&material.name) {
            Some(preset) => Self {
                weibull_modulus: preset.weibull_modulus,
                specimen: preset.specimen,
                fatigue: preset.fatigue,
                ..self
            },
            None => self,
        }
    }

    /// Factors of the place of each tetrahedron's centre: m, body frame.
    #[must_use]
    pub fn from_function(asset: &Asset, factors: impl Fn(Vec3) -> Factors) -> Self {
        let mesh = &asset.fracture;
        let of_tet = (0..mesh.tets.len()).map(|e| factors(mesh.centroid(e)));
        Self {
            of_tet: of_tet.collect(),
            ..Self::default()
        }
    }

    /// Factors of the point of a surface (m, body frame) that is nearest to each tetrahedron's centre. `factors` is given the vertices of the
    /// triangle that the point lies on, and their weights.
    ///
    /// # Errors
    /// A triangle with a vertex that is not there, a vertex that is not finite, or no triangle at all.
    pub fn from_surface(
        asset: &Asset,
        positions: &[Vec3],
        triangles: &[[u32; 3]],
        factors: impl Fn([(usize, f32); 3]) -> Factors,
    ) -> Result<Self, InputError> {
        let there = |t: &[u32; 3]| t.iter().all(|&v| (v as usize) < positions.len());
        if triangles.is_empty() || !triangles.iter().all(there) {
            return Err(InputError::Field(
                "the painted surface has no triangle, or a triangle with a vertex that does not exist"
                    .into(),
            ));
        }
        if !positions.iter().all(|p| p.is_finite()) {
            return Err(InputError::Field(
                "the painted surface has a vertex that is not finite".into(),
            ));
        }
        let tree = TriangleTree::new(positions, triangles);
        Ok(Self::from_function(asset, |p| {
            let at = tree.closest(p);
            let corners = triangles[at.triangle as usize];
            factors([0, 1, 2].map(|k| (corners[k] as usize, at.weights[k])))
        }))
    }

    /// Sets the scatter of the strength, see [`Fields::weibull_modulus`].
    #[must_use]
    pub fn with_weibull_modulus(self, weibull_modulus: f64) -> Self {
        Self {
            weibull_modulus,
            ..self
        }
    }

    /// Checks that they can be those of bodies of this asset.
    pub(crate) fn check(&self, asset: &Asset) -> Result<(), InputError> {
        let tets = asset.fracture.tets.len();
        if !self.of_tet.is_empty() && self.of_tet.len() != tets {
            let given = self.of_tet.len();
            return Err(InputError::Field(format!(
                "there are factors for {given} tetrahedra, but the body has {tets}; make the fields from the body's own asset"
            )));
        }
        for (tet, f) in self.of_tet.iter().enumerate() {
            let positive = |x: f32| x.is_finite() && x > 0.0;
            let sound = positive(f.strength)
                && positive(f.toughness)
                && f.weak_points.is_finite()
                && f.weak_points >= 0.0;
            if !sound {
                return Err(InputError::Field(format!(
                    "{f:?} at tetrahedron {tet}; strength and toughness must be finite and above 0, weak points 0 or above"
                )));
            }
        }
        if !(self.specimen.is_finite() && self.specimen > 0.0) {
            return Err(InputError::Field(format!(
                "the specimen's volume is {} m³; it must be finite and above 0",
                self.specimen
            )));
        }
        if let Some(fatigue) = &self.fatigue {
            fatigue.validate()?;
        }
        let m = self.weibull_modulus;
        if m.to_bits() == 0 || (m.is_finite() && m >= 1.0) {
            Ok(())
        } else {
            Err(InputError::Field(format!(
                "the Weibull modulus is {m}; it must be 0 (no scatter), or 1 or above"
            )))
        }
    }

    /// Expected weak points over those of the material.
    pub(crate) fn weak_points(&self, tet: usize) -> f64 {
        self.of_tet
            .get(tet)
            .map_or(1.0, |f| f64::from(f.weak_points))
    }
}
