//! Bakes a scene's body, lets it break, records it.

use std::sync::Arc;
use std::time::Instant;

use frangible::glam::{Quat, Vec3};
use frangible::{Asset, Body, Contact, ImpactReport, Material};
use frangible_bake::{BakeReport, BakeSpec, Progress};
use frangible_export::{Floor, Recording};
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties, WorldConfig};

use crate::appearance::{ball_surface, body_surfaces};
use crate::error::SceneError;
use crate::meshes::{BodySurfaces, ball, whole};
use crate::recorder::{FRAME_RATE, Recorder};
use crate::scene::{Action, BallThrow, Scene};

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

/// What came of a scene.
#[derive(Clone, Debug)]
pub struct Run {
    /// The animation.
    pub recording: Recording,
    /// Reports of the impacts that broke the body (none, or one).
    pub breaks: Vec<BreakRecord>,
    /// The hardest impact that did not break it, if any.
    pub held: Option<HeldRecord>,
    /// Whether everything but a thrown ball lay still at the end.
    pub at_rest: bool,
    /// Simulated time, s.
    pub simulated: f64,
    /// Wall-clock time of the rigid bodies, without the fracture, s.
    pub rigid_seconds: f64,
}

/// An impact that did not break the body.
#[derive(Clone, Debug)]
pub struct HeldRecord {
    /// The contacts, body frame.
    pub contacts: Vec<Contact>,
    /// What the fracture found.
    pub report: ImpactReport,
}

/// One break of a run.
#[derive(Clone, Debug)]
pub struct BreakRecord {
    /// Simulated time, s.
    pub time: f64,
    /// The contacts, body frame.
    pub contacts: Vec<Contact>,
    /// How the break came about.
    pub report: ImpactReport,
    /// Masses of the pieces, kg, falling.
    pub masses: Vec<f64>,
    /// Sum of the pieces' volumes, m³.
    pub volume: f64,
    /// Energy taken from the motion for the cracks, J.
    pub energy_paid: f64,
}

/// Bakes the scene's body.
///
/// # Errors
/// A quantity of the scene or of its shape that cannot be used.
pub fn bake(
    scene: &Scene,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Arc<Asset>, BakeReport), SceneError> {
    scene.validate()?;
    let spec = BakeSpec {
        modes: scene.modes,
        ..BakeSpec::new(&scene.name, scene.shape.clone(), scene.material.clone())
    };
    let (asset, report) = frangible_bake::bake(&spec, progress)?;
    Ok((Arc::new(asset), report))
}

/// Plays the scene with a baked body and records it; `progress` gets the share of the longest duration done.
///
/// # Errors
/// A quantity of the scene that cannot be used.
pub fn play(
    scene: &Scene,
    asset: &Arc<Asset>,
    progress: &mut dyn FnMut(f64),
) -> Result<Run, SceneError> {
    scene.validate()?;
    let clock = Instant::now();
    let mut config = WorldConfig::default();
    config.fracture = scene.fracture.clone();
    config.record_held = true;
    let mut world = BreakableWorld::new(config)?;
    let floor = SurfaceProperties::of(&Material::preset(&scene.floor)?, f32::INFINITY);
    world.insert_fixed_half_space(Vector::ZERO, Vector::Y, floor)?;

    let surfaces = BodySurfaces { outer: 0, inner: 1 };
    let mut looks: Vec<_> = body_surfaces(&scene.material.name).into();
    let lowest = lowest_point(asset, scene.rotation);
    let (clearance, thrown) = match &scene.action {
        Action::Drop { height } => (*height as f32, None),
        Action::Ball(throw) => (1e-4, Some(throw)),
    };
    let centre = Vec3::new(0.0, clearance - lowest, 0.0);
    let body = Body::new(Arc::clone(asset), scene.seed)?;
    let pose = Pose::from_parts(vector(centre), rotation(scene.rotation));
    let handle = world.insert_breakable(body, pose, Vector::ZERO, Vector::ZERO)?;
    if let Some(throw) = thrown {
        looks.push(ball_surface(&throw.material));
    }
    let mut recorder = Recorder::new(&scene.name, looks);
    let extras = vec![
        ("mass_kg".into(), asset.mass.mass),
        ("volume_m3".into(), asset.mass.volume),
    ];
    recorder.track(scene.name.clone(), whole(asset, surfaces), handle, extras);
    let mut ball_handle = None;
    if let Some(throw) = thrown {
        let handle = throw_ball(&mut world, throw, centre, asset)?;
        let extras = vec![("mass_kg".into(), throw.mass)];
        recorder.track("ball".into(), ball(throw.radius as f32, 2), handle, extras);
        ball_handle = Some(handle);
    }

    let mut run = Run {
        recording: Recording::default(),
        breaks: Vec::new(),
        held: None,
        at_rest: false,
        simulated: 0.0,
        rigid_seconds: 0.0,
    };
    let frames = (scene.duration * f64::from(FRAME_RATE)).ceil() as usize;
    let mut rest_frames = 0;
    recorder.frame(&world);
    let mut fine_until = frames;
    for frame in 1..=frames {
        let steps = if frame <= fine_until {
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
                if run
                    .held
                    .as_ref()
                    .is_none_or(|h| held.report.peak_stress > h.report.peak_stress)
                {
                    run.held = Some(HeldRecord {
                        contacts: held.contacts.clone(),
                        report: held.report.clone(),
                    });
                }
            }
            for event in world.breaks() {
                recorder.broke(event, surfaces);
                fine_until = frame + FINE_FRAMES;
                run.breaks.push(BreakRecord {
                    time: run.simulated,
                    contacts: event.contacts.clone(),
                    report: event.fracture.report.clone(),
                    masses: event
                        .fracture
                        .fragments
                        .iter()
                        .map(|f| f.mass.mass)
                        .collect(),
                    volume: event.fracture.fragments.iter().map(|f| f.mass.volume).sum(),
                    energy_paid: event.energy_paid,
                });
            }
        }
        for (_, body) in world.physics.bodies.iter_mut() {
            body.set_angular_damping(ROLLING);
        }
        recorder.frame(&world);
        progress(frame as f64 / frames as f64);
        rest_frames = if at_rest(&world, ball_handle) {
            rest_frames + 1
        } else {
            0
        };
        if rest_frames as f32 > REST * FRAME_RATE {
            break;
        }
    }
    run.at_rest = at_rest(&world, ball_handle);
    run.recording = recorder.finish(scene.look_from, farthest_point(asset));
    run.recording.floor = Some(Floor {
        height: 0.0,
        ..Floor::default()
    });
    let fracture = |r: &ImpactReport| {
        r.timings.response + r.timings.stress + r.timings.cracks + r.timings.fragments
    };
    let fractured: f64 = run.breaks.iter().map(|b| fracture(&b.report)).sum();
    run.rigid_seconds = clock.elapsed().as_secs_f64() - fractured;
    Ok(run)
}

/// Whether all but the ball sleep: a ball on a level floor rolls for tens of seconds.
fn at_rest(world: &BreakableWorld, ball: Option<RigidBodyHandle>) -> bool {
    world
        .physics
        .bodies
        .iter()
        .all(|(handle, body)| Some(handle) == ball || !body.is_dynamic() || body.is_sleeping())
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

/// Starts the ball a twentieth of a second of flight outside the body.
fn throw_ball(
    world: &mut BreakableWorld,
    throw: &BallThrow,
    centre: Vec3,
    asset: &Asset,
) -> Result<RigidBodyHandle, SceneError> {
    let direction = throw.toward.normalize();
    let reach = farthest_point(asset);
    let radius = throw.radius as f32;
    let speed = throw.speed as f32;
    let distance = (0.05 * speed).clamp(0.1, 1.0);
    // Outside the body's sphere, so that it cannot start inside the body; and back in time along the parabola that
    // arrives with the speed and direction asked for.
    let flight = (reach + radius + distance) / speed;
    let gravity = Vec3::from(world.physics.gravity.to_array());
    let start = centre + throw.at - direction * (speed * flight) + 0.5 * gravity * flight * flight;
    let velocity = direction * speed - gravity * flight;
    if start.y < radius {
        return Err(SceneError::BallBelowFloor {
            depth_mm: 1e3 * (radius - start.y),
        });
    }
    let surface = SurfaceProperties::of(&Material::preset(&throw.material)?, radius);
    let ball = Ball {
        mass: throw.mass as f32,
        radius,
    };
    let pose = Pose::from_translation(vector(start));
    Ok(world.insert_ball(ball, surface, pose, vector(velocity))?)
}

fn vector(v: Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn rotation(q: Quat) -> Rotation {
    Rotation::from_xyzw(q.x, q.y, q.z, q.w)
}
