//! The things of a scene as batches: one per surface, however many pieces, so that drawing them costs a few calls.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::glam::Vec3;
use frangible_export::Pose;
use frangible_scenes::{LiveScene, Thing, ThingKind};

use crate::picture::{Batch, BatchLooks};

/// Keeps the faces of the last picture: they change only when something breaks or comes.
#[derive(Default)]
pub(crate) struct Mesher {
    present: Vec<usize>,
    faces: BTreeMap<usize, Arc<Vec<[u32; 3]>>>,
}

impl Mesher {
    /// What there is, drawn apart by `explode`.
    pub(crate) fn batches(&mut self, live: &LiveScene, explode: f32) -> Vec<Batch> {
        let things: Vec<(usize, &Arc<Thing>, Pose)> = live
            .things()
            .iter()
            .enumerate()
            .filter_map(|(i, thing)| Some((i, thing, live.pose(thing)?)))
            .collect();
        let mut batches: BTreeMap<usize, Batch> = BTreeMap::new();
        for (_, thing, pose) in &things {
            let pose = apart(thing, *pose, explode);
            for part in &thing.mesh.parts {
                let batch = batches.entry(part.surface).or_insert_with(|| Batch {
                    looks: BatchLooks::Surface(live.surfaces()[part.surface].clone()),
                    positions: Vec::new(),
                    normals: Vec::new(),
                    values: Vec::new(),
                    faces: Arc::default(),
                });
                place_part(thing, &part.indices, pose, batch);
            }
        }
        let present: Vec<usize> = things.iter().map(|(i, ..)| *i).collect();
        if present != self.present {
            self.present = present;
            self.faces = batches
                .iter()
                .map(|(&surface, batch)| (surface, Arc::new(numbered(batch.positions.len()))))
                .collect();
        }
        for (surface, batch) in &mut batches {
            if let Some(faces) = self.faces.get(surface) {
                batch.faces = Arc::clone(faces);
            }
        }
        batches.into_values().collect()
    }
}

/// Triangles of corners in their order.
pub(crate) fn numbered(corners: usize) -> Vec<[u32; 3]> {
    (0..corners as u32 / 3)
        .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
        .collect()
}

fn place_part(thing: &Thing, indices: &[u32], pose: Pose, batch: &mut Batch) {
    let rotation = pose.rotation.normalize();
    batch.positions.reserve(indices.len());
    batch.normals.reserve(indices.len());
    for &corner in indices {
        let at = thing.mesh.positions[corner as usize];
        batch.positions.push(rotation * at + pose.translation);
        batch
            .normals
            .push(rotation * thing.mesh.normals[corner as usize].normalize_or(Vec3::Y));
    }
}

/// Where a piece is drawn: farther from where its parent's middle was, along the way it lay in it.
pub(crate) fn apart(thing: &Thing, pose: Pose, explode: f32) -> Pose {
    match thing.kind {
        ThingKind::Piece { birth, .. } => Pose {
            translation: pose.translation + explode * (pose.rotation * birth),
            ..pose
        },
        _ => pose,
    }
}
