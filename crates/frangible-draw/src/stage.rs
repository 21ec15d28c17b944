//! A frame of a recording as a lit kiss3d scene.
//!
//! The stage has its own units: what the camera looks at lies at the origin and
//! half the height of the picture there is 1. Lights, shadows and fog are so
//! set once, for a thimble and for a column.

use std::cell::RefCell;
use std::rc::Rc;

use frangible_export::glam::Vec3;
use frangible_export::{MeshPart, Pose, RecordedMesh, Recording, SurfaceMaterial, View};
use kiss3d::color::Color;
use kiss3d::glamx::Pose3;
use kiss3d::light::Light;
use kiss3d::resource::GpuMesh3d;
use kiss3d::scene::SceneNode3d;

/// Where the key light's bulbs sit on a disc of radius 1: together they cast
/// the soft shadow of a lamp that has a size.
const BULBS: [(f32, f32); 3] = [(0.0, 0.7), (-0.6, -0.4), (0.6, -0.4)];

/// How many shadow maps the stage needs, one per bulb.
pub(crate) const SHADOW_LAYERS: u32 = BULBS.len() as u32;

/// The change from world to stage units.
#[derive(Clone, Copy)]
pub(crate) struct StageUnits {
    origin: Vec3,
    /// Stage units per metre.
    pub(crate) scale: f32,
}

impl StageUnits {
    pub(crate) fn of(view: &View) -> Self {
        let half_height = view.eye.distance(view.target) * (0.5 * view.vertical_fov).tan();
        Self {
            origin: view.target,
            scale: half_height.recip(),
        }
    }

    fn point(self, world: Vec3) -> Vec3 {
        (world - self.origin) * self.scale
    }

    pub(crate) fn view(self, world: &View) -> View {
        View {
            eye: self.point(world.eye),
            target: Vec3::ZERO,
            ..*world
        }
    }
}

/// Builds the scene of a recording's first frame.
pub(crate) fn stage(recording: &Recording, view: &View) -> SceneNode3d {
    let units = StageUnits::of(view);
    let mut scene = SceneNode3d::empty();
    add_lights(&mut scene, &units.view(view));
    if let Some(floor) = &recording.floor {
        let height = (floor.height - units.origin.y) * units.scale;
        add_floor(&mut scene, height, floor.base_color);
    }
    for (index, node) in recording.nodes.iter().enumerate() {
        let pose = recording.pose(index, 0);
        let mesh = &recording.meshes[node.mesh];
        for part in mesh.parts.iter().filter(|part| !part.indices.is_empty()) {
            let surface = &recording.surfaces[part.surface];
            add_part(&mut scene, mesh, part, surface, pose, units);
        }
    }
    scene
}

fn add_part(
    scene: &mut SceneNode3d,
    mesh: &RecordedMesh,
    part: &MeshPart,
    surface: &SurfaceMaterial,
    pose: Pose,
    units: StageUnits,
) {
    let faces = part
        .indices
        .chunks_exact(3)
        .map(|face| [face[0], face[1], face[2]])
        .collect();
    let vertices = mesh
        .positions
        .iter()
        .map(|&position| position * units.scale)
        .collect();
    let normals = mesh
        .normals
        .iter()
        .map(|normal| normal.normalize_or(Vec3::Y))
        .collect();
    let gpu_mesh = GpuMesh3d::new(vertices, faces, Some(normals), None, false);
    let mut node = scene.add_mesh(Rc::new(RefCell::new(gpu_mesh)), Vec3::ONE);
    node.set_pose(Pose3::from_parts(
        units.point(pose.translation),
        pose.rotation.normalize(),
    ));
    node.enable_backface_culling(!surface.double_sided);
    let [red, green, blue, opacity] = surface.base_color;
    node.set_metallic(surface.metallic);
    node.set_roughness(surface.roughness);
    if surface.transmission > 0.0 {
        // The colour of glass lies in its depth, not on its face.
        node.set_color(Color::new(red, green, blue, 1.0));
        node.set_transmission(surface.transmission);
        node.set_ior(surface.ior);
        node.set_thickness(GLASS_DEPTH);
        node.set_attenuation(Color::new(red, green, blue, 1.0), GLASS_DEPTH);
    } else {
        node.set_color(Color::new(red, green, blue, opacity));
    }
}

/// How far light travels through glass before it has the glass's colour, stage units.
const GLASS_DEPTH: f32 = 0.12;

fn add_floor(scene: &mut SceneNode3d, height: f32, [red, green, blue]: [f32; 3]) {
    let corner = |x: f32, z: f32| Vec3::new(x * 60.0, height, z * 60.0);
    let corners = vec![
        corner(-1., -1.),
        corner(-1., 1.),
        corner(1., 1.),
        corner(1., -1.),
    ];
    let faces = vec![[0, 1, 2], [0, 2, 3]];
    let mesh = GpuMesh3d::new(corners, faces, Some(vec![Vec3::Y; 4]), None, false);
    let mut node = scene.add_mesh(Rc::new(RefCell::new(mesh)), Vec3::ONE);
    node.set_color(Color::new(red, green, blue, 1.0));
    node.set_roughness(0.85);
    node.set_metallic(0.0);
    node.set_casts_shadows(false);
    add_ballast(scene, height);
}

/// A speck far below the floor. A shadow map ends right behind the last thing
/// that casts a shadow, and where that end cuts the floor it draws faint lines.
fn add_ballast(scene: &mut SceneNode3d, floor_height: f32) {
    let low = Vec3::new(0.0, floor_height - 40.0, 0.0);
    let corners = vec![low, low + 0.01 * Vec3::X, low + 0.01 * Vec3::Z];
    let mesh = GpuMesh3d::new(
        corners,
        vec![[0, 1, 2]],
        Some(vec![Vec3::Y; 3]),
        None,
        false,
    );
    scene.add_mesh(Rc::new(RefCell::new(mesh)), Vec3::ONE);
}

/// A large key light from the upper left of the camera, a weak fill from the
/// right and a rim from behind that parts edges from the background.
fn add_lights(scene: &mut SceneNode3d, view: &View) {
    let backward = Vec3::new(view.eye.x, 0.0, view.eye.z)
        .try_normalize()
        .unwrap_or(Vec3::Z);
    let right = Vec3::Y.cross(backward);
    let key = -3.2 * right + 5.5 * Vec3::Y + 2.6 * backward;
    let across = key.cross(Vec3::Y).normalize();
    let along = across.cross(key).normalize();
    for (u, v) in BULBS {
        let bulb = key + 0.55 * (u * across + v * along);
        scene
            .add_light(
                Light::spot(0.55, 0.85, 60.0)
                    .with_color(Color::new(1.0, 0.97, 0.92, 1.0))
                    .with_intensity(2.7 / BULBS.len() as f32),
            )
            // A light shines along −z, and the z axis is what gets aimed.
            .reorient(bulb, 2.0 * bulb, across);
    }
    let fill = Light::directional(-(4.0 * right + 2.5 * Vec3::Y + 2.0 * backward))
        .with_color(Color::new(0.86, 0.92, 1.0, 1.0))
        .with_intensity(0.7)
        .with_casts_shadows(false);
    scene.add_light(fill);
    let rim = Light::directional(-(2.0 * right + 2.0 * Vec3::Y - 5.0 * backward))
        .with_intensity(0.8)
        .with_casts_shadows(false);
    scene.add_light(rim);
}
