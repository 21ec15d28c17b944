//! The sound of a running scene, step by step.

use std::collections::BTreeMap;

use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_recording::{Pose, View};
use frangible_sound::{
    Cast, Hearing, SoundError, Sounding, SynthConfig, SynthReport, recorded_blow,
};

use super::played::triangles;
use super::{config_at, floor_material};
use crate::live::{LiveScene, Thing, ThingKind};
use crate::scene::Scene;
use crate::touching::WorldTouching;

/// Computes the sound of a running scene step by step: pressures, Pa, in simulated time. The same steps give the same samples.
pub struct LiveSound {
    hearing: Hearing,
    touching: WorldTouching,
    /// Current or last pose of each object.
    poses: Vec<Pose>,
    /// Object number of each rigid body.
    numbers: BTreeMap<(u32, u32), usize>,
}

/// The things of a scene on the move.
struct Moving<'a> {
    live: &'a LiveScene,
    poses: &'a [Pose],
}

impl Moving<'_> {
    fn thing(&self, node: usize) -> &Thing {
        &self.live.things()[node]
    }
}

impl Cast for Moving<'_> {
    fn name(&self, node: usize) -> &str {
        &self.thing(node).name
    }

    fn sounding(&self, node: usize) -> &Sounding {
        &self.thing(node).sounding
    }

    fn vertices(&self, node: usize) -> &[Vec3] {
        &self.thing(node).mesh.positions
    }

    fn triangles(&self, node: usize) -> Vec<[u32; 3]> {
        triangles(&self.thing(node).mesh)
    }

    fn balls(&self, _time: f64) -> Vec<usize> {
        let things = self.live.things().iter().enumerate();
        let there = |thing: &Thing| self.live.pose(thing).is_some();
        things
            .filter(|(_, thing)| matches!(thing.sounding, Sounding::Ball(..)) && there(thing))
            .map(|(node, _)| node)
            .collect()
    }

    fn pose(&self, node: usize, _time: f64) -> Pose {
        self.poses[node]
    }

    fn floor(&self) -> Option<f32> {
        self.live.floor().map(|floor| floor.height)
    }
}

impl LiveSound {
    /// Creates a listener at the camera in a scene that has been set up, and prepares the sound of whole bodies, so that their first blow causes
    /// no delay.
    ///
    /// # Errors
    /// A value of the scene or of the camera is invalid.
    pub fn new(live: &LiveScene, scene: &Scene, camera: &View) -> Result<Self, SoundError> {
        let config = config_at(camera, scene).live();
        let mut sound = Self {
            hearing: Hearing::new(config, floor_material(scene))?,
            touching: WorldTouching::default(),
            poses: Vec::new(),
            numbers: BTreeMap::new(),
        };
        sound.find_poses(live);
        let Self { hearing, poses, .. } = &mut sound;
        let cast = Moving { live, poses };
        for (node, thing) in live.things().iter().enumerate() {
            if matches!(thing.kind, ThingKind::Body(_)) {
                hearing.ready(&cast, node, live.time())?;
            }
        }
        Ok(sound)
    }

    /// Returns its settings.
    #[must_use]
    pub fn config(&self) -> &SynthConfig {
        self.hearing.synth().config()
    }

    /// Returns its statistics so far.
    #[must_use]
    pub fn report(&self) -> SynthReport {
        self.hearing.synth().report()
    }

    /// Processes the last step and appends the sound up to its end to `out`: pressures, Pa, left and right interleaved. The last
    /// [`BLOCK`](frangible_sound::BLOCK) samples follow with the next step, so that events of that step start at their exact samples.
    ///
    /// # Errors
    /// A value of an event is invalid; the sound of the other events is added.
    pub fn step(&mut self, live: &LiveScene, out: &mut Vec<f32>) -> Result<(), SoundError> {
        self.find_poses(live);
        let happened = self.hear(live);
        self.hearing.until(live.time(), out);
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
        let (came, slid) = self.touching.step(world, &number, now);
        let poses = &self.poses;
        let cast = Moving { live, poses };
        self.hearing.happened(&cast, &struck, (&came, &slid))
    }
}
