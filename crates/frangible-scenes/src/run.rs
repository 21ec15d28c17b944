//! Lets a scene happen, and records it.

use std::sync::Arc;
use std::time::Instant;

use frangible::glam::{Quat, Vec3};
use frangible::{Asset, Body, ImpactReport, Material};
use frangible_export::{Floor, Recording};
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{BreakableWorld, SurfaceProperties, WorldConfig};

use crate::appearance::{body_surfaces, projectile_surface};
use crate::bake::BakedBody;
use crate::body::{BodySpec, Place};
use crate::error::SceneError;
use crate::launch::{Target, launch, vector};
use crate::meshes::{BodySurfaces, whole};
use crate::recorder::{FRAME_RATE, Recorder, Role};
use crate::result::{BreakRecord, HeldRecord, Run};
use crate::scene::Scene;

/// Physics steps per recorded frame while nothing is about to break.
const STEPS_PER_FRAME: usize = 4;

/// Physics steps per recorded frame until the break and just after it. A body that falls at 4 m/s moves 1 mm in such
/// a step; in a coarser one Rapier shares the blow among contact points that are not there yet.
const FINE_STEPS_PER_FRAME: usize = 64;

/// Frames after a break that are still stepped finely.
const FINE_FRAMES: usize = 2;

/// Damping of rotation, 1/s, on top of the world's rolling resistance; that the scenes come to rest was measured with it.
const ROLLING: f32 = 0.8;

/// Seconds recorded after everything came to rest.
const REST: f32 = 0.25;

/// Gap between a standing body and the floor, m.
const STANDING_GAP: f32 = 1e-4;

/// A body in the world.
struct Placed<'a> {
    spec: &'a BodySpec,
    handle: RigidBodyHandle,
    target: Target,
    surfaces: BodySurfaces,
}

/// A scene as it stands before the first step.
struct Stage<'a> {
    world: BreakableWorld,
    recorder: Recorder,
    bodies: Vec<Placed<'a>>,
    projectiles: Vec<RigidBodyHandle>,
}

/// Plays the scene with its baked bodies and records it; `progress` gets the share of the longest duration done.
///
/// # Errors
/// A quantity of the scene that cannot be used, or not as many baked bodies as the scene has.
pub fn play(
    scene: &Scene,
    baked: &[BakedBody],
    progress: &mut dyn FnMut(f64),
) -> Result<Run, SceneError> {
    scene.validate()?;
    let clock = Instant::now();
    let Stage {
        mut world,
        mut recorder,
        bodies,
        projectiles,
    } = set_up(scene, baked)?;
    let number = |handle| bodies.iter().position(|body| body.handle == handle);
    let mut run = Run {
        recording: Recording::default(),
        breaks: Vec::new(),
        held: Vec::new(),
        at_rest: false,
        simulated: 0.0,
        rigid_seconds: 0.0,
    };
    let frames = (scene.duration * f64::from(FRAME_RATE)).ceil() as usize;
    let mut rest_frames = 0;
    recorder.frame(&world);
    let mut fine_until = 0;
    for frame in 1..=frames {
        let whole_ones = world.breakables().next().is_some();
        let steps = if whole_ones || frame <= fine_until {
            FINE_STEPS_PER_FRAME
        } else {
            STEPS_PER_FRAME
        };
        let dt = 1.0 / (FRAME_RATE * steps as f32);
        world.physics.integration_parameters.dt = dt;
        for _ in 0..steps {
            run.simulated += f64::from(dt);
            world.step()?;
            for held in world.held() {
                if let Some(body) = number(held.body) {
                    keep_hardest(&mut run.held, body, held);
                }
            }
            for event in world.breaks() {
                fine_until = frame + FINE_FRAMES;
                let Some(body) = number(event.parent) else {
                    continue;
                };
                recorder.broke(&bodies[body].spec.name, event, bodies[body].surfaces);
                let fragments = &event.fracture.fragments;
                run.breaks.push(BreakRecord {
                    body,
                    time: run.simulated,
                    contacts: event.contacts.clone(),
                    report: event.fracture.report.clone(),
                    masses: fragments.iter().map(|f| f.mass.mass).collect(),
                    volume: fragments.iter().map(|f| f.mass.volume).sum(),
                    energy_paid: event.energy_paid,
                });
            }
        }
        for (_, body) in world.physics.bodies.iter_mut() {
            body.set_angular_damping(ROLLING);
        }
        recorder.frame(&world);
        progress(frame as f64 / frames as f64);
        rest_frames = if at_rest(&world, &projectiles) {
            rest_frames + 1
        } else {
            0
        };
        if rest_frames as f32 > REST * FRAME_RATE {
            break;
        }
    }
    run.held.sort_by_key(|held| held.body);
    run.at_rest = at_rest(&world, &projectiles);
    let floor = scene.floor.as_ref().map(|_| Floor::default());
    run.recording = recorder.finish(scene.look_from, floor);
    let fracture = |r: &ImpactReport| {
        r.timings.response + r.timings.stress + r.timings.cracks + r.timings.fragments
    };
    let fractured: f64 = run.breaks.iter().map(|b| fracture(&b.report)).sum();
    run.rigid_seconds = clock.elapsed().as_secs_f64() - fractured;
    Ok(run)
}

/// Puts floor, bodies and projectiles in a world, in this order.
fn set_up<'a>(scene: &'a Scene, baked: &[BakedBody]) -> Result<Stage<'a>, SceneError> {
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
    let body = Body::new(Arc::clone(asset), seed)?;
    let q = spec.rotation;
    let pose = Pose::from_parts(vector(centre), Rotation::from_xyzw(q.x, q.y, q.z, q.w));
    let handle = world.insert_breakable(body, pose, vector(spec.velocity), vector(spec.spin))?;
    let [outer, inner] = recorder.surfaces(body_surfaces(&asset.material.name));
    let surfaces = BodySurfaces { outer, inner };
    let extras = vec![
        ("mass_kg".into(), asset.mass.mass),
        ("volume_m3".into(), asset.mass.volume),
    ];
    let target = Target {
        centre,
        reach: farthest_point(asset),
    };
    let mesh = whole(&spec.name, asset, surfaces);
    let role = Role::Body(target.reach);
    recorder.track(spec.name.clone(), mesh, handle, extras, role);
    Ok(Placed {
        spec,
        handle,
        target,
        surfaces,
    })
}

/// Seed of the i-th body: equal bodies must not break alike, and the first one's is the scene's.
fn seed_of(scene: u64, i: usize) -> u64 {
    // The odd number nearest to 2^64 over the golden ratio: multiples of it lie far apart.
    scene.wrapping_add((i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// Keeps one record per body, the one with the greatest stress.
fn keep_hardest(all: &mut Vec<HeldRecord>, body: usize, event: &frangible_rapier::HeldEvent) {
    let new = || HeldRecord {
        body,
        contacts: event.contacts.clone(),
        report: event.report.clone(),
    };
    match all.iter_mut().find(|h| h.body == body) {
        Some(known) if event.report.peak_stress > known.report.peak_stress => *known = new(),
        Some(_) => {}
        None => all.push(new()),
    }
}

/// Whether all but projectiles sleep: a ball on a level floor rolls for tens of seconds.
fn at_rest(world: &BreakableWorld, projectiles: &[RigidBodyHandle]) -> bool {
    world.physics.bodies.iter().all(|(handle, body)| {
        projectiles.contains(&handle) || !body.is_dynamic() || body.is_sleeping()
    })
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
