//! The drawn surface as sections of a file.

use std::sync::Arc;

use super::AssetFileError;
use super::decode::sum;
use super::reader::Reader;
use super::sections::{self as s, Section};
use super::writer::Writer;
use crate::asset::{
    Blending, Image, ImageKind, Placement, RenderMaterial, RenderSurface, Texture, TextureSlot,
    Wrap,
};

/// Numbers of a material's look: emission, 1 if double-sided, blending.
const LOOK: usize = 5;

/// Numbers of a texture: material, slot, image, set of coordinates, wraps, 1 if pixelated, strength, placement.
const TEXTURE: usize = 13;

/// Numbers in place of a share of opacity below which nothing is drawn.
const AUTO: f32 = -1.0;
const BLEND: f32 = -2.0;

pub(super) fn encode(w: &mut Writer, surface: &RenderSurface) {
    if !surface.name.is_empty() {
        w.text(s::RENDER_NAME, &surface.name);
    }
    w.rows(s::RENDER_POSITIONS, &surface.positions);
    w.rows(s::RENDER_NORMALS, &surface.normals);
    w.rows(s::RENDER_UVS, &surface.uvs);
    w.rows(s::RENDER_TRIANGLES, &surface.triangles);
    w.rows(
        s::RENDER_MATERIAL_OF_TRIANGLE,
        &surface.material_of_triangle,
    );
    let materials = surface.materials.iter();
    let numbers = materials.clone().map(|m| {
        let [r, g, b, a] = m.base_color;
        [r, g, b, a, m.metallic, m.roughness]
    });
    w.each(s::RENDER_MATERIALS, numbers);
    w.each(
        s::RENDER_NAME_LENGTHS,
        materials.clone().map(|m| m.name.len() as u32),
    );
    let names: String = materials.clone().map(|m| m.name.as_str()).collect();
    w.text(s::RENDER_NAMES, &names);
    if !surface.colors.is_empty() {
        w.rows(s::RENDER_COLORS, &surface.colors);
    }
    if surface.srgb_colors {
        w.rows(s::RENDER_SRGB_COLORS, &[1_u32]);
    }
    if !surface.more_uvs.is_empty() {
        w.rows(s::RENDER_MORE_UVS, &surface.more_uvs.concat());
    }
    let looks: Vec<[f32; LOOK]> = materials.clone().map(look).collect();
    if looks
        .iter()
        .any(|numbers| *numbers != look(&RenderMaterial::default()))
    {
        w.rows(s::RENDER_LOOKS, &looks);
    }
    let textures = (0..)
        .zip(&surface.materials)
        .flat_map(|(m, material)| material.textures.iter().map(move |t| texture(m, t)));
    let textures: Vec<[f32; TEXTURE]> = textures.collect();
    if !textures.is_empty() {
        w.rows(s::RENDER_TEXTURES, &textures);
    }
    if !surface.images.is_empty() {
        let images = surface.images.iter();
        let numbers = images.clone().map(|image| {
            let [name, bytes] = [image.name.len(), image.bytes.len()].map(|n| n as u32);
            [image.kind as u32, name, bytes]
        });
        w.each(s::RENDER_IMAGES, numbers);
        let names: String = images.clone().map(|image| image.name.as_str()).collect();
        w.text(s::RENDER_IMAGE_NAMES, &names);
        let bytes: Vec<u8> = images.flat_map(|image| &*image.bytes).copied().collect();
        w.rows(s::RENDER_IMAGE_BYTES, &bytes);
    }
}

fn look(m: &RenderMaterial) -> [f32; LOOK] {
    let [r, g, b] = m.emission;
    let blending = match m.blending {
        Blending::Auto => AUTO,
        Blending::Blend => BLEND,
        Blending::Mask(least) => least,
    };
    [r, g, b, f32::from(u8::from(m.double_sided)), blending]
}

fn texture(material: u32, t: &Texture) -> [f32; TEXTURE] {
    let Placement {
        offset,
        rotation,
        scale,
    } = t.placement;
    [
        material as f32,
        f32::from(t.slot as u8),
        t.image as f32,
        t.uv_set as f32,
        f32::from(t.wrap[0] as u8),
        f32::from(t.wrap[1] as u8),
        f32::from(u8::from(t.is_pixelated)),
        t.strength,
        offset[0],
        offset[1],
        rotation,
        scale[0],
        scale[1],
    ]
}

/// The drawn surface, where the file has one: all of its sections or none.
pub(super) fn decode(r: &Reader<'_>) -> Result<Option<RenderSurface>, AssetFileError> {
    if !s::RENDER.iter().any(|&section| r.has(section)) {
        return Ok(None);
    }
    let positions: Vec<_> = r.rows(s::RENDER_POSITIONS)?;
    let more_uvs: Vec<[f32; 2]> = optional(r, s::RENDER_MORE_UVS)?;
    if !more_uvs.is_empty()
        && (positions.is_empty() || !more_uvs.len().is_multiple_of(positions.len()))
    {
        let problem = "is not a whole number of rows for each vertex";
        return Err(AssetFileError::section(s::RENDER_MORE_UVS.name, problem));
    }
    let name = if r.has(s::RENDER_NAME) {
        r.text(s::RENDER_NAME)?
    } else {
        ""
    };
    Ok(Some(RenderSurface {
        name: name.to_owned(),
        normals: r.rows(s::RENDER_NORMALS)?,
        uvs: r.rows(s::RENDER_UVS)?,
        more_uvs: more_uvs
            .chunks(positions.len().max(1))
            .map(<[_]>::to_vec)
            .collect(),
        colors: optional(r, s::RENDER_COLORS)?,
        srgb_colors: r.has(s::RENDER_SRGB_COLORS),
        triangles: r.rows(s::RENDER_TRIANGLES)?,
        material_of_triangle: r.rows(s::RENDER_MATERIAL_OF_TRIANGLE)?,
        materials: materials(r)?,
        images: images(r)?,
        positions,
    }))
}

/// The rows of a section; none if the file does not have it.
fn optional<T: super::row::Row>(
    r: &Reader<'_>,
    section: Section,
) -> Result<Vec<T>, AssetFileError> {
    match r.has(section) {
        true => r.rows(section),
        false => Ok(Vec::new()),
    }
}

fn materials(r: &Reader<'_>) -> Result<Vec<RenderMaterial>, AssetFileError> {
    let numbers = r.each::<[f32; 6]>(s::RENDER_MATERIALS)?;
    let lengths = r.rows::<u32>(s::RENDER_NAME_LENGTHS)?;
    let mut names = r.text(s::RENDER_NAMES)?;
    let fail = || {
        let problem = "does not divide the names among the materials";
        AssetFileError::section(s::RENDER_NAME_LENGTHS.name, problem)
    };
    if lengths.len() != numbers.len() || sum(&lengths) != names.len() as u64 {
        return Err(fail());
    }
    let materials = numbers
        .zip(&lengths)
        .map(|([r, g, b, a, metallic, roughness], &length)| {
            // No cut within a character.
            let (name, rest) = names.split_at_checked(length as usize).ok_or_else(fail)?;
            names = rest;
            Ok(RenderMaterial {
                name: name.to_owned(),
                base_color: [r, g, b, a],
                metallic,
                roughness,
                ..RenderMaterial::default()
            })
        });
    let mut materials = materials.collect::<Result<Vec<_>, AssetFileError>>()?;
    let looks: Vec<[f32; LOOK]> = optional(r, s::RENDER_LOOKS)?;
    if !looks.is_empty() && looks.len() != materials.len() {
        let problem = format!("has {} rows, not {}", looks.len(), materials.len());
        return Err(AssetFileError::section(s::RENDER_LOOKS.name, problem));
    }
    for (material, [red, green, blue, sides, blending]) in materials.iter_mut().zip(looks) {
        material.emission = [red, green, blue];
        material.double_sided = sides != 0.0;
        material.blending = match blending {
            AUTO => Blending::Auto,
            BLEND => Blending::Blend,
            least => Blending::Mask(least),
        };
    }
    for (row, numbers) in optional::<[f32; TEXTURE]>(r, s::RENDER_TEXTURES)?
        .iter()
        .enumerate()
    {
        let fail = || {
            let problem = format!("row {row} is no texture of a material");
            AssetFileError::section(s::RENDER_TEXTURES.name, problem)
        };
        let (material, texture) = placed(numbers).ok_or_else(fail)?;
        let material = materials.get_mut(material as usize).ok_or_else(fail)?;
        material.textures.push(texture);
    }
    Ok(materials)
}

/// The material of a texture, and the texture.
fn placed(numbers: &[f32; TEXTURE]) -> Option<(u32, Texture)> {
    let whole = |k: usize| {
        let number = numbers[k];
        let is_whole = (0.0..16_777_216.0).contains(&number) && number.fract() == 0.0;
        is_whole.then_some(number as u32)
    };
    let wrap = |k: usize| Wrap::ALL.get(whole(k)? as usize).copied();
    let texture = Texture {
        slot: *TextureSlot::ALL.get(whole(1)? as usize)?,
        image: whole(2)?,
        uv_set: whole(3)?,
        wrap: [wrap(4)?, wrap(5)?],
        is_pixelated: whole(6)? != 0,
        strength: numbers[7],
        placement: Placement {
            offset: [numbers[8], numbers[9]],
            rotation: numbers[10],
            scale: [numbers[11], numbers[12]],
        },
    };
    Some((whole(0)?, texture))
}

fn images(r: &Reader<'_>) -> Result<Vec<Image>, AssetFileError> {
    if !r.has(s::RENDER_IMAGES) {
        return Ok(Vec::new());
    }
    let (mut names, bytes) = (
        r.text(s::RENDER_IMAGE_NAMES)?,
        r.rows::<u8>(s::RENDER_IMAGE_BYTES)?,
    );
    let mut bytes = &bytes[..];
    let fail = || {
        let problem = "does not divide the names and bytes among the images";
        AssetFileError::section(s::RENDER_IMAGES.name, problem)
    };
    let image = |[kind, name, length]: [u32; 3]| {
        let own = names.split_at_checked(name as usize).ok_or_else(fail)?;
        let data = bytes.split_at_checked(length as usize).ok_or_else(fail)?;
        (names, bytes) = (own.1, data.1);
        Ok(Image {
            name: own.0.to_owned(),
            kind: *ImageKind::ALL.get(kind as usize).ok_or_else(fail)?,
            bytes: Arc::from(data.0),
        })
    };
    let images = r.each::<[u32; 3]>(s::RENDER_IMAGES)?.map(image);
    let images = images.collect::<Result<Vec<_>, AssetFileError>>()?;
    match (names, bytes) {
        ("", []) => Ok(images),
        _ => Err(fail()),
    }
}
