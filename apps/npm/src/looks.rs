//! Names, materials and images of a body's file as objects.

use frangible::internals::asset::{
    Blending, ImageKind, RenderMaterial, RenderSurface, Texture, TextureSlot, Wrap,
};
use js_sys::{Array, Object, Uint8Array};

use crate::bindings::set;

/// The name of the mesh, its materials and their images.
pub(crate) fn looks(surface: &RenderSurface) -> Object {
    let object = Object::new();
    set(&object, "name", surface.name.as_str());
    let materials: Array = surface.materials.iter().map(material).collect();
    set(&object, "materials", materials);
    let image = |image: &frangible::internals::asset::Image| {
        let object = Object::new();
        set(&object, "name", image.name.as_str());
        let kind = match image.kind {
            ImageKind::Png => "image/png",
            ImageKind::Jpeg => "image/jpeg",
        };
        set(&object, "type", kind);
        set(&object, "bytes", Uint8Array::from(&image.bytes[..]));
        object
    };
    set(
        &object,
        "images",
        surface.images.iter().map(image).collect::<Array>(),
    );
    object
}

fn material(look: &RenderMaterial) -> Object {
    let object = Object::new();
    set(&object, "name", look.name.as_str());
    set(&object, "baseColor", list(&look.base_color));
    set(&object, "metallic", look.metallic);
    set(&object, "roughness", look.roughness);
    set(&object, "emission", list(&look.emission));
    set(&object, "doubleSided", look.double_sided);
    let (blending, cutoff) = match look.blending {
        Blending::Auto => ("auto", None),
        Blending::Blend => ("blend", None),
        Blending::Mask(cutoff) => ("mask", Some(cutoff)),
    };
    set(&object, "blending", blending);
    if let Some(cutoff) = cutoff {
        set(&object, "alphaCutoff", cutoff);
    }
    let textures: Array = look.textures.iter().map(texture).collect();
    set(&object, "textures", textures);
    object
}

fn texture(texture: &Texture) -> Object {
    let object = Object::new();
    let slot = match texture.slot {
        TextureSlot::BaseColor => "baseColor",
        TextureSlot::MetallicRoughness => "metallicRoughness",
        TextureSlot::Normal => "normal",
        TextureSlot::Occlusion => "occlusion",
        TextureSlot::Emission => "emission",
    };
    set(&object, "slot", slot);
    set(&object, "image", texture.image);
    set(&object, "uvSet", texture.uv_set);
    let wrap = texture.wrap.iter().map(|wrap| match wrap {
        Wrap::Repeat => "repeat",
        Wrap::Clamp => "clamp",
        Wrap::Mirror => "mirror",
    });
    let wrap: Array = wrap.map(wasm_bindgen::JsValue::from).collect();
    set(&object, "wrap", wrap);
    set(&object, "pixelated", texture.is_pixelated);
    set(&object, "strength", texture.strength);
    set(&object, "offset", list(&texture.placement.offset));
    set(&object, "rotation", texture.placement.rotation);
    set(&object, "scale", list(&texture.placement.scale));
    object
}

fn list(numbers: &[f32]) -> Array {
    numbers
        .iter()
        .map(|&x| wasm_bindgen::JsValue::from(x))
        .collect()
}
