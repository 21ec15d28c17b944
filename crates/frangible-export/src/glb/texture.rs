//! Images and textures.

use gltf_json as json;
use json::extensions::{material as of_material, texture as of_texture};
use json::texture::{MagFilter, MinFilter, Sampler, WrappingMode};
use json::validation::Checked::Valid;
use serde_json::{Map, Value};

use frangible_recording::{Image, Placement, SurfaceMaterial, Texture, TextureSlot, Wrap};

pub(super) const TEXTURE_TRANSFORM: &str = "KHR_texture_transform";

/// Adds the files of images to the binary chunk.
pub(super) fn push_images(
    root: &mut json::Root,
    binary: &mut Vec<u8>,
    images: &[Image],
) -> Vec<json::Index<json::Image>> {
    let push = |image: &Image| {
        let view = root.push(json::buffer::View {
            buffer: json::Index::new(0),
            byte_length: image.bytes.len().into(),
            byte_offset: Some(binary.len().into()),
            byte_stride: None,
            name: None,
            target: None,
            extensions: None,
            extras: None,
        });
        binary.extend_from_slice(&image.bytes);
        // Every view starts on a multiple of the widest component.
        binary.resize(binary.len().next_multiple_of(4), 0);
        root.push(json::Image {
            buffer_view: Some(view),
            mime_type: Some(json::image::MimeType(image.kind.mime_type().into())),
            name: (!image.name.is_empty()).then(|| image.name.clone()),
            uri: None,
            extensions: None,
            extras: None,
        })
    };
    images.iter().map(push).collect()
}

/// Returns true if a texture does not take its coordinates as they are.
pub(super) fn is_placed(texture: &Texture) -> bool {
    texture.placement != Placement::IDENTITY
}

/// Gives a material the textures of its surface.
pub(super) fn texture(
    root: &mut json::Root,
    surface: &SurfaceMaterial,
    images: &[json::Index<json::Image>],
    material: &mut json::Material,
) {
    for texture in &surface.textures {
        let index = push_texture(root, texture, images[texture.image as usize]);
        let (tex_coord, others) = (texture.uv_set, placement(texture));
        let info = |others: Option<Map<String, Value>>| json::texture::Info {
            index,
            tex_coord,
            extensions: others.map(|others| of_texture::Info { others }),
            extras: None,
        };
        let pbr = &mut material.pbr_metallic_roughness;
        match texture.slot {
            TextureSlot::BaseColor => pbr.base_color_texture = Some(info(others)),
            TextureSlot::MetallicRoughness => pbr.metallic_roughness_texture = Some(info(others)),
            TextureSlot::Emission => material.emissive_texture = Some(info(others)),
            TextureSlot::Normal => {
                material.normal_texture = Some(json::material::NormalTexture {
                    index,
                    scale: texture.strength,
                    tex_coord,
                    extensions: others.map(|others| of_material::NormalTexture { others }),
                    extras: None,
                });
            }
            TextureSlot::Occlusion => {
                material.occlusion_texture = Some(json::material::OcclusionTexture {
                    index,
                    strength: json::material::StrengthFactor(texture.strength.clamp(0.0, 1.0)),
                    tex_coord,
                    extensions: others.map(|others| of_material::OcclusionTexture { others }),
                    extras: None,
                });
            }
        }
    }
}

/// A texture of an image; equal ones are kept once, and so are samplers.
fn push_texture(
    root: &mut json::Root,
    texture: &Texture,
    source: json::Index<json::Image>,
) -> json::Index<json::Texture> {
    let mode = |wrap: Wrap| {
        Valid(match wrap {
            Wrap::Repeat => WrappingMode::Repeat,
            Wrap::Clamp => WrappingMode::ClampToEdge,
            Wrap::Mirror => WrappingMode::MirroredRepeat,
        })
    };
    let (mag, min) = if texture.is_pixelated {
        (MagFilter::Nearest, MinFilter::NearestMipmapLinear)
    } else {
        (MagFilter::Linear, MinFilter::LinearMipmapLinear)
    };
    let [wrap_s, wrap_t] = texture.wrap.map(mode);
    let known = root
        .samplers
        .iter()
        .position(|s| s.mag_filter == Some(Valid(mag)) && s.wrap_s == wrap_s && s.wrap_t == wrap_t);
    let sampler = match known {
        Some(known) => json::Index::new(known as u32),
        None => root.push(Sampler {
            mag_filter: Some(Valid(mag)),
            min_filter: Some(Valid(min)),
            wrap_s,
            wrap_t,
            ..Sampler::default()
        }),
    };
    let mut textures = root.textures.iter();
    let known = textures.position(|t| t.source == source && t.sampler == Some(sampler));
    match known {
        Some(known) => json::Index::new(known as u32),
        None => root.push(json::Texture {
            name: None,
            sampler: Some(sampler),
            source,
            extensions: None,
            extras: None,
        }),
    }
}

/// The extension with a texture's placement.
fn placement(texture: &Texture) -> Option<Map<String, Value>> {
    let Placement {
        offset,
        rotation,
        scale,
    } = texture.placement;
    is_placed(texture).then(|| {
        let value = serde_json::json!({ "offset": offset, "rotation": rotation, "scale": scale });
        Map::from_iter([(TEXTURE_TRANSFORM.to_string(), value)])
    })
}
