//! Checks that the surface that its author drew can be drawn.

use super::rows::{Check, all, below, finite, none_or_one_each};
use crate::asset::{Blending, Placement, RenderSurface, Texture};

pub(super) fn render(surface: &RenderSurface) -> Check {
    let vertices = surface.positions.len();
    finite("render vertex", &surface.positions)?;
    finite("render normal", &surface.normals)?;
    all(
        &surface.uvs,
        |uv| uv.iter().all(|x| x.is_finite()),
        |v| format!("the texture coordinates of render vertex {v} are not finite"),
    )?;
    none_or_one_each("render vertex", vertices, "normal", surface.normals.len())?;
    none_or_one_each(
        "render vertex",
        vertices,
        "texture coordinate",
        surface.uvs.len(),
    )?;
    for uvs in &surface.more_uvs {
        none_or_one_each(
            "render vertex",
            vertices,
            "further texture coordinate",
            uvs.len(),
        )?;
        all(
            uvs,
            |uv| uv.iter().all(|x| x.is_finite()),
            |v| format!("the further texture coordinates of render vertex {v} are not finite"),
        )?;
    }
    none_or_one_each("render vertex", vertices, "colour", surface.colors.len())?;
    all(
        &surface.colors,
        |color| color.iter().all(|x| (0.0..=1.0).contains(x)),
        |v| format!("the colour of render vertex {v} lies outside 0 to 1"),
    )?;
    below("render triangle", &surface.triangles, vertices, "vertex")?;
    let (triangles, materials) = (surface.triangles.len(), surface.materials.len());
    let numbers = surface.material_of_triangle.len();
    none_or_one_each("render triangle", triangles, "material number", numbers)?;
    all(
        &surface.material_of_triangle,
        |&m| (m as usize) < materials,
        |t| {
            format!(
                "the material number of render triangle {t} lies beyond the {materials} materials"
            )
        },
    )?;
    let unit = |x: &f32| (0.0..=1.0).contains(x);
    all(
        &surface.materials,
        |m| m.base_color.iter().all(unit) && unit(&m.metallic) && unit(&m.roughness),
        |m| format!("a number of render material {m} lies outside 0 to 1"),
    )?;
    all(
        &surface.materials,
        |m| {
            let emits = m.emission.iter().all(|x| x.is_finite() && *x >= 0.0);
            emits && !matches!(m.blending, Blending::Mask(least) if !unit(&least))
        },
        |m| format!("the emission or the opacity that render material {m} needs is invalid"),
    )?;
    all(
        &surface.materials,
        |m| m.textures.iter().all(|t| is_sound(t, surface)),
        |m| {
            format!(
                "a texture of render material {m} has an image or coordinates that do not exist, or an infinite number"
            )
        },
    )
}

fn is_sound(texture: &Texture, surface: &RenderSurface) -> bool {
    let Placement {
        offset: [u, v],
        rotation,
        scale: [along, across],
    } = texture.placement;
    let numbers = [texture.strength, u, v, rotation, along, across];
    (texture.image as usize) < surface.images.len()
        && texture.uv_set as usize <= surface.more_uvs.len()
        && numbers.iter().all(|x| x.is_finite())
}
