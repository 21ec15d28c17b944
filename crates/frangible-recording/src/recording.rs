//! Recording of a scene, as plain data.
//!
//! Pictures, sound and files are made from this description, without the physics.

use std::ops::Range;

use frangible_geometry::{Blending, Image, Texture};
use glam::{Quat, Vec3};

/// Recording of a scene's motion and breaks, from which pictures, films and sound are made.
///
/// | contents | field | of | time |
/// |---|---|---|---|
/// | poses | [`RecordedNode::poses`] | each body, piece and striker | in each frame, [`Recording::frame_rate`] per second |
/// | which pieces took whose place | [`RecordedBlow::pieces`], [`RecordedNode::visible`] | each body that broke | at its break |
/// | forces F(t) of blows | [`RecordedBlow::pulses`] | each impact that was asked for cracks, whether or not the body broke | in each time step of the blow, some microseconds |
/// | cracks | [`RecordedBlow::cracks`] | each crack and each part that an old one grew by | when it was at each place, from the beginning of the blow |
/// | energy of cracks | [`RecordedBlow::fracture_energy`] | all cracks of a blow | as a sum |
/// | contacts that slide or roll | [`RecordedSlide`] | each pair, or a thing and the floor, at its deepest point | 240 times per second: force, speed and power, no F(t) |
/// | contacts of pieces | [`RecordedTouch`] | each pair, or a thing and the floor, at its deepest point | in the step in which they came together: an impulse, no F(t) |
///
/// Left out are touches that change the speed of the lighter body by less than 2 cm/s, slides that lose less than 0.1 mW, velocities, and contacts at
/// rest. An impact that a bound has refused unseen has no blow: it is a touch. Where F(t) is missing, sound takes the duration of Hertz's law. Modes
/// and materials belong to the bodies: the maker of a recording hands them on beside it (`frangible_scenes::Sounding`).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// Name of the file and of its scene.
    pub name: String,
    /// Frames per second of the poses, 1/s. Above zero.
    pub frame_rate: f32,
    /// Number of frames, at least one.
    pub frame_count: usize,
    /// The materials that mesh parts refer to by index.
    pub surfaces: Vec<SurfaceMaterial>,
    /// The images of their textures.
    pub images: Vec<Image>,
    /// The shapes that nodes refer to by index.
    pub meshes: Vec<RecordedMesh>,
    /// The rigid objects of the scene.
    pub nodes: Vec<RecordedNode>,
    /// A level floor, if the scene has one.
    pub floor: Option<Floor>,
    /// The camera.
    pub camera: View,
    /// Separate views for the [four moments](Recording::labelled_moments), in their order.
    pub views: Option<[View; 4]>,
    /// The key frames for pictures.
    pub moments: Moments,
    /// Blows that were tested for fracture, in the order of time.
    pub blows: Vec<RecordedBlow>,
    /// Other contacts of pieces, in the order of time.
    pub touches: Vec<RecordedTouch>,
    /// Sliding contacts, in the order of time.
    pub slides: Vec<RecordedSlide>,
}

/// A blow on a node, with its forces and cracks, for films and sound.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordedBlow {
    /// The node that was hit.
    pub node: usize,
    /// Start time of the blow, s after the first frame.
    pub time: f64,
    /// The nodes of its pieces; empty if it held.
    pub pieces: Range<usize>,
    /// The force history of each contact.
    pub pulses: Vec<RecordedPulse>,
    /// The new cracks, and extensions of old cracks.
    pub cracks: Vec<RecordedCrack>,
    /// Energy spent on the cracks, J.
    pub fracture_energy: f64,
}

/// Force history at a point of a node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordedPulse {
    /// Point of application, m, in the frame of the node.
    pub point: Vec3,
    /// Unit direction of the force on the node, in its frame.
    pub direction: Vec3,
    /// Time between two values, s.
    pub time_step: f64,
    /// The force at the end of each time step, N; zero before the first.
    pub force: Vec<f32>,
}

impl RecordedPulse {
    /// The impulse of the force, which is linear between its values, N·s.
    #[must_use]
    pub fn impulse(&self) -> f64 {
        let last = self.force.last().copied().unwrap_or(0.0);
        let sum: f64 = self.force.iter().map(|&force| f64::from(force)).sum();
        self.time_step * (sum - 0.5 * f64::from(last))
    }
}

/// Path and times of a crack.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordedCrack {
    /// Points of the crack in the order of growth, m, in the frame of the node.
    pub places: Vec<Vec3>,
    /// Time at which the crack reached each point, s after the start of the blow.
    pub times: Vec<f64>,
}

/// A collision of two objects, or of an object with a fixed one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RecordedTouch {
    /// Time, s after the first frame.
    pub time: f64,
    /// The node, and the other node; `None` for the floor.
    pub nodes: (usize, Option<usize>),
    /// Point of contact, m.
    pub point: Vec3,
    /// Unit direction of the push on the first node.
    pub normal: Vec3,
    /// Impulse along the normal, N·s. Part of it may come from objects on top.
    pub impulse: f64,
    /// Approach speed along the normal, m/s.
    pub speed: f64,
}

/// Sliding or rolling contact of two objects, or of an object with a fixed one, during a short interval.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RecordedSlide {
    /// Start time, s after the first frame.
    pub time: f64,
    /// Duration of the interval, during which speed and power are taken as constant, s.
    pub duration: f64,
    /// The node, and the other node; `None` for the floor.
    pub nodes: (usize, Option<usize>),
    /// Point of contact, m.
    pub point: Vec3,
    /// Unit direction of the push on the first node, across the surfaces.
    pub normal: Vec3,
    /// Sliding speed, or for rolling the speed at which the contact moves over both surfaces, m/s.
    pub speed: f64,
    /// Power dissipated by friction or rolling resistance, W.
    pub power: f64,
}

/// Appearance of a surface (metallic–roughness, as in glTF).
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceMaterial {
    /// Name in viewers.
    pub name: String,
    /// Linear red, green, blue, and opacity (1: opaque), each 0–1.
    pub base_color: [f32; 4],
    /// 0: dielectric (ceramic, glass), 1: metal.
    pub metallic: f32,
    /// 0: mirror, 1: chalk.
    pub roughness: f32,
    /// The fraction of light that passes through, 0–1; 0 for anything opaque.
    pub transmission: f32,
    /// Index of refraction, at least 1; 1.5 for glass and most dielectrics.
    pub ior: f32,
    /// If true, back faces are drawn too.
    pub double_sided: bool,
    /// Colour of white light after the [`attenuation_distance`](Self::attenuation_distance) in the body behind the surface: linear red, green and
    /// blue, each above 0 and at most 1.
    pub attenuation_color: [f32; 3],
    /// Distance in the body at which light has that colour, m; infinite without absorption.
    pub attenuation_distance: f32,
    /// True if the body continues behind the surface: an air-filled crack inside the body.
    pub thin: bool,
    /// Fine detail of the surface.
    pub grain: Grain,
    /// Light that it emits: linear red, green and blue, 0 or more.
    pub emission: [f32; 3],
    /// Meaning of the opacity of its base colour, its textures and its vertices.
    pub blending: Blending,
    /// Textures, as the author of a mesh gave them. The pictures and films of this project do not show them.
    pub textures: Vec<Texture>,
    /// True for cracks that end inside a body: faces without thickness, and lines along their border, which separate nothing. A body is closed
    /// without them.
    pub ends_inside: bool,
}

/// Fine detail of a surface, for renderers that support it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Grain {
    /// One colour, smooth.
    #[default]
    Even,
    /// Specks and pores of fired clay.
    Clay,
    /// Stones in mortar.
    Aggregate,
    /// Veins, as of marble.
    Veined,
    /// Clouds inside a clear body, as of ice and sugar.
    Cloudy,
    /// The fine roughness of a fresh face: small bumps at any angle.
    Broken,
    /// A crack face of glass: mirror, mist and hackle as its [marks](RecordedMesh::marks) say, and as [`Grain::Broken`] where it has none.
    Marked,
}

impl Default for SurfaceMaterial {
    fn default() -> Self {
        Self {
            name: String::from("surface"),
            base_color: [0.8, 0.8, 0.8, 1.0],
            metallic: 0.0,
            roughness: 0.5,
            transmission: 0.0,
            ior: 1.5,
            double_sided: false,
            attenuation_color: [1.0; 3],
            attenuation_distance: f32::INFINITY,
            thin: false,
            grain: Grain::Even,
            emission: [0.0; 3],
            blending: Blending::Auto,
            textures: Vec::new(),
            ends_inside: false,
        }
    }
}

/// A triangle mesh, already split at hard edges: one normal per vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordedMesh {
    /// Name in viewers.
    pub name: String,
    /// Vertices in the frame of the node, m.
    pub positions: Vec<Vec3>,
    /// Unit normals, one per position.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, v downwards as in glTF: none, or one pair per position.
    pub uvs: Vec<[f32; 2]>,
    /// Further sets of texture coordinates, each with one pair per position.
    pub more_uvs: Vec<Vec<[f32; 2]>>,
    /// Linear colours (red, green, blue and opacity), which multiply those of the surfaces: none, or one per position.
    pub colors: Vec<[f32; 4]>,
    /// Marks of cracks, for surfaces with [`Grain::Marked`]: none, or one row per position. The way that the crack has come in a straight line, m, in the
    /// frame of the node, and one over the distance at which its mirror ends, 1/m; zeros where nothing is known.
    pub marks: Vec<[f32; 4]>,
    /// The triangles, grouped by material.
    pub parts: Vec<MeshPart>,
}

/// The triangles of a mesh that share a material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshPart {
    /// Index into [`Recording::surfaces`].
    pub surface: usize,
    /// Three vertex indices per triangle, counter-clockwise from outside.
    pub indices: Vec<u32>,
}

/// A rigid object: a mesh, its pose in each frame, and the frames in which it exists.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordedNode {
    /// Name in viewers.
    pub name: String,
    /// Index into [`Recording::meshes`].
    pub mesh: usize,
    /// One pose per frame, or exactly one for a node that never moves.
    pub poses: Vec<Pose>,
    /// The frames in which it is visible; a piece appears when its parent breaks.
    pub visible: Range<usize>,
    /// Extra numbers stored with the node in the file, such as `mass_kg` or `volume_m3`.
    pub keep_extras: Vec<(String, f64)>,
}

/// A rigid placement: rotate, then translate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Position of the mesh's origin, m.
    pub translation: Vec3,
    /// Its orientation; need not be exactly unit length.
    pub rotation: Quat,
}

/// A level floor that catches shadows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    /// Its y coordinate, m.
    pub height: f32,
    /// Linear red, green and blue, each 0–1.
    pub base_color: [f32; 3],
}

impl Default for Floor {
    fn default() -> Self {
        Self {
            height: 0.0,
            base_color: [0.38, 0.38, 0.38],
        }
    }
}

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Position of the camera, m.
    pub eye: Vec3,
    /// Target of the view, m.
    pub target: Vec3,
    /// Up direction in the picture.
    pub up: Vec3,
    /// Vertical field of view, rad; between 0 and π.
    pub vertical_fov: f32,
}

impl Default for View {
    fn default() -> Self {
        Self {
            eye: Vec3::new(1.2, 0.9, 1.6),
            target: Vec3::ZERO,
            up: Vec3::Y,
            vertical_fov: 0.6,
        }
    }
}

/// Frame indices of the four moments of a break.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Moments {
    /// Whole, before contact.
    pub before: usize,
    /// The first frame with a crack.
    pub first_crack: usize,
    /// Pieces in flight.
    pub just_after: usize,
    /// The end of the recording.
    pub at_rest: usize,
    /// True if objects still move at the end.
    pub moves_on: bool,
}

impl Recording {
    /// The pose of a node in a frame; the last known one beyond the end.
    #[must_use]
    pub fn pose(&self, node: usize, frame: usize) -> Pose {
        let poses = self.nodes.get(node).map_or(&[][..], |node| &node.poses);
        poses
            .get(frame)
            .or(poses.last())
            .copied()
            .unwrap_or_default()
    }

    /// The four moments with the words that label them.
    #[must_use]
    pub fn labelled_moments(&self) -> [(usize, &'static str); 4] {
        [
            (self.moments.before, "before"),
            (self.moments.first_crack, "first crack"),
            (self.moments.just_after, "just after"),
            (
                self.moments.at_rest,
                if self.moments.moves_on {
                    "at the end"
                } else {
                    "at rest"
                },
            ),
        ]
    }

    /// The view for a frame: that of the latest moment at or before it.
    #[must_use]
    pub fn view_of(&self, frame: usize) -> View {
        let Some(views) = self.views else {
            return self.camera;
        };
        let begun = self.labelled_moments().map(|(moment, _)| moment <= frame);
        let latest = begun.iter().rposition(|&begun| begun);
        views[latest.unwrap_or(0)]
    }
}
