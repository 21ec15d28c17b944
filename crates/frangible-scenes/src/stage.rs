//! A scene's bodies and projectiles where they start.

use std::sync::Arc;

use frangible::glam::{Quat, Vec3};
use frangible::{Asset, Body, Breakable, Fields, Material};
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{BreakableWorld, SurfaceProperties, WorldConfig};

use crate::appearance::{authored_surface, body_surfaces, projectile_surface};
use crate::bake::BakedBody;
use crate::body::{BodySpec, Place};
use crate::error::SceneError;
use crate::launch::{Target, launch, vector};
use crate::meshes::{BodySurfaces, whole};
use crate::recorder::{Recorder, Role};
use crate::scene::Scene;

/// Gap between a standing body and the floor, m.
const STANDING_GAP: f32 = 1e-4;

/// A body in the world.
pub(crate) struct Placed<'a> {
    pub(crate) spec: &'a BodySpec,
    pub(crate) handle: RigidBodyHandle,
    pub(crate) target: Target,
    pub(crate) surfaces: BodySurfaces,
}

/// A scene as it stands before the first step.
pub(crate) struct Stage<'a> {
    pub(crate) world: BreakableWorld,
    pub(crate) recorder: Recorder,
    pub(crate) bodies: Vec<Placed<'a>>,
    pub(crate) projectiles: Vec<RigidBodyHandle>,
}

/// Puts floor, bodies and projectiles in a world, in this order.
pub(crate) fn set_up<'a>(scene: &'a Scene, baked: &[BakedBody]) -> Result<Stage<'a>, SceneError> {
    if baked.len() != scene.bodies.len() {
        return Err(SceneError::BakedBodies {
            wanted: scene.bodies.len(),
            given: baked.len(),
        });
    }
    let mut config = WorldConfig::default();
    config.fracture = scene.fracture.clone();
    config.record_held = true;
    let mut world = BreakableWorld::new(config)?;
    if let Some(floor) = &scene.floor {
        let floor = SurfaceProperties::of(&Material::preset(floor)?, f32::INFINITY);
        world.insert_fixed_half_space(Vector::ZERO, Vector::Y, floor)?;
    }
    let mut recorder = Recorder::new(&scene.name);
    let mut bodies = Vec::with_capacity(baked.len());
    for (i, (spec, baked)) in scene.bodies.iter().zip(baked).enumerate() {
        let seed = seed_of(scene.seed, i);
        let floor = scene.floor.is_some();
        bodies.push(put(
            &mut world,
            &mut recorder,
            spec,
            &baked.asset,
            seed,
            floor,
        )?);
    }
    let mut projectiles = Vec::with_capacity(scene.projectiles.len());
    for (i, projectile) in scene.projectiles.iter().enumerate() {
        let kind = projectile.kind.name();
        let [surface] = recorder.surfaces([projectile_surface(kind, &projectile.material)]);
        // Checked by `Scene::validate`.
        let Some(target) = bodies.get(projectile.target).map(|body| body.target) else {
            continue;
        };
        let (handle, mesh) = launch(
            &mut world,
            projectile,
            target,
            scene.floor.is_some(),
            surface,
        )?;
        let name = if scene.projectiles.len() == 1 {
            kind.to_string()
        } else {
            format!("{kind} {}", i + 1)
        };
        let extras = vec![("mass_kg".into(), projectile.mass)];
        recorder.track(name, mesh, handle, extras, Role::Projectile);
        projectiles.push(handle);
    }
    Ok(Stage {
        world,
        recorder,
        bodies,
        projectiles,
    })
}

/// Puts a body in the world.
fn put<'a>(
    world: &mut BreakableWorld,
    recorder: &mut Recorder,
    spec: &'a BodySpec,
    asset: &Arc<Asset>,
    seed: u64,
    floor: bool,
) -> Result<Placed<'a>, SceneError> {
    let lowest = lowest_point(asset, spec.rotation);
    let centre = match spec.place {
        Place::Standing { over: [x, z] } => Vec3::new(x, STANDING_GAP - lowest, z),
        Place::Above {
            height,
            over: [x, z],
        } => Vec3::new(x, height as f32 - lowest, z),
        Place::Centre(centre) => centre,
    };
    let depth = -(centre.y + lowest);
    if floor && depth > STANDING_GAP {
        return Err(SceneError::BodyBelowFloor {
            body: spec.name.clone(),
            depth_mm: 1e3 * depth,
        });
    }
    let body = breakable(spec, asset)?.body(seed);
    let q = spec.rotation;
    let pose = Pose::from_parts(vector(centre), Rotation::from_xyzw(q.x, q.y, q.z, q.w));
    let handle = world.insert_breakable(body, pose, vector(spec.velocity), vector(spec.spin))?;
    let [outer, inner] = recorder.surfaces(body_surfaces(&asset.material.name));
    let authored = asset.render.iter().flat_map(|render| &render.materials);
    let surfaces = BodySurfaces {
        outer,
        inner,
        authored: authored
            .map(|look| recorder.surface(authored_surface(look)))
            .collect(),
    };
    let extras = vec![
        ("mass_kg".into(), asset.mass.mass),
        ("volume_m3".into(), asset.mass.volume),
    ];
    let target = Target {
        centre,
        reach: farthest_point(asset),
    };
    let mesh = whole(&spec.name, asset, &surfaces);
    let role = Role::Body(target.reach);
    recorder.track(spec.name.clone(), mesh, handle, extras, role);
    Ok(Placed {
        spec,
        handle,
        target,
        surfaces,
    })
}

/// What bodies of this description and asset are made of, with what the description says of their weakness.
fn breakable(spec: &BodySpec, asset: &Arc<Asset>) -> Result<Breakable, SceneError> {
    let fields = Fields::from_paint(asset, &spec.paint)?
        .patched(asset, &spec.weakness)?
        .with_weibull_modulus(spec.weibull_modulus);
    Ok(Breakable::new(Arc::clone(asset))?.with_fields(fields)?)
}

/// The intact body of this number, from 0, of a scene, as [`play`](crate::play()) puts it into its world.
///
/// # Errors
/// No body of this number; an asset or a weakness that cannot be used.
pub fn intact_body(scene: &Scene, number: usize, asset: &Arc<Asset>) -> Result<Body, SceneError> {
    let spec = scene.bodies.get(number).ok_or(SceneError::BakedBodies {
        wanted: number + 1,
        given: scene.bodies.len(),
    })?;
    Ok(breakable(spec, asset)?.body(seed_of(scene.seed, number)))
}

/// Seed of the i-th body: equal bodies must not break alike, and the first one's is the scene's.
fn seed_of(scene: u64, i: usize) -> u64 {
    // The odd number nearest to 2^64 over the golden ratio: multiples of it lie far apart.
    scene.wrapping_add((i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// Radius of the sphere about the centre of mass that holds the body, m.
fn farthest_point(asset: &Asset) -> f32 {
    asset
        .fracture
        .positions
        .iter()
        .map(|p| p.length())
        .fold(0.0, f32::max)
}

/// Height of the body's lowest point below its centre of mass (negative), m.
fn lowest_point(asset: &Asset, rotation: Quat) -> f32 {
    asset
        .fracture
        .positions
        .iter()
        .map(|&p| (rotation * p).y)
        .fold(f32::INFINITY, f32::min)
}
