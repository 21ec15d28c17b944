//! Breakable bodies: the shared data of a kind, and the data of each body.

mod edges;
mod flaw;
mod mesh_index;
mod patches;
mod prepared;
mod tempered;
mod thickness;

use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::asset::{Asset, EmbeddedPoint, RescaleError, StressBounds, scaled};
use crate::bounds::WeakClusters;
use crate::config::FractureConfig;
use crate::error::InputError;
use crate::fields::{Fields, Resistance, Toughness};
use crate::mesh::{SurfacePoint, WallFaces};
use crate::rng::{Purpose, stream, uniform};
use crate::state::BodyState;
use crate::stress::{Law, Places, WeakRows, weak_place};
use crate::tips::{CrackFront, Tip, fronts, tips};

pub(crate) use mesh_index::MeshIndex;
pub(crate) use prepared::Prepared;

/// A kind of breakable object: a checked and prepared asset, cheap to clone and shared by all its bodies.
#[derive(Clone, Debug)]
pub struct Breakable {
    asset: Arc<Asset>,
    prepared: Arc<Prepared>,
    fields: Arc<Fields>,
    toughness: Toughness,
    /// Its faces, if it is tempered.
    tempered: Option<Arc<WallFaces>>,
}

impl Breakable {
    /// Checks an asset and prepares it. The strength scatters from one weak point to the next and decreases under a sustained load as it does for the
    /// material with this name ([`Preset::named`](crate::internals::Preset::named)); a material with another name has uniform strength.
    ///
    /// # Errors
    /// The arrays of the asset are inconsistent, a number of its material is invalid, or the material has a
    /// [residual stress](crate::Material::residual_stress) and the body is not one wall.
    pub fn new(asset: impl Into<Arc<Asset>>) -> Result<Self, InputError> {
        let uniform = Self::uniform(asset)?;
        let fields = Fields::of_material(&uniform.asset.material);
        uniform.with_fields(fields)
    }

    /// Checks an asset and prepares it like [`Breakable::new`], but every weak point has exactly the strength of the material, under a load of any
    /// duration. For comparisons with theory, and for tests.
    ///
    /// # Errors
    /// The errors of [`Breakable::new`].
    pub fn uniform(asset: impl Into<Arc<Asset>>) -> Result<Self, InputError> {
        let asset = asset.into();
        asset.validate()?;
        Self::of_sound(asset).tempered()
    }

    /// The kind of an asset that has been checked, with uniform strength.
    pub(crate) fn of_sound(asset: Arc<Asset>) -> Self {
        let fields = Arc::new(Fields::default());
        Self {
            toughness: Toughness::new(&asset.material, &fields, &asset.fracture),
            prepared: Arc::new(Prepared::of_whole(&asset)),
            asset,
            fields,
            tempered: None,
        }
    }

    /// Returns this kind with locally varying strength, toughness and density of weak points, for scored lines or painted weakness.
    ///
    /// # Errors
    /// Fields of another asset, or with an invalid number.
    pub fn with_fields(self, fields: Fields) -> Result<Self, InputError> {
        fields.check(&self.asset)?;
        let fields = fields.with_grooves(&self.asset.material, &self.prepared.thickness);
        let fields = Arc::new(fields);
        Ok(Self {
            toughness: Toughness::new(&self.asset.material, &fields, &self.asset.fracture),
            fields,
            ..self
        })
    }

    /// Returns this kind scaled by `factor`, with the same fields.
    ///
    /// # Errors
    /// The errors of [`scaled`](crate::internals::asset::scaled).
    pub fn scaled(&self, factor: f64) -> Result<Self, RescaleError> {
        let asset = scaled(&self.asset, factor)?;
        let kind = Self::of_sound(Arc::new(asset)).tempered()?;
        let mut fields = Fields::clone(&self.fields);
        for factors in &mut fields.of_tet {
            factors.groove *= factor as f32;
        }
        Ok(kind.with_fields(fields)?)
    }

    /// The asset.
    #[must_use]
    pub fn asset(&self) -> &Arc<Asset> {
        &self.asset
    }

    /// Locally varying strength, toughness and density of weak points, and the scatter of strength.
    #[must_use]
    pub fn fields(&self) -> &Fields {
        &self.fields
    }

    /// Bounds of the stress of a motion, cluster by cluster.
    #[doc(hidden)]
    #[must_use]
    pub fn stress_bounds(&self) -> &StressBounds {
        &self.prepared.bounds
    }

    /// Makes a body of this kind; `seed` selects its weak points.
    ///
    /// Weak points are a Poisson process of the material's density (1/m³): a tetrahedron of volume V is weak
    /// with probability 1 − exp(−density V).
    #[must_use]
    pub fn body(&self, seed: u64) -> Body {
        let asset = &self.asset;
        let mut rng = stream(seed, Purpose::WeakPoints, 0);
        let weak_tets: Vec<u32> = (0..asset.fracture.tets.len())
            .filter(|&e| {
                let expected = asset.material.weak_point_density
                    * asset.fracture.volume(e)
                    * self.fields.weak_points(e);
                uniform(&mut rng) < -libm::expm1(-expected)
            })
            // A tempered wall has no flaws but those of its surface: nothing has ever touched its middle.
            .filter(|&e| self.tempered.is_none() || self.prepared.skin.flaw(e).is_some())
            .map(|e| e as u32)
            .collect();
        let resistance = Resistance::new(
            &asset.material,
            &self.fields,
            self.toughness.clone(),
            asset.fracture.tets.len(),
            &weak_tets,
            seed,
        );
        Body {
            asset: Arc::clone(asset),
            prepared: Arc::clone(&self.prepared),
            resistance,
            clusters: WeakClusters::default(),
            rows: Arc::default(),
            places: Places::new(asset.fracture.tets.len(), &weak_tets, seed),
            seed,
            weak_tets,
            tempered: self.tempered.clone(),
            state: BodyState::default(),
            tips: Vec::new(),
        }
        .clustered()
    }
}

/// A breakable body: a shared asset, and its own seed, weak points and cracks.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) asset: Arc<Asset>,
    pub(crate) prepared: Arc<Prepared>,
    pub(crate) resistance: Resistance,
    pub(crate) clusters: WeakClusters,
    /// Stress rows of its weak points; copies of the body share them.
    pub(crate) rows: Arc<WeakRows>,
    /// Places of its flaws.
    pub(crate) places: Places,
    /// Seed of its weak points and of the roughness of its cracks.
    seed: u64,
    weak_tets: Vec<u32>,
    /// Its faces, if it is tempered and whole.
    tempered: Option<Arc<WallFaces>>,
    state: BodyState,
    /// Fronts of the cracks in its state.
    pub(crate) tips: Vec<Tip>,
}

impl Body {
    /// Makes a body of this asset. For many bodies of one asset, make one [`Breakable`], which performs the checks only once.
    ///
    /// # Errors
    /// The errors of [`Breakable::new`].
    pub fn new(asset: Arc<Asset>, seed: u64) -> Result<Self, InputError> {
        Ok(Breakable::new(asset)?.body(seed))
    }

    /// The asset: meshes, modes and material.
    #[must_use]
    pub fn asset(&self) -> &Arc<Asset> {
        &self.asset
    }

    /// Seed of its weak points and of the roughness of its cracks.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Number of breaks that led to this body: 0 for an original body, 1 for a piece of it, 2 for a piece of that piece.
    #[must_use]
    pub fn generation(&self) -> u32 {
        self.asset.portion.as_ref().map_or(0, |p| p.generation())
    }

    /// Returns the point of the surface nearest to `point`, m, body frame.
    #[doc(hidden)]
    #[must_use]
    pub fn nearest_on_surface(&self, point: Vec3) -> SurfacePoint {
        self.prepared.surface.closest(point)
    }

    /// Centre of mass in the frame of the fracture mesh, m; zero except for pieces.
    #[doc(hidden)]
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        match &self.asset.portion {
            Some(portion) => portion.origin(),
            None => DVec3::ZERO,
        }
    }

    /// Prepared data of the body as it was baked.
    pub(crate) fn root(&self) -> &Arc<Prepared> {
        self.prepared.root.as_ref().unwrap_or(&self.prepared)
    }

    /// A part of this body.
    pub(crate) fn part(&self, mut asset: Asset, weak_tets: Vec<u32>, state: BodyState) -> Self {
        let prepared = match asset.portion.clone() {
            Some(portion) => {
                let (root, places) = (self.root(), &self.places);
                Arc::new(Prepared::of_piece(&mut asset, &portion, root, places))
            }
            None => Arc::clone(&self.prepared),
        };
        let resistance = self.resistance.of_part(&weak_tets);
        let tips = tips(&asset, &state, room(&asset, &prepared));
        Self {
            clusters: WeakClusters::default(),
            rows: Arc::default(),
            places: self.places.clone(),
            asset: Arc::new(asset),
            prepared,
            resistance,
            seed: self.seed,
            weak_tets,
            tempered: None,
            tips,
            state,
        }
        .clustered()
    }

    /// This body with its weak tetrahedra in clusters.
    fn clustered(mut self) -> Self {
        let flaw_depth = |e: u32| self.flaw_depth(e);
        let bounds = &self.prepared.bounds;
        self.clusters = WeakClusters::new(
            &self.asset,
            &self.weak_tets,
            bounds,
            &self.resistance,
            flaw_depth,
        );
        self
    }

    /// Returns this body with its strength multiplied by `factor` (above 0) and its toughness unchanged. A large factor shows the stress of a
    /// blow in a body that does not crack.
    #[doc(hidden)]
    #[must_use]
    pub fn strengthened(&self, factor: f32) -> Self {
        Self {
            resistance: self.resistance.strengthened(factor),
            ..self.clone()
        }
        .clustered()
    }

    /// This body under a load that has lasted so long, s; none where that makes no difference.
    pub(crate) fn tired(&self, duration: f64) -> Option<Self> {
        if duration <= 0.0 || !self.resistance.tires() {
            return None;
        }
        let tets = self.asset.fracture.tets.len();
        let tired = Self {
            resistance: self.resistance.tired(duration, tets, &self.weak_tets),
            ..self.clone()
        };
        Some(tired.clustered())
    }

    /// k of the stress bounds' quadratic term, Pa.
    pub(crate) fn quadratic_modulus(&self, config: &FractureConfig) -> f32 {
        if config.is_paper() {
            self.prepared.quadratic_modulus
        } else {
            0.0
        }
    }

    /// The current cracks of the body.
    #[must_use]
    pub fn state(&self) -> &BodyState {
        &self.state
    }

    /// The fronts of the current cracks, in the order of the state. Cracks that end at a surface everywhere have none.
    #[doc(hidden)]
    #[must_use]
    pub fn crack_fronts(&self) -> Vec<CrackFront> {
        fronts(&self.asset, &self.state, &self.tips)
    }

    /// Sets the cracks of the body, from an impact ([`Outcome::Held`](crate::Outcome::Held)) or from a saved state. Later impacts
    /// take them into account.
    ///
    /// # Errors
    /// A state that does not belong to a body of this asset.
    pub fn set_state(&mut self, state: BodyState) -> Result<(), InputError> {
        state.check(&self.asset)?;
        self.tips = tips(&self.asset, &state, room(&self.asset, &self.prepared));
        self.state = state;
        Ok(())
    }

    /// Indices of the weak fracture tetrahedra, ascending. Cracks start only there `[G12 §4.4]`.
    #[doc(hidden)]
    #[must_use]
    pub fn weak_tets(&self) -> &[u32] {
        &self.weak_tets
    }

    /// Strength R_c of a fracture tetrahedron, Pa: a crack starts there if the stress exceeds it.
    #[doc(hidden)]
    #[must_use]
    pub fn strength(&self, tet: u32) -> f32 {
        self.resistance.strength(tet)
    }

    /// Fracture energy G_c of a fracture tetrahedron, J/m².
    #[doc(hidden)]
    #[must_use]
    pub fn toughness(&self, tet: u32) -> f64 {
        self.resistance.toughness.of(tet)
    }

    /// Returns the point at which the stress of a weak tetrahedron is evaluated, and the stress law there: its flaw on the free surface, or
    /// else its centroid. `pressed`: surface triangles under a contact, whose flaws are ignored.
    #[doc(hidden)]
    #[must_use]
    pub fn weak_place(
        &self,
        tet: u32,
        config: &FractureConfig,
        pressed: &[u32],
    ) -> (EmbeddedPoint, Law) {
        let (skin, places) = (&self.prepared.skin, &self.places);
        let place = weak_place(&self.asset, skin, places, config, pressed, tet as usize);
        (place.point, place.law)
    }

    /// Smallest strength of the weak tetrahedra, Pa; the strength of the material if there are none.
    #[doc(hidden)]
    #[must_use]
    pub fn weakest(&self) -> f64 {
        self.resistance.weakest
    }
}

/// Thickness of a body at its tetrahedra where cracks have sections, m: in no wall, and of no piece.
fn room<'a>(asset: &'a Asset, prepared: &'a Prepared) -> impl Fn(u32) -> Option<f32> + 'a {
    let is_solid = |tet: usize| asset.portion.is_none() && prepared.skin.wall(asset, tet).is_none();
    move |tet| is_solid(tet as usize).then(|| prepared.thickness[tet as usize])
}
