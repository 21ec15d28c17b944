//! Simulates and records a scene.
//!
//! Steps are short until a body breaks: at 1/240 s a falling body moves 2 cm per step, and Rapier distributes the blow over predicted contact
//! points. At 1/3840 s there is a single contact at the right place.

use std::collections::BTreeMap;

use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::{BreakableWorld, HeldEvent};
use frangible_recording::{Floor, Recording};
use web_time::Instant;

use crate::bake::BakedBody;
use crate::error::SceneError;
use crate::output::Simplified;
use crate::recorder::{FRAME_RATE, piece_name};
use crate::result::{BlowRecord, BreakRecord, HeldRecord, Run};
use crate::scene::Scene;
use crate::stage::{FEW, Stage, Thrown, set_up};

/// Physics steps per recorded frame while nothing is about to break.
const STEPS_PER_FRAME: usize = 4;

/// Physics steps per recorded frame until the break and just after it. A body that falls at 4 m/s moves 1 mm in such
/// a step; in a coarser one Rapier shares the blow among contact points that are not there yet.
const FINE_STEPS_PER_FRAME: usize = 64;

/// Physics steps per recorded frame while pieces may break, or some of many bodies: slower than what broke them, and dear.
const PIECE_STEPS_PER_FRAME: usize = 16;

/// Frames after a break that are still stepped finely.
const FINE_FRAMES: usize = 2;

/// Damping of rotation, 1/s, on top of the world's rolling resistance; that the scenes come to rest was measured with it.
const ROLLING: f32 = 0.8;

/// Seconds recorded after everything came to rest.
const REST: f32 = 0.25;

/// Simulates and records the scene with its baked bodies. `progress` receives the simulated share of the scene's duration.
///
/// # Errors
/// An invalid quantity of the scene, or a wrong number of baked bodies.
pub fn play(
    scene: &Scene,
    baked: &[BakedBody],
    progress: &mut dyn FnMut(f64),
) -> Result<Run, SceneError> {
    scene.validate()?;
    let clock = Instant::now();
    let mut stage = set_up(scene, baked)?;
    // Number and name of every breakable body, and of the pieces that broke off it.
    let mut known: BTreeMap<(u32, u32), (usize, String)> = BTreeMap::new();
    for (i, body) in stage.bodies.iter().enumerate() {
        known.insert(body.handle.into_raw_parts(), (i, body.spec.name.clone()));
    }
    let mut run = Run {
        recording: Recording::default(),
        simplified: Simplified::default(),
        soundings: Vec::new(),
        breaks: Vec::new(),
        held: Vec::new(),
        blows: Vec::new(),
        at_rest: false,
        simulated: 0.0,
        rigid_seconds: 0.0,
        frame_seconds: Vec::new(),
    };
    let frames = (scene.duration * f64::from(FRAME_RATE)).ceil() as usize;
    let mut rest_frames = 0;
    stage.recorder.frame(&stage.world);
    let mut fine_until = 0;
    for frame in 1..=frames {
        stage.throw(scene, run.simulated)?;
        let clock = Instant::now();
        let steps = steps_of_frame(&mut stage, scene, frame <= fine_until);
        let Stage {
            world,
            recorder,
            bodies,
            projectiles,
        } = &mut stage;
        let dt = 1.0 / (FRAME_RATE * steps as f32);
        world.physics.integration_parameters.dt = dt;
        for _ in 0..steps {
            run.simulated += f64::from(dt);
            world.step()?;
            // A blow begins within its step, and is known at its end.
            recorder.touches(world, run.simulated);
            for held in world.held() {
                let Some((body, _)) = known.get(&held.body.into_raw_parts()) else {
                    continue;
                };
                let generation = world.breakable(held.body).map_or(0, |b| b.generation());
                let surfaces = &bodies[*body].surfaces;
                if let (Some(state), Some(body)) = (&held.state, world.breakable(held.body)) {
                    let found = (state, &held.report);
                    recorder.cracked(held.body, body.asset(), found, surfaces);
                }
                let (contacts, report) = (&held.contacts, &held.report);
                // A resting load is no blow.
                if !contacts.is_empty() {
                    if let Some(breakable) = world.breakable(held.body) {
                        recorder.blow(held.body, breakable.asset(), report, run.simulated, 0..0);
                    }
                    let margin = Some(held.margin);
                    let blow =
                        BlowRecord::new(*body, generation, run.simulated, contacts, report, margin);
                    run.blows.push(blow);
                }
                if bodies[*body].handle == held.body {
                    keep_hardest(&mut run.held, *body, run.simulated, held);
                }
            }
            for event in world.breaks() {
                // Clumps of dice that part do so without a blow.
                if event
                    .fracture
                    .clump(0)
                    .is_none_or(|clump| clump.generation() == 1)
                {
                    fine_until = frame + FINE_FRAMES;
                }
                let Some((body, name)) = known.remove(&event.parent.into_raw_parts()) else {
                    continue;
                };
                let generation = event.generation();
                recorder.broke(
                    world,
                    &name,
                    generation,
                    event,
                    &bodies[body].surfaces,
                    run.simulated,
                );
                for (i, handle) in event.fragments.iter().enumerate() {
                    let name = piece_name(&name, generation, i);
                    known.insert(handle.into_raw_parts(), (body, name));
                }
                let (contacts, report) = (&event.contacts, &event.fracture.report);
                if !contacts.is_empty() {
                    let blow =
                        BlowRecord::new(body, generation, run.simulated, contacts, report, None);
                    run.blows.push(blow);
                }
                let fragments = &event.fracture.fragments;
                run.breaks.push(BreakRecord {
                    body,
                    generation,
                    time: run.simulated,
                    contacts: event.contacts.clone(),
                    report: event.fracture.report.clone(),
                    masses: fragments.iter().map(|f| f.mass.mass).collect(),
                    volume: fragments.iter().map(|f| f.mass.volume).sum(),
                    energy_paid: event.energy_paid,
                    cause: event.cause,
                    kinetic_before: event.kinetic_before,
                    cracks_together: event.cracks_together,
                    kinetic_after: event.kinetic_after,
                    work: event.work,
                });
            }
        }
        resist_rolling(world);
        run.frame_seconds.push(clock.elapsed().as_secs_f64());
        recorder.frame(world);
        progress(frame as f64 / frames as f64);
        // A held body rests all along: a projectile that flies towards it arrives first.
        let arrived = projectiles.iter().all(|t| t.arrives <= run.simulated);
        rest_frames = match arrived && at_rest(world, projectiles) {
            true => rest_frames + 1,
            false => 0,
        };
        if rest_frames as f32 > REST * FRAME_RATE {
            break;
        }
    }
    run.held.sort_by_key(|held| held.body);
    run.at_rest = at_rest(&stage.world, &stage.projectiles);
    let floor = scene.floor.as_ref().map(|_| Floor::default());
    run.simplified = stage.recorder.simplified;
    (run.recording, run.soundings) = stage.recorder.finish(scene.look_from, floor, run.at_rest);
    let reports = run.breaks.iter().map(|b| &b.report);
    let fractured: f64 = reports.map(|r| r.timings.total()).sum();
    run.rigid_seconds = clock.elapsed().as_secs_f64() - fractured;
    Ok(run)
}

/// Keeps one record per body, the one with the greatest stress or bound of it.
fn keep_hardest(all: &mut Vec<HeldRecord>, body: usize, time: f64, event: &HeldEvent) {
    let new = || HeldRecord {
        body,
        time,
        margin: event.margin,
        contacts: event.contacts.clone(),
        report: event.report.clone(),
    };
    match all.iter_mut().find(|h| h.body == body) {
        Some(known) if event.report.stress_bound > known.report.stress_bound => *known = new(),
        Some(_) => {}
        None => all.push(new()),
    }
}

/// Damps the rotation of all bodies that there are at the end of a frame.
pub(crate) fn resist_rolling(world: &mut BreakableWorld) {
    for (_, body) in world.physics.bodies.iter_mut() {
        body.set_angular_damping(ROLLING);
    }
}

/// Returns true if all but projectiles sleep: a ball on a level floor rolls for tens of seconds.
fn at_rest(world: &BreakableWorld, projectiles: &[Thrown]) -> bool {
    world.physics.bodies.iter().all(|(handle, body)| {
        let thrown = projectiles.iter().any(|t| t.handle == Some(handle));
        thrown || !body.is_dynamic() || body.is_sleeping()
    })
}

/// Physics steps of the coming frame: finer where a body that has not broken yet may be hit, or a piece may.
pub(crate) fn steps_of_frame(stage: &mut Stage<'_>, scene: &Scene, just_broken: bool) -> usize {
    let world = &mut stage.world;
    let mut whole = stage
        .bodies
        .iter()
        .filter(|body| world.breakable(body.handle).is_some());
    let first = whole.next().is_some();
    // Some bodies may stay whole to the end: among the debris of others they are looked after as below.
    let none_broke = whole.count() + 1 == stage.bodies.len();
    let waits = first && none_broke && (stage.bodies.len() == 1 || scene.pieces.generations == 0);
    if (just_broken && stage.bodies.len() <= FEW) || waits {
        return FINE_STEPS_PER_FRAME;
    }
    if world.breakables().next().is_none() {
        return STEPS_PER_FRAME;
    }
    let near = world.near_within(1.0 / FRAME_RATE);
    let whole = |handle: &RigidBodyHandle| stage.bodies.iter().any(|b| b.handle == *handle);
    if near.iter().any(whole) && stage.bodies.len() <= FEW {
        FINE_STEPS_PER_FRAME
    } else if near.is_empty() {
        STEPS_PER_FRAME
    } else {
        PIECE_STEPS_PER_FRAME
    }
}
