//! A scene that runs, for a file or a camera.

use frangible::glam::Vec3;
use frangible_recording::{RecordedNode, Recording, View};

use super::{LiveScene, Thing, ThingKind};
use crate::cameras::view;
use crate::recorder::FRAME_RATE;

/// Centre of the highest body that is in view from the beginning, above the floor, in units of how far the body reaches.
const HIGHEST: f32 = 2.2;

impl LiveScene {
    /// Records the present moment as one frame, seen from `camera`: for a file or a picture.
    #[must_use]
    pub fn recording(&self, camera: View) -> Recording {
        let mut recording = Recording {
            name: self.name.clone(),
            frame_rate: FRAME_RATE,
            frame_count: 1,
            surfaces: self.surfaces.clone(),
            images: self.images.clone(),
            floor: self.floor,
            camera,
            ..Recording::default()
        };
        for thing in &self.things {
            let Some(pose) = self.pose(thing) else {
                continue;
            };
            recording.meshes.push(thing.mesh.clone());
            recording.nodes.push(RecordedNode {
                name: thing.name.clone(),
                mesh: recording.meshes.len() - 1,
                poses: vec![pose],
                visible: 0..1,
                keep_extras: vec![
                    ("mass_kg".into(), thing.mass),
                    ("volume_m3".into(), thing.volume),
                ],
            });
        }
        recording
    }

    /// A camera that has the scene's bodies in view, or the pieces left of them, and the floor below them. Bodies high above the floor come into view
    /// as they fall: a glass that falls 1.2 m would be a speck in a picture of all of its way.
    #[must_use]
    pub fn view(&self, look_from: Vec3) -> View {
        let mut seen = Vec::new();
        let mut largest = 0.05_f32;
        let is_body = |thing: &Thing| matches!(thing.kind, ThingKind::Body(_));
        let there = self
            .things
            .iter()
            .filter(|thing| self.pose(thing).is_some());
        let whole = there.clone().any(|thing| is_body(thing));
        // If all bodies are broken, their pieces and the projectiles.
        for thing in there.filter(|thing| is_body(thing) || !whole) {
            let Some(pose) = self.pose(thing) else {
                continue;
            };
            let positions = &thing.mesh.positions;
            let reach = positions.iter().map(|p| p.length()).fold(0.0, f32::max);
            largest = largest.max(reach);
            let falls = self.floor.is_some()
                && (self.world.physics.bodies.get(thing.handle)).is_some_and(|b| b.is_dynamic());
            let mut at = pose.translation;
            if falls {
                at.y = at.y.min(HIGHEST * reach);
            }
            for &point in positions {
                seen.push(pose.rotation * point + at);
            }
        }
        if self.floor.is_some() {
            let feet: Vec<Vec3> = seen.iter().map(|p| p.with_y(0.0)).collect();
            seen.extend(feet);
        }
        view(&seen, f32::MIN, look_from, 2.2 * largest)
    }
}
