//! Pictures of the scenes that the example for Bullet plays: `cargo run --release -p frangible-lab --example bullet_pictures -- IN.txt OUT.jpg`. IN.txt
//! is what `apps/c/examples/frames.cpp` prints, which `cargo xtask c` compiles.

use std::collections::BTreeMap;
use std::error::Error;
use std::str::FromStr;

use frangible::glam::{Quat, Vec3};
use frangible_photo::{SheetOptions, sheet_of_frames};
use frangible_recording::{
    Floor, Grain, MeshPart, Pose, RecordedMesh, RecordedNode, Recording, SurfaceMaterial, View,
    write_atomically,
};
use image::RgbImage;
use image::codecs::jpeg::JpegEncoder;

/// Quality of the JPEG, of 100.
const QUALITY: u8 = 85;
/// Frames per second.
const RATE: usize = 240;
/// Frames from that of the break, of a pane and of a glass that falls.
const FRAMES: [[isize; 4]; 2] = [[-1, 1, 8, 20], [-1, 1, 8, 16]];

/// Outside and crack faces of glass, and steel.
fn surfaces() -> Vec<SurfaceMaterial> {
    let glass = |name: &str, roughness: f32, grain: Grain| SurfaceMaterial {
        name: name.into(),
        base_color: [0.62, 0.80, 0.78, 0.38],
        roughness,
        grain,
        transmission: 1.0,
        ior: 1.52,
        double_sided: true,
        attenuation_color: [0.46, 0.80, 0.68],
        attenuation_distance: 0.04,
        ..SurfaceMaterial::default()
    };
    let steel = SurfaceMaterial {
        name: "steel".into(),
        base_color: [0.56, 0.57, 0.58, 1.0],
        metallic: 1.0,
        roughness: 0.25,
        ..SurfaceMaterial::default()
    };
    vec![
        glass("outside", 0.02, Grain::Even),
        glass("crack face", 0.25, Grain::Broken),
        steel,
    ]
}

/// The next words as numbers.
fn numbers<'a, T: FromStr<Err: Error + 'static>>(
    words: &mut impl Iterator<Item = &'a str>,
    count: usize,
) -> Result<Vec<T>, Box<dyn Error>> {
    let mut next = || words.next().ok_or("the text ends within a line");
    (0..count).map(|_| Ok(next()?.parse()?)).collect()
}

fn vectors(numbers: &[f32]) -> Vec<Vec3> {
    let (rows, _) = numbers.as_chunks();
    rows.iter().map(|&row| Vec3::from_array(row)).collect()
}

/// A ball, as rings of facets.
fn ball(radius: f32) -> RecordedMesh {
    const RINGS: u32 = 32;
    let mut mesh = RecordedMesh::default();
    let mut indices = Vec::new();
    for i in 0..=RINGS {
        for j in 0..=2 * RINGS {
            let [polar, turn] = [i, j].map(|k| std::f32::consts::PI * k as f32 / RINGS as f32);
            let ring = Vec3::new(turn.cos(), 0.0, -turn.sin()) * polar.sin();
            mesh.normals.push(ring + Vec3::Y * polar.cos());
            if i < RINGS && j < 2 * RINGS {
                let (a, b) = (i * (2 * RINGS + 1) + j, (i + 1) * (2 * RINGS + 1) + j);
                indices.extend([a, b, a + 1, a + 1, b, b + 1]);
            }
        }
    }
    mesh.positions = mesh.normals.iter().map(|n| n * radius).collect();
    mesh.parts = vec![MeshPart {
        surface: 2,
        indices,
    }];
    mesh
}

/// Reads the text, and returns the recording and the frame of the break.
fn read(text: &str) -> Result<(Recording, usize), Box<dyn Error>> {
    let mut words = text.split_whitespace();
    let mut recording = Recording {
        name: "bullet".into(),
        frame_rate: RATE as f32,
        surfaces: surfaces(),
        ..Recording::default()
    };
    let (mut broke, mut poses) = (0, BTreeMap::<usize, BTreeMap<usize, Pose>>::new());
    while let Some(word) = words.next() {
        match word {
            "mesh" => {
                let sizes: Vec<usize> = numbers(&mut words, 4)?;
                let places: Vec<f32> = numbers(&mut words, 3 * sizes[1])?;
                let normals: Vec<f32> = numbers(&mut words, 3 * sizes[1])?;
                let mut outer: Vec<u32> = numbers(&mut words, sizes[2])?;
                let inner = outer.split_off(sizes[3]);
                let part = |surface, indices| MeshPart { surface, indices };
                recording.meshes.push(RecordedMesh {
                    positions: vectors(&places),
                    normals: vectors(&normals),
                    parts: vec![part(0, outer), part(1, inner)],
                    ..RecordedMesh::default()
                });
            }
            "ball" => {
                let of: Vec<f32> = numbers(&mut words, 2)?;
                recording.meshes.push(ball(of[1]));
            }
            "at" => {
                let of: Vec<usize> = numbers(&mut words, 2)?;
                let place: Vec<f32> = numbers(&mut words, 7)?;
                let pose = Pose {
                    translation: Vec3::from_slice(&place),
                    rotation: Quat::from_slice(&place[3..]),
                };
                poses.entry(of[1]).or_default().insert(of[0], pose);
                recording.frame_count = recording.frame_count.max(of[0] + 1);
            }
            "broke" => broke = numbers(&mut words, 1)?[0],
            other => return Err(format!("`{other}` begins no line").into()),
        }
    }
    for (mesh, poses) in poses {
        let (Some(first), Some(last)) = (poses.keys().next(), poses.keys().last()) else {
            continue;
        };
        let visible = *first..last + 1;
        // A pose for each frame, also for those in which it is not there.
        let before = std::iter::repeat_n(poses[first], visible.start);
        let after = std::iter::repeat_n(poses[last], recording.frame_count - visible.end);
        recording.nodes.push(RecordedNode {
            mesh,
            visible,
            poses: before.chain(poses.into_values()).chain(after).collect(),
            ..RecordedNode::default()
        });
    }
    Ok((recording, broke))
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [from, to] = &words[..] else {
        return Err("give the text of frames.cpp and the picture to write".into());
    };
    let (mut recording, broke) = read(&std::fs::read_to_string(from)?)?;
    // A glass that falls comes from above; a pane stands free where it was.
    let falls = broke > 10;
    recording.floor = Some(Floor {
        height: if falls { 0.0 } else { -0.16 },
        ..Floor::default()
    });
    recording.camera = View {
        eye: if falls {
            Vec3::new(0.42, 0.34, 0.74)
        } else {
            Vec3::new(0.62, 0.22, 0.30)
        },
        target: if falls { Vec3::Y * 0.15 } else { Vec3::ZERO },
        ..View::default()
    };
    let last = recording.frame_count - 1;
    let frames = FRAMES[usize::from(falls)].map(|after| {
        let label = match after {
            ..0 => "before".into(),
            _ => format!("{} ms after", 1000 * after.unsigned_abs() / RATE),
        };
        (broke.saturating_add_signed(after).min(last), label)
    });
    let cells: Vec<(&Recording, usize, &str)> = frames
        .iter()
        .map(|(frame, label)| (&recording, *frame, label.as_str()))
        .collect();
    let options = SheetOptions {
        cell_width: 400,
        cell_height: 300,
        ..SheetOptions::default()
    };
    let sheet = sheet_of_frames(&cells, &options)?;
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, QUALITY).encode_image(&RgbImage::from(sheet))?;
    write_atomically(to.as_ref(), &bytes)?;
    Ok(())
}
