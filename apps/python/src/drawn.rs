//! Meshes to draw, and the looks of the mesh that was baked.

use frangible::glam::DVec3;
use frangible::internals::asset::{
    Blending, ImageKind, RenderMaterial, RenderSurface, Texture, TextureSlot, Wrap,
};
use frangible_js::drawn::Drawn;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};

/// Arrays of a mesh whose origin is `centre` in the body's frame, m.
pub(crate) fn arrays<'py>(
    py: Python<'py>,
    drawn: &Drawn,
    centre: DVec3,
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let places = drawn.positions.as_chunks().0.iter();
    let places = places.flat_map(|&[x, y, z]: &[f32; 3]| {
        (DVec3::new(x.into(), y.into(), z.into()) + centre).to_array()
    });
    dict.set_item("vertices", PyArray1::from_vec(py, places.collect()))?;
    dict.set_item("normals", PyArray1::from_slice(py, &drawn.normals))?;
    let sets = std::iter::once(&drawn.uvs).chain(&drawn.more_uvs);
    let sets = sets.map(|uvs| PyArray1::from_slice(py, uvs));
    dict.set_item("uvs", sets.collect::<Vec<_>>())?;
    let colors = (!drawn.colors.is_empty()).then(|| PyArray1::from_slice(py, &drawn.colors));
    dict.set_item("colors", colors)?;
    dict.set_item("faces", PyArray1::from_slice(py, &drawn.indices))?;
    dict.set_item("outer_faces", drawn.outer_indices / 3)?;
    let mut materials = vec![-1_i32; drawn.indices.len() / 3];
    for group in &drawn.groups {
        materials[group.first / 3..][..group.count / 3].fill(group.material as i32);
    }
    dict.set_item("material", PyArray1::from_vec(py, materials))?;
    Ok(dict)
}

/// Name, materials and images.
pub(crate) fn looks<'py>(py: Python<'py>, surface: &RenderSurface) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("name", &surface.name)?;
    let materials = surface.materials.iter().map(|look| material(py, look));
    let materials = materials.collect::<PyResult<Vec<_>>>()?;
    dict.set_item("materials", PyList::new(py, materials)?)?;
    let images = surface.images.iter().map(|image| {
        let kind = match image.kind {
            ImageKind::Png => "image/png",
            ImageKind::Jpeg => "image/jpeg",
        };
        (image.name.as_str(), kind, PyBytes::new(py, &image.bytes))
    });
    dict.set_item("images", images.collect::<Vec<_>>())?;
    Ok(dict)
}

fn material<'py>(py: Python<'py>, look: &RenderMaterial) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("name", &look.name)?;
    dict.set_item("base_color", look.base_color)?;
    dict.set_item("metallic", look.metallic)?;
    dict.set_item("roughness", look.roughness)?;
    dict.set_item("emission", look.emission)?;
    dict.set_item("double_sided", look.double_sided)?;
    let (blending, cutoff) = match look.blending {
        Blending::Auto => ("auto", None),
        Blending::Blend => ("blend", None),
        Blending::Mask(cutoff) => ("mask", Some(cutoff)),
    };
    dict.set_item("blending", blending)?;
    dict.set_item("alpha_cutoff", cutoff)?;
    let textures = look.textures.iter().map(|own| texture(py, own));
    let textures = textures.collect::<PyResult<Vec<_>>>()?;
    dict.set_item("textures", textures)?;
    Ok(dict)
}

fn texture<'py>(py: Python<'py>, texture: &Texture) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let slot = match texture.slot {
        TextureSlot::BaseColor => "base_color",
        TextureSlot::MetallicRoughness => "metallic_roughness",
        TextureSlot::Normal => "normal",
        TextureSlot::Occlusion => "occlusion",
        TextureSlot::Emission => "emission",
    };
    dict.set_item("slot", slot)?;
    dict.set_item("image", texture.image)?;
    dict.set_item("uv_set", texture.uv_set)?;
    let wrap = texture.wrap.map(|wrap| match wrap {
        Wrap::Repeat => "repeat",
        Wrap::Clamp => "clamp",
        Wrap::Mirror => "mirror",
    });
    dict.set_item("wrap", wrap)?;
    dict.set_item("pixelated", texture.is_pixelated)?;
    dict.set_item("strength", texture.strength)?;
    dict.set_item("offset", texture.placement.offset)?;
    dict.set_item("rotation", texture.placement.rotation)?;
    dict.set_item("scale", texture.placement.scale)?;
    Ok(dict)
}
