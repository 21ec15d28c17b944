//! Surfaces as glTF materials.

use gltf_json as json;
use json::extensions::material as extension;
use json::validation::Checked::Valid;

use frangible_recording::{Recording, SurfaceMaterial};

/// Index of refraction that glTF assumes where a material states none.
const DEFAULT_IOR: f32 = 1.5;

/// Path length of light through a clear body in viewers that trace no rays, m: the wall of a drinking glass.
const VIEWER_THICKNESS: f32 = 0.003;

/// Adds a material per surface, in the same order, and one for the floor.
pub(super) fn push_materials(root: &mut json::Root, recording: &Recording) {
    let floor = recording.floor.map(|floor| {
        let [red, green, blue] = floor.base_color;
        SurfaceMaterial {
            name: "floor".into(),
            base_color: [red, green, blue, 1.0],
            roughness: 0.9,
            ..SurfaceMaterial::default()
        }
    });
    for surface in recording.surfaces.iter().chain(&floor) {
        root.push(material(surface));
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
}

fn has_transmission(surface: &SurfaceMaterial) -> bool {
    surface.transmission > 0.0
}

/// Returns true if the body behind the surface absorbs light. Without transmission this cannot be seen.
fn has_volume(surface: &SurfaceMaterial) -> bool {
    has_transmission(surface) && !surface.thin && surface.attenuation_distance.is_finite()
}

fn has_ior(surface: &SurfaceMaterial) -> bool {
    surface.ior != DEFAULT_IOR
}

fn material(surface: &SurfaceMaterial) -> json::Material {
    // Blending and transmission would each thin the surface, one on top of the
    // other; opacity below 1 only stands in where nothing is transmitted.
    let blends = surface.base_color[3] < 1.0 && !has_transmission(surface);
    let [red, green, blue, opacity] = surface.base_color;
    // A surface that transmits light has its colour in the depth of the body.
    let base_color = if has_volume(surface) {
        [1.0; 4]
    } else {
        [red, green, blue, if blends { opacity } else { 1.0 }]
    };
    json::Material {
        name: Some(surface.name.clone()),
        alpha_mode: Valid(if blends {
            json::material::AlphaMode::Blend
        } else {
            json::material::AlphaMode::Opaque
        }),
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
    (has_transmission(surface) || has_ior(surface)).then_some(extensions)
}
