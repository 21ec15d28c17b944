//! Meshes that a scene shows, and their transforms.

use glam::{DMat4, DQuat, DVec3};
use gltf_json::scene::Node;
use gltf_json::{Index, Mesh, Root};

use crate::read::ReadError;

/// A mesh that is shown.
pub(super) struct Instance<'a> {
    pub(super) mesh: Index<Mesh>,
    /// Transform into the world.
    pub(super) transform: DMat4,
    /// Name of the node that shows it.
    pub(super) node: Option<&'a str>,
}

/// Every mesh of the default scene with its transform into the world. Without a scene, all nodes that are no child of
/// another; without nodes, each mesh once.
pub(super) fn instances(root: &Root) -> Result<Vec<Instance<'_>>, ReadError> {
    if root.nodes.is_empty() {
        let meshes = 0..root.meshes.len() as u32;
        return Ok(meshes
            .map(|i| Instance {
                mesh: Index::new(i),
                transform: DMat4::IDENTITY,
                node: None,
            })
            .collect());
    }
    let mut open: Vec<(usize, DMat4)> = Vec::new();
    for node in roots(root) {
        open.push((node, DMat4::IDENTITY));
    }
    open.reverse();
    let mut seen = vec![false; root.nodes.len()];
    let mut instances = Vec::new();
    while let Some((i, above)) = open.pop() {
        let bad = |problem: &str| ReadError::malformed(format!("node {i}"), problem);
        let node = root.nodes.get(i).ok_or_else(|| bad("it does not exist"))?;
        if std::mem::replace(&mut seen[i], true) {
            return Err(bad(
                "it occurs twice in the scene; a node may have only one parent",
            ));
        }
        let transform = above * local(node);
        instances.extend(node.mesh.map(|mesh| Instance {
            mesh,
            transform,
            node: node.name.as_deref(),
        }));
        let children = node.children.as_deref().unwrap_or_default();
        open.extend(
            children
                .iter()
                .rev()
                .map(|child| (child.value(), transform)),
        );
    }
    Ok(instances)
}

fn roots(root: &Root) -> Vec<usize> {
    let scene = match root.scene {
        Some(scene) => root.get(scene),
        None => root.scenes.first(),
    };
    if let Some(scene) = scene {
        return scene.nodes.iter().map(|node| node.value()).collect();
    }
    let mut is_child = vec![false; root.nodes.len()];
    for child in root
        .nodes
        .iter()
        .flat_map(|node| node.children.iter().flatten())
    {
        if let Some(flag) = is_child.get_mut(child.value()) {
            *flag = true;
        }
    }
    (0..is_child.len()).filter(|&i| !is_child[i]).collect()
}

fn local(node: &Node) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    let scale = node.scale.map_or(DVec3::ONE, vector);
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |q| {
        let q = glam::DVec4::from(q.0.map(f64::from));
        q.try_normalize().map_or(DQuat::IDENTITY, DQuat::from_vec4)
    });
    DMat4::from_scale_rotation_translation(
        scale,
        rotation,
        node.translation.map_or(DVec3::ZERO, vector),
    )
}
