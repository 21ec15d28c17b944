//! Materials, textures and images.

use std::borrow::Cow;
use std::path::Path;

use gltf_json::extensions::texture::Info as InfoExtensions;
use gltf_json::image::Image as JsonImage;
use gltf_json::material::{AlphaMode, Material};
use gltf_json::texture::{MagFilter, Texture as JsonTexture, WrappingMode};
use gltf_json::validation::Checked;
use gltf_json::{Index, Root, Value};

use super::buffers::{Buffers, referenced};
use crate::read::images::image_of;
use crate::read::text::shown;
use crate::{Blending, Image, InputMaterial, InputMesh, Placement, Texture, TextureSlot, Wrap};

pub(super) const TEXTURE_TRANSFORM: &str = "KHR_texture_transform";
pub(super) const EMISSIVE_STRENGTH: &str = "KHR_materials_emissive_strength";

/// Reads the materials of a mesh, and the images that those in use refer to.
pub(super) fn read_materials(
    root: &Root,
    buffers: &Buffers,
    folder: Option<&Path>,
    mesh: &mut InputMesh,
) {
    let mut is_used = vec![false; root.materials.len()];
    for &material in &mesh.material_of_triangle {
        if let Some(flag) = is_used.get_mut(material as usize) {
            *flag = true;
        }
    }
    let mut images = Images {
        root,
        buffers,
        folder,
        number: vec![None; root.images.len()],
        list: Vec::new(),
    };
    let mut materials = Vec::with_capacity(root.materials.len());
    for (source, is_used) in root.materials.iter().zip(is_used) {
        let mut material = plain(source);
        if is_used {
            for given in textures(source) {
                material.textures.extend(images.texture(given, mesh));
            }
        }
        materials.push(material);
    }
    mesh.materials = materials;
    mesh.images = images.list;
}

fn plain(material: &Material) -> InputMaterial {
    let pbr = &material.pbr_metallic_roughness;
    let share = |v: f32| {
        if v.is_finite() {
            v.clamp(0.0, 1.0)
        } else {
            1.0
        }
    };
    let strength = material
        .extensions
        .as_ref()
        .and_then(|all| all.others.get(EMISSIVE_STRENGTH))
        .and_then(|extension| extension.get("emissiveStrength"))
        .and_then(Value::as_f64)
        .unwrap_or(1.0);
    let light = |v: f32| {
        let light = v * strength as f32;
        if light.is_finite() {
            light.max(0.0)
        } else {
            0.0
        }
    };
    let mut base_color = pbr.base_color_factor.0.map(share);
    let blending = match material.alpha_mode {
        Checked::Valid(AlphaMode::Blend) => Blending::Blend,
        Checked::Valid(AlphaMode::Mask) => {
            Blending::Mask(share(material.alpha_cutoff.unwrap_or_default().0))
        }
        // The format ignores the opacity of opaque materials.
        _ => {
            base_color[3] = 1.0;
            Blending::Auto
        }
    };
    InputMaterial {
        name: material.name.clone().unwrap_or_default(),
        base_color,
        metallic: share(pbr.metallic_factor.0),
        roughness: share(pbr.roughness_factor.0),
        emission: material.emissive_factor.0.map(light),
        double_sided: material.double_sided,
        blending,
        textures: Vec::new(),
    }
}

/// A texture as a material names it.
struct Given<'a> {
    slot: TextureSlot,
    texture: Index<JsonTexture>,
    uv_set: u32,
    strength: f32,
    transform: Option<&'a Value>,
}

fn textures(material: &Material) -> impl Iterator<Item = Given<'_>> {
    fn transform(all: &Option<InfoExtensions>) -> Option<&Value> {
        all.as_ref()?.others.get(TEXTURE_TRANSFORM)
    }
    let pbr = &material.pbr_metallic_roughness;
    let infos = [
        (TextureSlot::BaseColor, &pbr.base_color_texture),
        (
            TextureSlot::MetallicRoughness,
            &pbr.metallic_roughness_texture,
        ),
        (TextureSlot::Emission, &material.emissive_texture),
    ];
    let plain = infos.into_iter().filter_map(move |(slot, info)| {
        let info = info.as_ref()?;
        Some(Given {
            slot,
            texture: info.index,
            uv_set: info.tex_coord,
            strength: 1.0,
            transform: transform(&info.extensions),
        })
    });
    let normal = material.normal_texture.as_ref().map(|info| Given {
        slot: TextureSlot::Normal,
        texture: info.index,
        uv_set: info.tex_coord,
        strength: info.scale,
        transform: (info.extensions.as_ref()).and_then(|all| all.others.get(TEXTURE_TRANSFORM)),
    });
    let occlusion = material.occlusion_texture.as_ref().map(|info| Given {
        slot: TextureSlot::Occlusion,
        texture: info.index,
        uv_set: info.tex_coord,
        strength: info.strength.0,
        transform: (info.extensions.as_ref()).and_then(|all| all.others.get(TEXTURE_TRANSFORM)),
    });
    plain.chain(normal).chain(occlusion)
}

/// The images in use, each read once.
struct Images<'a> {
    root: &'a Root,
    buffers: &'a Buffers<'a>,
    folder: Option<&'a Path>,
    /// Number of each image of the file in the list; `None` inside if it cannot be kept.
    number: Vec<Option<Option<u32>>>,
    list: Vec<Image>,
}

impl Images<'_> {
    /// The texture, unless it cannot be kept, which is taken down.
    fn texture(&mut self, given: Given, mesh: &mut InputMesh) -> Option<Texture> {
        let Some(texture) = self.root.get(given.texture) else {
            mesh.leave_out("a texture that does not exist");
            return None;
        };
        let image = self.image(texture.source.value(), mesh)?;
        let sampler = texture.sampler.and_then(|sampler| self.root.get(sampler));
        let wrap = |mode: Checked<WrappingMode>| match mode {
            Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
            Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
            _ => Wrap::Repeat,
        };
        let (placement, other_set) = given
            .transform
            .map_or((Placement::IDENTITY, None), placement);
        let uv_set = other_set.unwrap_or(given.uv_set);
        if uv_set as usize > mesh.more_uvs.len() || (uv_set == 0 && mesh.uvs.is_empty()) {
            mesh.leave_out("textures without texture coordinates");
            return None;
        }
        Some(Texture {
            slot: given.slot,
            image,
            uv_set,
            wrap: sampler.map_or([Wrap::Repeat; 2], |s| [wrap(s.wrap_s), wrap(s.wrap_t)]),
            is_pixelated: sampler
                .is_some_and(|s| s.mag_filter == Some(Checked::Valid(MagFilter::Nearest))),
            strength: if given.strength.is_finite() {
                given.strength
            } else {
                1.0
            },
            placement,
        })
    }

    fn image(&mut self, source: usize, mesh: &mut InputMesh) -> Option<u32> {
        // Formats of extensions have no source.
        let Some(known) = self.number.get(source).copied() else {
            mesh.leave_out("textures that are neither PNG nor JPEG");
            return None;
        };
        if let Some(known) = known {
            return known;
        }
        let number = self.list.len() as u32;
        let read = self.read(source, &self.root.images[source]);
        let kept = match read {
            Ok(image) => {
                self.list.push(image);
                Some(number)
            }
            Err(problem) => {
                mesh.leave_out(problem);
                None
            }
        };
        self.number[source] = Some(kept);
        kept
    }

    /// The image, or words on why it is left out.
    fn read(&self, number: usize, image: &JsonImage) -> Result<Image, String> {
        let file = image.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
        let name = image.name.as_deref().or(file).unwrap_or_default();
        let called = match name {
            "" => format!("image {number}"),
            name => format!("image {}", shown(name.as_bytes())),
        };
        let unreadable = |error: crate::ReadError| format!("{called} ({error})");
        let bytes = match (image.buffer_view, &image.uri) {
            (Some(view), _) => Cow::from(self.buffers.view(self.root, view).map_err(unreadable)?.0),
            (None, Some(uri)) => referenced(&called, uri, self.folder)
                .map_err(unreadable)?
                .into(),
            (None, None) => return Err(format!("{called}, which has no data")),
        };
        image_of(name, &called, &bytes)
    }
}

/// Placement of a texture, and the set of coordinates that it names.
fn placement(transform: &Value) -> (Placement, Option<u32>) {
    let number = |value: &Value| value.as_f64().map(|x| x as f32).filter(|x| x.is_finite());
    let pair = |name: &str, other: [f32; 2]| {
        let pair = transform.get(name);
        let at = |k: usize| pair.and_then(|pair| number(pair.get(k)?));
        [at(0).unwrap_or(other[0]), at(1).unwrap_or(other[1])]
    };
    let placement = Placement {
        offset: pair("offset", [0.0; 2]),
        rotation: transform.get("rotation").and_then(number).unwrap_or(0.0),
        scale: pair("scale", [1.0; 2]),
    };
    let set = transform.get("texCoord").and_then(Value::as_u64);
    (placement, set.and_then(|set| u32::try_from(set).ok()))
}
