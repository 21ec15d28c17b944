//! Draws a made-up break: a stack of cubes topples, a glass cylinder comes
//! apart. `cargo run --release -p frangible-draw --example demo_sheet OUT.png`

use std::f32::consts::TAU;

use frangible_draw::{SheetOptions, contact_sheet, encode_png};
use frangible_export::glam::{Quat, Vec3};
use frangible_export::{
    Floor, MeshPart, Moments, Pose, RecordedMesh, RecordedNode, Recording, SurfaceMaterial, View,
    write_atomically, write_glb,
};

const FRAMES: usize = 60;
const WEDGES: usize = 7;

/// A prism over a polygon given counter-clockwise from above; sides listed in
/// `outer` are outside, the others and nothing else are broken faces.
fn prism(name: &str, base: &[(f32, f32)], height: f32, surface: usize, outer: &[usize]) -> RecordedMesh {
    let mut mesh = RecordedMesh { name: name.into(), ..RecordedMesh::default() };
    let mut parts = [surface, surface + 1].map(|surface| MeshPart { surface, indices: vec![] });
    let mut face = |corners: Vec<Vec3>, part: usize| {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let start = mesh.positions.len() as u32;
        mesh.normals.extend(corners.iter().map(|_| normal));
        for i in 2..corners.len() as u32 {
            parts[part].indices.extend([start, start + i - 1, start + i]);
        }
        mesh.positions.extend(corners);
    };
    let at = |i: usize, y: f32| Vec3::new(base[i % base.len()].0, y, -base[i % base.len()].1);
    face((0..base.len()).map(|i| at(i, height)).collect(), 0);
    face((0..base.len()).rev().map(|i| at(i, 0.0)).collect(), 0);
    for i in 0..base.len() {
        let side = vec![at(i, 0.0), at(i + 1, 0.0), at(i + 1, height), at(i, height)];
        face(side, usize::from(!outer.contains(&i)));
    }
    mesh.parts = parts.into();
    mesh
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let surface = |name: &str, color, roughness, transmission| SurfaceMaterial {
        name: name.into(), base_color: color, roughness, transmission, ..Default::default()
    };
    let mut recording = Recording {
        name: "demo".into(), frame_rate: 60.0, frame_count: FRAMES,
        surfaces: vec![
            surface("glaze", [0.75, 0.12, 0.06, 1.0], 0.25, 0.0),
            surface("clay", [0.72, 0.55, 0.40, 1.0], 0.9, 0.0),
            surface("glass", [0.80, 0.93, 0.88, 1.0], 0.05, 0.9),
            surface("glass edge", [0.30, 0.62, 0.50, 1.0], 0.12, 0.75),
        ],
        floor: Some(Floor::default()),
        camera: View { eye: Vec3::new(0.25, 0.3, 0.55), target: Vec3::new(0.0, 0.05, 0.0), ..View::default() },
        moments: Moments { before: 0, first_crack: 11, just_after: 22, at_rest: 59 },
        ..Recording::default()
    };
    let mut add = |mesh, pose: &dyn Fn(f32) -> Pose| {
        let poses = (0..FRAMES).map(|frame| pose((frame as f32 / 40.0 - 0.25).clamp(0.0, 1.0)));
        let node = RecordedNode { mesh: recording.meshes.len(), poses: poses.collect(), visible: 0..FRAMES, ..Default::default() };
        recording.nodes.push(node);
        recording.meshes.push(mesh);
    };
    for i in 0..3 {
        let square = [(-0.02, -0.02), (0.02, -0.02), (0.02, 0.02), (-0.02, 0.02)];
        let level = i as f32;
        add(prism("cube", &square, 0.04, 0, &[0, 1]), &|t| Pose {
            translation: Vec3::new(-0.1 - 0.05 * level * t, 0.04 * level * (1.0 - t * t), 0.0),
            rotation: Quat::from_rotation_y(0.5 * level + t * level),
        });
    }
    for i in 0..WEDGES {
        let angle = |i: f32| TAU * i / WEDGES as f32;
        let rim = (0..=6).map(|k| angle(i as f32 + k as f32 / 6.0));
        let base: Vec<_> = rim.map(|a| (0.05 * a.cos(), 0.05 * a.sin())).chain([(0.0, 0.0)]).collect();
        let out = Vec3::new(angle(i as f32 + 0.5).cos(), 0.0, -angle(i as f32 + 0.5).sin());
        add(prism("wedge", &base, 0.1, 2, &[0, 1, 2, 3, 4, 5]), &|t| Pose {
            translation: Vec3::new(0.06, 0.0, 0.0) + out * 0.06 * t,
            rotation: Quat::from_axis_angle(Vec3::Y.cross(out), 1.2 * t * t),
        });
    }
    let path = std::env::args().nth(1).unwrap_or("demo_sheet.png".into());
    let picture = encode_png(&contact_sheet(&recording, &SheetOptions::default())?)?;
    write_atomically(path.as_ref(), &picture)?;
    write_atomically(format!("{path}.glb").as_ref(), &write_glb(&recording)?)?;
    Ok(())
}
