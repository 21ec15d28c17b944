//! The first breaking impact of a scene.

use std::collections::BTreeMap;

use frangible::glam::{DVec3, Quat, Vec3};
use frangible::{Body, Contact, FractureConfig, Fragment};
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::{BreakCause, BreakEvent};
use frangible_recording::{
    Image, MeshPart, Pose, RecordedMesh, RecordedNode, Recording, SurfaceMaterial, View,
};

use crate::bake::BakedBody;
use crate::cameras::view;
use crate::error::SceneError;
use crate::meshes::{BodySurfaces, piece, whole};
use crate::recorder::FRAME_RATE;
use crate::run::{resist_rolling, steps_of_frame};
use crate::scene::Scene;
use crate::stage::{Stage, set_up};

/// The first impact of a scene that breaks one of its bodies.
#[derive(Clone, Debug)]
pub struct FirstBreak {
    /// The body's name.
    pub name: String,
    /// The body just before the impact, with any cracks it already had.
    pub body: Body,
    /// Contacts of the impact, in the body frame.
    pub contacts: Vec<Contact>,
    /// Settings of the fracture model.
    pub config: FractureConfig,
    /// Simulated time, s.
    pub time: f64,
    pub(crate) rotation: Quat,
    look: BodySurfaces,
    surfaces: Vec<SurfaceMaterial>,
    images: Vec<Image>,
    look_from: Vec3,
}

/// Runs the scene with its baked bodies until an impact breaks one of them; `progress` receives the elapsed fraction of the
/// maximum duration.
/// Returns `None` if nothing breaks.
///
/// # Errors
/// The errors of [`play`](crate::play()).
pub fn first_break(
    scene: &Scene,
    baked: &[BakedBody],
    progress: &mut dyn FnMut(f64),
) -> Result<Option<FirstBreak>, SceneError> {
    scene.validate()?;
    let mut stage = set_up(scene, baked)?;
    let mut known: BTreeMap<(u32, u32), Body> = BTreeMap::new();
    let handles: Vec<RigidBodyHandle> = stage.bodies.iter().map(|b| b.handle).collect();
    for &handle in &handles {
        note(&stage, handle, &mut known);
    }
    let mut time = 0.0;
    let frames = (scene.duration * f64::from(FRAME_RATE)).ceil() as usize;
    for frame in 0..frames {
        stage.throw(scene, time)?;
        let steps = steps_of_frame(&mut stage, scene, false);
        let dt = 1.0 / (FRAME_RATE * steps as f32);
        stage.world.physics.integration_parameters.dt = dt;
        for _ in 0..steps {
            time += f64::from(dt);
            stage.world.step()?;
            let broke = stage.world.breaks().iter().find_map(|event| {
                let of_impact = event.cause == BreakCause::Impact && !event.contacts.is_empty();
                let number = handles.iter().position(|h| *h == event.parent);
                number
                    .filter(|_| of_impact)
                    .map(|number| (event.clone(), number))
            });
            if let Some((event, number)) = broke {
                let body = known.remove(&event.parent.into_raw_parts());
                return Ok(body.map(|body| found(scene, stage, number, &event, body, time)));
            }
            let cracked = stage
                .world
                .held()
                .iter()
                .filter(|held| held.state.is_some());
            let cracked: Vec<RigidBodyHandle> = cracked.map(|held| held.body).collect();
            for handle in cracked {
                note(&stage, handle, &mut known);
            }
        }
        resist_rolling(&mut stage.world);
        progress((frame + 1) as f64 / frames as f64);
    }
    Ok(None)
}

/// Remembers a body as it is before the next step.
fn note(stage: &Stage<'_>, handle: RigidBodyHandle, known: &mut BTreeMap<(u32, u32), Body>) {
    if let Some(body) = stage.world.breakable(handle) {
        known.insert(handle.into_raw_parts(), body.clone());
    }
}

fn found(
    scene: &Scene,
    stage: Stage<'_>,
    number: usize,
    event: &BreakEvent,
    body: Body,
    time: f64,
) -> FirstBreak {
    let placed = &stage.bodies[number];
    let recording = stage.recorder.into_parts().0;
    FirstBreak {
        name: placed.spec.name.clone(),
        body,
        contacts: event.contacts.clone(),
        config: stage.world.config().fracture.clone(),
        time,
        rotation: Quat::from_array(event.pose.rotation.to_array()),
        look: placed.surfaces.clone(),
        surfaces: recording.surfaces,
        images: recording.images,
        look_from: scene.look_from,
    }
}

impl FirstBreak {
    /// Makes a still of each set of pieces in an exploded view, or of the whole body for an empty set.
    ///
    /// The body has the pose it had at the impact, and each piece is moved away from the body's centre by `apart` times its
    /// distance from it. All stills share one camera, so that they can be shown side by side.
    #[must_use]
    pub fn stills(&self, sets: &[&[Fragment]], apart: f32) -> Vec<Recording> {
        let mut stills: Vec<Recording> = sets.iter().map(|set| self.still(set, apart)).collect();
        let arrow = self.still_of_impact(&Recording::default());
        let mut seen: Vec<Vec3> = stills.iter().chain([&arrow]).flat_map(points).collect();
        // Room for a heading.
        let top = seen.iter().copied().max_by(|a, b| a.y.total_cmp(&b.y));
        let low = seen.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
        seen.extend(top.map(|top| top + Vec3::Y * 0.15 * (top.y - low)));
        let camera: View = view(&seen, f32::MIN, self.look_from, 0.0);
        stills.iter_mut().for_each(|still| still.camera = camera);
        stills
    }

    /// Makes a still of the whole body with an arrow along the impulse, its tip at the point of impact, seen with the camera of `like`.
    #[must_use]
    pub fn still_of_impact(&self, like: &Recording) -> Recording {
        let mut still = self.still(&[], 0.0);
        still.camera = like.camera;
        let (mut point, mut impulse, mut weight) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for contact in &self.contacts {
            point += contact.point * contact.impulse;
            impulse += contact.whole_impulse();
            weight += contact.impulse;
        }
        let positions = self.body.asset().fracture().positions.iter();
        let reach = positions.map(|p| p.length()).fold(0.0, f32::max);
        let surface = still.surfaces.len();
        still.surfaces.push(SurfaceMaterial {
            name: "impulse".into(),
            base_color: [0.8, 0.04, 0.02, 1.0],
            ..SurfaceMaterial::default()
        });
        let mesh = arrow(impulse.normalize_or(Vec3::NEG_Y), 0.45 * reach, surface);
        self.put(&mut still, mesh, point / weight);
        still
    }

    fn still(&self, pieces: &[Fragment], apart: f32) -> Recording {
        let mut still = Recording {
            name: self.name.clone(),
            frame_rate: FRAME_RATE,
            frame_count: 1,
            surfaces: self.surfaces.clone(),
            images: self.images.clone(),
            ..Recording::default()
        };
        if pieces.is_empty() {
            let mesh = whole(&self.name, self.body.asset(), &self.look);
            self.put(&mut still, mesh, Vec3::ZERO);
        }
        for (i, fragment) in pieces.iter().enumerate() {
            let name = format!("{} piece {}", self.name, i + 1);
            let mesh = piece(&name, fragment, DVec3::ZERO, &self.look).mesh;
            self.put(
                &mut still,
                mesh,
                (1.0 + apart) * fragment.mass.centre.as_vec3(),
            );
        }
        still
    }

    fn put(&self, still: &mut Recording, mesh: RecordedMesh, at: Vec3) {
        let pose = Pose {
            translation: self.rotation * at,
            rotation: self.rotation,
        };
        still.nodes.push(RecordedNode {
            name: mesh.name.clone(),
            mesh: still.meshes.len(),
            poses: vec![pose],
            visible: 0..1,
            ..RecordedNode::default()
        });
        still.meshes.push(mesh);
    }
}

/// All vertices of a still, m.
fn points(still: &Recording) -> Vec<Vec3> {
    let nodes = still.nodes.iter().zip(&still.meshes);
    let placed = nodes.flat_map(|(node, mesh)| {
        let pose = node.poses[0];
        let place = move |p: &Vec3| pose.rotation * *p + pose.translation;
        mesh.positions.iter().map(place)
    });
    placed.collect()
}

/// An arrow of this length, m, its tip at the origin.
fn arrow(direction: Vec3, length: f32, surface: usize) -> RecordedMesh {
    const SIDES: u32 = 24;
    let across = direction.any_orthonormal_vector();
    let other = direction.cross(across);
    let mut mesh = RecordedMesh {
        name: "impulse".into(),
        ..RecordedMesh::default()
    };
    // Distance behind the tip and radius of the ends of each part, in lengths: head, its back, shaft, its end.
    let parts = [
        [[0.0, 0.0], [0.35, 0.13]],
        [[0.35, 0.13], [0.35, 0.05]],
        [[0.35, 0.05], [1.0, 0.05]],
        [[1.0, 0.05], [1.0, 0.0]],
    ];
    let mut indices = Vec::new();
    for [front, back] in parts {
        let slope = Vec3::new(back[0] - front[0], back[1] - front[1], 0.0);
        for i in 0..=SIDES {
            let (sine, cosine) = (std::f32::consts::TAU * i as f32 / SIDES as f32).sin_cos();
            let out = across * cosine + other * sine;
            let normal = out * slope.x + direction * slope.y;
            for [behind, radius] in [front, back] {
                let place = out * radius - direction * behind;
                mesh.positions.push(place * length);
                mesh.normals.push(normal.normalize_or(direction));
            }
            if i < SIDES {
                let at = mesh.positions.len() as u32 - 2;
                indices.extend([at, at + 2, at + 1, at + 1, at + 2, at + 3]);
            }
        }
    }
    mesh.parts.push(MeshPart { surface, indices });
    mesh
}
