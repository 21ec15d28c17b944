//! Meshes that a scene shows, and their transforms.

use glam::{DMat4, DQuat, DVec3, DVec4};
use gltf_json::scene::Node;
use gltf_json::{Index, Mesh, Root, Skin};

use super::accessor::{read, row_count};
use super::buffers::Buffers;
use crate::read::{ReadError, check_vertices};

/// Extension that draws a mesh many times.
pub(super) const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// A mesh that is shown.
pub(super) struct Instance<'a> {
    pub(super) mesh: Index<Mesh>,
    /// Transform into the world. That of the node is ignored if the mesh has a skin, as the format says.
    pub(super) transform: DMat4,
    pub(super) skin: Option<Index<Skin>>,
    /// Node that shows it.
    pub(super) node: Option<&'a Node>,
}

/// Every mesh of the default scene with its transform into the world. Without a scene, all nodes that are no child of
/// another; without nodes, each mesh once.
pub(super) fn instances<'a>(
    root: &'a Root,
    buffers: &Buffers,
) -> Result<Vec<Instance<'a>>, ReadError> {
    if root.nodes.is_empty() {
        let meshes = 0..root.meshes.len() as u32;
        return Ok(meshes
            .map(|i| Instance {
                mesh: Index::new(i),
                transform: DMat4::IDENTITY,
                skin: None,
                node: None,
            })
            .collect());
    }
    let mut instances = Vec::new();
    walk(root, shown(root), &mut |i, node, world| {
        let Some(mesh) = node.mesh else {
            return Ok(());
        };
        let transforms = match node.skin {
            Some(_) => vec![DMat4::IDENTITY],
            None => copies(root, buffers, i, node)?,
        };
        check_vertices((instances.len() + transforms.len()) as u64)?;
        instances.extend(transforms.into_iter().map(|copy| Instance {
            mesh,
            transform: if node.skin.is_some() {
                copy
            } else {
                world * copy
            },
            skin: node.skin,
            node: Some(node),
        }));
        Ok(())
    })?;
    Ok(instances)
}

/// Transforms of all nodes into the world, in their order.
pub(super) fn worlds(root: &Root) -> Result<Vec<DMat4>, ReadError> {
    let mut worlds = vec![DMat4::IDENTITY; root.nodes.len()];
    walk(root, tops(root), &mut |i, _, world| {
        worlds[i] = world;
        Ok(())
    })?;
    Ok(worlds)
}

/// Visits the nodes below some, in their order, with their transforms into the world.
fn walk<'a>(
    root: &'a Root,
    from: Vec<usize>,
    visit: &mut dyn FnMut(usize, &'a Node, DMat4) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    let mut open: Vec<(usize, DMat4)> = from.iter().map(|&i| (i, DMat4::IDENTITY)).collect();
    open.reverse();
    let mut seen = vec![false; root.nodes.len()];
    while let Some((i, above)) = open.pop() {
        let bad = |problem: &str| ReadError::malformed(format!("node {i}"), problem);
        let node = root.nodes.get(i).ok_or_else(|| bad("it does not exist"))?;
        if std::mem::replace(&mut seen[i], true) {
            return Err(bad(
                "it occurs twice in the scene; a node may have only one parent",
            ));
        }
        let transform = above * local(node);
        visit(i, node, transform)?;
        let children = node.children.as_deref().unwrap_or_default();
        open.extend(
            children
                .iter()
                .rev()
                .map(|child| (child.value(), transform)),
        );
    }
    Ok(())
}

/// Transforms of the copies of a node's mesh in its frame: one, unless it is drawn many times.
fn copies(root: &Root, buffers: &Buffers, i: usize, node: &Node) -> Result<Vec<DMat4>, ReadError> {
    let extension = node
        .extensions
        .as_ref()
        .and_then(|all| all.others.get(INSTANCING));
    let Some(extension) = extension else {
        return Ok(vec![DMat4::IDENTITY]);
    };
    let bad = |problem: &str| ReadError::malformed(format!("node {i}, {INSTANCING}"), problem);
    let attribute = |name: &str| {
        let value = extension.get("attributes")?.get(name)?;
        let number = value.as_u64().and_then(|n| u32::try_from(n).ok());
        Some(
            number
                .map(Index::new)
                .ok_or_else(|| bad("an accessor is not a number")),
        )
    };
    let [translations, rotations, scales] =
        ["TRANSLATION", "ROTATION", "SCALE"].map(|name| attribute(name).transpose());
    let (translations, rotations, scales) = (translations?, rotations?, scales?);
    let given = [translations, rotations, scales];
    let mut counts = given.into_iter().flatten().map(|at| row_count(root, at));
    let count = counts.next().unwrap_or(Ok(1))?;
    for other in counts {
        if other? != count {
            return Err(bad("its attributes differ in length"));
        }
    }
    let translations = translations
        .map(|at| read::<3>(root, buffers, at))
        .transpose()?;
    let rotations = rotations
        .map(|at| read::<4>(root, buffers, at))
        .transpose()?;
    let scales = scales.map(|at| read::<3>(root, buffers, at)).transpose()?;
    let vector = |list: &Option<Vec<[f64; 3]>>, k: usize, other| {
        list.as_ref().map_or(other, |list| DVec3::from(list[k]))
    };
    let copy = |k: usize| {
        DMat4::from_scale_rotation_translation(
            vector(&scales, k, DVec3::ONE),
            rotations
                .as_ref()
                .map_or(DQuat::IDENTITY, |list| turn(list[k])),
            vector(&translations, k, DVec3::ZERO),
        )
    };
    Ok((0..count).map(copy).collect())
}

/// Nodes from which the default scene begins.
fn shown(root: &Root) -> Vec<usize> {
    let scene = match root.scene {
        Some(scene) => root.get(scene),
        None => root.scenes.first(),
    };
    match scene {
        Some(scene) => scene.nodes.iter().map(|node| node.value()).collect(),
        None => tops(root),
    }
}

/// Nodes that are no child of another.
fn tops(root: &Root) -> Vec<usize> {
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
    DMat4::from_scale_rotation_translation(
        node.scale.map_or(DVec3::ONE, vector),
        node.rotation
            .map_or(DQuat::IDENTITY, |q| turn(q.0.map(f64::from))),
        node.translation.map_or(DVec3::ZERO, vector),
    )
}

/// Rotation of a quaternion that may not have unit length.
fn turn(q: [f64; 4]) -> DQuat {
    DVec4::from(q)
        .try_normalize()
        .map_or(DQuat::IDENTITY, DQuat::from_vec4)
}
