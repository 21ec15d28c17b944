//! The nodes of a recording as bodies of a synthesiser.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::glam::{Quat, Vec3};
use frangible::{Asset, Material};
use frangible_export::{Pose, RecordedMesh};
use frangible_sound::{
    AssetSound, AudibleDamping, Body, Hold, Plate, PlateMaterial, SoundError, SurfaceElement, Synth,
};

use super::place;
use crate::recorder::Sounding;
use crate::result::Run;

/// How a push on a node reaches its modes.
enum Shape {
    Asset(Arc<AssetSound>),
    Plate(Plate),
    /// No modes.
    Ball,
}

/// A node that sounds.
struct Ready {
    /// Its number in the synthesiser.
    id: usize,
    shape: Shape,
    body: Arc<Body>,
}

/// Nodes are made ready when they are first struck.
pub(super) struct Nodes<'a> {
    run: &'a Run,
    ready: BTreeMap<usize, Ready>,
    /// Bodies of one asset sound alike.
    assets: Vec<(Arc<Asset>, Arc<AssetSound>, Arc<Body>)>,
}

impl<'a> Nodes<'a> {
    pub(super) fn new(run: &'a Run) -> Self {
        Self {
            run,
            ready: BTreeMap::new(),
            assets: Vec::new(),
        }
    }

    pub(super) fn material(&self, node: usize) -> &'a Material {
        match &self.run.soundings[node] {
            Sounding::Modes(body) => &body.asset().material,
            Sounding::Piece(material, _) | Sounding::Ball(material, ..) => material,
        }
    }

    /// The body of a node, to be read.
    pub(super) fn body(&self, node: usize) -> Option<&Arc<Body>> {
        self.ready.get(&node).map(|ready| &ready.body)
    }

    /// Where a node is at a time.
    pub(super) fn pose(&self, node: usize, time: f64) -> Pose {
        let recording = &self.run.recording;
        let first = recording.nodes[node].visible.start;
        let frame = (time * f64::from(recording.frame_rate)).max(0.0) as usize;
        recording.pose(node, frame.max(first))
    }

    /// Number of a node in the synthesiser, moved to where it is at a time.
    pub(super) fn ready(
        &mut self,
        synth: &mut Synth,
        node: usize,
        time: f64,
    ) -> Result<usize, SoundError> {
        let pose = self.pose(node, time);
        let (at, turned) = (place(pose.translation), pose.rotation.as_dquat());
        if let Some(ready) = self.ready.get(&node) {
            synth.put(time, ready.id, at, turned)?;
            return Ok(ready.id);
        }
        let (shape, body) = self.make(node)?;
        let id = synth.add(Arc::clone(&body), at, turned)?;
        self.ready.insert(node, Ready { id, shape, body });
        Ok(id)
    }

    fn make(&mut self, node: usize) -> Result<(Shape, Arc<Body>), SoundError> {
        let name = self.run.recording.nodes[node].name.clone();
        match &self.run.soundings[node] {
            Sounding::Ball(_, radius, mass) => {
                Ok((Shape::Ball, Arc::new(Body::ball(name, *radius, *mass)?)))
            }
            Sounding::Modes(body) => {
                let known = self
                    .assets
                    .iter()
                    .find(|(a, ..)| Arc::ptr_eq(a, body.asset()));
                if let Some((_, sound, body)) = known {
                    return Ok((Shape::Asset(Arc::clone(sound)), Arc::clone(body)));
                }
                let asset = body.asset();
                let hold = if asset.is_supported() {
                    Hold::Framed
                } else {
                    Hold::Free
                };
                let damping = AudibleDamping::of(&asset.material);
                let (sound, heard) = AssetSound::new(body, &damping, hold)?;
                let (sound, heard) = (Arc::new(sound), Arc::new(heard));
                let entry = (Arc::clone(asset), Arc::clone(&sound), Arc::clone(&heard));
                self.assets.push(entry);
                Ok((Shape::Asset(sound), heard))
            }
            Sounding::Piece(material, mass) => {
                let mesh = &self.run.recording.meshes[self.run.recording.nodes[node].mesh];
                let plate = PlateMaterial {
                    youngs_modulus: material.youngs_modulus,
                    poisson_ratio: material.poisson_ratio,
                    density: material.density,
                    damping: AudibleDamping::of(material),
                };
                let (shape, body) = Plate::of_surface(name, &elements(mesh), *mass, &plate)?;
                Ok((Shape::Plate(shape), Arc::new(body)))
            }
        }
    }

    /// Distance of a point, m, in the frame of a node, from the nearest vertex of its mesh.
    pub(super) fn distance(&self, node: usize, point: Vec3) -> f32 {
        let recording = &self.run.recording;
        let vertices = recording.meshes[recording.nodes[node].mesh]
            .positions
            .iter();
        vertices
            .map(|v| v.distance_squared(point))
            .fold(f32::INFINITY, f32::min)
    }

    /// What a newton along a direction gives each mode of a node that is ready, at a point of it, m.
    pub(super) fn push(&self, node: usize, point: Vec3, direction: Vec3) -> Vec<f32> {
        match self.ready.get(&node).map(|ready| &ready.shape) {
            Some(Shape::Asset(asset)) => asset.push(point, direction),
            Some(Shape::Plate(plate)) => plate.push(point, direction),
            Some(Shape::Ball) | None => Vec::new(),
        }
    }

    /// The push of a force of no known direction: the root of the sum of the squares of three directions.
    pub(super) fn push_any(&self, node: usize, point: Vec3) -> Vec<f32> {
        let pushes = Vec3::AXES.map(|axis| self.push(node, point, axis));
        let [x, y, z] = &pushes;
        let each = x.iter().zip(y).zip(z);
        each.map(|((x, y), z)| Vec3::new(*x, *y, *z).length())
            .collect()
    }
}

/// The triangles of a closed mesh.
fn elements(mesh: &RecordedMesh) -> Vec<SurfaceElement> {
    let triangles = mesh
        .parts
        .iter()
        .flat_map(|part| part.indices.chunks_exact(3));
    let element = |corners: &[u32]| {
        let corner = |k: usize| place(mesh.positions[corners[k] as usize]);
        let [a, b, c] = [0, 1, 2].map(corner);
        SurfaceElement {
            place: (a + b + c) / 3.0,
            area: 0.5 * (b - a).cross(c - a),
        }
    };
    triangles.map(element).collect()
}

/// A point of one node in the frame of another, m, by their poses.
pub(super) fn carried(point: Vec3, from: &Pose, to: &Pose) -> Vec3 {
    let unit = |q: Quat| {
        if q.length() > 0.0 {
            q.normalize()
        } else {
            Quat::IDENTITY
        }
    };
    let world = unit(from.rotation) * point + from.translation;
    unit(to.rotation).inverse() * (world - to.translation)
}
