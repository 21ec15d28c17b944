//! Parts of a glTF that are not kept, for the note on the file.

use gltf_json::Root;
use gltf_json::mesh::Semantic;
use gltf_json::validation::Checked;

use super::material::{EMISSIVE_STRENGTH, TEXTURE_TRANSFORM};
use super::primitive::UV_SETS;
use super::scene::INSTANCING;
use crate::InputMesh;

/// Extensions whose contents are kept, or need not be.
const KEPT: [&str; 4] = [
    INSTANCING,
    TEXTURE_TRANSFORM,
    EMISSIVE_STRENGTH,
    "KHR_mesh_quantization",
];

/// Takes down what the file has beside its meshes, materials and images.
pub(super) fn take_down(root: &Root, mesh: &mut InputMesh) {
    for (is_there, what) in [
        (!root.animations.is_empty(), "animations"),
        (!root.cameras.is_empty(), "cameras"),
        (
            !root.skins.is_empty(),
            "the skeleton, which stands as its nodes do",
        ),
    ] {
        if is_there {
            mesh.leave_out(what);
        }
    }
    for extension in &root.extensions_used {
        if !KEPT.contains(&extension.as_str()) {
            mesh.leave_out(format!("the extension {extension}"));
        }
    }
    let extras = [
        root.nodes.iter().any(|node| node.extras.is_some()),
        root.meshes.iter().any(|mesh| mesh.extras.is_some()),
        root.materials
            .iter()
            .any(|material| material.extras.is_some()),
    ];
    if extras.contains(&true) {
        mesh.leave_out("extras");
    }
    for primitive in root.meshes.iter().flat_map(|mesh| &mesh.primitives) {
        if primitive.targets.iter().flatten().next().is_some() {
            mesh.leave_out("morph targets, which stand at their weights");
        }
        for attribute in primitive.attributes.keys() {
            match attribute {
                Checked::Valid(Semantic::Tangents) => mesh.leave_out("tangents"),
                Checked::Valid(Semantic::Colors(1..)) => mesh.leave_out("further vertex colours"),
                Checked::Valid(Semantic::TexCoords(UV_SETS..)) => {
                    mesh.leave_out(format!("texture coordinates beyond {UV_SETS} sets"));
                }
                Checked::Valid(Semantic::Extras(name)) => {
                    mesh.leave_out(format!("the vertex attribute _{name}"));
                }
                Checked::Invalid => mesh.leave_out("a vertex attribute of no known name"),
                Checked::Valid(_) => {}
            }
        }
    }
}
