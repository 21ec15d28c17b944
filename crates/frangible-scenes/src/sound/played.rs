//! A finished run as the input of sound synthesis.

use frangible::glam::Vec3;
use frangible_recording::{Pose, RecordedMesh};
use frangible_sound::{Cast, Sounding};

use crate::result::Run;

/// The things of a run that is over.
pub(super) struct Played<'a>(pub(super) &'a Run);

impl Played<'_> {
    fn mesh(&self, node: usize) -> &RecordedMesh {
        let recording = &self.0.recording;
        &recording.meshes[recording.nodes[node].mesh]
    }

    fn is_there(&self, node: usize, time: f64) -> bool {
        let recording = &self.0.recording;
        let frame = (time * f64::from(recording.frame_rate)) as usize;
        recording.nodes[node].visible.contains(&frame)
    }
}

impl Cast for Played<'_> {
    fn name(&self, node: usize) -> &str {
        &self.0.recording.nodes[node].name
    }

    fn sounding(&self, node: usize) -> &Sounding {
        &self.0.soundings[node]
    }

    fn vertices(&self, node: usize) -> &[Vec3] {
        &self.mesh(node).positions
    }

    fn triangles(&self, node: usize) -> Vec<[u32; 3]> {
        triangles(self.mesh(node))
    }

    fn balls(&self, time: f64) -> Vec<usize> {
        let all = self.0.soundings.iter().enumerate();
        all.filter(|(_, sounding)| matches!(sounding, Sounding::Ball(..)))
            .map(|(node, _)| node)
            .filter(|&node| self.is_there(node, time))
            .collect()
    }

    /// Between two frames it is on the line from one to the other; within a frame before its first one and after its last it is as fast as there.
    fn pose(&self, node: usize, time: f64) -> Pose {
        let recording = &self.0.recording;
        let visible = &recording.nodes[node].visible;
        let frames = (time * f64::from(recording.frame_rate)).max(0.0);
        let frame = (frames as usize).max(visible.start);
        let at = |frame: usize| recording.pose(node, frame).translation;
        let here = at(frame);
        let step = if visible.contains(&(frame + 1)) {
            at(frame + 1) - here
        } else if frame > visible.start && frame < visible.end {
            here - at(frame - 1)
        } else {
            Vec3::ZERO
        };
        let share = (frames - frame as f64).clamp(-1.0, 1.0) as f32;
        Pose {
            translation: here + step * share,
            ..recording.pose(node, frame)
        }
    }

    fn floor(&self) -> Option<f32> {
        self.0.recording.floor.map(|floor| floor.height)
    }
}

/// All triangles of a mesh.
pub(super) fn triangles(mesh: &RecordedMesh) -> Vec<[u32; 3]> {
    let parts = mesh.parts.iter();
    parts
        .flat_map(|part| part.indices.as_chunks::<3>().0)
        .copied()
        .collect()
}
