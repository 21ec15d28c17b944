//! Breakable bodies: what is shared by all bodies of a kind, and what is a body's own.

use std::sync::{Arc, OnceLock};

use glam::{DVec3, Vec3};

use crate::asset::{Asset, EmbeddedPoint};
use crate::config::FractureConfig;
use crate::contact::PerImpulse;
use crate::crack::{CrackFront, Tip, fronts, tips, weak_place};
use crate::error::InputError;
use crate::fields::{Fields, Resistance, Toughness};
use crate::fragment::{MeshIndex, RenderIndex};
use crate::loads::PerNewton;
use crate::mesh::{SurfacePoint, TriangleTree};
use crate::modal::{ModalBasis, Reaches};
use crate::rng::{Purpose, stream, uniform};
use crate::state::BodyState;
use crate::stress::{Law, ShapeWeights, Skin, StressBounds, quadratic_modulus};
use crate::weak_clusters::WeakClusters;
use crate::weak_rows::WeakRows;

/// An asset that has been checked and made ready: one per kind of object, cheap to clone, shared by its bodies.
#[derive(Clone, Debug)]
pub struct Breakable {
    asset: Arc<Asset>,
    prepared: Arc<Prepared>,
    fields: Arc<Fields>,
    toughness: Toughness,
}

/// What follows from an asset and every impact needs.
#[derive(Debug)]
pub(crate) struct Prepared {
    /// What was prepared for the body as it was baked, where this is a piece of it.
    pub(crate) root: Option<Arc<Prepared>>,
    /// What hangs together in the fracture mesh.
    pub(crate) index: Arc<MeshIndex>,
    /// Over the triangles of the outer surface.
    pub(crate) surface: TriangleTree,
    /// Over those of the render surface; none of a piece.
    pub(crate) render: Option<RenderIndex>,
    /// Free surfaces: flaws and walls.
    pub(crate) skin: Skin,
    /// Stress bounds of the clusters.
    pub(crate) bounds: StressBounds,
    /// Stress bounds of the whole body: stress and gradient, one number per mode.
    pub(crate) whole: (Vec<f32>, Vec<f32>),
    /// 1/√λ_i of every mode, s.
    pub(crate) periods: Vec<f32>,
    /// How far an impulse moves each mode.
    pub(crate) reaches: Reaches,
    /// What an impulse does at most, by place and duration.
    pub(crate) per_impulse: PerImpulse,
    /// Σ φ_i dm of every mode, √kg: what a held body's weight pushes; empty for a free one, where it is zero.
    pub(crate) weight: Vec<Vec3>,
    /// k of the bounds' quadratic term, Pa.
    pub(crate) quadratic_modulus: f32,
    /// What any newton does at most; made when it is asked for.
    pub(crate) per_newton: OnceLock<PerNewton>,
    /// Centroid of each fracture tetrahedron, m.
    pub(crate) centroids: Arc<[Vec3]>,
    /// Mean edge of the fracture mesh, m.
    pub(crate) edge: f32,
    /// Longest edge of the fracture mesh, m.
    pub(crate) longest_edge: f32,
}

impl Breakable {
    /// Checks an asset and makes it ready.
    ///
    /// # Errors
    /// When the asset's arrays do not fit together, or a number of its material is unusable.
    pub fn new(asset: impl Into<Arc<Asset>>) -> Result<Self, InputError> {
        let asset = asset.into();
        asset.validate()?;
        Ok(Self::of_sound(asset))
    }

    /// The kind of an asset that has been checked.
    pub(crate) fn of_sound(asset: Arc<Asset>) -> Self {
        let modes = &asset.modes;
        let skin = Skin::of(&asset);
        let bounds = if asset.bounds.is_empty() {
            StressBounds::with_skin(&asset, &skin)
        } else {
            asset.bounds.clone()
        };
        let whole = bounds.root(modes.count());
        let reaches = Reaches::new(modes);
        let surface = TriangleTree::new(&asset.fracture.positions, &asset.surface.triangles);
        let prepared = Prepared {
            root: None,
            index: Arc::new(MeshIndex::new(&asset)),
            render: asset
                .render
                .as_ref()
                .map(|render| RenderIndex::new(render, &surface)),
            surface,
            per_impulse: PerImpulse::new(&asset, &whole.0, &reaches),
            reaches,
            whole,
            bounds,
            skin,
            weight: weight(&asset),
            periods: periods(modes),
            per_newton: OnceLock::new(),
            quadratic_modulus: quadratic_modulus(&asset.material),
            centroids: (0..asset.fracture.tets.len())
                .map(|e| asset.fracture.centroid(e))
                .collect(),
            edge: asset.fracture.mean_edge(),
            longest_edge: asset.fracture.longest_edge(),
        };
        let fields = Arc::new(Fields::default());
        Self {
            toughness: Toughness::new(&asset.material, &fields),
            asset,
            prepared: Arc::new(prepared),
            fields,
        }
    }

    /// The kind of the same asset with strength, toughness and weak points that vary over the body: scored lines, painted weakness.
    ///
    /// # Errors
    /// Fields of another asset, or with a number that cannot be used.
    pub fn with_fields(self, fields: Fields) -> Result<Self, InputError> {
        fields.check(&self.asset)?;
        let fields = Arc::new(fields);
        Ok(Self {
            toughness: Toughness::new(&self.asset.material, &fields),
            fields,
            ..self
        })
    }

    /// The asset.
    #[must_use]
    pub fn asset(&self) -> &Arc<Asset> {
        &self.asset
    }

    /// What bounds the stress of a motion, cluster by cluster.
    #[must_use]
    pub fn stress_bounds(&self) -> &StressBounds {
        &self.prepared.bounds
    }

    /// A body of this kind; `seed` decides its weak points.
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
                uniform(&mut rng) < -(-expected).exp_m1()
            })
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
        let clusters = WeakClusters::new(asset, &weak_tets, &self.prepared.bounds, &resistance);
        Body {
            asset: Arc::clone(asset),
            prepared: Arc::clone(&self.prepared),
            resistance,
            clusters,
            rows: Arc::default(),
            seed,
            weak_tets,
            state: BodyState::default(),
            tips: Vec::new(),
        }
    }
}

/// 1/√λ_i of every mode, s.
pub(crate) fn periods(modes: &ModalBasis) -> Vec<f32> {
    let eigenvalues = modes.eigenvalues.iter();
    eigenvalues.map(|l| (1.0 / l.sqrt()) as f32).collect()
}

/// Σ φ_i dm of every mode of a held body. Of a piece the divided tetrahedra are left out and the sum scaled to its mass.
pub(crate) fn weight(asset: &Asset) -> Vec<Vec3> {
    let modes = asset.modes.count();
    if !asset.is_supported() {
        return Vec::new();
    }
    let mut mass_of_node = vec![0.0_f32; asset.analysis.nodes.len()];
    let masses = asset
        .tets()
        .map(|tet| asset.material.density * asset.fracture.volume(tet));
    let scale = match asset.portion {
        Some(_) => asset.mass.mass / masses.clone().sum::<f64>(),
        None => 1.0,
    };
    for (mass, point) in masses.zip(&asset.embedding.tets) {
        let mass = (mass * scale) as f32;
        let element = asset.analysis.elements[point.element as usize];
        for (&node, share) in element.iter().zip(ShapeWeights::values(point)) {
            mass_of_node[node as usize] += mass * share;
        }
    }
    let mut sums = vec![Vec3::ZERO; modes];
    for (node, &mass) in mass_of_node.iter().enumerate() {
        for axis in 0..3 {
            for (sum, &phi) in sums.iter_mut().zip(asset.modes.row(3 * node + axis)) {
                sum[axis] += mass * phi;
            }
        }
    }
    sums
}

/// A body that may break: shares its asset with its like, has its own seed, weak points and cracks.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) asset: Arc<Asset>,
    pub(crate) prepared: Arc<Prepared>,
    pub(crate) resistance: Resistance,
    pub(crate) clusters: WeakClusters,
    /// How the modes stress its weak points; its copies share it.
    pub(crate) rows: Arc<WeakRows>,
    /// Seed of its weak points and of the roughness of its cracks.
    seed: u64,
    weak_tets: Vec<u32>,
    state: BodyState,
    /// Fronts of the cracks in its state.
    pub(crate) tips: Vec<Tip>,
}

impl Body {
    /// A body of this asset. For many bodies of one asset make the [`Breakable`] once: the checks are in it.
    ///
    /// # Errors
    /// As [`Breakable::new`].
    pub fn new(asset: Arc<Asset>, seed: u64) -> Result<Self, InputError> {
        Ok(Breakable::new(asset)?.body(seed))
    }

    /// What it is.
    #[must_use]
    pub fn asset(&self) -> &Arc<Asset> {
        &self.asset
    }

    /// Seed of its weak points and of the roughness of its cracks.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// How many breaks it comes from: 0 as it was made, 1 for a piece of it, 2 for a piece of that.
    #[must_use]
    pub fn generation(&self) -> u32 {
        self.asset.portion.as_ref().map_or(0, |p| p.generation())
    }

    /// Works out what its first steady load would ask for, so that this does not have to wait for it.
    pub fn prepare_for_loads(&self) {
        crate::loads::prepare(self);
    }

    /// Works out how its modes stress its weak points, so that its first blow does not have to wait for it. Else that is done part by part,
    /// where a blow has to look. Copies of the body share it.
    pub fn prepare_for_blows(&self, config: &FractureConfig) {
        self.rows.prepare(self, config);
    }

    /// The point of its surface nearest to a point, m, body frame.
    #[doc(hidden)]
    #[must_use]
    pub fn nearest_on_surface(&self, point: Vec3) -> SurfacePoint {
        self.prepared.surface.closest(point)
    }

    /// Its centre of mass in the frame of the fracture mesh, m: zero but for pieces.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        match &self.asset.portion {
            Some(portion) => portion.origin(),
            None => DVec3::ZERO,
        }
    }

    /// A part of this body.
    pub(crate) fn part(&self, mut asset: Asset, weak_tets: Vec<u32>, state: BodyState) -> Self {
        let prepared = match asset.portion.clone() {
            Some(portion) => Arc::new(Prepared::of_piece(&mut asset, &portion)),
            None => Arc::clone(&self.prepared),
        };
        let resistance = self.resistance.of_part(&weak_tets);
        let tips = tips(&asset, &state);
        Self {
            clusters: WeakClusters::new(&asset, &weak_tets, &prepared.bounds, &resistance),
            rows: Arc::default(),
            asset: Arc::new(asset),
            prepared,
            resistance,
            seed: self.seed,
            weak_tets,
            tips,
            state,
        }
    }

    /// This body, so many times as strong (above 0) and as tough as it was: the stress that a blow would bring is seen
    /// on one that does not crack.
    #[must_use]
    pub fn strengthened(&self, factor: f32) -> Self {
        let resistance = self.resistance.strengthened(factor);
        let bounds = &self.prepared.bounds;
        Self {
            clusters: WeakClusters::new(&self.asset, &self.weak_tets, bounds, &resistance),
            resistance,
            ..self.clone()
        }
    }

    /// k of the stress bounds' quadratic term, Pa.
    pub(crate) fn quadratic_modulus(&self, config: &FractureConfig) -> f32 {
        if config.green_lagrange {
            self.prepared.quadratic_modulus
        } else {
            0.0
        }
    }

    /// The cracks it has so far.
    #[must_use]
    pub fn state(&self) -> &BodyState {
        &self.state
    }

    /// The fronts of the cracks it has so far, in the order of its state; cracks that run out everywhere have none.
    #[must_use]
    pub fn crack_fronts(&self) -> Vec<CrackFront> {
        fronts(&self.asset, &self.state, &self.tips)
    }

    /// Gives it the cracks that an impact left ([`Outcome::Held`](crate::Outcome::Held)), or that were saved: the next impact
    /// finds them.
    ///
    /// # Errors
    /// A state that is not of a body of this asset.
    pub fn set_state(&mut self, state: BodyState) -> Result<(), InputError> {
        state.check(&self.asset)?;
        self.tips = tips(&self.asset, &state);
        self.state = state;
        Ok(())
    }

    /// Its weak fracture tetrahedra, ascending: cracks start only there `[G12 §4.4]`.
    #[must_use]
    pub fn weak_tets(&self) -> &[u32] {
        &self.weak_tets
    }

    /// R_c that the stress must pass for a crack to start in a fracture tetrahedron, Pa.
    #[must_use]
    pub fn strength(&self, tet: u32) -> f32 {
        self.resistance.strength(tet)
    }

    /// G_c that a crack must pay in a fracture tetrahedron, J/m².
    #[must_use]
    pub fn toughness(&self, tet: u32) -> f64 {
        self.resistance.toughness.of(tet)
    }

    /// Where the stress of a weak tetrahedron is taken, and by which law: at its flaw on the free surface, else at its
    /// centroid. `pressed`: surface triangles that something presses on, whose flaws do not count.
    #[must_use]
    pub fn weak_place(
        &self,
        tet: u32,
        config: &FractureConfig,
        pressed: &[u32],
    ) -> (&EmbeddedPoint, Law) {
        let skin = &self.prepared.skin;
        let place = weak_place(&self.asset, skin, config, pressed, tet as usize);
        (place.point, place.law)
    }

    /// The smallest strength of its weak tetrahedra, Pa; the material's where there is none.
    #[must_use]
    pub fn weakest(&self) -> f64 {
        self.resistance.weakest
    }
}
