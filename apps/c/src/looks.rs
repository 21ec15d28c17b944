//! Looks of the mesh that was baked.
#![expect(unsafe_code, reason = "exported functions take pointers")]

use std::ffi::{CString, c_char};

use frangible::Asset;
use frangible::internals::asset::{
    Blending, ImageKind, RenderMaterial, Texture, TextureSlot, Wrap,
};
use frangible_js::drawn::authored;

use crate::breakable::{BREAKABLES, c_text};
use crate::entry::{Failure, entry, frangible_status};
use crate::memory::{Form, Sized32};
use crate::types::{frangible_breakable, sized};

/// Looks of the mesh that was baked. Fragments have them, too.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_looks {
    /// sizeof(frangible_looks).
    pub size: u32,
    /// Zero.
    pub reserved: u32,
    /// Name of the mesh, UTF-8, which may be empty. The texts are valid while the handle is.
    pub name: *const c_char,
    /// Number of looks, for `frangible_breakable_look`.
    pub looks: usize,
    /// Number of images, for `frangible_breakable_image`.
    pub images: usize,
}

/// A surface is opaque, or blends with what is behind it if the opacity of its base colour is below 1.
pub const FRANGIBLE_BLENDING_AUTO: u32 = 0;
/// A surface blends with what is behind it; opacities of textures and vertices count, too.
pub const FRANGIBLE_BLENDING_BLEND: u32 = 1;
/// Points with less opacity than `alpha_cutoff` are not drawn, the others are opaque.
pub const FRANGIBLE_BLENDING_MASK: u32 = 2;

/// A material of the mesh that was baked, in the metallic-roughness model of glTF 2.0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_look {
    /// sizeof(frangible_look).
    pub size: u32,
    /// 1 if triangles are seen from behind, too, else 0.
    pub double_sided: u32,
    /// Its name, UTF-8, which may be empty.
    pub name: *const c_char,
    /// Linear red, green, blue and opacity.
    pub base_color: [f32; 4],
    /// Light that it emits: linear red, green and blue.
    pub emission: [f32; 3],
    /// 0 (dielectric) to 1 (metal).
    pub metallic: f32,
    /// 0 (mirror) to 1 (matt).
    pub roughness: f32,
    /// Opacity below which points are not drawn, of a FRANGIBLE_BLENDING_MASK.
    pub alpha_cutoff: f32,
    /// FRANGIBLE_BLENDING_AUTO, FRANGIBLE_BLENDING_BLEND or FRANGIBLE_BLENDING_MASK.
    pub blending: u32,
    /// Zero.
    pub reserved: u32,
    /// Number of textures, for `frangible_breakable_texture`.
    pub textures: usize,
}

/// Multiplies base colour and opacity; sRGB.
pub const FRANGIBLE_TEXTURE_BASE_COLOR: u32 = 0;
/// Green multiplies the roughness, blue the metallic share.
pub const FRANGIBLE_TEXTURE_METALLIC_ROUGHNESS: u32 = 1;
/// Normals in tangent space.
pub const FRANGIBLE_TEXTURE_NORMAL: u32 = 2;
/// Red is the share of ambient light that arrives.
pub const FRANGIBLE_TEXTURE_OCCLUSION: u32 = 3;
/// Multiplies the emitted light; sRGB.
pub const FRANGIBLE_TEXTURE_EMISSION: u32 = 4;

/// Beyond its border an image begins anew.
pub const FRANGIBLE_WRAP_REPEAT: u32 = 0;
/// Beyond its border an image's border goes on.
pub const FRANGIBLE_WRAP_CLAMP: u32 = 1;
/// Beyond its border an image begins anew, mirrored.
pub const FRANGIBLE_WRAP_MIRROR: u32 = 2;

/// A texture of a look. Texture coordinates are scaled, rotated, then moved, as in `KHR_texture_transform`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_texture {
    /// sizeof(frangible_texture).
    pub size: u32,
    /// FRANGIBLE_TEXTURE_BASE_COLOR and so on.
    pub slot: u32,
    /// Number of its image.
    pub image: usize,
    /// Set of texture coordinates: 0 is `uvs`, 1 the first of `more_uvs`.
    pub uv_set: u32,
    /// FRANGIBLE_WRAP_REPEAT, FRANGIBLE_WRAP_CLAMP or FRANGIBLE_WRAP_MIRROR, along u and v.
    pub wrap: [u32; 2],
    /// 1 if texels keep hard edges when they are enlarged, else 0.
    pub pixelated: u32,
    /// Scale of normals, or strength of occlusion; 1 for the others.
    pub strength: f32,
    /// Shift of the origin of the texture coordinates.
    pub offset: [f32; 2],
    /// Counter-clockwise, rad.
    pub rotation: f32,
    /// Along u and v.
    pub scale: [f32; 2],
}

/// Format of an image.
pub const FRANGIBLE_IMAGE_PNG: u32 = 0;
/// Format of an image.
pub const FRANGIBLE_IMAGE_JPEG: u32 = 1;

/// A file of an image. The bytes are valid while the handle is.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_image {
    /// sizeof(frangible_image).
    pub size: u32,
    /// FRANGIBLE_IMAGE_PNG or FRANGIBLE_IMAGE_JPEG.
    pub kind: u32,
    /// Its name, UTF-8, which may be empty.
    pub name: *const c_char,
    /// Bytes of the file.
    pub bytes: *const u8,
    /// Number of bytes.
    pub length: usize,
}

sized! {
    frangible_image
    frangible_look
    frangible_looks
    frangible_texture
}

/// Names of an asset's looks as C has them.
#[derive(Debug, Default)]
pub(crate) struct Names {
    mesh: CString,
    looks: Vec<CString>,
    images: Vec<CString>,
}

impl Names {
    pub(crate) fn of(asset: &Asset) -> Self {
        authored(asset).map_or_else(Self::default, |surface| Self {
            mesh: c_text(&surface.name),
            looks: surface
                .materials
                .iter()
                .map(|look| c_text(&look.name))
                .collect(),
            images: surface
                .images
                .iter()
                .map(|image| c_text(&image.name))
                .collect(),
        })
    }
}

fn missing(what: &str, index: usize, count: usize) -> Failure {
    Failure::range(format!("there is no {what} {index}; there are {count}"))
}

fn looks_of(asset: &Asset) -> &[RenderMaterial] {
    authored(asset).map_or(&[], |surface| &surface.materials)
}

/// Tells the name of the mesh that was baked, and how many looks and images it has.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_looks(
    breakable: frangible_breakable,
    out: *mut frangible_looks,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let kind = BREAKABLES.get(breakable.id)?;
        out.fill(&frangible_looks {
            name: kind.names.mesh.as_ptr(),
            looks: kind.names.looks.len(),
            images: kind.names.images.len(),
            ..Default::default()
        });
        Ok(())
    })
}

/// Gives a look, a material of the mesh that was baked.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_look(
    breakable: frangible_breakable,
    look: usize,
    out: *mut frangible_look,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let kind = BREAKABLES.get(breakable.id)?;
        let all = looks_of(kind.breakable.asset());
        let found = all.get(look).zip(kind.names.looks.get(look));
        let (own, name) = found.ok_or_else(|| missing("look", look, all.len()))?;
        let (blending, alpha_cutoff) = match own.blending {
            Blending::Auto => (FRANGIBLE_BLENDING_AUTO, 0.0),
            Blending::Blend => (FRANGIBLE_BLENDING_BLEND, 0.0),
            Blending::Mask(cutoff) => (FRANGIBLE_BLENDING_MASK, cutoff),
        };
        out.fill(&frangible_look {
            double_sided: own.double_sided.into(),
            name: name.as_ptr(),
            base_color: own.base_color,
            emission: own.emission,
            metallic: own.metallic,
            roughness: own.roughness,
            alpha_cutoff,
            blending,
            textures: own.textures.len(),
            ..Default::default()
        });
        Ok(())
    })
}

/// Gives a texture of a look.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_texture(
    breakable: frangible_breakable,
    look: usize,
    index: usize,
    out: *mut frangible_texture,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let kind = BREAKABLES.get(breakable.id)?;
        let all = looks_of(kind.breakable.asset());
        let own = all
            .get(look)
            .ok_or_else(|| missing("look", look, all.len()))?;
        let texture = own.textures.get(index);
        let texture = texture.ok_or_else(|| missing("texture", index, own.textures.len()))?;
        out.fill(&texture_of(texture));
        Ok(())
    })
}

fn texture_of(texture: &Texture) -> frangible_texture {
    frangible_texture {
        slot: match texture.slot {
            TextureSlot::BaseColor => FRANGIBLE_TEXTURE_BASE_COLOR,
            TextureSlot::MetallicRoughness => FRANGIBLE_TEXTURE_METALLIC_ROUGHNESS,
            TextureSlot::Normal => FRANGIBLE_TEXTURE_NORMAL,
            TextureSlot::Occlusion => FRANGIBLE_TEXTURE_OCCLUSION,
            TextureSlot::Emission => FRANGIBLE_TEXTURE_EMISSION,
        },
        image: texture.image as usize,
        uv_set: texture.uv_set,
        wrap: texture.wrap.map(|wrap| match wrap {
            Wrap::Repeat => FRANGIBLE_WRAP_REPEAT,
            Wrap::Clamp => FRANGIBLE_WRAP_CLAMP,
            Wrap::Mirror => FRANGIBLE_WRAP_MIRROR,
        }),
        pixelated: texture.is_pixelated.into(),
        strength: texture.strength,
        offset: texture.placement.offset,
        rotation: texture.placement.rotation,
        scale: texture.placement.scale,
        ..Default::default()
    }
}

/// Gives the file of an image.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_breakable_image(
    breakable: frangible_breakable,
    image: usize,
    out: *mut frangible_image,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let kind = BREAKABLES.get(breakable.id)?;
        let all = authored(kind.breakable.asset()).map_or(&[][..], |surface| &surface.images);
        let found = all.get(image).zip(kind.names.images.get(image));
        let (own, name) = found.ok_or_else(|| missing("image", image, all.len()))?;
        out.fill(&frangible_image {
            kind: match own.kind {
                ImageKind::Png => FRANGIBLE_IMAGE_PNG,
                ImageKind::Jpeg => FRANGIBLE_IMAGE_JPEG,
            },
            name: name.as_ptr(),
            bytes: own.bytes.as_ptr(),
            length: own.bytes.len(),
            ..Default::default()
        });
        Ok(())
    })
}
