//! Turns a running world into a [`Recording`].

use frangible::glam::{Quat, Vec3};
use frangible_export::{Moments, Pose, RecordedMesh, RecordedNode, Recording, SurfaceMaterial, View};
use frangible_rapier::BreakEvent;
use frangible_rapier::BreakableWorld;
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;

use crate::meshes::{BodySurfaces, piece};

/// Frames per second of a recording.
pub(crate) const FRAME_RATE: f32 = 60.0;

/// A node that follows a rigid body.
struct Tracked {
    node: usize,
    body: RigidBodyHandle,
}

/// Collects poses frame by frame.
pub(crate) struct Recorder {
    recording: Recording,
    tracked: Vec<Tracked>,
    break_frame: Option<usize>,
}

impl Recorder {
    pub(crate) fn new(name: &str, surfaces: Vec<SurfaceMaterial>) -> Self {
        let recording =
            Recording { name: name.into(), frame_rate: FRAME_RATE, surfaces, ..Recording::default() };
        Self { recording, tracked: Vec::new(), break_frame: None }
    }

    /// A thing to follow from the next frame on.
    pub(crate) fn track(&mut self, name: String, mesh: RecordedMesh, body: RigidBodyHandle, extras: Vec<(String, f64)>) {
        let recording = &mut self.recording;
        recording.meshes.push(mesh);
        let frame = recording.frame_count;
        let node = RecordedNode {
            name,
            mesh: recording.meshes.len() - 1,
            poses: Vec::new(),
            visible: frame..frame,
            keep_extras: extras,
        };
        recording.nodes.push(node);
        self.tracked.push(Tracked { node: recording.nodes.len() - 1, body });
    }

    /// Puts the pieces in the place of their parent.
    pub(crate) fn broke(&mut self, event: &BreakEvent, surfaces: BodySurfaces) {
        self.break_frame.get_or_insert(self.recording.frame_count);
        for (i, (fragment, &body)) in event.fracture.fragments.iter().zip(&event.fragments).enumerate() {
            let name = format!("{} piece {}", event.asset.name, i + 1);
            let mesh = piece(name.clone(), &fragment.mesh, surfaces);
            let extras =
                vec![("mass_kg".into(), fragment.mass.mass), ("volume_m3".into(), fragment.mass.volume)];
            self.track(name, mesh, body, extras);
        }
    }

    /// Writes down where everything is now.
    pub(crate) fn frame(&mut self, world: &BreakableWorld) {
        let recording = &mut self.recording;
        for tracked in &self.tracked {
            let node = &mut recording.nodes[tracked.node];
            let Some(body) = world.physics.bodies.get(tracked.body) else { continue };
            let pose = body.position();
            let pose = Pose {
                translation: Vec3::from(pose.translation.to_array()),
                rotation: Quat::from_array(pose.rotation.to_array()),
            };
            // Poses cover all frames, the unseen ones before the node's birth too.
            node.poses.resize(recording.frame_count, pose);
            node.poses.push(pose);
            node.visible.end = recording.frame_count + 1;
        }
        recording.frame_count += 1;
    }

    /// The finished recording, its camera set so that what matters fills the picture.
    pub(crate) fn finish(mut self, look_from: Vec3, body_radius: f32) -> Recording {
        let recording = &mut self.recording;
        let last = recording.frame_count.saturating_sub(1);
        for node in &mut recording.nodes {
            let pose = node.poses.last().copied().unwrap_or_default();
            node.poses.resize(recording.frame_count, pose);
        }
        let first_crack = self.break_frame.unwrap_or(last).min(last);
        // Two frames before contact the body is near the floor, in view; five after it the pieces are on their way.
        recording.moments = Moments {
            before: first_crack.saturating_sub(2),
            first_crack,
            just_after: (first_crack + 5).min(last),
            at_rest: last,
        };
        recording.camera = camera(recording, look_from, body_radius);
        self.recording
    }
}

/// Looks at where most of the pieces come to rest, from far enough to see them and the whole body.
fn camera(recording: &Recording, look_from: Vec3, body_radius: f32) -> View {
    let moments = recording.moments;
    let mut seen: Vec<Vec3> = Vec::new();
    for (i, node) in recording.nodes.iter().enumerate() {
        for frame in [moments.first_crack, moments.at_rest] {
            if node.visible.contains(&frame) && node.name != "ball" {
                seen.push(recording.pose(i, frame).translation);
            }
        }
    }
    let vertical_fov = 0.6_f32;
    let mut by_axis = |axis: usize| {
        seen.sort_by(|a, b| a[axis].total_cmp(&b[axis]));
        // Strays beyond the middle four fifths do not move the camera.
        let at = |share: f32| seen.get((share * seen.len() as f32) as usize).map_or(0.0, |p| p[axis]);
        (at(0.1), at(0.899))
    };
    let (x, z) = (by_axis(0), by_axis(2));
    let half = 0.5 * (x.1 - x.0).hypot(z.1 - z.0);
    let target = Vec3::new(0.5 * (x.0 + x.1), 0.55 * body_radius, 0.5 * (z.0 + z.1));
    let radius = (0.75 * half + 0.45 * body_radius).max(1.2 * body_radius);
    let eye = target + look_from.normalize() * (radius / (0.5 * vertical_fov).tan());
    View { eye, target, up: Vec3::Y, vertical_fov }
}
