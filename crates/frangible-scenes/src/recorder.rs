//! Turns a running world into a [`Recording`].

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use frangible::glam::{Quat, Vec3};
use frangible::internals::BodyState;
use frangible::{Asset, ImpactReport};
use frangible_rapier::BreakEvent;
use frangible_rapier::BreakableWorld;
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_recording::{
    Floor, Image, Moments, Pose, RecordedMesh, RecordedNode, Recording, SurfaceMaterial,
};
use frangible_sound::{Sounding, recorded_blow};

use crate::cameras::cameras;
use crate::cracks::with_cracks;
use crate::marks::Marks;
use crate::meshes::{BodySurfaces, DrawnPiece, origin, piece};
use crate::output::{Simplified, WANTED_OF_DRAWN};
use crate::touching::WorldTouching;

/// Frames per second of a recording.
pub(crate) const FRAME_RATE: f32 = 60.0;

/// A node that follows a rigid body.
struct Tracked {
    node: usize,
    body: RigidBodyHandle,
    /// Mesh of the body without the cracks that part nothing and came later.
    plain: usize,
    /// True once another node follows the body.
    replaced: bool,
}

/// Role of a node for the camera.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Role {
    /// A breakable body.
    Body,
    /// A piece of one.
    Piece,
    /// A projectile: it may leave the picture.
    Projectile,
}

/// Collects poses frame by frame.
pub(crate) struct Recorder {
    recording: Recording,
    /// One per node.
    roles: Vec<Role>,
    soundings: Vec<Sounding>,
    tracked: Vec<Tracked>,
    /// The node of each rigid body.
    node_of_body: BTreeMap<(u32, u32), usize>,
    /// Marks of the cracks of each rigid body, and the place of its frame in theirs, m.
    marks: BTreeMap<(u32, u32), (Arc<Marks>, Vec3)>,
    touching: WorldTouching,
    break_frame: Option<usize>,
    /// Frame in which cracks first ran that parted nothing.
    crack_frame: Option<usize>,
    /// Triangles and error of the light drawing so far.
    pub(crate) simplified: Simplified,
}

impl Recorder {
    pub(crate) fn new(name: &str) -> Self {
        let recording = Recording {
            name: name.into(),
            frame_rate: FRAME_RATE,
            ..Recording::default()
        };
        Self {
            recording,
            roles: Vec::new(),
            soundings: Vec::new(),
            tracked: Vec::new(),
            node_of_body: BTreeMap::new(),
            marks: BTreeMap::new(),
            touching: WorldTouching::default(),
            break_frame: None,
            crack_frame: None,
            simplified: Simplified::default(),
        }
    }

    /// Numbers of these surfaces in the recording; equal ones are kept once.
    pub(crate) fn surfaces<const N: usize>(&mut self, looks: [SurfaceMaterial; N]) -> [usize; N] {
        looks.map(|look| self.surface(look))
    }

    /// Returns the recording so far, as plain data, and for each node its rigid body, its role for the camera and its sound source.
    pub(crate) fn into_parts(self) -> (Recording, Vec<RigidBodyHandle>, Vec<Role>, Vec<Sounding>) {
        let bodies = self.tracked.iter().map(|tracked| tracked.body).collect();
        (self.recording, bodies, self.roles, self.soundings)
    }

    /// Number of a surface in the recording.
    pub(crate) fn surface(&mut self, look: SurfaceMaterial) -> usize {
        let known = &mut self.recording.surfaces;
        known.iter().position(|k| *k == look).unwrap_or_else(|| {
            known.push(look);
            known.len() - 1
        })
    }

    /// Number of an image in the recording; equal ones are kept once.
    pub(crate) fn image(&mut self, image: &Image) -> u32 {
        let known = &mut self.recording.images;
        let number = known.iter().position(|k| k == image).unwrap_or_else(|| {
            known.push(image.clone());
            known.len() - 1
        });
        number as u32
    }

    /// A thing to follow from the next frame on.
    pub(crate) fn track(
        &mut self,
        name: String,
        mesh: RecordedMesh,
        body: RigidBodyHandle,
        extras: Vec<(String, f64)>,
        role: Role,
        sounding: Sounding,
    ) {
        self.roles.push(role);
        self.soundings.push(sounding);
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
        let node = recording.nodes.len() - 1;
        self.tracked.push(Tracked {
            node,
            body,
            plain: recording.nodes[node].mesh,
            replaced: false,
        });
        self.node_of_body.insert(body.into_raw_parts(), node);
    }

    /// Puts the pieces in the place of their parent, which has this name and generation, `time` s after the first frame.
    pub(crate) fn broke(
        &mut self,
        world: &BreakableWorld,
        name: &str,
        generation: u32,
        event: &BreakEvent,
        surfaces: &BodySurfaces,
        time: f64,
    ) {
        self.break_frame.get_or_insert(self.recording.frame_count);
        let first = self.recording.nodes.len();
        let marks = self.marked(event.parent, &event.asset, &event.fracture.report);
        if generation == 0 && surfaces.light.is_some() {
            let drawn = event.asset.render();
            self.simplified.wanted += WANTED_OF_DRAWN * drawn.map_or(0, |r| r.triangles.len());
        }
        for (i, (fragment, &body)) in event
            .fracture
            .fragments
            .iter()
            .zip(&event.fragments)
            .enumerate()
        {
            let name = piece_name(name, generation, i);
            let DrawnPiece {
                mut mesh,
                simplified,
            } = piece(&name, fragment, origin(&event.asset), surfaces);
            self.simplified.add(&simplified);
            let centre = fragment.mass.centre.as_vec3();
            marks.lay_on(&mut mesh, centre, surfaces);
            if !marks.is_empty() {
                let known = (Arc::clone(&marks), centre);
                self.marks.insert(body.into_raw_parts(), known);
            }
            let extras = vec![
                ("mass_kg".into(), fragment.mass.mass),
                ("volume_m3".into(), fragment.mass.volume),
            ];
            let sounding = piece_sounding(world, event, i);
            self.track(name, mesh, body, extras, Role::Piece, sounding);
        }
        let pieces = first..self.recording.nodes.len();
        self.blow(
            event.parent,
            &event.asset,
            &event.fracture.report,
            time,
            pieces,
        );
    }

    /// The marks of all cracks of a body after an impact.
    fn marked(&self, body: RigidBodyHandle, asset: &Asset, report: &ImpactReport) -> Arc<Marks> {
        let before = self.marks.get(&body.into_raw_parts());
        let before = before.map(|(marks, centre)| (&**marks, -*centre));
        Arc::new(Marks::of(report, asset, before))
    }

    /// Takes in a blow on a body that was tracked when it came, `time` s after the first frame, with the nodes of its pieces.
    pub(crate) fn blow(
        &mut self,
        body: RigidBodyHandle,
        asset: &Asset,
        report: &ImpactReport,
        time: f64,
        pieces: Range<usize>,
    ) {
        let Some(&node) = self.node_of_body.get(&body.into_raw_parts()) else {
            return;
        };
        let blow = recorded_blow(node, asset, report, time, pieces);
        self.recording.blows.push(blow);
    }

    /// Shows the cracks that a body got without coming apart, from the next frame on: another node takes the place of its own.
    pub(crate) fn cracked(
        &mut self,
        body: RigidBodyHandle,
        asset: &Asset,
        (state, report): (&BodyState, &ImpactReport),
        surfaces: &BodySurfaces,
    ) {
        let Some(&node) = self.node_of_body.get(&body.into_raw_parts()) else {
            return;
        };
        let recording = &self.recording;
        let plain = self.tracked[node].plain;
        let Some(mut mesh) = with_cracks(&recording.meshes[plain], asset, state, surfaces) else {
            return;
        };
        let marks = self.marked(body, asset, report);
        marks.lay_on(&mut mesh, Vec3::ZERO, surfaces);
        self.marks
            .insert(body.into_raw_parts(), (marks, Vec3::ZERO));
        let recording = &self.recording;
        self.crack_frame.get_or_insert(recording.frame_count);
        let RecordedNode {
            name, keep_extras, ..
        } = recording.nodes[node].clone();
        self.tracked[node].replaced = true;
        let sounding = self.soundings[node].clone();
        self.track(name, mesh, body, keep_extras, self.roles[node], sounding);
        if let Some(tracked) = self.tracked.last_mut() {
            tracked.plain = plain;
        }
    }

    /// Takes in what came together or slid in the step that ended `time` s after the first frame.
    pub(crate) fn touches(&mut self, world: &BreakableWorld, time: f64) {
        let known = &self.node_of_body;
        let node = |body: RigidBodyHandle| known.get(&body.into_raw_parts()).copied();
        let (touches, slides) = self.touching.step(world, &node, time);
        self.recording.touches.extend(touches);
        self.recording.slides.extend(slides);
    }

    /// Writes down where everything is now.
    pub(crate) fn frame(&mut self, world: &BreakableWorld) {
        let recording = &mut self.recording;
        for tracked in self.tracked.iter().filter(|tracked| !tracked.replaced) {
            let node = &mut recording.nodes[tracked.node];
            let Some(body) = world.physics.bodies.get(tracked.body) else {
                continue;
            };
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

    /// The finished recording, its views set so that what matters fills the picture, and what each node is to the ear; `at_rest`: whether
    /// nothing moves in the end.
    pub(crate) fn finish(
        mut self,
        look_from: Vec3,
        floor: Option<Floor>,
        at_rest: bool,
    ) -> (Recording, Vec<Sounding>) {
        let recording = &mut self.recording;
        recording.floor = floor;
        let last = recording.frame_count.saturating_sub(1);
        for node in &mut recording.nodes {
            let pose = node.poses.last().copied().unwrap_or_default();
            node.poses.resize(recording.frame_count, pose);
        }
        let first_crack = self
            .break_frame
            .or(self.crack_frame)
            .unwrap_or(last)
            .min(last);
        // A frame before contact the body is near the floor; five after it the pieces are on their way.
        recording.moments = Moments {
            before: first_crack.saturating_sub(1),
            first_crack,
            just_after: (first_crack + 5).min(last),
            at_rest: last,
            moves_on: !at_rest,
        };
        let (camera, views) = cameras(recording, &self.roles, look_from);
        (recording.camera, recording.views) = (camera, Some(views));
        (self.recording, self.soundings)
    }
}

/// A piece of a break as a sound source: by its own modes where it can break again, by its dice where it is a clump of them.
pub(crate) fn piece_sounding(world: &BreakableWorld, event: &BreakEvent, piece: usize) -> Sounding {
    let (fracture, material) = (&event.fracture, event.asset.material().clone());
    let mass = fracture.fragments[piece].mass.mass;
    if let Some(clump) = fracture.clump(piece) {
        return Sounding::Dice(material, mass, Arc::clone(clump));
    }
    world.breakable(event.fragments[piece]).map_or_else(
        || Sounding::Piece(material, mass),
        |body| Sounding::Modes(body.clone()),
    )
}

/// Name of a piece of a parent of this name and generation: `plate piece 3`, and of that `plate piece 3.1`.
pub(crate) fn piece_name(parent: &str, generation: u32, i: usize) -> String {
    match generation {
        0 => format!("{parent} piece {}", i + 1),
        _ => format!("{parent}.{}", i + 1),
    }
}
