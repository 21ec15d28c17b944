//! Looks of an authored surface: materials and the images of their textures, as glTF 2.0 has them.

use std::sync::Arc;

/// Material of triangles of a [`RenderSurface`](super::RenderSurface), in the metallic-roughness model of glTF 2.0.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderMaterial {
    /// Name of the material; may be empty.
    pub name: String,
    /// Linear red, green, blue and opacity, each 0..=1.
    pub base_color: [f32; 4],
    /// 0 (dielectric) to 1 (metal).
    pub metallic: f32,
    /// 0 (mirror) to 1 (matt).
    pub roughness: f32,
    /// Light that the surface emits: linear red, green and blue, 0 or more.
    pub emission: [f32; 3],
    /// If true, triangles are seen from behind, too.
    pub double_sided: bool,
    /// Meaning of its opacity.
    pub blending: Blending,
    /// Its textures, at most one for each slot.
    pub textures: Vec<Texture>,
}

impl Default for RenderMaterial {
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: [0.8, 0.8, 0.8, 1.0],
            metallic: 0.0,
            roughness: 0.7,
            emission: [0.0; 3],
            double_sided: false,
            blending: Blending::Auto,
            textures: Vec::new(),
        }
    }
}

/// Makes an sRGB colour linear (IEC 61966-2-1); the opacity stays.
#[must_use]
pub fn linear_color([red, green, blue, opacity]: [f32; 4]) -> [f32; 4] {
    let linear = |part: f32| match part {
        dark if dark <= 0.04045 => dark / 12.92,
        bright => libm::powf((bright + 0.055) / 1.055, 2.4),
    };
    [linear(red), linear(green), linear(blue), opacity]
}

/// Meaning of the opacity of a material.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Blending {
    /// The surface blends with what is behind it if the opacity of its base colour is below 1.
    #[default]
    Auto,
    /// It blends; opacities of textures and vertices count, too.
    Blend,
    /// Points with less opacity than this are not drawn, the others are opaque.
    Mask(f32),
}

/// A texture of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture {
    /// Property of the material that the texture gives.
    pub slot: TextureSlot,
    /// Index of its image.
    pub image: u32,
    /// Set of texture coordinates, from 0.
    pub uv_set: u32,
    /// Beyond the image, along u and v.
    pub wrap: [Wrap; 2],
    /// If true, texels keep hard edges when they are enlarged.
    pub is_pixelated: bool,
    /// Scale of normals, or strength of occlusion; 1 for the others.
    pub strength: f32,
    /// Offset, rotation (rad) and scale of the texture coordinates, as in `KHR_texture_transform`.
    pub placement: Placement,
}

impl Texture {
    /// An image as the first set of coordinates places it, repeated.
    #[must_use]
    pub const fn of(slot: TextureSlot, image: u32) -> Self {
        Self {
            slot,
            image,
            uv_set: 0,
            wrap: [Wrap::Repeat; 2],
            is_pixelated: false,
            strength: 1.0,
            placement: Placement::IDENTITY,
        }
    }
}

/// Placement of an image in texture coordinates: they are scaled, rotated, then moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Shift of the origin of the texture coordinates.
    pub offset: [f32; 2],
    /// Counter-clockwise, rad.
    pub rotation: f32,
    /// Along u and v.
    pub scale: [f32; 2],
}

impl Placement {
    /// The coordinates unchanged.
    pub const IDENTITY: Self = Self {
        offset: [0.0; 2],
        rotation: 0.0,
        scale: [1.0; 2],
    };
}

/// Property of a material that a texture gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TextureSlot {
    /// Multiplies the base colour and opacity; sRGB.
    BaseColor,
    /// Green multiplies the roughness, blue the metallic share.
    MetallicRoughness,
    /// Normals in tangent space.
    Normal,
    /// Red is the share of ambient light that arrives.
    Occlusion,
    /// Multiplies the emitted light; sRGB.
    Emission,
}

impl TextureSlot {
    /// All slots.
    pub const ALL: [Self; 5] = [
        Self::BaseColor,
        Self::MetallicRoughness,
        Self::Normal,
        Self::Occlusion,
        Self::Emission,
    ];
}

/// Continuation of an image beyond its border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// It begins anew.
    #[default]
    Repeat,
    /// Its border goes on.
    Clamp,
    /// It begins anew, mirrored.
    Mirror,
}

impl Wrap {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Repeat, Self::Clamp, Self::Mirror];
}

/// An image file in memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Name in the file, or its file name; may be empty.
    pub name: String,
    /// Its format.
    pub kind: ImageKind,
    /// The bytes of the file, shared by all copies.
    pub bytes: Arc<[u8]>,
}

/// Format of an image: those that glTF 2.0 has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageKind {
    /// PNG.
    Png,
    /// JPEG.
    Jpeg,
}

impl ImageKind {
    /// All formats.
    pub const ALL: [Self; 2] = [Self::Png, Self::Jpeg];

    /// The format that the first bytes of a file tell.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
            Some(Self::Png)
        } else if bytes.starts_with(&[0xff, 0xd8, 0xff]) {
            Some(Self::Jpeg)
        } else {
            None
        }
    }

    /// Its media type.
    #[must_use]
    pub const fn mime_type(self) -> &'static str {
        match self {
            Self::Png => "image/png",
            Self::Jpeg => "image/jpeg",
        }
    }
}
