//! Triangle meshes.

use std::collections::BTreeMap;

use glam::Vec3;
use gltf_json as json;
use json::buffer::Target::ArrayBuffer;
use json::mesh::{Mode, Primitive, Semantic};
use json::validation::Checked::Valid;

use serde_json::value::{RawValue, to_raw_value};

use super::binary::{push_indices, push_rows};
use super::quantized::{Dequantized, push_colors, push_normals, push_positions};
use crate::ExportError;
use frangible_recording::{Grain, RecordedMesh, SurfaceMaterial};

/// A mesh of the file, and its place in its node, if its positions are quantised.
pub(super) type Pushed = (json::Index<json::Mesh>, Option<Dequantized>);

/// Adds a mesh: one primitive per part, all on the same vertices. `None` if it
/// has no triangle, as glTF knows no empty mesh. Primitives of marked crack faces have the marks as the attribute `_MARK`.
pub(super) fn push_mesh(
    root: &mut json::Root,
    binary: &mut Vec<u8>,
    mesh: &RecordedMesh,
    surfaces: &[SurfaceMaterial],
    is_quantized: bool,
) -> Result<Option<Pushed>, ExportError> {
    if mesh.parts.iter().all(|part| part.indices.is_empty()) {
        return Ok(None);
    }
    // A normal that is not of unit length makes the whole file invalid.
    let normals: Vec<_> = mesh
        .normals
        .iter()
        .map(|normal| normal.try_normalize().unwrap_or(Vec3::Y).to_array())
        .collect();
    let (positions, place) = if is_quantized {
        let (positions, place) = push_positions(root, binary, &mesh.positions);
        (positions, Some(place))
    } else {
        let rows: Vec<_> = mesh.positions.iter().map(|p| p.to_array()).collect();
        let positions = push_rows(root, binary, &rows, Some(ArrayBuffer), true);
        (positions, None)
    };
    let normals = if is_quantized {
        push_normals(root, binary, &normals)
    } else {
        push_rows(root, binary, &normals, Some(ArrayBuffer), false)
    };
    let uvs = (!mesh.uvs.is_empty())
        .then(|| push_rows(root, binary, &mesh.uvs, Some(ArrayBuffer), false));
    let more_uvs: Vec<_> = (mesh.more_uvs.iter())
        .map(|uvs| push_rows(root, binary, uvs, Some(ArrayBuffer), false))
        .collect();
    let colors = (!mesh.colors.is_empty()).then(|| match is_quantized {
        true => push_colors(root, binary, &mesh.colors),
        false => push_rows(root, binary, &mesh.colors, Some(ArrayBuffer), false),
    });
    let marks = (!mesh.marks.is_empty())
        .then(|| push_rows(root, binary, &mesh.marks, Some(ArrayBuffer), false));
    let mut primitives = Vec::with_capacity(mesh.parts.len());
    for part in mesh.parts.iter().filter(|part| !part.indices.is_empty()) {
        let surface = surfaces.get(part.surface);
        let indices = push_indices(root, binary, &part.indices, mesh.positions.len());
        let mut attributes = BTreeMap::from([
            (Valid(Semantic::Positions), positions),
            (Valid(Semantic::Normals), normals),
        ]);
        let sets = uvs.into_iter().chain(more_uvs.iter().copied());
        attributes.extend((0..).map(|set| Valid(Semantic::TexCoords(set))).zip(sets));
        attributes.extend(colors.map(|colors| (Valid(Semantic::Colors(0)), colors)));
        let is_marked = surface.is_some_and(|s| s.grain == Grain::Marked);
        let marks = marks.filter(|_| is_marked);
        attributes.extend(marks.map(|marks| (Valid(Semantic::Extras("MARK".into())), marks)));
        primitives.push(Primitive {
            attributes,
            extensions: None,
            extras: surface.filter(|s| s.ends_inside).map(mark).transpose()?,
            indices: Some(indices),
            material: Some(json::Index::new(part.surface as u32)),
            mode: Valid(Mode::Triangles),
            targets: None,
        });
    }
    let mesh = root.push(json::Mesh {
        extensions: None,
        extras: None,
        name: Some(mesh.name.clone()),
        primitives,
        weights: None,
    });
    Ok(Some((mesh, place)))
}

/// The mark of a primitive that a closed body does not need.
fn mark(surface: &SurfaceMaterial) -> Result<Box<RawValue>, serde_json::Error> {
    to_raw_value(&serde_json::json!({ "name": surface.name, "ends_inside": true }))
}
