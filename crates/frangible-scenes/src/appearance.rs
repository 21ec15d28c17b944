//! Appearance of materials: outside and crack faces.

use frangible::internals::asset::RenderMaterial;
use frangible_recording::{Grain, SurfaceMaterial, Texture};

/// Appearance of the parts of a body.
pub(crate) struct Appearance {
    pub(crate) outside: SurfaceMaterial,
    pub(crate) crack_face: SurfaceMaterial,
    /// A crack that parts nothing, seen through a clear body.
    pub(crate) crack: SurfaceMaterial,
    /// The line at which such a crack comes to the surface.
    pub(crate) crack_line: SurfaceMaterial,
}

/// Appearance of a body of a material.
pub(crate) fn appearance(material: &str) -> Appearance {
    let plain = |part: &str, base_color: [f32; 4], roughness: f32| SurfaceMaterial {
        name: format!("{material} {part}"),
        base_color,
        roughness,
        ..SurfaceMaterial::default()
    };
    let opaque = |outer: [f32; 3], inner: [f32; 3], roughness: f32, grains: [Grain; 2]| {
        let [a, b] = [outer, inner].map(|[r, g, b]| [r, g, b, 1.0]);
        let [red, green, blue] = inner.map(|part| 0.12 * part);
        let crack_face = |part: &str| SurfaceMaterial {
            grain: grains[1],
            ..plain(part, b, 0.85)
        };
        Appearance {
            outside: SurfaceMaterial {
                grain: grains[0],
                ..plain("outside", a, roughness)
            },
            crack: ending(crack_face("crack")),
            crack_face: crack_face("crack face"),
            crack_line: ending(plain("crack line", [red, green, blue, 1.0], 1.0)),
        }
    };
    // Renderers that do not trace light draw clear bodies with some opacity and darker crack faces, so that shards can be told apart.
    let clear = |outer: [f32; 4], inner: [f32; 4], ior: f32, left: [f32; 3], grains: [Grain; 2]| {
        let part = |name: &str, color: [f32; 4], roughness: f32| SurfaceMaterial {
            transmission: 1.0,
            ior,
            double_sided: true,
            attenuation_color: left,
            attenuation_distance: COLOR_DEPTH,
            grain: grains[0],
            ..plain(name, color, roughness)
        };
        Appearance {
            outside: part(
                "outside",
                outer,
                if grains[0] == Grain::Even { 0.02 } else { 0.2 },
            ),
            crack_face: SurfaceMaterial {
                grain: grains[1],
                ..part("crack face", inner, 0.25)
            },
            crack: ending(SurfaceMaterial {
                thin: true,
                grain: match grains[1] {
                    Grain::Marked => Grain::Marked,
                    _ => Grain::Broken,
                },
                ..part("crack", [0.9, 0.95, 0.95, 0.45], 0.25)
            }),
            crack_line: ending(plain("crack line", [0.75, 0.82, 0.80, 1.0], 0.6)),
        }
    };
    let even = [Grain::Even, Grain::Broken];
    match material.trim_start_matches("paper-") {
        "glass"
        | "glass-new"
        | "glass-abraded"
        | "tempered-glass"
        | "heat-strengthened-glass"
        | "laminated-glass"
        | "slab"
        | "slab-low"
        | "slab-moderate"
        | "slab-high"
        | "slab-very-high" => clear(
            [0.62, 0.80, 0.78, 0.38],
            [0.16, 0.42, 0.38, 0.9],
            1.52,
            [0.46, 0.80, 0.68],
            [Grain::Even, Grain::Marked],
        ),
        "pmma" => clear(
            [0.85, 0.88, 0.92, 0.35],
            [0.55, 0.62, 0.70, 0.9],
            1.49,
            [0.82, 0.88, 0.95],
            even,
        ),
        "ice" => clear(
            [0.75, 0.87, 0.95, 0.55],
            [0.85, 0.93, 0.98, 0.95],
            1.31,
            [0.70, 0.86, 0.95],
            [Grain::Cloudy; 2],
        ),
        "sugar" => clear(
            [0.80, 0.48, 0.16, 0.6],
            [0.62, 0.30, 0.06, 0.95],
            1.5,
            [0.80, 0.36, 0.06],
            [Grain::Cloudy; 2],
        ),
        "porcelain" => opaque([0.86, 0.86, 0.84], [0.74, 0.70, 0.64], 0.16, even),
        "piggy" | "piggy-fig4" => opaque([0.85, 0.45, 0.45], [0.75, 0.62, 0.55], 0.25, even),
        "brick" => opaque(
            [0.30, 0.088, 0.050],
            [0.36, 0.115, 0.066],
            0.9,
            [Grain::Clay; 2],
        ),
        "concrete" => opaque(
            [0.45, 0.45, 0.43],
            [0.40, 0.39, 0.37],
            0.95,
            [Grain::Even, Grain::Aggregate],
        ),
        "marble" => opaque(
            [0.82, 0.81, 0.79],
            [0.88, 0.88, 0.86],
            0.2,
            [Grain::Veined; 2],
        ),
        "chocolate" => opaque([0.042, 0.016, 0.008], [0.062, 0.026, 0.013], 0.34, even),
        "casing" => opaque([0.012, 0.012, 0.014], [0.10, 0.10, 0.11], 0.35, even),
        _ => opaque([0.62, 0.60, 0.57], [0.50, 0.46, 0.42], 0.6, even),
    }
}

/// Marks the look of a crack that ends inside its body.
fn ending(look: SurfaceMaterial) -> SurfaceMaterial {
    SurfaceMaterial {
        ends_inside: true,
        ..look
    }
}

/// Distance that light goes through a clear body until it has the body's colour, m: a good deal farther than a wall is thick, so that panes are
/// clear and their edges, along which light runs, are not.
const COLOR_DEPTH: f32 = 0.04;

/// Surface of a part of a mesh file, as its author drew it. `images`: numbers of its images in the recording.
pub(crate) fn authored_surface(look: &RenderMaterial, images: &[u32]) -> SurfaceMaterial {
    let textures = look.textures.iter().map(|texture| Texture {
        image: images[texture.image as usize],
        ..*texture
    });
    SurfaceMaterial {
        name: look.name.clone(),
        base_color: look.base_color,
        metallic: look.metallic,
        roughness: look.roughness,
        double_sided: look.double_sided || look.base_color[3] < 1.0,
        emission: look.emission,
        blending: look.blending,
        textures: textures.collect(),
        ..SurfaceMaterial::default()
    }
}

/// Surface of a body whose vertices have colours, but which has no materials: white, so that they are seen as they are.
pub(crate) fn painted_surface(outside: &SurfaceMaterial) -> SurfaceMaterial {
    SurfaceMaterial {
        name: "vertex colours".into(),
        base_color: [1.0; 4],
        roughness: outside.roughness,
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
