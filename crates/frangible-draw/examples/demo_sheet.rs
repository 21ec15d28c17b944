//! A made-up break, drawn and exported: two cylinders fall apart into wedges.
//! `cargo run --release -p frangible-draw --example demo_sheet -- OUT.png`

use frangible_draw::{SheetOptions, contact_sheet, encode_png};
use frangible_export::glam::{Quat, Vec3};
use frangible_export::*;
use std::f32::consts::TAU;

const FRAMES: usize = 60;
const WEDGES: usize = 7;

fn on_circle(turn: f32) -> Vec3 {
    Vec3::new((TAU * turn).cos(), 0.0, -(TAU * turn).sin())
}

/// A slice of a cylinder; its two broken sides take the next surface.
fn wedge(turn: f32, surface: usize) -> RecordedMesh {
    let mut mesh = RecordedMesh::default();
    let mut face = |corners: &[Vec3], surface: usize| {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let start = mesh.positions.len() as u32;
        let fan = (2..corners.len() as u32).flat_map(|i| [start, start + i - 1, start + i]);
        let indices = fan.collect();
        mesh.parts.push(MeshPart { surface, indices });
        mesh.positions.extend(corners);
        mesh.normals.resize(mesh.positions.len(), normal);
    };
    let rim = (0..7).map(|k| 0.05 * on_circle(turn + k as f32 / 6.0 / WEDGES as f32));
    let base: Vec<_> = rim.chain([Vec3::ZERO]).collect();
    let top: Vec<_> = base.iter().map(|&corner| corner + 0.1 * Vec3::Y).collect();
    face(&top, surface);
    face(&base.iter().rev().copied().collect::<Vec<_>>(), surface);
    for (i, j) in (0..8).map(|i| (i, (i + 1) % 8)) {
        let inside = usize::from(i >= 6);
        face(&[base[i], base[j], top[j], top[i]], surface + inside);
    }
    mesh
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut recording = Recording::default();
    (recording.frame_rate, recording.frame_count) = (60.0, FRAMES);
    recording.floor = Some(Floor::default());
    recording.camera.eye = Vec3::new(0.1, 0.35, 0.6);
    let moments = &mut recording.moments;
    (moments.first_crack, moments.just_after, moments.at_rest) = (17, 30, 59);
    for (name, [r, g, b], roughness, opacity) in [
        ("porcelain", [0.86, 0.85, 0.82], 0.2, 1.0),
        ("clay", [0.75, 0.45, 0.25], 0.9, 1.0),
        ("glass", [0.62, 0.80, 0.78], 0.06, 0.38),
        ("glass edge", [0.16, 0.42, 0.38], 0.25, 0.9),
    ] {
        let mut surface = SurfaceMaterial::default();
        (surface.name, surface.base_color) = (name.into(), [r, g, b, opacity]);
        (surface.roughness, surface.double_sided) = (roughness, opacity < 1.0);
        recording.surfaces.push(surface);
    }
    for i in 0..2 * WEDGES {
        let (side, turn) = (i / WEDGES, i as f32 / WEDGES as f32);
        let out = on_circle(turn + 0.5 / WEDGES as f32);
        let mut node = RecordedNode::default();
        (node.mesh, node.visible) = (i, 0..FRAMES);
        for frame in 0..FRAMES {
            let time = (frame as f32 / 40.0 - 0.4).clamp(0.0, 1.0);
            let translation = (side as f32 * 0.24 - 0.12) * Vec3::X + 0.05 * time * out;
            let rotation = Quat::from_axis_angle(Vec3::Y.cross(out), 1.3 * time * time);
            node.poses.push(Pose {
                translation,
                rotation,
            });
        }
        recording.nodes.push(node);
        recording.meshes.push(wedge(turn, 2 * side));
    }
    let path = std::env::args().nth(1).unwrap_or("demo.png".into());
    let picture = contact_sheet(&recording, &SheetOptions::default())?;
    write_atomically(path.as_ref(), &encode_png(&picture)?)?;
    write_atomically(format!("{path}.glb").as_ref(), &write_glb(&recording)?)?;
    Ok(())
}
