//! Surfaces as glTF materials.

use gltf_json as json;
use json::extensions::material as extension;
use json::validation::Checked::Valid;

use super::texture::{TEXTURE_TRANSFORM, is_placed, push_images, texture};
use frangible_recording::{Blending, Recording, SurfaceMaterial};

const EMISSIVE_STRENGTH: &str = "KHR_materials_emissive_strength";

/// Index of refraction that glTF assumes where a material states none.
const DEFAULT_IOR: f32 = 1.5;

/// Path length of light through a clear body in viewers that trace no rays, m: the wall of a drinking glass.
const VIEWER_THICKNESS: f32 = 0.003;

/// Adds a material per surface, in the same order, and one for the floor.
pub(super) fn push_materials(root: &mut json::Root, binary: &mut Vec<u8>, recording: &Recording) {
    let floor = recording.floor.map(|floor| {
        let [red, green, blue] = floor.base_color;
        SurfaceMaterial {
            name: "floor".into(),
            base_color: [red, green, blue, 1.0],
            roughness: 0.9,
            ..SurfaceMaterial::default()
        }
    });
    let images = push_images(root, binary, &recording.images);
    for surface in recording.surfaces.iter().chain(&floor) {
        let mut material = material(surface);
        texture(root, surface, &images, &mut material);
        root.push(material);
    }
    let any = |used: fn(&SurfaceMaterial) -> bool| recording.surfaces.iter().any(used);
    if any(has_ior) {
        root.extensions_used.push("KHR_materials_ior".into());
    }
    if any(has_transmission) {
        root.extensions_used
            .push("KHR_materials_transmission".into());
    }
    if any(has_volume) {
        root.extensions_used.push("KHR_materials_volume".into());
    }
    if any(|surface| strength(surface) > 1.0) {
        root.extensions_used.push(EMISSIVE_STRENGTH.into());
    }
    if any(|surface| surface.textures.iter().any(is_placed)) {
        root.extensions_used.push(TEXTURE_TRANSFORM.into());
    }
}

fn has_transmission(surface: &SurfaceMaterial) -> bool {
    surface.transmission > 0.0
}

/// Returns true if the body behind the surface absorbs light. Without transmission this cannot be seen.
fn has_volume(surface: &SurfaceMaterial) -> bool {
    has_transmission(surface) && !surface.thin && surface.attenuation_distance.is_finite()
}

/// Factor of the emitted light, which the format keeps at or below 1.
fn strength(surface: &SurfaceMaterial) -> f32 {
    surface.emission.into_iter().fold(1.0, f32::max)
}

fn has_ior(surface: &SurfaceMaterial) -> bool {
    surface.ior != DEFAULT_IOR
}

fn material(surface: &SurfaceMaterial) -> json::Material {
    // Blending and transmission would each thin the surface, one on top of the
    // other; opacity below 1 only stands in where nothing is transmitted.
    let blends = match surface.blending {
        Blending::Auto => surface.base_color[3] < 1.0 && !has_transmission(surface),
        Blending::Blend => true,
        Blending::Mask(_) => false,
    };
    let least = match surface.blending {
        Blending::Mask(least) => Some(least),
        _ => None,
    };
    let strength = strength(surface);
    let [red, green, blue, opacity] = surface.base_color;
    // A surface that transmits light has its colour in the depth of the body.
    let base_color = if has_volume(surface) {
        [1.0; 4]
    } else {
        let is_seen = blends || least.is_some();
        [red, green, blue, if is_seen { opacity } else { 1.0 }]
    };
    json::Material {
        name: Some(surface.name.clone()),
        alpha_mode: Valid(match (blends, least) {
            (true, _) => json::material::AlphaMode::Blend,
            (false, Some(_)) => json::material::AlphaMode::Mask,
            (false, None) => json::material::AlphaMode::Opaque,
        }),
        alpha_cutoff: least.map(json::material::AlphaCutoff),
        emissive_factor: json::material::EmissiveFactor(
            surface.emission.map(|part| part / strength),
        ),
        double_sided: surface.double_sided,
        pbr_metallic_roughness: json::material::PbrMetallicRoughness {
            base_color_factor: json::material::PbrBaseColorFactor(base_color),
            metallic_factor: json::material::StrengthFactor(surface.metallic),
            roughness_factor: json::material::StrengthFactor(surface.roughness),
            ..Default::default()
        },
        extensions: extensions(surface),
        ..Default::default()
    }
}

fn extensions(surface: &SurfaceMaterial) -> Option<extension::Material> {
    let mut extensions = extension::Material::default();
    if has_transmission(surface) {
        extensions.transmission = Some(extension::Transmission {
            transmission_factor: extension::TransmissionFactor(surface.transmission),
            ..Default::default()
        });
    }
    if has_ior(surface) {
        extensions.ior = Some(extension::Ior {
            ior: extension::IndexOfRefraction(surface.ior),
            ..Default::default()
        });
    }
    if has_volume(surface) {
        extensions.volume = Some(extension::Volume {
            // For renderers without rays, which take it for the way of light through the body.
            thickness_factor: extension::ThicknessFactor(VIEWER_THICKNESS),
            attenuation_distance: extension::AttenuationDistance(surface.attenuation_distance),
            attenuation_color: extension::AttenuationColor(surface.attenuation_color),
            ..Default::default()
        });
    }
    let strength = strength(surface);
    if strength > 1.0 {
        let value = serde_json::json!({ "emissiveStrength": strength });
        extensions.others.insert(EMISSIVE_STRENGTH.into(), value);
    }
    (has_transmission(surface) || has_ior(surface) || strength > 1.0).then_some(extensions)
}
