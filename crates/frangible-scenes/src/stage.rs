//! A scene's bodies and projectiles at the start.

use std::sync::Arc;

use frangible::glam::{Quat, Vec3};
use frangible::internals::FineFaces;
use frangible::{Asset, Body, Breakable, Material};
use frangible_bake::weakness;
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::geometry::SharedShape;
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{BreakableWorld, ColliderDetail, SurfaceProperties, WorldConfig};
use frangible_sound::Sounding;

use crate::adhesive::glue;
use crate::appearance::{appearance, authored_surface, painted_surface, projectile_surface};
use crate::bake::BakedBody;
use crate::body::{BodySpec, Place};
use crate::bonds::bond;
use crate::error::SceneError;
use crate::launch::{Launched, Target, launch, vector};
use crate::meshes::{BodySurfaces, whole};
use crate::output::{Drawing, TOLERANCE};
use crate::overlap::check_overlaps;
use crate::projectile::Projectile;
use crate::recorder::{Recorder, Role};
use crate::scene::Scene;

/// Gap between a standing body and the floor, m.
pub(crate) const STANDING_GAP: f32 = 1e-4;

/// Number of bodies above which the colliders are light.
pub(crate) const FEW: usize = 8;

/// A body in the world.
pub(crate) struct Placed<'a> {
    pub(crate) spec: &'a BodySpec,
    pub(crate) handle: RigidBodyHandle,
    pub(crate) target: Target,
    pub(crate) surfaces: BodySurfaces,
    /// Lowest and highest corner of its box, m, world.
    pub(crate) bounds: [Vec3; 2],
}

/// A scene as it stands before the first step.
pub(crate) struct Stage<'a> {
    pub(crate) world: BreakableWorld,
    pub(crate) recorder: Recorder,
    pub(crate) bodies: Vec<Placed<'a>>,
    pub(crate) projectiles: Vec<Thrown>,
}

/// A projectile, on its way or not yet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Thrown {
    /// Its number in the scene.
    pub(crate) number: usize,
    /// None before it sets out.
    pub(crate) handle: Option<RigidBodyHandle>,
    /// Time at which it should reach its target, s; infinite before it sets out.
    pub(crate) arrives: f64,
    /// Time at which it is taken away, s; infinite for never.
    pub(crate) until: f64,
}

/// Puts floor, bodies and projectiles in a world, in this order.
pub(crate) fn set_up<'a>(scene: &'a Scene, baked: &[BakedBody]) -> Result<Stage<'a>, SceneError> {
    set_up_as(scene, baked, |_| {})
}

/// Sets up a scene in a world of other settings.
pub(crate) fn set_up_as<'a>(
    scene: &'a Scene,
    baked: &[BakedBody],
    change: impl FnOnce(&mut WorldConfig),
) -> Result<Stage<'a>, SceneError> {
    check_count(scene, baked.len())?;
    let bodies = scene.bodies.iter().zip(baked);
    let kinds: Result<Vec<Breakable>, SceneError> = bodies
        .map(|(spec, baked)| breakable(spec, &baked.asset))
        .collect();
    set_up_kinds(scene, &kinds?, change)
}

/// Sets up a scene whose bodies are of these kinds; their description's weakness is not looked at.
pub(crate) fn set_up_kinds<'a>(
    scene: &'a Scene,
    kinds: &[Breakable],
    change: impl FnOnce(&mut WorldConfig),
) -> Result<Stage<'a>, SceneError> {
    check_count(scene, kinds.len())?;
    let mut config = WorldConfig::default();
    config.fracture = scene.fracture.clone();
    config.record_held = true;
    if scene.bodies.len() > FEW {
        let convex = kinds.iter().all(|kind| is_convex(kind.asset()));
        config.whole_collider = ColliderDetail {
            parts: if convex { 1 } else { 32 },
            hull_points: 64,
        };
        config.fragment_collider = ColliderDetail {
            parts: 4,
            hull_points: 64,
        };
        config.hull_volume_ratio = 2.0;
        config.dust_mass = scene.pieces.least_mass as f32;
    }
    config.pieces.generations = scene.pieces.generations;
    config.pieces.least_mass = scene.pieces.least_mass as f32;
    change(&mut config);
    let mut world = BreakableWorld::new(config)?;
    if let Some(floor) = &scene.floor {
        let floor = SurfaceProperties::of(&Material::preset(floor)?, f32::INFINITY);
        world.insert_fixed_half_space(Vector::ZERO, Vector::Y, floor)?;
    }
    let mut recorder = Recorder::new(&scene.name);
    let mut bodies = Vec::with_capacity(kinds.len());
    for (i, (spec, kind)) in scene.bodies.iter().zip(kinds).enumerate() {
        let seed = seed_of(scene.seed, i);
        let floor = scene.floor.is_some();
        let drawing = scene.output.drawing;
        bodies.push(put(
            &mut world,
            &mut recorder,
            spec,
            kind,
            seed,
            floor,
            drawing,
        )?);
    }
    let assets: Vec<Arc<Asset>> = kinds.iter().map(|kind| Arc::clone(kind.asset())).collect();
    check_overlaps(&bodies, &assets)?;
    if let Some(strength) = scene.mortar {
        bond(&mut world, &bodies, strength)?;
    }
    if let Some(adhesive) = &scene.adhesive {
        glue(&mut world, &bodies, &assets, adhesive)?;
    }
    #[cfg(feature = "bake")]
    if scene.pieces.generations > 0 {
        let model = frangible_bake::pieces::Pieces::new(scene.pieces.method);
        world = world.with_piece_model(model);
    }
    let numbers = 0..scene.projectiles.len();
    let mut stage = Stage {
        world,
        recorder,
        bodies,
        projectiles: numbers
            .map(|number| Thrown {
                number,
                handle: None,
                arrives: f64::INFINITY,
                until: f64::INFINITY,
            })
            .collect(),
    };
    stage.throw(scene, 0.0)?;
    Ok(stage)
}

impl Stage<'_> {
    /// Throws the projectiles whose time has come, s, and takes away those whose time is over.
    pub(crate) fn throw(&mut self, scene: &Scene, now: f64) -> Result<(), SceneError> {
        for thrown in &mut self.projectiles {
            let projectile = &scene.projectiles[thrown.number];
            if let Some(handle) = thrown.handle {
                if now >= thrown.until {
                    self.world.physics.remove_body(handle);
                }
                continue;
            }
            // The target is checked by `Scene::validate`.
            let (true, Some(body)) = (projectile.delay <= now, self.bodies.get(projectile.target))
            else {
                continue;
            };
            let look = projectile_surface(projectile.kind.name(), &projectile.material);
            let [surface] = self.recorder.surfaces([look]);
            let floor = scene.floor.is_some();
            let Launched {
                handle,
                mesh,
                flight,
            } = launch(&mut self.world, projectile, body.target, floor, surface)?;
            let name = projectile_name(&scene.projectiles, thrown.number);
            let extras = vec![("mass_kg".into(), projectile.mass)];
            let material = Material::preset(&projectile.material)?;
            let sounding = Sounding::Ball(material, projectile.radius, projectile.mass);
            self.recorder
                .track(name, mesh, handle, extras, Role::Projectile, sounding);
            thrown.handle = Some(handle);
            thrown.arrives = now + flight;
            thrown.until = projectile.stays.map_or(f64::INFINITY, |stays| now + stays);
        }
        Ok(())
    }
}

/// Name of the projectile of this number: `ball`, or `hammer 2` of several.
pub(crate) fn projectile_name(all: &[Projectile], number: usize) -> String {
    let kind = all[number].kind.name();
    match all.len() {
        1 => kind.to_string(),
        _ => format!("{kind} {}", number + 1),
    }
}

fn check_count(scene: &Scene, given: usize) -> Result<(), SceneError> {
    let wanted = scene.bodies.len();
    match given == wanted {
        true => Ok(()),
        false => Err(SceneError::BakedBodies { wanted, given }),
    }
}

/// Puts a body in the world.
fn put<'a>(
    world: &mut BreakableWorld,
    recorder: &mut Recorder,
    spec: &'a BodySpec,
    kind: &Breakable,
    seed: u64,
    floor: bool,
    drawing: Drawing,
) -> Result<Placed<'a>, SceneError> {
    let asset = kind.asset();
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
    let body = kind.body(seed);
    let q = spec.rotation;
    let pose = Pose::from_parts(vector(centre), Rotation::from_xyzw(q.x, q.y, q.z, q.w));
    let sounding = Sounding::Modes(body.clone());
    let handle = world.insert(
        body,
        RigidBodyBuilder::dynamic()
            .pose(pose)
            .linvel(vector(spec.velocity))
            .angvel(vector(spec.spin)),
    )?;
    let mut look = appearance(&asset.material().name);
    let clear = look.outside.transmission > 0.0;
    if let Some(render) = asset.render()
        && !render.colors.is_empty()
    {
        look.outside = painted_surface(&look.outside);
    }
    let [outer, inner, crack, crack_line] =
        recorder.surfaces([look.outside, look.crack_face, look.crack, look.crack_line]);
    let images = asset.render().into_iter().flat_map(|render| &render.images);
    let images: Vec<u32> = images.map(|image| recorder.image(image)).collect();
    let authored = asset
        .render()
        .into_iter()
        .flat_map(|render| &render.materials);
    let surfaces = BodySurfaces {
        outer,
        inner,
        crack,
        crack_line,
        clear,
        authored: authored
            .map(|look| recorder.surface(authored_surface(look, &images)))
            .collect(),
        srgb_colors: asset.render().is_some_and(|r| r.srgb_colors),
        light: (drawing == Drawing::Light).then(|| TOLERANCE * longest_side(asset)),
        fine: (drawing == Drawing::Fine).then(|| fine_faces(asset)),
        names: [
            spec.name.clone(),
            asset.render().map_or("", |r| &r.name).to_owned(),
        ],
    };
    let extras = vec![
        ("mass_kg".into(), asset.mass().mass),
        ("volume_m3".into(), asset.mass().volume),
    ];
    let target = Target {
        centre,
        reach: farthest_point(asset),
    };
    let mesh = whole(&spec.name, asset, &surfaces);
    let role = Role::Body;
    recorder.track(spec.name.clone(), mesh, handle, extras, role, sounding);
    let corners = asset.fracture().positions.iter().map(|&p| centre + q * p);
    let (low, high) = corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| {
        (low.min(p), high.max(p))
    });
    Ok(Placed {
        spec,
        handle,
        target,
        surfaces,
        bounds: [low, high],
    })
}

/// Returns true if a body's hull has hardly more volume than the body.
fn is_convex(asset: &Asset) -> bool {
    let points: Vec<Vector> = asset
        .fracture()
        .positions
        .iter()
        .map(|&p| vector(p))
        .collect();
    let hull = SharedShape::convex_hull(&points).map(|hull| hull.mass_properties(1.0).mass());
    hull.is_some_and(|volume| f64::from(volume) <= 1.01 * asset.mass().volume)
}

/// Makes the kind of bodies of this description and asset, with the weakness that the description gives them.
///
/// # Errors
/// An invalid weakness.
pub fn breakable(spec: &BodySpec, asset: &Arc<Asset>) -> Result<Breakable, SceneError> {
    let painted = weakness::from_paint(asset, &spec.paint)?;
    let fields = weakness::patched(painted, asset, &spec.weakness)?.scattered_as(asset.material());
    let mut fields = match spec.weibull_modulus {
        Some(modulus) => fields.with_weibull_modulus(modulus),
        None => fields,
    };
    fields.specimen = spec.specimen.unwrap_or(fields.specimen);
    fields.fatigue = spec.fatigue.or(fields.fatigue);
    Ok(Breakable::new(Arc::clone(asset))?.with_fields(fields)?)
}

/// The intact body of this number, from 0, of a scene, as [`play`](crate::play()) puts it into its world.
///
/// # Errors
/// An unknown body number, or an invalid asset or weakness.
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
        .fracture()
        .positions
        .iter()
        .map(|p| p.length())
        .fold(0.0, f32::max)
}

/// Detail of fine crack faces.
fn fine_faces(asset: &Asset) -> FineFaces {
    let material = asset.material();
    let roughness = [material.roughness_amplitude, material.roughness_wavelength];
    FineFaces::new(asset.fracture().mean_edge(), roughness)
}

/// Longest side of the body's box, m.
fn longest_side(asset: &Asset) -> f32 {
    let nothing = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    let places = asset.fracture().positions.iter();
    let [low, high] = places.fold(nothing, |[low, high], &p| [low.min(p), high.max(p)]);
    (high - low).max_element()
}

/// Height of the body's lowest point below its centre of mass (negative), m.
fn lowest_point(asset: &Asset, rotation: Quat) -> f32 {
    asset
        .fracture()
        .positions
        .iter()
        .map(|&p| (rotation * p).y)
        .fold(f32::INFINITY, f32::min)
}
