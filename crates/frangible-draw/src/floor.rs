//! The floor, with its shadows as a texture.

use std::cell::RefCell;
use std::rc::Rc;

use frangible_photo::internals::FloorShadow;
use frangible_recording::glam::{Vec2, Vec3};
use kiss3d::color::Color;
use kiss3d::resource::{GpuMesh3d, Texture};
use kiss3d::scene::SceneNode3d;
use wgpu::{AddressMode, FilterMode, TextureFormat};

use crate::stage::FLOOR;

/// Width of the floor around the shadow's square, beyond what the haze hides, stage units.
const FAR: f32 = 60.0;

/// A floor to be laid.
pub(crate) struct Laid<'a> {
    /// Stage units.
    pub(crate) height: f32,
    /// Linear red, green, blue.
    pub(crate) color: [f32; 3],
    pub(crate) shadow: &'a FloorShadow,
    /// Pixels that [`texels`] makes of the shadow.
    pub(crate) texels: &'a [u8],
    /// If true, smaller copies of the texture are made for distant parts.
    pub(crate) mipmaps: bool,
}

/// Adds the floor.
pub(crate) fn add_floor(scene: &mut SceneNode3d, floor: Laid<'_>) -> SceneNode3d {
    let Laid {
        height,
        color: [red, green, blue],
        shadow,
        ..
    } = floor;
    // Lowered a little, so that it does not flicker with the lower faces of things on it.
    let height = height - 0.003;
    // Nine fields, the shadow's square in the middle; around it the texture's
    // border, plain floor, goes on.
    let offsets = [-FAR, -shadow.half_side, shadow.half_side, FAR];
    let places = [0.0, 0.0, 1.0, 1.0];
    let (mut corners, mut texels, mut faces) = (Vec::new(), Vec::new(), Vec::new());
    for (row, column) in (0..4).flat_map(|row| (0..4).map(move |column| (row, column))) {
        let (x, z) = (offsets[column], offsets[row]);
        corners.push(Vec3::new(shadow.center.x + x, height, shadow.center.y + z));
        texels.push(Vec2::new(places[column], places[row]));
        if row < 3 && column < 3 {
            let [here, below] = [4 * row + column, 4 * row + column + 4].map(|at| at as u32);
            faces.push([here, below, below + 1]);
            faces.push([here, below + 1, here + 1]);
        }
    }
    let normals = vec![Vec3::Y; corners.len()];
    let mesh = GpuMesh3d::new(corners, faces, Some(normals), Some(texels), false);
    let mut node = scene.add_mesh(Rc::new(RefCell::new(mesh)), Vec3::ONE);
    node.set_texture(Texture::new(
        shadow.side as u32,
        shadow.side as u32,
        floor.texels,
        TextureFormat::Rgba8UnormSrgb,
        AddressMode::ClampToEdge,
        FilterMode::Linear,
        floor.mipmaps,
        1,
    ));
    node.set_color(Color::new(red, green, blue, 1.0));
    node.set_roughness(1.0);
    node.set_reflectance(0.0);
    node.set_metallic(0.0);
    node.set_light_layers(FLOOR);
    node.set_casts_shadows(false);
    node
}

/// The shadow as sRGB pixels.
pub(crate) fn texels(shadow: &FloorShadow) -> Vec<u8> {
    let code = |light: f32| (light.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0 + 0.5) as u8;
    let pixel = |&light: &f32| [code(light), code(light), code(light), 255];
    shadow.brightness.iter().flat_map(pixel).collect()
}
