//! Locally varying strength, toughness and density of weak points: factors on the values of the material, one set per fracture
//! tetrahedron.
//!
//! They are made from a function of position ([`Fields::from_function`]) or from values on a surface ([`Fields::from_surface`]). The module
//! `weakness` of `frangible-bake` makes them from zones, scored lines and painted vertices.
//!
//! The factors are not baked. They belong to a [`Breakable`](crate::Breakable), so that scored and plain bodies share an asset; culling
//! compares each cluster with its weakest point.

mod groove;
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

/// Factors on the values of the material at one position; 1 means unchanged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// Factor on the tensile strength R_c, above 0.
    pub strength: f32,
    /// Factor on the fracture energy G_c, above 0.
    pub toughness: f32,
    /// Factor on the density of weak points, 0 or above; if it is 0, no crack starts.
    pub weak_points: f32,
    /// Depth of a groove in the surface, m; 0: none. A groove is a flaw of its depth: it sets the strength and the toughness, in place of
    /// their factors.
    pub groove: f32,
}

impl Factors {
    /// Factors of 1: the unchanged material.
    pub const ONE: Self = Self {
        strength: 1.0,
        toughness: 1.0,
        weak_points: 1.0,
        groove: 0.0,
    };

    /// Scales the strength, and the toughness so that the flaw size stays the same: G_c ∝ K_Ic² ∝ R_c².
    ///
    /// If only the strength is reduced, the energy criterion may still prevent cracks.
    #[must_use]
    pub fn of_strength(strength: f32) -> Self {
        Self {
            strength,
            toughness: strength * strength,
            weak_points: 1.0,
            groove: 0.0,
        }
    }

    /// Sets the strength and the toughness to those of a groove of this depth, m.
    #[must_use]
    pub const fn of_groove(depth: f32) -> Self {
        Self {
            groove: depth,
            ..Self::ONE
        }
    }
}

/// Locally varying factors on the values of the material, and the scatter of strength. `Default`: uniform, without scatter;
/// [`Fields::of_material`]: the scatter of a material.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Fields {
    /// Factors of each fracture tetrahedron; an empty list means one everywhere.
    pub of_tet: Vec<Factors>,
    /// Weibull modulus m of the strength of weak points, drawn per body seed. Glass 5 to 10, fine ceramics 10 to 20; a lower value means
    /// more scatter. Default 0: no scatter, every weak point has the strength R_c.
    ///
    /// A test specimen is as strong as the weakest of its many flaws, so a single flaw is usually much stronger. With scatter, R_c is the
    /// stress at which 63 % of specimens fail; 63 % of single weak points fail at R_c times the m-th root of the number of weak points in a
    /// [`specimen`](Self::specimen).
    pub weibull_modulus: f64,
    /// Volume of the test specimen with strength R_c, m³; used only with scatter. Default 1e-4: a 4 mm pane with 240 cm² under load.
    pub specimen: f64,
    /// Static fatigue: decrease of strength with the duration of a load. Default: none.
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
    /// Makes uniform fields with the scatter and the fatigue of the preset with this material's name ([`Preset::weibull_modulus`],
    /// [`Preset::fatigue`]), or without either if there is no such preset.
    #[must_use]
    pub fn of_material(material: &Material) -> Self {
        Self::default().scattered_as(material)
    }

    /// Sets scatter and fatigue to the values of the preset with this material's name.
    #[doc(hidden)]
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

    /// Makes fields by evaluating `factors` at the centre of each tetrahedron, m, body frame, with the scatter of the asset's material.
    #[must_use]
    pub fn from_function(asset: &Asset, factors: impl Fn(Vec3) -> Factors) -> Self {
        let mesh = &asset.fracture;
        let of_tet = (0..mesh.tets.len()).map(|e| factors(mesh.centroid(e)));
        Self {
            of_tet: of_tet.collect(),
            ..Self::of_material(&asset.material)
        }
    }

    /// Makes fields by evaluating `factors` at the point of a surface (m, body frame) nearest to the centre of each tetrahedron. `factors`
    /// receives the vertices of the triangle with that point, and their barycentric weights.
    ///
    /// # Errors
    /// A triangle with a missing vertex, a vertex that is not finite, or no triangle.
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
    #[doc(hidden)]
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
                && f.groove.is_finite()
                && f.groove >= 0.0
                && f.weak_points.is_finite()
                && f.weak_points >= 0.0;
            if !sound {
                return Err(InputError::Field(format!(
                    "{f:?} at tetrahedron {tet}; strength and toughness must be finite and above 0, weak points and groove 0 or above"
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
