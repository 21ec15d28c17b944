//! A surface coloured by a value at each vertex, as a kiss3d scene.
//!
//! The colours are stored in a texture, because kiss3d has no vertex colours.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use frangible_photo::internals::StageUnits;
use frangible_recording::View;
use frangible_recording::glam::{Vec2, Vec3};
use kiss3d::color::Color;
use kiss3d::light::Light;
use kiss3d::resource::{GpuMesh3d, Texture};
use kiss3d::scene::SceneNode3d;
use wgpu::{AddressMode, FilterMode, TextureFormat};

use crate::color_map::color_of;

/// A closed surface with a number at each vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Field {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// 0..=1.
    pub(crate) values: Vec<f32>,
    /// Dark lines on it.
    pub(crate) lines: Vec<SurfaceLine>,
}

/// A dark line on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceLine {
    /// Its ends, m.
    pub ends: [Vec3; 2],
    /// Unit normal of the surface there, outwards.
    pub normal: Vec3,
}

/// Faces that meet at less than this are shaded as one, cosine of the angle: 35°.
const CREASE: f32 = 0.82;

/// Colours in the palette's texture, so that they are blended along the map and not across it.
const SHADES: usize = 256;

/// Width of a line, and its distance from the surface, over the height of the view.
const LINE: [f32; 2] = [0.005, 0.0015];

/// Half of a colour shines by itself, whatever the light: shading must not be taken for a value.
const GLOW: f32 = 0.5;

/// Builds the scene, seen from `view`.
pub(crate) fn field_scene(field: &Field, view: &View) -> SceneNode3d {
    let mut scene = SceneNode3d::empty();
    if field.triangles.is_empty() {
        return scene;
    }
    let units = StageUnits::of(view);
    let backward = (view.eye - view.target).normalize_or(Vec3::Z);
    let right = view.up.cross(backward).normalize_or(Vec3::X);
    for (toward, intensity) in [
        (backward - 0.8 * right + 0.9 * view.up, 1.1),
        (backward + right + 0.2 * view.up, 0.5),
    ] {
        scene.add_light(
            Light::directional(-toward)
                .with_intensity(intensity)
                .with_casts_shadows(false),
        );
    }
    let (mut corners, mut texels, mut faces) = (Vec::new(), Vec::new(), Vec::new());
    for triangle in &field.triangles {
        let first = corners.len() as u32;
        faces.push([first, first + 1, first + 2]);
        for &vertex in triangle {
            corners.push(units.point(field.positions[vertex as usize]));
            texels.push(texel(field.values[vertex as usize]));
        }
    }
    let normals = creased_normals(&field.positions, &field.triangles);
    let mesh = GpuMesh3d::new(corners, faces, Some(normals), Some(texels), false);
    let mut node = scene.add_mesh(Rc::new(RefCell::new(mesh)), Vec3::ONE);
    dress_in_values(&mut node, palette_texture());
    if !field.lines.is_empty() {
        let mut node = scene.add_mesh(Rc::new(RefCell::new(ribbons(field, view))), Vec3::ONE);
        node.set_color(Color::new(0.0, 0.0, 0.0, 1.0));
        node.set_metallic(0.0);
        node.set_roughness(1.0);
        node.set_reflectance(0.0);
        node.enable_backface_culling(false);
    }
    scene
}

/// The lines as ribbons that lie just above the surface, in the units of the stage.
fn ribbons(field: &Field, view: &View) -> GpuMesh3d {
    let units = StageUnits::of(view);
    let seen = 2.0 * view.eye.distance(view.target) * (0.5 * view.vertical_fov).tan();
    let [width, lift] = LINE.map(|share| share * seen);
    let (mut corners, mut normals, mut faces) = (Vec::new(), Vec::new(), Vec::new());
    for line in &field.lines {
        let [a, b] = line.ends;
        let along = (b - a).normalize_or_zero();
        let across = along.cross(line.normal) * (0.5 * width);
        let out = line.normal * lift;
        // A little longer than it is, so that a bend has no gap.
        let beyond = along * (0.3 * width);
        let first = corners.len() as u32;
        for corner in [
            a - beyond - across,
            b + beyond - across,
            b + beyond + across,
            a - beyond + across,
        ] {
            corners.push(units.point(corner + out));
            normals.push(line.normal);
        }
        faces.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    GpuMesh3d::new(corners, faces, Some(normals), None, false)
}

/// Texture coordinates of a value of 0..=1 in the palette: from the middle of the first texel to that of the last.
pub(crate) fn texel(value: f32) -> Vec2 {
    let along = (0.5 + value.clamp(0.0, 1.0) * (SHADES - 1) as f32) / SHADES as f32;
    Vec2::new(along, 0.5)
}

/// Colours a thing whose texture coordinates are those of [`texel`].
pub(crate) fn dress_in_values(node: &mut SceneNode3d, palette: Arc<Texture>) {
    node.set_texture(palette.clone());
    node.set_emissive_map(palette);
    node.set_emissive(Color::new(GLOW, GLOW, GLOW, 1.0));
    let rest = 1.0 - GLOW;
    node.set_color(Color::new(rest, rest, rest, 1.0));
    node.set_metallic(0.0);
    node.set_roughness(1.0);
    node.set_reflectance(0.0);
    node.enable_backface_culling(false);
}

pub(crate) fn palette_texture() -> Arc<Texture> {
    Texture::new(
        SHADES as u32,
        1,
        &palette(),
        TextureFormat::Rgba8UnormSrgb,
        AddressMode::ClampToEdge,
        FilterMode::Linear,
        false,
        1,
    )
}

fn palette() -> Vec<u8> {
    let shade = |i: usize| {
        let [red, green, blue] = color_of(i as f32 / (SHADES - 1) as f32);
        [red, green, blue, 255]
    };
    (0..SHADES).flat_map(shade).collect()
}

/// Unit normals of each triangle's corners, three per triangle: means over the faces around, but for creases.
pub(crate) fn creased_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); positions.len()];
    let mut areas = Vec::with_capacity(triangles.len());
    for (number, triangle) in (0..).zip(triangles) {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
        areas.push((b - a).cross(c - a));
        for &vertex in triangle {
            around[vertex as usize].push(number);
        }
    }
    let mut normals = Vec::with_capacity(3 * triangles.len());
    for (area, triangle) in areas.iter().zip(triangles) {
        let own = area.normalize_or(Vec3::Y);
        for &vertex in triangle {
            let near = around[vertex as usize].iter().map(|&f| areas[f as usize]);
            let sum: Vec3 = near
                .filter(|area| area.normalize_or_zero().dot(own) > CREASE)
                .sum();
            normals.push(sum.normalize_or(own));
        }
    }
    normals
}

#[cfg(test)]
mod tests {
    use frangible_recording::glam::Vec3;

    use super::creased_normals;

    #[test]
    fn normals_are_shared_across_flat_edges_and_not_across_creases() {
        // Two triangles at a bend of 10°, a third at a right angle.
        let up =
            |degrees: f32| Vec3::new(degrees.to_radians().cos(), 0.0, degrees.to_radians().sin());
        let positions = [
            Vec3::ZERO,
            Vec3::Y,
            -Vec3::X,
            up(10.0),
            Vec3::new(0.0, 0.5, -1.0),
        ];
        let normals = creased_normals(&positions, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
        assert!(normals[0].abs_diff_eq(normals[4], 1e-6), "{normals:?}");
        assert!(normals[0].z > 0.99 && normals[0].x.abs() > 0.05);
        assert!(normals[6].abs_diff_eq(Vec3::NEG_X, 1e-6), "{normals:?}");
    }
}
