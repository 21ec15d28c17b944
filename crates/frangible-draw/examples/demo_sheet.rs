//! A made-up break, drawn and exported: a porcelain cube tumbles while a glass
//! cylinder comes apart into wedges.
//! `cargo run --release -p frangible-draw --example demo_sheet -- OUT.png`

use std::f32::consts::TAU;

use frangible_draw::{SheetOptions, contact_sheet, encode_png};
use frangible_export::glam::{Quat, Vec3};
use frangible_export::{
    Floor, MeshPart, Moments, Pose, RecordedMesh, RecordedNode, Recording, SurfaceMaterial, View,
    write_atomically, write_glb,
};

const FRAMES: usize = 60;
const WEDGES: usize = 7;

/// A prism on the corners given, counter-clockwise from above. The first `outer`
/// sides, top and bottom take the surface given, broken sides the next one.
fn prism(base: &[Vec3], outer: usize, surface: usize) -> RecordedMesh {
    let mut mesh = RecordedMesh::default();
    let mut face = |corners: Vec<Vec3>, surface| {
        let normal = (corners[1] - corners[0])
            .cross(corners[2] - corners[0])
            .normalize();
        let (start, end) = (mesh.positions.len() as u32, corners.len() as u32);
        let indices = (2..end)
            .flat_map(|i| [start, start + i - 1, start + i])
            .collect();
        mesh.normals.extend(corners.iter().map(|_| normal));
        mesh.positions.extend(corners);
        mesh.parts.push(MeshPart { surface, indices });
    };
    let up = 0.1 * Vec3::Y;
    face(base.iter().map(|&corner| corner + up).collect(), surface);
    face(base.iter().rev().copied().collect(), surface);
    for i in 0..base.len() {
        let (a, b) = (base[i], base[(i + 1) % base.len()]);
        face(
            vec![a, b, b + up, a + up],
            surface + usize::from(i >= outer),
        );
    }
    mesh
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let surface = |name: &str, [r, g, b]: [f32; 3], roughness, transmission| {
        let (name, base_color) = (name.into(), [r, g, b, 1.0]);
        SurfaceMaterial {
            name,
            base_color,
            roughness,
            transmission,
            ..Default::default()
        }
    };
    let mut recording = Recording {
        name: "demo".into(),
        frame_rate: 60.0,
        frame_count: FRAMES,
        surfaces: vec![
            surface("porcelain", [0.86, 0.85, 0.82], 0.2, 0.0),
            surface("clay", [0.75, 0.45, 0.25], 0.9, 0.0),
            surface("glass", [0.80, 0.93, 0.88], 0.05, 0.9),
            surface("glass edge", [0.30, 0.62, 0.50], 0.12, 0.75),
        ],
        floor: Some(Floor::default()),
        camera: View {
            eye: Vec3::new(0.2, 0.3, 0.55),
            target: 0.04 * Vec3::Y,
            ..View::default()
        },
        moments: Moments {
            before: 0,
            first_crack: 17,
            just_after: 30,
            at_rest: 59,
        },
        ..Recording::default()
    };
    let on_circle = |angle: f32| Vec3::new(angle.cos(), 0.0, -angle.sin());
    let mut add = |mesh, start: Vec3, out: Vec3| {
        let pose = |time: f32| Pose {
            translation: start + 0.06 * time * out,
            rotation: Quat::from_axis_angle(Vec3::Y.cross(out), 1.3 * time * time),
        };
        let poses = (0..FRAMES)
            .map(|f| pose((f as f32 / 40.0 - 0.4).clamp(0.0, 1.0)))
            .collect();
        let index = recording.meshes.len();
        let node = RecordedNode {
            mesh: index,
            poses,
            visible: 0..FRAMES,
            ..Default::default()
        };
        recording.nodes.push(node);
        recording.meshes.push(mesh);
    };
    let square: Vec<_> = (0..4)
        .map(|i| 0.06 * on_circle(TAU * i as f32 / 4.0))
        .collect();
    add(
        prism(&square, 4, 0),
        Vec3::new(-0.12, 0.0, -0.02),
        Vec3::NEG_X,
    );
    for turn in (0..WEDGES).map(|wedge| wedge as f32 / WEDGES as f32) {
        let rim = (0..7).map(|k| 0.05 * on_circle(TAU * (turn + k as f32 / 6.0 / WEDGES as f32)));
        let base: Vec<_> = rim.chain([Vec3::ZERO]).collect();
        add(
            prism(&base, 6, 2),
            Vec3::new(0.08, 0.0, 0.0),
            on_circle(TAU * (turn + 0.07)),
        );
    }
    let path = std::env::args().nth(1).unwrap_or("demo_sheet.png".into());
    let picture = contact_sheet(&recording, &SheetOptions::default())?;
    write_atomically(path.as_ref(), &encode_png(&picture)?)?;
    Ok(write_atomically(
        format!("{path}.glb").as_ref(),
        &write_glb(&recording)?,
    )?)
}
