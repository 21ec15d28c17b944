//! A frame of a recording as a lit kiss3d scene, on the stage of the traced pictures.

use std::cell::RefCell;
use std::rc::Rc;

use frangible_photo::internals::{
    Fineness, FloorShadow, StageUnits, casters, clarity, key_light, stage_directions,
};
use frangible_recording::glam::Vec3;
use frangible_recording::{Recording, SurfaceMaterial, View};
use kiss3d::color::Color;
use kiss3d::context::Context;
use kiss3d::light::Light;
use kiss3d::resource::GpuMesh3d;
use kiss3d::scene::{AlphaMode, SceneNode3d};

use crate::floor::{Laid, add_floor, texels};

/// Light layers: things that break, and the floor.
pub(crate) const THINGS: u32 = 1;
pub(crate) const FLOOR: u32 = 2;

/// Builds the scene of a recording's first frame, for a film.
pub(crate) fn stage(recording: &Recording, view: &View) -> SceneNode3d {
    let units = StageUnits::of(view);
    let mut scene = SceneNode3d::empty();
    let view = &units.view(view);
    add_lights(&mut scene, view);
    if let Some(floor) = &recording.floor {
        let height = (floor.height - units.origin.y) * units.scale;
        let shadow = FloorShadow::cast(
            &casters(recording, units),
            height,
            key_light(view),
            Fineness::MOVING,
        );
        let laid = Laid {
            height,
            color: floor.base_color,
            texels: &texels(&shadow),
            shadow: &shadow,
            mipmaps: true,
        };
        add_floor(&mut scene, laid);
    }
    for bunch in bunches(recording, units) {
        add_bunch(&mut scene, bunch, &recording.surfaces);
    }
    scene
}

/// Faces of one surface, stage units: drawn at once, however many pieces they
/// belong to. A draw of its own for each piece takes most of the time.
#[derive(Default)]
struct Bunch {
    surface: usize,
    vertices: Vec<Vec3>,
    normals: Vec<Vec3>,
    faces: Vec<[u32; 3]>,
}

fn bunches(recording: &Recording, units: StageUnits) -> Vec<Bunch> {
    let mut bunches: Vec<Bunch> = Vec::new();
    for (index, node) in recording.nodes.iter().enumerate() {
        let pose = recording.pose(index, 0);
        let rotation = pose.rotation.normalize();
        let mesh = &recording.meshes[node.mesh];
        for part in mesh.parts.iter().filter(|part| !part.indices.is_empty()) {
            let surface = part.surface;
            // Glass that refracts shows through other glass, not through itself.
            let refracts = refracts(&recording.surfaces[surface]);
            let same = |bunch: &Bunch| !refracts && bunch.surface == surface;
            let at = bunches.iter().position(same).unwrap_or_else(|| {
                bunches.push(Bunch {
                    surface,
                    ..Bunch::default()
                });
                bunches.len() - 1
            });
            let bunch = &mut bunches[at];
            for face in part.indices.chunks_exact(3) {
                let first = bunch.vertices.len() as u32;
                bunch.faces.push([first, first + 1, first + 2]);
                for &corner in face {
                    let point = rotation * mesh.positions[corner as usize] + pose.translation;
                    let normal = mesh.normals[corner as usize].normalize_or(Vec3::Y);
                    bunch.vertices.push(units.point(point));
                    bunch.normals.push(rotation * normal);
                }
            }
        }
    }
    bunches
}

fn add_bunch(scene: &mut SceneNode3d, bunch: Bunch, surfaces: &[SurfaceMaterial]) {
    let surface = &surfaces[bunch.surface];
    let mesh = GpuMesh3d::new(
        bunch.vertices,
        bunch.faces,
        Some(bunch.normals),
        None,
        false,
    );
    let mut node = scene.add_mesh(Rc::new(RefCell::new(mesh)), Vec3::ONE);
    dress(&mut node, surface);
}

/// Gives a thing the looks of a surface.
pub(crate) fn dress(node: &mut SceneNode3d, surface: &SurfaceMaterial) {
    node.set_light_layers(THINGS);
    node.enable_backface_culling(!surface.double_sided);
    let [red, green, blue, opacity] = surface.base_color;
    node.set_metallic(surface.metallic);
    node.set_roughness(surface.roughness);
    if refracts(surface) {
        // The colour of glass lies in its depth, not on its face.
        node.set_color(Color::new(red, green, blue, 1.0));
        node.set_transmission(surface.transmission);
        node.set_ior(surface.ior);
        node.set_thickness(GLASS_DEPTH);
        node.set_attenuation(Color::new(red, green, blue, 1.0), GLASS_DEPTH);
    } else {
        node.set_color(Color::new(red, green, blue, opacity));
        if opacity < 1.0 && !draws_clear_things() {
            node.set_alpha_mode(AlphaMode::Opaque);
        }
    }
}

/// Returns true if a clear surface is drawn so that it bends light. With some opacity it is drawn in less time, and shards are easier to tell apart.
pub(crate) fn refracts(surface: &SurfaceMaterial) -> bool {
    surface.transmission > 0.0 && surface.base_color[3] >= 1.0
}

/// Returns true if transparent surfaces can be drawn. WebGL 2 lacks the blending that sums their layers, and would draw nothing at all.
fn draws_clear_things() -> bool {
    let able = Context::get().adapter.get_downlevel_capabilities().flags;
    able.contains(wgpu::DownlevelFlags::INDEPENDENT_BLEND)
}

/// Depth of glass at which light takes on its colour, stage units.
const GLASS_DEPTH: f32 = 0.12;

/// A large key light from the upper left of the camera, a weak fill from the
/// right and a rim from behind that parts edges from the background. The floor
/// has a lamp of its own, even all over: its shadows come with its texture.
pub(crate) fn add_lights(scene: &mut SceneNode3d, view: &View) {
    let [backward, right] = stage_directions(view);
    let key = key_light(view);
    // A spot takes one shadow map, a directional light four.
    scene
        .add_light(
            Light::spot(0.55, 0.85, 60.0)
                .with_color(Color::new(1.0, 0.97, 0.93, 1.0))
                .with_intensity(1.45)
                .with_layers(THINGS),
        )
        // A light shines along −z, and its z axis is what is aimed.
        .reorient(key, 2.0 * key, key.cross(Vec3::Y).normalize());
    let fill = 4.0 * right + 2.0 * Vec3::Y + 2.5 * backward;
    let rim = 2.0 * right + 2.0 * Vec3::Y - 5.0 * backward;
    for (toward, [red, green, blue], intensity, layer) in [
        (fill, [0.86, 0.92, 1.0], 0.8, THINGS),
        (rim, [1.0; 3], 0.9, THINGS),
        (Vec3::Y, [1.0; 3], 2.4, FLOOR),
    ] {
        scene.add_light(
            Light::directional(-toward)
                .with_color(Color::new(red, green, blue, 1.0))
                .with_intensity(intensity)
                .with_layers(layer)
                .with_casts_shadows(false),
        );
    }
}

/// Returns true if any face lets light through.
pub(crate) fn has_glass(recording: &Recording) -> bool {
    let surfaces = &recording.surfaces;
    let mut parts = recording.meshes.iter().flat_map(|mesh| &mesh.parts);
    parts.any(|part| clarity(&surfaces[part.surface]) > 0.0)
}
