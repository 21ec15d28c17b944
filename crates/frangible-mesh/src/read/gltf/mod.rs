//! glTF 2.0, as JSON with buffers or as GLB, in its rest pose.

mod accessor;
mod buffers;
mod deform;
mod left_out;
mod material;
mod primitive;
mod scene;

use std::path::Path;

use gltf_json::{Root, Value};

use self::buffers::Buffers;
use self::primitive::{Meshes, Placed};
use self::scene::Instance;
use super::ReadError;
use super::text::shown;
use crate::{InputGroup, InputMesh};

/// Extensions that hide the geometry from a reader that does not know them. Others change only how it looks.
const UNREADABLE: [&str; 3] = [
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
];

pub(crate) fn parse(bytes: &[u8], folder: Option<&Path>) -> Result<InputMesh, ReadError> {
    let (json, blob) = if bytes.starts_with(b"glTF") {
        split_glb(bytes)?
    } else {
        (bytes, None)
    };
    if !json.trim_ascii_start().starts_with(b"{") {
        let problem = "the file is neither a GLB, which begins with “glTF”, nor a glTF, which begins with “{”";
        return Err(ReadError::malformed("the first bytes", problem));
    }
    let root: Root = gltf_json::deserialize::from_slice(json).map_err(|error| {
        other_version(json)
            .unwrap_or_else(|| ReadError::malformed("the JSON of the glTF", error.to_string()))
    })?;
    check_version(&root.asset.version)?;
    if let Some(extension) = root
        .extensions_required
        .iter()
        .find(|e| UNREADABLE.contains(&e.as_str()))
    {
        return Err(ReadError::Unsupported(format!(
            "the glTF extension {extension}"
        )));
    }
    let buffers = Buffers::read(&root, blob, folder)?;
    let mut meshes = Meshes::new(&root, &buffers);
    let mut groups = Vec::new();
    let instances = scene::instances(&root, &buffers)?;
    let worlds = match instances.iter().any(|instance| instance.skin.is_some()) {
        true => scene::worlds(&root)?,
        false => Vec::new(),
    };
    for Instance {
        mesh,
        transform,
        skin,
        node,
    } in instances
    {
        let first = meshes.mesh.triangles.len() as u32;
        let source = root.get(mesh);
        let joints = skin.map(|skin| deform::joints(&root, &buffers, skin, &worlds));
        let joints = joints.transpose()?;
        let own = node.and_then(|node| node.weights.as_deref());
        let placed = Placed {
            transform,
            weights: own
                .or(source.and_then(|mesh| mesh.weights.as_deref()))
                .unwrap_or_default(),
            joints: joints.as_deref(),
        };
        meshes.add(mesh, placed)?;
        let triangles = first..meshes.mesh.triangles.len() as u32;
        let names = [
            node.and_then(|node| node.name.as_deref()),
            source.and_then(|mesh| mesh.name.as_deref()),
        ];
        groups.extend(names.into_iter().flatten().map(|name| InputGroup {
            name: name.into(),
            triangles: triangles.clone(),
        }));
    }
    let pieces = pieces(&root);
    if pieces > 0 {
        return Err(ReadError::Pieces { pieces });
    }
    let mut mesh = meshes.mesh;
    mesh.groups = groups;
    material::read_materials(&root, &buffers, folder, &mut mesh);
    left_out::take_down(&root, &mut mesh);
    Ok(mesh)
}

fn check_version(version: &str) -> Result<(), ReadError> {
    if version.split('.').next() == Some("2") {
        return Ok(());
    }
    let version = shown(version.as_bytes());
    Err(ReadError::GltfVersion { version })
}

/// The error for JSON that cannot be read because it is another version's: 1.0 has its parts by name, not in lists.
fn other_version(json: &[u8]) -> Option<ReadError> {
    let json: Value = gltf_json::deserialize::from_slice(json).ok()?;
    let version = match json.get("asset").and_then(|asset| asset.get("version")) {
        Some(Value::String(version)) => version.clone(),
        Some(Value::Number(version)) => version.to_string(),
        _ if json.get("meshes")?.is_object() => "1.0".into(),
        _ => return None,
    };
    check_version(&version).err()
}

/// Number of pieces of bodies that a film of this project shows: they overlap where the body was whole, and are no body together.
fn pieces(root: &Root) -> usize {
    let generator = root.asset.generator.as_deref().unwrap_or_default();
    if !generator.starts_with("Frangible ") {
        return 0;
    }
    let names = root.meshes.iter().filter_map(|mesh| mesh.name.as_deref());
    names.filter(|name| name.contains(" piece ")).count()
}

/// The JSON and binary chunks of a GLB.
fn split_glb(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), ReadError> {
    let word = |at: usize| {
        bytes
            .get(at..at.checked_add(4)?)?
            .try_into()
            .ok()
            .map(u32::from_le_bytes)
    };
    let version = word(4).ok_or_else(|| ReadError::truncated("the GLB header"))?;
    if version != 2 {
        check_version(&format!("{version}.0"))?;
    }
    let chunk = |at: usize, kind: &[u8]| {
        let length = word(at)? as usize;
        (bytes.get(at + 4..at + 8)? == kind).then_some(length)
    };
    let Some(length) = chunk(12, b"JSON") else {
        return Err(ReadError::malformed(
            "the GLB",
            "its first chunk is not JSON",
        ));
    };
    let json = bytes
        .get(20..20 + length)
        .ok_or_else(|| ReadError::truncated("the JSON chunk"))?;
    let start = 20 + length;
    let blob = match chunk(start, b"BIN\0") {
        Some(length) => Some(
            bytes
                .get(start + 8..start + 8 + length)
                .ok_or_else(|| ReadError::truncated("the binary chunk"))?,
        ),
        None => None,
    };
    Ok((json, blob))
}
