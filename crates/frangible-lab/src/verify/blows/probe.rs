//! Baked bodies that are hit, and the stress that the run time says they have.

use std::sync::{Mutex, PoisonError};

use frangible::glam::{DVec3, Vec3};
use frangible::internals::blow::Blow;
use frangible::{Asset, Body, Breakable, Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeError, BakeSpec, MeshSize, Region, Shape, Support, bake};

use super::plate::{InPlane, Plate};

/// The plate of the tables: PMMA, 100 × 100 × 1 mm.
pub(crate) const PLATE: Plate = Plate {
    side: 0.1,
    thickness: 1e-3,
    youngs_modulus: 3.3e9,
    poisson_ratio: 0.37,
    density: 1180.0,
};

/// The ball of the tables: steel, 4 mm across.
pub(crate) const BALL: [f64; 2] = [2.6e-4, 2e-3];

/// A material without damping that nothing crushes, and of which no tetrahedron is a weak point: stresses are those of the middles of faces, and not of
/// flaws that lie anywhere on them.
pub(crate) fn material(youngs_modulus: f64, poisson_ratio: f64, density: f64) -> Material {
    let mut material = Material::preset("glass").expect("glass is a preset");
    (material.youngs_modulus, material.poisson_ratio) = (youngs_modulus, poisson_ratio);
    material.density = density;
    (material.stiffness_damping, material.mass_damping) = (0.0, 0.0);
    material.crushing_pressure = f64::INFINITY;
    material.weak_point_density = 1e-3;
    material
}

/// A plate four times as wide, for the same waves: no echo comes back within a blow.
pub(crate) const WIDE: Plate = Plate { side: 0.2, ..PLATE };

/// The plate, baked: simply supported all round, 100 modes, 50 elements along a side. It is baked once and shared.
pub(crate) fn plate() -> Result<Asset, BakeError> {
    static BAKED: Mutex<Option<Asset>> = Mutex::new(None);
    once(&BAKED, || supported(&PLATE, 0.002))
}

/// The wide plate, in the same way.
pub(crate) fn wide_plate() -> Result<Asset, BakeError> {
    static BAKED: Mutex<Option<Asset>> = Mutex::new(None);
    once(&BAKED, || supported(&WIDE, 0.005))
}

fn once(
    baked: &Mutex<Option<Asset>>,
    bake: impl FnOnce() -> Result<Asset, BakeError>,
) -> Result<Asset, BakeError> {
    let mut baked = baked.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(asset) = &*baked {
        return Ok(asset.clone());
    }
    let asset = bake()?;
    *baked = Some(asset.clone());
    Ok(asset)
}

/// A simply supported plate with elements of this edge, m.
fn supported(plate: &Plate, edge: f64) -> Result<Asset, BakeError> {
    let (side, thickness) = (plate.side, plate.thickness);
    let held = |axis: usize, last: bool| {
        let region = if last {
            Region::above(axis, side)
        } else {
            Region::below(axis, 0.0)
        };
        // Across the plate all along the edge, and along the edge, as Navier's series has it: what twists is held too.
        let axes = [axis == 1, axis == 0, true];
        Support { region, axes }
    };
    let m = material(plate.youngs_modulus, plate.poisson_ratio, plate.density);
    let spec = BakeSpec {
        modes: 100,
        analysis: Some(MeshSize { edge, layers: 1 }),
        fracture: Some(MeshSize {
            edge: side / 100.0,
            layers: 1,
        }),
        supports: [0, 1]
            .into_iter()
            .flat_map(|axis| [held(axis, false), held(axis, true)])
            .collect(),
        ..BakeSpec::new("plate", Shape::plate(side, side, thickness), m)
    };
    bake(&spec)
}

/// The asset with its lowest modes followed and the rest as its residual vector.
pub(crate) fn following(mut asset: Asset, modes: usize) -> Asset {
    asset.parts_mut().modes.residual_modes = asset.modes().count() - modes;
    asset
}

/// A solid of tetrahedra of this edge, m, with so many modes.
pub(crate) fn solid(
    shape: Shape,
    material: &Material,
    edge: f64,
    modes: usize,
) -> Result<Body, BakeError> {
    let size = MeshSize { edge, layers: 0 };
    let spec = BakeSpec {
        modes,
        analysis: Some(size),
        fracture: Some(size),
        ..BakeSpec::new("solid", shape, material.clone())
    };
    body(bake(&spec)?)
}

/// A body of an asset.
pub(crate) fn body(asset: Asset) -> Result<Body, BakeError> {
    Ok(Breakable::uniform(asset)?.body(1))
}

/// A steel ball on the upper face of the plate.
pub(crate) fn ball(at: [f64; 2], speed: f64, [mass, radius]: [f64; 2]) -> Contact {
    let steel = Material::preset("steel").expect("steel is a preset");
    Contact::strike(
        Vec3::new(at[0] as f32, at[1] as f32, 0.5 * PLATE.thickness as f32),
        Vec3::NEG_Z,
        speed as f32,
        Striker::ball(&steel, mass, radius),
    )
}

/// The blow of a single contact that pushes.
pub(crate) fn blow(
    body: &Body,
    contact: Contact,
    config: &FractureConfig,
) -> Result<Blow, BakeError> {
    let blow = Blow::new(body, std::slice::from_ref(&contact), config)?;
    Ok(blow.expect("all contacts of the cases approach, or are scripts with an impulse"))
}

/// A weak place on the lower face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    tet: u32,
    /// Position from the middle of the body, m.
    pub(crate) at: [f64; 2],
    /// Distance from the contact, m.
    pub(crate) distance: f64,
}

/// The places of the lower face next to those at these distances from a point of it, along a direction.
pub(crate) fn places(
    body: &Body,
    from: [f64; 2],
    direction: [f64; 2],
    distances: &[f64],
) -> Vec<Place> {
    let asset = body.asset();
    let surface = asset.surface();
    let lower: Vec<Place> = surface
        .triangles
        .iter()
        .zip(&surface.tets)
        .zip(&surface.normals)
        .filter(|(_, normals)| normals[0].z < -0.9)
        .map(|((corners, &tet), _)| {
            let sum: Vec3 = corners
                .iter()
                .map(|&v| asset.surface_positions()[v as usize])
                .sum();
            let at = [f64::from(sum.x) / 3.0, f64::from(sum.y) / 3.0];
            let distance = (at[0] - from[0]).hypot(at[1] - from[1]);
            Place { tet, at, distance }
        })
        .collect();
    let nearest = |&r: &f64| {
        let wanted = DVec3::new(from[0] + r * direction[0], from[1] + r * direction[1], 0.0);
        let off = |p: &Place| (p.at[0] - wanted.x).hypot(p.at[1] - wanted.y);
        lower
            .iter()
            .copied()
            .min_by(|a, b| off(a).total_cmp(&off(b)))
    };
    distances.iter().filter_map(nearest).collect()
}

/// Stress that the run time computes at a place after a time step, Pa.
pub(crate) fn felt(
    body: &Body,
    blow: &Blow,
    place: &Place,
    step: usize,
    config: &FractureConfig,
) -> InPlane {
    let s = blow.stress(body, place.tet, step, config);
    [s.diagonal[0], s.diagonal[1], s.off[0]].map(f64::from)
}

/// Radial and hoop stress about a point, Pa.
pub(crate) fn about(from: [f64; 2], at: [f64; 2], [xx, yy, xy]: InPlane) -> [f64; 2] {
    let (x, y) = (at[0] - from[0], at[1] - from[1]);
    let r2 = x * x + y * y;
    let radial = (xx * x * x + yy * y * y + 2.0 * xy * x * y) / r2;
    [radial, xx + yy - radial]
}
