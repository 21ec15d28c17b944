//! Pictures, sheets and their encoding.

use frangible_photo::{
    PhotoError, Picture, SheetOptions, contact_sheet, encode_png, render_frame, sheet_of_frames,
};
use frangible_recording::glam::Vec3;
use frangible_recording::{
    Floor, MeshPart, Pose, RecordedMesh, RecordedNode, Recording, SurfaceMaterial, View,
};

/// A red triangle that stands on the floor in frame 0 and is gone in frame 1.
fn recording() -> Recording {
    Recording {
        frame_rate: 60.0,
        frame_count: 2,
        surfaces: vec![SurfaceMaterial {
            base_color: [0.8, 0.02, 0.02, 1.0],
            double_sided: true,
            ..SurfaceMaterial::default()
        }],
        meshes: vec![RecordedMesh {
            positions: vec![Vec3::NEG_X, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            parts: vec![MeshPart {
                surface: 0,
                indices: vec![0, 1, 2],
            }],
            ..RecordedMesh::default()
        }],
        nodes: vec![RecordedNode {
            poses: vec![Pose::default()],
            visible: 0..1,
            ..Default::default()
        }],
        floor: Some(Floor::default()),
        camera: View {
            eye: Vec3::new(0.0, 1.0, 4.0),
            ..View::default()
        },
        ..Recording::default()
    }
}

fn red_pixels(picture: &Picture) -> usize {
    let pixels = picture.bytes().chunks_exact(3);
    pixels
        .filter(|pixel| pixel[0] > 100 && pixel[1] < 80)
        .count()
}

#[test]
fn what_is_visible_is_drawn_and_drawn_alike_each_time() {
    let recording = recording();
    let draw = |frame| render_frame(&recording, frame, &recording.camera, 96, 64).unwrap();
    let (there, gone) = (draw(0), draw(1));
    assert_eq!((there.width(), there.height()), (96, 64));
    assert!(
        red_pixels(&there) > 200,
        "{} red pixels",
        red_pixels(&there)
    );
    assert_eq!(red_pixels(&gone), 0);
    assert_eq!(there, draw(0));
}

#[test]
fn a_sheet_has_a_cell_per_moment() {
    let options = SheetOptions {
        cell_width: 64,
        cell_height: 48,
        columns: 2,
    };
    let sheet = contact_sheet(&recording(), &options).unwrap();
    assert_eq!((sheet.width(), sheet.height()), (2 * 64 + 4, 2 * 48 + 4));
}

#[test]
fn a_cell_has_its_label_in_the_upper_left_corner_and_is_otherwise_the_frame() {
    let recording = recording();
    let options = SheetOptions {
        cell_width: 160,
        cell_height: 96,
        columns: 1,
    };
    let sheet = sheet_of_frames(&[(&recording, 0, "before")], &options).unwrap();
    let frame = render_frame(&recording, 0, &recording.camera, 160, 96).unwrap();
    let places = (0..96).flat_map(|y| (0..160).map(move |x| (x, y)));
    let inked: Vec<_> = places
        .filter(|&(x, y)| sheet.pixel(x, y) != frame.pixel(x, y))
        .collect();
    assert!(inked.len() > 100, "{} pixels", inked.len());
    assert!(inked.iter().all(|&(x, y)| x < 100 && y < 45));
}

#[test]
fn bad_requests_are_errors() {
    let recording = recording();
    let empty = sheet_of_frames(&[], &SheetOptions::default());
    assert!(matches!(empty, Err(PhotoError::EmptySheet)));
    let draw = |frame, view: &View, width| render_frame(&recording, frame, view, width, 48);
    let view = recording.camera;
    assert!(matches!(
        draw(2, &view, 64),
        Err(PhotoError::NoSuchFrame { frame: 2, count: 2 })
    ));
    assert!(matches!(draw(0, &view, 0), Err(PhotoError::BadSize { .. })));
    assert!(matches!(
        draw(0, &view, 1_000_000),
        Err(PhotoError::BadSize { .. })
    ));
    let blind = View {
        target: view.eye,
        ..view
    };
    assert!(matches!(draw(0, &blind, 64), Err(PhotoError::Recording(_))));
}

#[test]
fn a_picture_survives_encoding_and_a_noisy_one_stays_small() {
    let plain = Picture::from_fn(64, 64, |x, y| [x as u8, y as u8, 7]);
    let encoded = encode_png(&plain).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(encoded))
        .read_info()
        .unwrap();
    let mut decoded = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut decoded).unwrap();
    assert_eq!((frame.width, frame.height), (64, 64));
    assert_eq!(decoded, plain.bytes());

    // Faint noise, as of grain or dither: too large when kept exactly.
    let grain = |x: u32, y: u32| (x * 7919 + y * 104_729).wrapping_mul(2_654_435_761) >> 31;
    let noisy = Picture::from_fn(1284, 964, |x, y| [120 + grain(x, y) as u8; 3]);
    assert!(encode_png(&noisy).unwrap().len() < 1_250_000);
}
