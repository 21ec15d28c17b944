//! The sound of a scene on the move, as it comes.

use std::collections::BTreeMap;

use frangible::Material;
use frangible_export::{Pose, RecordedMesh, View};
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_sound::{BLOCK, SoundError, Synth, SynthConfig, SynthReport};

use super::blows::{blows, cracks};
use super::cast::Cast;
use super::nodes::Nodes;
use super::slides::slides;
use super::touches::touches;
use super::{config_at, floor_material};
use crate::live::{LiveScene, ThingKind};
use crate::recorder::{Sounding, recorded_blow};
use crate::scene::Scene;
use crate::touching::Touching;

/// Blows are remembered for so long, s: what touches then is part of them.
const REMEMBERED: f64 = 0.02;

/// Hears a scene step by step: pressures, Pa, in simulated time. The same steps give the same samples.
pub struct LiveSound {
    synth: Synth,
    nodes: Nodes,
    touching: Touching,
    floor: Option<Material>,
    /// Where each thing is, or was last.
    poses: Vec<Pose>,
    /// The thing of each rigid body.
    numbers: BTreeMap<(u32, u32), usize>,
    blows: Vec<(usize, f64)>,
}

/// The things of a scene on the move.
struct Moving<'a> {
    live: &'a LiveScene,
    poses: &'a [Pose],
    blows: &'a [(usize, f64)],
}

impl Cast for Moving<'_> {
    fn count(&self) -> usize {
        self.live.things().len()
    }

    fn name(&self, node: usize) -> &str {
        &self.live.things()[node].name
    }

    fn sounding(&self, node: usize) -> &Sounding {
        &self.live.things()[node].sounding
    }

    fn mesh(&self, node: usize) -> &RecordedMesh {
        &self.live.things()[node].mesh
    }

    fn is_there(&self, node: usize, _time: f64) -> bool {
        self.live.pose(&self.live.things()[node]).is_some()
    }

    fn pose(&self, node: usize, _time: f64) -> Pose {
        self.poses[node]
    }

    fn floor(&self) -> Option<f32> {
        self.live.floor().map(|floor| floor.height)
    }

    fn blows(&self) -> &[(usize, f64)] {
        self.blows
    }
}

impl LiveSound {
    /// Ears where a camera is, in a scene that has been set up; whole bodies are made ready to sound here, lest their first blow waits.
    ///
    /// # Errors
    /// A number of the scene or of the camera that cannot be used.
    pub fn new(live: &LiveScene, scene: &Scene, camera: &View) -> Result<Self, SoundError> {
        let mut sound = Self {
            synth: Synth::new(config_at(camera, scene).live())?,
            nodes: Nodes::default(),
            touching: Touching::default(),
            floor: floor_material(scene),
            poses: Vec::new(),
            numbers: BTreeMap::new(),
            blows: Vec::new(),
        };
        sound.find_poses(live);
        let Self {
            synth,
            nodes,
            poses,
            blows,
            ..
        } = &mut sound;
        let cast = Moving { live, poses, blows };
        for (node, thing) in live.things().iter().enumerate() {
            if matches!(thing.kind, ThingKind::Body(_)) {
                nodes.ready(synth, &cast, node, live.time())?;
            }
        }
        Ok(sound)
    }

    /// How it listens.
    #[must_use]
    pub fn config(&self) -> &SynthConfig {
        self.synth.config()
    }

    /// What it did so far.
    #[must_use]
    pub fn report(&self) -> SynthReport {
        self.synth.report()
    }

    /// Takes in the step that was just taken, and adds what is heard until its end to `out`: pressures, Pa, left and right in turn. The last
    /// [`BLOCK`] samples come with the next step, so that what happens then begins on its sample.
    ///
    /// # Errors
    /// A number of what happened that cannot be used; the rest is heard.
    pub fn step(&mut self, live: &LiveScene, out: &mut Vec<f32>) -> Result<(), SoundError> {
        self.find_poses(live);
        let happened = self.hear(live);
        let (rate, channels) = (self.config().rate, self.config().listener.channels);
        let behind = (live.time() - self.synth.time()) * rate;
        let count = (behind - BLOCK as f64).max(0.0) as usize;
        let from = out.len();
        out.resize(from + count * channels, 0.0);
        self.synth.render(&mut out[from..]);
        happened
    }

    fn find_poses(&mut self, live: &LiveScene) {
        for (number, thing) in live.things().iter().enumerate().skip(self.poses.len()) {
            self.numbers.insert(thing.handle.into_raw_parts(), number);
        }
        self.poses.resize(live.things().len(), Pose::default());
        for (pose, thing) in self.poses.iter_mut().zip(live.things()) {
            if let Some(now) = live.pose(thing) {
                *pose = now;
            }
        }
    }

    fn hear(&mut self, live: &LiveScene) -> Result<(), SoundError> {
        let (world, now, numbers) = (live.world(), live.time(), &self.numbers);
        let number = |handle: RigidBodyHandle| numbers.get(&handle.into_raw_parts()).copied();
        let held = world.held().iter().filter(|held| !held.contacts.is_empty());
        let held = held.filter_map(|held| {
            let asset = world.breakable(held.body)?.asset();
            Some(recorded_blow(
                number(held.body)?,
                asset,
                &held.report,
                now,
                0..0,
            ))
        });
        let broke = world.breaks().iter().filter_map(|event| {
            let first = number(*event.fragments.first()?)?;
            let pieces = first..first + event.fragments.len();
            let report = &event.fracture.report;
            let parent = number(event.parent)?;
            Some(recorded_blow(parent, &event.asset, report, now, pieces))
        });
        let struck: Vec<_> = held.chain(broke).collect();
        self.blows.retain(|(_, time)| now - time < REMEMBERED);
        let new = struck.iter().map(|blow| (blow.node, blow.time));
        self.blows.extend(new);
        let (came, slid) = self.touching.step(world, &number, now);
        let Self {
            synth,
            nodes,
            poses,
            blows: known,
            floor,
            ..
        } = self;
        let cast = Moving {
            live,
            poses,
            blows: known,
        };
        for blow in &struck {
            blows(synth, nodes, &cast, blow)?;
            cracks(synth, nodes, &cast, blow)?;
        }
        for touch in &came {
            touches(synth, nodes, &cast, floor.as_ref(), touch)?;
        }
        for slide in &slid {
            slides(synth, nodes, &cast, slide)?;
        }
        Ok(())
    }
}
