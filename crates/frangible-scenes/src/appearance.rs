//! How materials look: outside and crack faces.

use frangible::internals::asset::RenderMaterial;
use frangible_export::SurfaceMaterial;

/// Surfaces of a material's outside and of its crack faces.
pub(crate) fn body_surfaces(material: &str) -> [SurfaceMaterial; 2] {
    let plain = |part: &str, base_color: [f32; 4], roughness: f32| SurfaceMaterial {
        name: format!("{material} {part}"),
        base_color,
        roughness,
        ..SurfaceMaterial::default()
    };
    let opaque = |outer: [f32; 3], inner: [f32; 3], roughness: f32| {
        let [a, b] = [outer, inner].map(|[r, g, b]| [r, g, b, 1.0]);
        [plain("outside", a, roughness), plain("crack face", b, 0.85)]
    };
    // Clear bodies are drawn with some opacity and darker crack faces, so that shards can be told apart.
    let clear = |outer: [f32; 4], inner: [f32; 4], ior: f32| {
        [("outside", outer, 0.06), ("crack face", inner, 0.25)].map(|(part, color, roughness)| {
            SurfaceMaterial {
                ior,
                double_sided: true,
                ..plain(part, color, roughness)
            }
        })
    };
    match material.trim_start_matches("paper-") {
        "glass" | "slab" | "slab-low" | "slab-moderate" | "slab-high" | "slab-very-high" => {
            clear([0.62, 0.80, 0.78, 0.38], [0.16, 0.42, 0.38, 0.9], 1.52)
        }
        "pmma" => clear([0.85, 0.88, 0.92, 0.35], [0.55, 0.62, 0.70, 0.9], 1.49),
        "ice" => clear([0.75, 0.87, 0.95, 0.55], [0.85, 0.93, 0.98, 0.95], 1.31),
        "sugar" => clear([0.80, 0.48, 0.16, 0.6], [0.62, 0.30, 0.06, 0.95], 1.5),
        "porcelain" => opaque([0.86, 0.86, 0.84], [0.70, 0.66, 0.60], 0.22),
        "piggy" | "piggy-fig4" => opaque([0.85, 0.45, 0.45], [0.75, 0.62, 0.55], 0.3),
        "brick" => opaque([0.46, 0.16, 0.10], [0.55, 0.22, 0.14], 0.9),
        "concrete" => opaque([0.45, 0.45, 0.43], [0.38, 0.37, 0.35], 0.95),
        "marble" => opaque([0.82, 0.81, 0.79], [0.90, 0.90, 0.88], 0.3),
        "chocolate" => opaque([0.13, 0.055, 0.025], [0.20, 0.095, 0.05], 0.4),
        _ => opaque([0.62, 0.60, 0.57], [0.50, 0.46, 0.42], 0.6),
    }
}

/// Surface of a part of a mesh file, as its author drew it.
pub(crate) fn authored_surface(look: &RenderMaterial) -> SurfaceMaterial {
    SurfaceMaterial {
        name: look.name.clone(),
        base_color: look.base_color,
        metallic: look.metallic,
        roughness: look.roughness,
        double_sided: look.base_color[3] < 1.0,
        ..SurfaceMaterial::default()
    }
}

/// Surface of a projectile; `kind` is its form's name.
pub(crate) fn projectile_surface(kind: &str, material: &str) -> SurfaceMaterial {
    let (base_color, metallic, roughness) = match material {
        "steel" => ([0.56, 0.57, 0.58, 1.0], 1.0, 0.25),
        "rubber" => ([0.03, 0.03, 0.035, 1.0], 0.0, 0.8),
        "wood" => ([0.42, 0.25, 0.12, 1.0], 0.0, 0.7),
        _ => ([0.4, 0.4, 0.4, 1.0], 0.0, 0.6),
    };
    SurfaceMaterial {
        name: format!("{material} {kind}"),
        base_color,
        metallic,
        roughness,
        ..SurfaceMaterial::default()
    }
}
