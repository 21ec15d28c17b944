//! The near field of a contact on a wall: its start beyond the modes, its waves and its reach.

use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use crate::asset::Asset;
use crate::body::Body;
use crate::contact::{Touch, WallReceptance};
use crate::mesh::SurfacePoint;
use crate::near_field::{Bands, NearField, NearPlace, NearShapes, PlateTheory, WallMaterial};

/// Least distance to the wall's edge for a near field, times its lowest wave number.
const LEAST_EDGE: f64 = 1.0;

/// Least ratio of two estimates of the frequency at which the wall oscillators take over: from the modes' own motion at the contact, over that from
/// their frequencies. The ratio is held between this and its inverse: beyond, the place is no plain wall.
const LEAST_MATCH: f64 = 0.8;

/// Cosine between the force and the wall's normal below which a blow falls along the wall.
const ACROSS: f64 = 0.3;

/// The near field of a contact, before its motion is known.
#[derive(Clone, Debug)]
pub(super) struct NearPlan {
    pub(super) place: NearPlace,
    pub(super) wall: WallReceptance,
    /// Share of the contact's force, with friction, that acts across the wall.
    pub(super) across: f64,
    pub(super) bands: Bands,
    pub(super) shapes: Arc<NearShapes>,
    /// Its oscillators among those of the bank.
    pub(super) oscillators: Range<usize>,
    /// Radius a of the contact, m.
    pub(super) contact_radius: f64,
}

/// The wall behind a contact, its unit normal inwards, and the number of the first mode that it stands for.
pub(super) fn wall_at(
    body: &Body,
    touch: &Touch,
    theory: PlateTheory,
) -> Option<(WallReceptance, Vec3, usize)> {
    let asset = &*body.asset;
    let surface = asset.surface.walls.at(touch.triangle)?;
    let inwards = inwards(asset, touch.triangle, touch.weights)?;
    let along_normal = f64::from(touch.contact.normal.dot(inwards));
    if along_normal < ACROSS {
        return None;
    }
    let material = WallMaterial::new(&asset.material, &surface, theory);
    let (first, lowest) = first_wave(asset, &material, surface.margin, asset.modes.followed())?;
    let wall = WallReceptance {
        material,
        widest: surface.margin.max(surface.thickness),
        lowest: matched(body, touch, &material, inwards, first, lowest),
        along_normal,
    };
    Some((wall, inwards, first))
}

/// Place and reach of the near field of a contact on a wall.
pub(super) fn place(body: &Body, touch: &Touch, wall: &WallReceptance) -> Option<NearPlace> {
    let point = touch.contact.point + body.origin().as_vec3();
    let start = wall.material.wave_number(wall.lowest);
    Some(NearPlace {
        point,
        inwards: inwards(&body.asset, touch.triangle, touch.weights)?,
        reach: NearField::reach(start).min(nearest_crack(body, point)),
        in_ply: body.asset.material.laminate.is_some(),
    })
}

/// Near field of a steady force on a wall: its place, wall and force.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SteadyNear {
    place: NearPlace,
    wall: WallMaterial,
    /// Lowest wave number, 1/m.
    first: f64,
    /// Force across the wall, N.
    across: f32,
}

impl SteadyNear {
    /// Near field of a force, N, at a place of the surface, beside all modes of the body; none if the force does not press on a wall.
    pub(crate) fn of(
        body: &Body,
        at: &SurfacePoint,
        force: Vec3,
        theory: PlateTheory,
    ) -> Option<Self> {
        let asset = &*body.asset;
        let surface = asset.surface.walls.at(at.triangle)?;
        let inwards = inwards(asset, at.triangle, at.weights)?;
        let across = force.dot(inwards);
        if across <= 0.0 {
            return None;
        }
        let wall = WallMaterial::new(&asset.material, &surface, theory);
        let (_, lowest) = first_wave(asset, &wall, surface.margin, asset.modes.count())?;
        let first = wall.wave_number(lowest);
        let point = at.position + body.origin().as_vec3();
        let reach = NearField::reach(first).min(nearest_crack(body, point));
        let place = NearPlace {
            point,
            inwards,
            reach,
            in_ply: asset.material.laminate.is_some(),
        };
        Some(Self {
            place,
            wall,
            first,
            across,
        })
    }

    /// Upper bound of the principal stress of a steady force on a triangle of the surface, per newton, Pa/N.
    pub(crate) fn most_per_newton(body: &Body, triangle: u32) -> Option<f32> {
        let asset = &*body.asset;
        let surface = asset.surface.walls.at(triangle)?;
        let of = |theory| {
            let wall = WallMaterial::new(&asset.material, &surface, theory);
            let (_, lowest) = first_wave(asset, &wall, surface.margin, asset.modes.count())?;
            Some(wall.most_stress(wall.wave_number(lowest)) as f32)
        };
        // The bound is kept for the body, so it must hold for either theory.
        of(PlateTheory::Kirchhoff)
            .into_iter()
            .chain(of(PlateTheory::Layer))
            .reduce(f32::max)
    }

    /// Upper bound of its principal stress, Pa.
    pub(crate) fn bound(&self) -> f32 {
        (f64::from(self.across) * self.wall.most_stress(self.first)) as f32
    }

    /// Its stress field.
    pub(crate) fn field(&self) -> NearField {
        NearField::steady(self.place, &self.wall, self.first, self.across)
    }
}

/// Unit normal of a wall at a place of the surface, inwards.
fn inwards(asset: &Asset, triangle: u32, weights: [f32; 3]) -> Option<Vec3> {
    let normals = &asset.surface.normals[triangle as usize];
    let mixed: Vec3 = normals.iter().zip(weights).map(|(n, w)| *n * w).sum();
    mixed.try_normalize().map(|n| -n)
}

/// Returns true if a contact on this triangle of the surface may have a near field.
pub(crate) fn has_near_field(asset: &Asset, triangle: u32, theory: PlateTheory) -> bool {
    asset.surface.walls.at(triangle).is_some_and(|surface| {
        let wall = WallMaterial::new(&asset.material, &surface, theory);
        first_wave(asset, &wall, surface.margin, asset.modes.followed()).is_some()
    })
}

/// Start of the near field beyond the `followed` lowest modes: the first mode that it stands for, and its lowest angular frequency, rad/s. None at an
/// edge, and where curvature prevents all waves that the modes leave out.
///
/// It starts at the same wave number close to an edge. Measured (`docs/near-field.md`): a quarter of the shortest mode's wavelength from a free or a
/// held edge this is 8 % off, and 25 % if the modes up to twice the inverse distance answer statically first. Closer than a sixth of that wavelength
/// it is off by half and more, and the residual vector serves instead.
fn first_wave(
    asset: &Asset,
    wall: &WallMaterial,
    margin: f64,
    followed: usize,
) -> Option<(usize, f64)> {
    let modes = &asset.modes;
    let count = modes.count();
    // Between two modes; above the last one as far as it lies above its neighbour, on average.
    let after = |i: usize| {
        let here = modes.eigenvalues[i - 1].sqrt();
        match modes.eigenvalues.get(i) {
            Some(next) => 0.5 * (here + next.sqrt()),
            None => here * (1.0 + 0.5 / i as f64),
        }
    };
    if followed == 0 || margin <= 0.0 {
        return None;
    }
    let wanted = wall.bending_rules_from();
    let lowest = wall.eigenvalue(wanted).sqrt().max(after(followed));
    let first = modes.eigenvalues.partition_point(|l| l.sqrt() < lowest);
    let (first, lowest) = if first < count || lowest <= after(count) {
        (first, lowest)
    } else {
        // The modes do not reach that far.
        (count, after(count))
    };
    let k = wall.wave_number(lowest);
    (k >= 0.999 * wanted && k * margin >= LEAST_EDGE).then_some((first, lowest))
}

/// Angular frequency at which the wall oscillators take over, rad/s, such that they and the modes before `first` are the whole wall.
///
/// All motions of an infinite wall up to wave number k move a place by `Σ ξ² = k²/4πμ` per unit impulse, and so do the modes of a body, on average.
/// But they come in shells: at the middle of a square plate only every fourth is felt, in pairs. So k is taken from the sum over the actual modes,
/// which elements that are too stiff do not mislead. Measured: without this a wall with 120 modes and one with 300 differ twice as much, on a glass
/// and on a bowl (`frangible-bake/tests/blow`).
fn matched(
    body: &Body,
    touch: &Touch,
    wall: &WallMaterial,
    inwards: Vec3,
    first: usize,
    lowest: f64,
) -> f64 {
    let asset = &*body.asset;
    let shape = touch.project(body, inwards);
    let mut moved: f64 = shape[..first].iter().map(|xi| xi * xi).sum();
    if !asset.is_supported() {
        let place = (touch.contact.point.as_dvec3(), inwards.as_dvec3());
        moved += asset.mass.inverse_mass_between(place, place);
    }
    let k = (4.0 * PI * wall.mass_per_area * moved).sqrt();
    let found = wall.eigenvalue(k).sqrt();
    found.clamp(LEAST_MATCH * lowest, lowest / LEAST_MATCH)
}

/// Distance of the nearest place that a crack of the body has cut, m; infinite without cracks.
fn nearest_crack(body: &Body, point: Vec3) -> f64 {
    let cuts = body.state().cracks.iter().flat_map(|crack| &crack.cuts);
    let centroids = &body.prepared.centroids;
    let squares = cuts.map(|cut| centroids[cut.tet as usize].distance_squared(point));
    f64::from(squares.fold(f32::INFINITY, f32::min).sqrt())
}
