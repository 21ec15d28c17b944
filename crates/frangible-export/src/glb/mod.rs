//! A recording as one binary glTF 2.0 file.
//!
//! A viewer finds inside:
//!
//! * a node per [`RecordedNode`](crate::RecordedNode), in the same order, with
//!   its numbers as `extras`; then the floor and the camera, if any;
//! * one animation, `break`: translation and rotation interpolated linearly,
//!   and the time a node is to be seen told by its scale, 1 or 0, in steps.
//!   Scale is the one switch that every viewer and Blender honour;
//! * a material per surface, with `KHR_materials_transmission` and
//!   `KHR_materials_ior` where they say something, and the images of its
//!   textures;
//! * a primitive per surface of a mesh. Cracks that end inside a body have
//!   primitives of their own, with `extras` that say so:
//!   `{"name": …, "ends_inside": true}`.
//!
//! Nothing in the file depends on the time, the machine or hashing: the same
//! recording gives the same bytes.

mod animation;
mod binary;
mod material;
mod mesh;
mod quantized;
mod scene;
mod texture;

use gltf_json as json;

use crate::ExportError;
use frangible_recording::Recording;

const MAGIC: u32 = 0x4654_6C67; // "glTF"
const VERSION: u32 = 2;
const CHUNK_JSON: u32 = 0x4E4F_534A; // "JSON"
const CHUNK_BINARY: u32 = 0x004E_4942; // "BIN\0"

/// Options of [`write_glb_with`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct GlbOptions {
    /// If true, positions have 16 bits, each at most 8 millionths of its mesh's longest side off, normals 8 and colours 16 bits. Readers need the
    /// extension `KHR_mesh_quantization`. Default false: 32 bits.
    pub quantized: bool,
}

/// Writes a recording as a binary glTF 2.0 file (`.glb`), vertices in full precision.
///
/// # Errors
///
/// [`ExportError::Recording`] if the recording does not validate,
/// [`ExportError::TooLarge`] beyond 4 GiB.
pub fn write_glb(recording: &Recording) -> Result<Vec<u8>, ExportError> {
    write_glb_with(recording, &GlbOptions::default())
}

/// Writes a recording as a binary glTF 2.0 file (`.glb`).
///
/// # Errors
///
/// [`ExportError::Recording`] if the recording does not validate,
/// [`ExportError::TooLarge`] beyond 4 GiB.
pub fn write_glb_with(recording: &Recording, options: &GlbOptions) -> Result<Vec<u8>, ExportError> {
    recording.validate()?;
    let mut root = json::Root {
        asset: json::Asset {
            generator: Some(concat!("Frangible ", env!("CARGO_PKG_VERSION")).into()),
            ..json::Asset::default()
        },
        ..json::Root::default()
    };
    let mut binary = Vec::new();
    material::push_materials(&mut root, &mut binary, recording);
    scene::push_scene(&mut root, &mut binary, recording, options)?;
    if options.quantized {
        for list in [&mut root.extensions_used, &mut root.extensions_required] {
            list.push(quantized::QUANTIZATION.into());
        }
    }
    animation::push_animation(&mut root, &mut binary, recording);
    if !binary.is_empty() {
        root.buffers.push(json::Buffer {
            byte_length: binary.len().into(),
            name: None,
            uri: None,
            extensions: None,
            extras: None,
        });
    }
    container(root.to_vec()?, binary)
}

/// Wraps the two chunks; each starts and ends on a multiple of four bytes.
fn container(mut description: Vec<u8>, mut binary: Vec<u8>) -> Result<Vec<u8>, ExportError> {
    description.resize(description.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let binary_chunk = if binary.is_empty() {
        0
    } else {
        8 + binary.len()
    };
    let bytes = 12 + 8 + description.len() + binary_chunk;
    let length = u32::try_from(bytes).map_err(|_| ExportError::TooLarge { bytes })?;
    let mut file = Vec::with_capacity(bytes);
    let words = |file: &mut Vec<u8>, words: &[u32]| {
        file.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    };
    words(&mut file, &[MAGIC, VERSION, length]);
    // Both chunks are shorter than the file, whose length fits.
    words(&mut file, &[description.len() as u32, CHUNK_JSON]);
    file.append(&mut description);
    if !binary.is_empty() {
        words(&mut file, &[binary.len() as u32, CHUNK_BINARY]);
        file.append(&mut binary);
    }
    Ok(file)
}
