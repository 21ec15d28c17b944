//! The things of a scene as batches: many pieces in each, so that drawing them costs a few calls, and each piece written
//! again only when it moved, so that a floor full of shards at rest costs nothing.
//!
//! The renderer knows one pose per draw call only, and 500 draws cost more than 20 uploads.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::glam::{Mat3, Vec3};
use frangible_recording::{Pose, RecordedMesh};
use frangible_scenes::{LiveScene, Thing, ThingKind};

use crate::picture::{Batch, BatchLooks};

/// Vertices of a batch. A batch is uploaded whole when a piece of it moves, and each batch is a draw call: larger ones make
/// more of the first and less of the second. With 500 pieces these make about twenty.
const FULL: usize = 16_384;

/// A batch with fewer vertices is put together with others when pieces come.
const SMALL: usize = FULL / 4;

/// Smallest motion since a part was written that has it written again, m: a tenth of a pixel at ten times the usual nearness. Pieces in a heap
/// tremble by micrometres until all of it sleeps.
const STILL: f32 = 1e-5;

/// Keeps the batches of the last pictures.
#[derive(Default)]
pub(crate) struct Mesher {
    chunks: Vec<Chunk>,
    /// Pose in which each thing is drawn; `None` if it is gone.
    poses: Vec<Option<Pose>>,
    /// Counts the batches that were written.
    stamp: u64,
}

/// A batch to be, and its last copies.
struct Chunk {
    surface: usize,
    looks: BatchLooks,
    parts: Vec<Part>,
    vertices: usize,
    faces: Arc<Vec<[u32; 3]>>,
    copies: Vec<Copy>,
    current: usize,
}

/// The triangles of one surface of one thing.
struct Part {
    number: usize,
    thing: Arc<Thing>,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    faces: Vec<[u32; 3]>,
    /// Distance of its farthest vertex from the thing's origin, m.
    reach: f32,
}

/// A batch, and where its parts were when they were written into it. Whoever draws may still have it: then another is written.
struct Copy {
    batch: Arc<Batch>,
    poses: Vec<Pose>,
}

impl Mesher {
    /// Batches of all things, drawn apart by `explode`.
    pub(crate) fn batches(&mut self, live: &LiveScene, explode: f32) -> Vec<Arc<Batch>> {
        self.poses.clear();
        let place = |thing: &Arc<Thing>| Some(apart(thing, live.pose(thing)?, explode));
        self.poses.extend(live.things().iter().map(place));
        self.regroup(live);
        let mut batches = Vec::with_capacity(self.chunks.len());
        for chunk in &mut self.chunks {
            batches.push(chunk.written(&self.poses, &mut self.stamp));
        }
        batches
    }

    /// Puts new things into batches, and takes out those that are gone.
    fn regroup(&mut self, live: &LiveScene) {
        let things = live.things();
        let there = |part: &Part| {
            // After an undone break the number may be another thing's.
            let same = |thing| Arc::ptr_eq(thing, &part.thing);
            things.get(part.number).is_some_and(same) && self.poses[part.number].is_some()
        };
        let mut known = vec![false; things.len()];
        let parts = self.chunks.iter().flat_map(|chunk| &chunk.parts);
        for part in parts.filter(|part| there(part)) {
            known[part.number] = true;
        }
        let complete = |chunk: &Chunk| chunk.parts.iter().all(there);
        let came = |number: usize| self.poses[number].is_some() && !known[number];
        let new: Vec<usize> = (0..things.len()).filter(|&number| came(number)).collect();
        if new.is_empty() && self.chunks.iter().all(complete) {
            return;
        }
        let mut loose: BTreeMap<usize, Vec<Part>> = BTreeMap::new();
        let mut kept = Vec::new();
        for chunk in std::mem::take(&mut self.chunks) {
            if complete(&chunk) && chunk.vertices >= SMALL {
                kept.push(chunk);
            } else {
                let parts = chunk.parts.into_iter().filter(|part| there(part));
                loose.entry(chunk.surface).or_default().extend(parts);
            }
        }
        for number in new {
            for part in &things[number].mesh.parts {
                let taken = Part::new(number, &things[number], &part.indices);
                loose.entry(part.surface).or_default().push(taken);
            }
        }
        self.chunks = kept;
        for (surface, parts) in loose {
            self.pack(surface, parts, live);
        }
        // Surfaces in their order, so that the same scene is drawn in the same order.
        self.chunks
            .sort_by_key(|chunk| (chunk.surface, chunk.parts[0].number));
    }

    fn pack(&mut self, surface: usize, mut parts: Vec<Part>, live: &LiveScene) {
        parts.retain(|part| !part.faces.is_empty());
        parts.sort_by_key(|part| part.number);
        let mut group = Vec::new();
        let mut vertices = 0;
        let looks = BatchLooks::Surface(live.surfaces()[surface].clone());
        for part in parts {
            if vertices > 0 && vertices + part.positions.len() > FULL {
                let full = std::mem::take(&mut group);
                self.chunks.push(Chunk::of(surface, looks.clone(), full));
                vertices = 0;
            }
            vertices += part.positions.len();
            group.push(part);
        }
        if !group.is_empty() {
            self.chunks.push(Chunk::of(surface, looks, group));
        }
    }
}

impl Part {
    /// Takes the vertices that these triangles use.
    fn new(number: usize, thing: &Arc<Thing>, indices: &[u32]) -> Self {
        let mesh: &RecordedMesh = &thing.mesh;
        let mut part = Self {
            number,
            thing: Arc::clone(thing),
            positions: Vec::new(),
            normals: Vec::new(),
            faces: Vec::with_capacity(indices.len() / 3),
            reach: 0.0,
        };
        const NONE: u32 = u32::MAX;
        let mut taken = vec![NONE; mesh.positions.len()];
        for face in indices.chunks_exact(3) {
            part.faces.push([face[0], face[1], face[2]].map(|vertex| {
                let vertex = vertex as usize;
                if taken[vertex] == NONE {
                    taken[vertex] = part.positions.len() as u32;
                    part.positions.push(mesh.positions[vertex]);
                    part.normals
                        .push(mesh.normals[vertex].normalize_or(Vec3::Y));
                }
                taken[vertex]
            }));
        }
        let lengths = part.positions.iter().map(|p| p.length());
        part.reach = lengths.fold(0.0, f32::max);
        part
    }

    /// Returns true if the difference cannot be seen.
    fn is_still(&self, written: Pose, pose: Pose) -> bool {
        let moved = written.translation.distance(pose.translation);
        // Twice the chord between unit quaternions is the angle, where it is small.
        let turned = 2.0 * (written.rotation - pose.rotation).length();
        moved + turned * self.reach < STILL
    }

    fn write(&self, pose: Pose, positions: &mut [Vec3], normals: &mut [Vec3]) {
        let rotation = Mat3::from_quat(pose.rotation.normalize());
        for (to, &at) in positions.iter_mut().zip(&self.positions) {
            *to = rotation * at + pose.translation;
        }
        for (to, &normal) in normals.iter_mut().zip(&self.normals) {
            *to = rotation * normal;
        }
    }
}

impl Chunk {
    fn of(surface: usize, looks: BatchLooks, parts: Vec<Part>) -> Self {
        let mut faces = Vec::with_capacity(parts.iter().map(|part| part.faces.len()).sum());
        let mut vertices = 0;
        for part in &parts {
            let first = vertices as u32;
            faces.extend(
                part.faces
                    .iter()
                    .map(|face| face.map(|vertex| first + vertex)),
            );
            vertices += part.positions.len();
        }
        Self {
            surface,
            looks,
            parts,
            vertices,
            faces: Arc::new(faces),
            copies: Vec::new(),
            current: 0,
        }
    }

    /// The batch with everything where it is: the last one if nothing moved, else a copy that nobody has any more.
    fn written(&mut self, poses: &[Option<Pose>], stamp: &mut u64) -> Arc<Batch> {
        let pose = |part: &Part| poses[part.number].unwrap_or_default();
        if let Some(last) = self.copies.get(self.current) {
            let mut parts = self.parts.iter().zip(&last.poses);
            if parts.all(|(part, &written)| part.is_still(written, pose(part))) {
                return Arc::clone(&last.batch);
            }
        }
        let free = |copy: &mut Copy| Arc::get_mut(&mut copy.batch).is_some();
        self.current = match self.copies.iter_mut().position(free) {
            Some(free) => free,
            None => {
                self.copies.push(self.blank());
                self.copies.len() - 1
            }
        };
        *stamp += 1;
        let copy = &mut self.copies[self.current];
        if let Some(batch) = Arc::get_mut(&mut copy.batch) {
            batch.stamp = *stamp;
            let mut first = 0;
            for (part, written) in self.parts.iter().zip(&mut copy.poses) {
                let range = first..first + part.positions.len();
                first = range.end;
                let pose = pose(part);
                if !part.is_still(*written, pose) {
                    *written = pose;
                    let (to, normals) = (&mut batch.positions, &mut batch.normals);
                    part.write(pose, &mut to[range.clone()], &mut normals[range]);
                }
            }
        }
        Arc::clone(&copy.batch)
    }

    /// A copy into which nothing was written yet.
    fn blank(&self) -> Copy {
        let nowhere = Pose {
            translation: Vec3::NAN,
            ..Pose::default()
        };
        Copy {
            batch: Arc::new(Batch {
                looks: self.looks.clone(),
                positions: vec![Vec3::ZERO; self.vertices],
                normals: vec![Vec3::Y; self.vertices],
                values: Vec::new(),
                faces: Arc::clone(&self.faces),
                stamp: 0,
            }),
            poses: vec![nowhere; self.parts.len()],
        }
    }
}

/// Triangles of corners in their order.
pub(crate) fn numbered(corners: usize) -> Vec<[u32; 3]> {
    (0..corners as u32 / 3)
        .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
        .collect()
}

/// Pose in which a piece is drawn: farther from the middle of its parent, in the direction in which it lay there.
pub(crate) fn apart(thing: &Thing, pose: Pose, explode: f32) -> Pose {
    match thing.kind {
        ThingKind::Piece { birth, .. } => Pose {
            translation: pose.translation + explode * (pose.rotation * birth),
            ..pose
        },
        _ => pose,
    }
}

#[cfg(test)]
mod tests;
