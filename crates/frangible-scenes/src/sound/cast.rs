//! Whose sound is made: a run that is over, or a scene on the move.

use frangible::Material;
use frangible::glam::Vec3;
use frangible_export::{Pose, RecordedMesh};

use crate::recorder::Sounding;
use crate::result::Run;

/// The things of a scene, by their numbers.
pub(super) trait Cast {
    /// How many there are.
    fn count(&self) -> usize;
    /// What a thing is called.
    fn name(&self, node: usize) -> &str;
    /// What it is to the ear.
    fn sounding(&self, node: usize) -> &Sounding;
    /// Its shape in its own frame, m.
    fn mesh(&self, node: usize) -> &RecordedMesh;
    /// Whether it is there at a time, s.
    fn is_there(&self, node: usize, time: f64) -> bool;
    /// Where it is at a time, s.
    fn pose(&self, node: usize, time: f64) -> Pose;
    /// Height of the floor, m, if there is one.
    fn floor(&self) -> Option<f32>;
    /// Blows on each thing: thing and time, s.
    fn blows(&self) -> &[(usize, f64)];

    /// What a thing is made of.
    fn material(&self, node: usize) -> &Material {
        match self.sounding(node) {
            Sounding::Modes(body) => &body.asset().material,
            Sounding::Piece(material, _) | Sounding::Ball(material, ..) => material,
        }
    }

    /// Mass of a thing, kg.
    fn mass(&self, node: usize) -> f64 {
        mass(self.sounding(node))
    }

    /// Distance of a point, m, in the frame of a thing, from the nearest vertex of its mesh.
    fn distance(&self, node: usize, point: Vec3) -> f32 {
        let vertices = self.mesh(node).positions.iter();
        vertices
            .map(|v| v.distance_squared(point))
            .fold(f32::INFINITY, f32::min)
    }
}

/// Mass of what sounds, kg.
pub(super) fn mass(sounding: &Sounding) -> f64 {
    match sounding {
        Sounding::Modes(body) => body.asset().mass.mass,
        Sounding::Piece(_, mass) | Sounding::Ball(_, _, mass) => *mass,
    }
}

/// A run that is over.
pub(super) struct Played<'a> {
    run: &'a Run,
    blows: Vec<(usize, f64)>,
}

impl<'a> Played<'a> {
    pub(super) fn new(run: &'a Run) -> Self {
        let blows = run.recording.blows.iter();
        Self {
            run,
            blows: blows.map(|blow| (blow.node, blow.time)).collect(),
        }
    }
}

impl Cast for Played<'_> {
    fn count(&self) -> usize {
        self.run.soundings.len()
    }

    fn name(&self, node: usize) -> &str {
        &self.run.recording.nodes[node].name
    }

    fn sounding(&self, node: usize) -> &Sounding {
        &self.run.soundings[node]
    }

    fn mesh(&self, node: usize) -> &RecordedMesh {
        &self.run.recording.meshes[self.run.recording.nodes[node].mesh]
    }

    fn is_there(&self, node: usize, time: f64) -> bool {
        let recording = &self.run.recording;
        let frame = (time * f64::from(recording.frame_rate)) as usize;
        recording.nodes[node].visible.contains(&frame)
    }

    /// Between two frames it is on the line from one to the other; within a frame before its first one and after its last it is as fast as there.
    fn pose(&self, node: usize, time: f64) -> Pose {
        let recording = &self.run.recording;
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
        self.run.recording.floor.map(|floor| floor.height)
    }

    fn blows(&self) -> &[(usize, f64)] {
        &self.blows
    }
}
