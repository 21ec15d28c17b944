//! The objects of a scene as bodies of a synthesiser.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::Arc;

use frangible::Asset;
use frangible_recording::Pose;
use glam::{Quat, Vec3};

use super::cast::{Cast, Sounding};
use super::place;
use crate::body::SoundBody;
use crate::damping::{AudibleDamping, Hold};
use crate::error::SoundError;
use crate::of_asset::AssetSound;
use crate::plate::{Plate, PlateMaterial};
use crate::sphere::SurfaceElement;
use crate::synth::Synth;

/// The shape of a node, from which a push on its modes is computed.
enum Shape {
    Asset(Arc<AssetSound>),
    Plate(Plate),
    /// No modes.
    Ball,
}

/// A node that sounds.
struct Ready {
    /// Number of the body in the synthesiser.
    id: usize,
    shape: Shape,
    body: Arc<SoundBody>,
}

/// Nodes are made ready when they are first struck.
#[derive(Default)]
pub(super) struct Nodes {
    ready: BTreeMap<usize, Ready>,
    /// Bodies of one asset sound alike.
    assets: Vec<(Arc<Asset>, Arc<AssetSound>, Arc<SoundBody>)>,
}

impl Nodes {
    /// A node's number in the synthesiser and its body, moved to where it is at a time.
    pub(super) fn ready(
        &mut self,
        synth: &mut Synth,
        cast: &dyn Cast,
        node: usize,
        time: f64,
    ) -> Result<(usize, Arc<SoundBody>), SoundError> {
        let pose = cast.pose(node, time);
        let (at, turned) = (place(pose.translation), pose.rotation.as_dquat());
        if let Some(ready) = self.ready.get(&node) {
            synth.put(time, ready.id, at, turned)?;
            return Ok((ready.id, Arc::clone(&ready.body)));
        }
        let (shape, body) = self.make(cast, node)?;
        let id = synth.add(Arc::clone(&body), at, turned)?;
        let ready = Ready {
            id,
            shape,
            body: Arc::clone(&body),
        };
        self.ready.insert(node, ready);
        Ok((id, body))
    }

    /// Makes what bodies of one asset share, lest the first blow on one of them waits.
    pub(super) fn prepare(&mut self, cast: &dyn Cast, node: usize) -> Result<(), SoundError> {
        self.make(cast, node).map(drop)
    }

    /// Forgets a thing that is gone, and returns its number in the synthesiser.
    pub(super) fn forget(&mut self, node: usize) -> Option<usize> {
        let gone = self.ready.remove(&node)?;
        let id = gone.id;
        drop(gone);
        // An asset that only this list and its own sound know of belongs to a piece that is gone.
        let used = |asset: &Arc<Asset>, sound: &Arc<AssetSound>| {
            Arc::strong_count(sound) > 1 || Arc::strong_count(asset) > 2
        };
        self.assets.retain(|(asset, sound, _)| used(asset, sound));
        Some(id)
    }

    /// The number of a thing in the synthesiser, if it is ready.
    pub(super) fn id(&self, node: usize) -> Option<usize> {
        self.ready.get(&node).map(|ready| ready.id)
    }

    fn make(
        &mut self,
        cast: &dyn Cast,
        node: usize,
    ) -> Result<(Shape, Arc<SoundBody>), SoundError> {
        let name = cast.name(node);
        match cast.sounding(node) {
            Sounding::Ball(_, radius, mass) => Ok((
                Shape::Ball,
                Arc::new(SoundBody::ball(name, *radius, *mass)?),
            )),
            Sounding::Dice(material, ..) => {
                let mass = cast.sounding(node).grain_mass();
                let radius = (3.0 * mass / (4.0 * PI * material.density)).cbrt();
                Ok((Shape::Ball, Arc::new(SoundBody::ball(name, radius, mass)?)))
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
                let damping = AudibleDamping::of(asset.material());
                let (sound, heard) = AssetSound::new(body, &damping, hold)?;
                let (sound, heard) = (Arc::new(sound), Arc::new(heard));
                let entry = (Arc::clone(asset), Arc::clone(&sound), Arc::clone(&heard));
                self.assets.push(entry);
                Ok((Shape::Asset(sound), heard))
            }
            Sounding::Piece(material, mass) => {
                let plate = PlateMaterial {
                    youngs_modulus: material.youngs_modulus,
                    poisson_ratio: material.poisson_ratio,
                    density: material.density,
                    damping: AudibleDamping::of(material),
                };
                let (shape, body) = Plate::of_surface(name, &elements(cast, node), *mass, &plate)?;
                Ok((Shape::Plate(shape), Arc::new(body)))
            }
        }
    }

    /// Force on each mode of a node that is ready, of one newton along a direction at a point of it, m.
    pub(super) fn push(&self, node: usize, point: Vec3, direction: Vec3) -> Vec<f32> {
        match self.ready.get(&node).map(|ready| &ready.shape) {
            Some(Shape::Asset(asset)) => asset.push(point, direction),
            Some(Shape::Plate(plate)) => plate.push(point, direction),
            Some(Shape::Ball) | None => Vec::new(),
        }
    }

    /// Motion of a body at a point of it, m, as the sum of its modes with these weights; zero without modes of its own.
    pub(super) fn motion(&self, node: usize, point: Vec3, weights: &[f32]) -> Vec3 {
        match self.ready.get(&node).map(|ready| &ready.shape) {
            Some(Shape::Asset(asset)) => asset.motion(point, weights),
            Some(Shape::Plate(_) | Shape::Ball) | None => Vec3::ZERO,
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

/// The closed surface of a thing.
fn elements(cast: &dyn Cast, node: usize) -> Vec<SurfaceElement> {
    let vertices = cast.vertices(node);
    let element = |corners: [u32; 3]| {
        let [a, b, c] = corners.map(|corner| place(vertices[corner as usize]));
        SurfaceElement {
            place: (a + b + c) / 3.0,
            area: 0.5 * (b - a).cross(c - a),
        }
    };
    cast.triangles(node).into_iter().map(element).collect()
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
