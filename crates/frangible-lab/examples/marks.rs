//! Mirror, mist and hackle on the crack faces of scenes of glass: shares of the area, radii of the mirrors, and a close picture of a face, with its marks
//! and without.
//!
//! `cargo run --release -p frangible-lab --example marks -- FOLDER SCENE...`

use std::path::Path;

use frangible::glam::{Quat, Vec3};
use frangible_lab::Result;
use frangible_photo::{Studio, encode_png};
use frangible_recording::{
    Grain, Moments, Pose, RecordedMesh, Recording, View, make_folder, write_atomically,
};
use frangible_scenes::{bake_with, play, scene};

/// Radius at which hackle takes the place of mist, in mirrors.
const HACKLE: f32 = 1.3;

/// Size of the picture, pixels.
const SIZE: [u32; 2] = [960, 640];

fn main() -> Result<()> {
    let mut words = std::env::args().skip(1);
    let folder = words.next().unwrap_or_else(|| "marks".into());
    make_folder(Path::new(&folder), &[], "FOLDER")?;
    for name in words {
        let scene = scene(&name)?;
        let baked = bake_with(&scene, |_| {})?;
        let run = play(&scene, &baked, &mut |_| {})?;
        measure(&name, &run.recording);
        let meshes = run.recording.meshes.iter();
        let rows: usize = meshes.map(|mesh| mesh.marks.len()).sum();
        let pieces = run.recording.blows.iter().map(|blow| blow.pieces.len());
        let cracks = run.recording.blows.iter().map(|blow| blow.cracks.len());
        println!(
            "{name}: {} cracks, {} pieces, {} kB of marks in a GLB",
            cracks.sum::<usize>(),
            pieces.sum::<usize>(),
            16 * rows / 1000
        );
        let Some((mut still, view)) = close(&run.recording) else {
            continue;
        };
        for suffix in ["", "-plain"] {
            let picture = Studio::new(SIZE[0], SIZE[1])?.frame(&still, 0, &view, "")?;
            let path = Path::new(&folder).join(format!("{name}{suffix}.png"));
            write_atomically(&path, &encode_png(&picture)?)?;
            still.meshes.iter_mut().for_each(|mesh| mesh.marks.clear());
        }
    }
    Ok(())
}

/// Corners of the marked faces of a mesh.
fn marked<'a>(
    recording: &'a Recording,
    mesh: &'a RecordedMesh,
) -> impl Iterator<Item = [usize; 3]> + 'a {
    let parts = mesh.parts.iter();
    let parts = parts.filter(|p| recording.surfaces[p.surface].grain == Grain::Marked);
    let faces = parts.flat_map(|part| part.indices.chunks_exact(3));
    faces.map(|face| [face[0], face[1], face[2]].map(|corner| corner as usize))
}

fn way(mesh: &RecordedMesh, corner: usize) -> Vec3 {
    let [x, y, z, _] = mesh.marks[corner];
    Vec3::new(x, y, z)
}

/// Prints the shares of mirror, mist and hackle, and the quartiles of the mirrors' radii, by area.
fn measure(name: &str, recording: &Recording) {
    let (mut shares, mut radii) = ([0.0_f32; 4], Vec::new());
    for mesh in &recording.meshes {
        for face in marked(recording, mesh) {
            let [a, b, c] = face.map(|corner| mesh.positions[corner]);
            let area = 0.5 * (b - a).cross(c - a).length();
            if mesh.marks.is_empty() || face.iter().any(|&f| mesh.marks[f] == [0.0; 4]) {
                shares[3] += area;
                continue;
            }
            let run = face.iter().map(|&f| way(mesh, f)).sum::<Vec3>() / 3.0;
            let inverse = face.iter().map(|&f| mesh.marks[f][3]).sum::<f32>() / 3.0;
            let reached = run.length() * inverse;
            shares[usize::from(reached > 1.0) + usize::from(reached > HACKLE)] += area;
            radii.push((1.0 / inverse, area));
        }
    }
    let all: f32 = shares.iter().sum();
    radii.sort_by(|a, b| a.0.total_cmp(&b.0));
    let known: f32 = radii.iter().map(|radius| radius.1).sum();
    let quartile = |share: f32| {
        let mut sum = 0.0;
        let found = radii.iter().find(|radius| {
            sum += radius.1;
            sum >= share * known
        });
        1e3 * found.map_or(0.0, |radius| radius.0)
    };
    let [mirror, mist, hackle, unknown] = shares.map(|share| 100.0 * share / all);
    println!(
        "{name}: {:.0} cm²; mirror {mirror:.0} %, mist {mist:.0} %, hackle {hackle:.0} %, unknown {unknown:.0} %; mirrors {:.2} {:.2} {:.2} mm",
        1e4 * all,
        quartile(0.25),
        quartile(0.5),
        quartile(0.75)
    );
}

/// The piece whose face shows most of an origin, alone, and a view of that face.
fn close(recording: &Recording) -> Option<(Recording, View)> {
    let mut best: Option<(f32, usize, Vec3, Vec3, f32)> = None;
    for (node, recorded) in recording.nodes.iter().enumerate() {
        let mesh = &recording.meshes[recorded.mesh];
        if mesh.marks.is_empty() {
            continue;
        }
        for face in marked(recording, mesh) {
            let [a, b, c] = face.map(|corner| mesh.positions[corner]);
            let [x, _, _, inverse] = mesh.marks[face[0]];
            if inverse <= 0.0 || x == 0.0 {
                continue;
            }
            let (run, radius) = (way(mesh, face[0]), 1.0 / inverse);
            // A mirror that the face shows whole, with what surrounds it.
            let area = 0.5 * (b - a).cross(c - a).length();
            let score = area / (radius * radius) * (-run.length() * inverse).exp();
            if (5e-4..6e-3).contains(&radius) && best.is_none_or(|best| score > best.0) {
                best = Some((
                    score,
                    node,
                    a - run,
                    (b - a).cross(c - a).normalize(),
                    radius,
                ));
            }
        }
    }
    let (_, node, start, normal, radius) = best?;
    let turn = Quat::from_rotation_arc(normal, Vec3::new(0.0, 0.35, 0.94).normalize());
    let mut recorded = recording.nodes[node].clone();
    let mesh = &recording.meshes[recorded.mesh];
    let low = mesh.positions.iter().map(|p| (turn * *p).y);
    let lift = -low.fold(f32::INFINITY, f32::min);
    recorded.poses = vec![Pose {
        translation: Vec3::Y * lift,
        rotation: turn,
    }];
    recorded.visible = 0..1;
    let target = turn * start + Vec3::Y * lift;
    let distance = 22.0 * radius;
    let view = View {
        eye: target + distance * Vec3::new(0.25, 0.3, 0.92).normalize(),
        target,
        up: Vec3::Y,
        vertical_fov: 0.45,
    };
    let still = Recording {
        nodes: vec![recorded],
        frame_count: 1,
        blows: Vec::new(),
        touches: Vec::new(),
        slides: Vec::new(),
        moments: Moments::default(),
        views: None,
        ..recording.clone()
    };
    Some((still, view))
}
