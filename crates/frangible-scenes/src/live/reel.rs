//! The last seconds of a scene that runs, kept as poses, from which a recording of it is made. Keeping them costs a few microseconds sixty
//! times a second.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use super::{LiveScene, Thing};
use frangible_recording::{Pose, RecordedNode, Recording, View};

/// Pictures kept per second of film.
const RATE: f64 = 60.0;

/// Things at one moment, and their poses.
type Moment = Vec<(Arc<Thing>, Pose)>;

/// The last seconds as a spectator saw them: in slow motion a step is long.
pub struct Reel {
    /// Seconds that are kept.
    kept: f64,
    moments: VecDeque<Arc<Moment>>,
    /// Film that passed since the last moment, s.
    since: f64,
}

impl Reel {
    /// An empty reel that keeps the last `seconds`, which may be infinite.
    #[must_use]
    pub fn keeping(seconds: f64) -> Self {
        Self {
            kept: seconds,
            moments: VecDeque::new(),
            since: 0.0,
        }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        *self = Self::keeping(self.kept);
    }

    /// Seconds of film there are.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.moments.len() as f64 / RATE
    }

    /// Notes the poses of all things after `passed` seconds of film.
    pub fn note(&mut self, live: &LiveScene, passed: f64) {
        self.since += passed;
        let due = ((self.since * RATE + 1e-6).floor()).min(self.kept * RATE);
        if due < 1.0 && !self.moments.is_empty() {
            return;
        }
        self.since = (self.since - due / RATE).clamp(0.0, 1.0 / RATE);
        let things = live.things().iter();
        let there = things.filter_map(|thing| Some((Arc::clone(thing), live.pose(thing)?)));
        let moment = Arc::new(there.collect::<Moment>());
        for _ in 0..(due as usize).max(1) {
            if self.moments.len() as f64 >= self.kept * RATE {
                self.moments.pop_front();
            }
            self.moments.push_back(Arc::clone(&moment));
        }
    }

    /// The last seconds with `rate` pictures a second, seen from `camera`; at least one picture, of the present things.
    #[must_use]
    pub fn recording(&self, live: &LiveScene, seconds: f64, rate: f64, camera: View) -> Recording {
        let mut chosen: Vec<&Moment> = Vec::new();
        let count = ((seconds.min(self.seconds()) * rate).round() as usize).max(1);
        for back in (0..count).rev() {
            let back = (back as f64 * RATE / rate).round() as usize;
            let at = self.moments.len().checked_sub(1 + back);
            chosen.extend(at.and_then(|at| self.moments.get(at)).map(Arc::as_ref));
        }
        if chosen.is_empty() {
            return live.recording(camera);
        }
        let mut recording = Recording {
            frame_rate: rate as f32,
            frame_count: chosen.len(),
            ..Recording {
                meshes: Vec::new(),
                nodes: Vec::new(),
                ..live.recording(camera)
            }
        };
        // The mesh of each thing, and its last node; a thing that comes back after a while, undone, is another node.
        let mut known: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
        for (frame, moment) in chosen.into_iter().enumerate() {
            for (thing, pose) in moment {
                let key = Arc::as_ptr(thing) as usize;
                let last = known.get(&key).copied();
                let node = last.filter(|&(_, node)| recording.nodes[node].visible.end == frame);
                if let Some((_, node)) = node {
                    let node = &mut recording.nodes[node];
                    node.visible.end = frame + 1;
                    node.poses.push(*pose);
                    continue;
                }
                let mesh = last.map_or(recording.meshes.len(), |(mesh, _)| mesh);
                if last.is_none() {
                    recording.meshes.push(thing.mesh.clone());
                }
                known.insert(key, (mesh, recording.nodes.len()));
                recording.nodes.push(RecordedNode {
                    name: thing.name.clone(),
                    mesh,
                    // Poses cover all frames, the unseen ones too.
                    poses: vec![*pose; frame + 1],
                    visible: frame..frame + 1,
                    keep_extras: vec![("mass_kg".into(), thing.mass)],
                });
            }
        }
        for node in &mut recording.nodes {
            let last = node.poses.last().copied().unwrap_or_default();
            node.poses.resize(recording.frame_count, last);
        }
        recording
    }
}
