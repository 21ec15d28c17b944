//! Nodes: the recorded things, the floor, the camera.

use std::collections::BTreeMap;

use glam::{Mat3, Quat, Vec3};
use gltf_json as json;
use json::extensions::scene::khr_lights_punctual::{KhrLightsPunctual, Light, Type};
use json::scene::UnitQuaternion;
use json::validation::Checked::Valid;

use super::GlbOptions;
use super::mesh::{Pushed, push_mesh};
use crate::ExportError;
use frangible_recording::{Floor, MeshPart, RecordedMesh, RecordedNode, Recording, View};

/// Adds meshes and nodes; recorded nodes come first and keep their order, so
/// that the animation finds them by index.
pub(super) fn push_scene(
    root: &mut json::Root,
    binary: &mut Vec<u8>,
    recording: &Recording,
    options: &GlbOptions,
) -> Result<(), ExportError> {
    let meshes: Vec<_> = recording
        .meshes
        .iter()
        .map(|mesh| {
            let surfaces = &recording.surfaces;
            push_mesh(root, binary, mesh, surfaces, options.quantized)
        })
        .collect::<Result<_, _>>()?;
    let mut nodes = Vec::with_capacity(recording.nodes.len() + 2);
    for node in &recording.nodes {
        nodes.push(root.push(recorded_node(node, meshes[node.mesh])?));
    }
    place_quantized(root, recording, &meshes);
    let (center, radius) = recording.bounding_sphere();
    if let Some(floor) = &recording.floor {
        let mesh = push_mesh(
            root,
            binary,
            &floor_mesh(floor, recording.surfaces.len(), radius),
            &[],
            false,
        )?;
        let mesh = mesh.map(|(mesh, _)| mesh);
        nodes.push(root.push(json::Node {
            mesh,
            name: Some("floor".into()),
            translation: Some([center.x, floor.height, center.z]),
            ..Default::default()
        }));
    }
    nodes.push(push_camera(root, &recording.camera, center, radius));
    nodes.extend(push_lights(root, &recording.camera));
    let scene = root.push(json::Scene {
        extensions: None,
        extras: None,
        name: Some(recording.name.clone()),
        nodes,
    });
    root.scene = Some(scene);
    Ok(())
}

/// Adds a node below each that shows a quantised mesh, with the mesh and its place: the scale of the node itself says when it is seen.
fn place_quantized(root: &mut json::Root, recording: &Recording, meshes: &[Option<Pushed>]) {
    for (i, node) in recording.nodes.iter().enumerate() {
        let Some((mesh, Some(place))) = meshes[node.mesh] else {
            continue;
        };
        let child = root.push(json::Node {
            mesh: Some(mesh),
            name: Some(node.name.clone()),
            translation: Some(place.center.to_array()),
            scale: Some([place.scale; 3]),
            ..Default::default()
        });
        root.nodes[i].children = Some(vec![child]);
    }
}

fn recorded_node(node: &RecordedNode, mesh: Option<Pushed>) -> Result<json::Node, ExportError> {
    // A quantised mesh has a node of its own below.
    let mesh = mesh.and_then(|(mesh, place)| place.is_none().then_some(mesh));
    // Viewers that play no animation show a node where it first appears, and
    // only if it is there in the first frame.
    let first = node.visible.start.min(node.poses.len() - 1);
    let pose = node.poses[first];
    let hidden = node.visible.is_empty() || node.visible.start > 0;
    let extras: BTreeMap<&str, f64> = node
        .keep_extras
        .iter()
        .map(|(key, value)| (key.as_str(), *value))
        .collect();
    let extras = (!extras.is_empty()).then(|| serde_json::value::to_raw_value(&extras));
    Ok(json::Node {
        mesh,
        name: Some(node.name.clone()),
        translation: Some(pose.translation.to_array()),
        rotation: Some(UnitQuaternion(pose.rotation.normalize().to_array())),
        scale: hidden.then_some([0.0; 3]),
        extras: extras.transpose()?,
        ..Default::default()
    })
}

/// A square that reaches beyond everything that moves.
fn floor_mesh(floor: &Floor, surface: usize, radius: f32) -> RecordedMesh {
    debug_assert!(floor.height.is_finite());
    let half = 2.0 * radius.max(1e-3);
    let corner = |x: f32, z: f32| Vec3::new(x * half, 0.0, z * half);
    RecordedMesh {
        name: "floor".into(),
        positions: vec![
            corner(-1.0, -1.0),
            corner(-1.0, 1.0),
            corner(1.0, 1.0),
            corner(1.0, -1.0),
        ],
        normals: vec![Vec3::Y; 4],
        parts: vec![MeshPart {
            surface,
            indices: vec![0, 1, 2, 0, 2, 3],
        }],
        ..RecordedMesh::default()
    }
}

fn push_camera(
    root: &mut json::Root,
    view: &View,
    center: Vec3,
    radius: f32,
) -> json::Index<json::Node> {
    let distance = view.eye.distance(center);
    let far = 10.0 * (distance + radius);
    let camera = root.push(json::Camera {
        name: Some("view".into()),
        orthographic: None,
        perspective: Some(json::camera::Perspective {
            aspect_ratio: None,
            yfov: view.vertical_fov,
            zfar: Some(far),
            // The widest range that 24 bits of depth resolve to a thousandth.
            znear: far * 1e-4,
            extensions: None,
            extras: None,
        }),
        type_: Valid(json::camera::Type::Perspective),
        extensions: None,
        extras: None,
    });
    root.push(json::Node {
        camera: Some(camera),
        name: Some("view".into()),
        translation: Some(view.eye.to_array()),
        rotation: Some(facing(view.eye - view.target, view.up)),
        ..Default::default()
    })
}

/// The turn of a camera or light, which look along their −z axis, away from this direction.
fn facing(backward: Vec3, up: Vec3) -> UnitQuaternion {
    let backward = backward.normalize();
    let right = up.cross(backward).normalize();
    let turn = Quat::from_mat3(&Mat3::from_cols(right, backward.cross(right), backward));
    UnitQuaternion(turn.normalize().to_array())
}

/// A key light from the upper left of the camera, a weak fill from the right and a rim from behind, all far away.
fn push_lights(root: &mut json::Root, view: &View) -> [json::Index<json::Node>; 3] {
    let away = view.eye - view.target;
    let backward = Vec3::new(away.x, 0.0, away.z).normalize_or(Vec3::Z);
    let right = Vec3::Y.cross(backward);
    root.extensions_used.push("KHR_lights_punctual".into());
    let lights = [
        ("key", [-3.4, 4.6, 2.4], [1.0, 0.97, 0.93], 3.0),
        ("fill", [4.0, 2.0, 2.5], [0.86, 0.92, 1.0], 1.0),
        ("rim", [2.0, 2.0, -5.0], [1.0; 3], 1.5),
    ];
    lights.map(|(name, [along, up, back], color, intensity)| {
        let light = root.push(Light {
            color,
            extensions: None,
            extras: None,
            intensity,
            name: Some(name.into()),
            range: None,
            spot: None,
            type_: Valid(Type::Directional),
        });
        root.push(json::Node {
            name: Some(name.into()),
            rotation: Some(facing(
                along * right + up * Vec3::Y + back * backward,
                Vec3::Y,
            )),
            extensions: Some(json::extensions::scene::Node {
                khr_lights_punctual: Some(KhrLightsPunctual { light }),
                ..Default::default()
            }),
            ..Default::default()
        })
    })
}
