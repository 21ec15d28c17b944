//! The written file, read back by another library.

use frangible_export::{ExportError, write_glb};
use frangible_recording::glam::{Quat, Vec3};
use frangible_recording::{
    Floor, Grain, MeshPart, Moments, Pose, RecordedBlow, RecordedCrack, RecordedMesh, RecordedNode,
    RecordedPulse, RecordedSlide, RecordedTouch, Recording, RecordingError, SurfaceMaterial, View,
};
use gltf::animation::util::ReadOutputs;
use gltf::animation::{Interpolation, Property};

const FRAMES: usize = 10;
const BREAK: usize = 4;

/// A plate that falls, and two shards that take its place in frame 4 and come
/// to rest in frame 7.
fn recording() -> Recording {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    let shape = |name: &str| RecordedMesh {
        name: name.into(),
        positions: corners.to_vec(),
        normals: vec![Vec3::ONE; 4],
        uvs: corners.iter().map(|p| [p.x, p.z]).collect(),
        parts: vec![
            MeshPart {
                surface: 0,
                indices: vec![0, 2, 1, 0, 3, 2],
            },
            MeshPart {
                surface: 1,
                indices: vec![0, 1, 3, 1, 2, 3],
            },
        ],
        ..RecordedMesh::default()
    };
    let pose = |frame: usize, drift: f32| {
        let time = frame.min(7) as f32;
        Pose {
            translation: Vec3::new(drift * time, 5.0 - 0.5 * time, 0.0),
            // Alternating signs: the writer must undo them.
            rotation: Quat::from_rotation_x(0.3 * time)
                * if frame.is_multiple_of(2) { 1.0 } else { -1.0 },
        }
    };
    let node = |name: &str, mesh: usize, drift: f32, visible| RecordedNode {
        name: name.into(),
        mesh,
        poses: (0..FRAMES).map(|frame| pose(frame, drift)).collect(),
        visible,
        keep_extras: vec![("mass_kg".into(), 0.25), ("volume_m3".into(), 1e-4)],
    };
    Recording {
        name: "a plate".into(),
        frame_rate: 60.0,
        frame_count: FRAMES,
        surfaces: vec![
            SurfaceMaterial {
                name: "glaze".into(),
                ior: 1.6,
                ..SurfaceMaterial::default()
            },
            SurfaceMaterial {
                name: "inside".into(),
                transmission: 0.5,
                attenuation_color: [0.5, 0.8, 0.7],
                attenuation_distance: 0.04,
                ..Default::default()
            },
        ],
        meshes: vec![shape("plate"), shape("left"), shape("right")],
        nodes: vec![
            node("plate", 0, 0.0, 0..BREAK),
            node("left", 1, -0.1, BREAK..FRAMES),
            node("right", 2, 0.1, BREAK..FRAMES),
            RecordedNode {
                name: "table".into(),
                poses: vec![Pose::default()],
                visible: 0..FRAMES,
                ..RecordedNode::default()
            },
        ],
        floor: Some(Floor::default()),
        camera: View::default(),
        moments: Moments {
            before: 0,
            first_crack: BREAK,
            just_after: 5,
            at_rest: 9,
            moves_on: false,
        },
        ..Recording::default()
    }
}

fn read(bytes: &[u8]) -> (gltf::Document, Vec<u8>) {
    let file = gltf::Gltf::from_slice(bytes).expect("a valid GLB");
    (file.document, file.blob.expect("a binary chunk"))
}

#[test]
fn every_recorded_thing_is_found_again() {
    let (document, blob) = read(&write_glb(&recording()).unwrap());
    let names: Vec<_> = document
        .nodes()
        .map(|node| node.name().unwrap().to_owned())
        .collect();
    let scene = [
        "plate", "left", "right", "table", "floor", "view", "key", "fill", "rim",
    ];
    assert_eq!(names, scene);
    assert_eq!(document.meshes().count(), 4, "three shapes and the floor");
    assert_eq!(document.materials().count(), 3);
    assert_eq!(document.animations().count(), 1);
    let used: Vec<_> = document.extensions_used().collect();
    let extensions = [
        "KHR_materials_ior",
        "KHR_materials_transmission",
        "KHR_materials_volume",
        "KHR_lights_punctual",
    ];
    assert_eq!(used, extensions);
    for primitive in document
        .meshes()
        .flat_map(|mesh| mesh.primitives().collect::<Vec<_>>())
    {
        let reader = primitive.reader(|_| Some(&blob));
        assert_eq!(reader.read_positions().unwrap().count(), 4);
        let unit = |n: [f32; 3]| (Vec3::from(n).length() - 1.0).abs() < 1e-6;
        assert!(reader.read_normals().unwrap().all(unit));
        assert_eq!(reader.read_indices().unwrap().into_u32().count(), 6);
    }
    let meshes: Vec<_> = document.meshes().collect();
    for (mesh, recorded) in meshes.iter().zip(recording().meshes) {
        for primitive in mesh.primitives() {
            let reader = primitive.reader(|_| Some(&blob));
            let uvs: Vec<_> = reader.read_tex_coords(0).unwrap().into_f32().collect();
            assert_eq!(uvs, recorded.uvs);
        }
    }
    let floor = meshes[3].primitives().next().unwrap();
    assert!(floor.reader(|_| Some(&blob)).read_tex_coords(0).is_none());
}

#[test]
fn positions_carry_their_bounds_and_views_are_aligned() {
    let (document, blob) = read(&write_glb(&recording()).unwrap());
    for view in document.views() {
        assert_eq!(view.offset() % 4, 0);
        assert!(view.offset() + view.length() <= blob.len());
    }
    let mesh = document.meshes().next().unwrap();
    let bounds = mesh.primitives().next().unwrap().bounding_box();
    assert_eq!((bounds.min, bounds.max), ([0.0; 3], [1.0; 3]));
}

#[test]
fn masses_travel_as_extras() {
    let bytes = write_glb(&recording()).unwrap();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let json: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    assert_eq!(json["nodes"][1]["extras"]["mass_kg"], 0.25);
    assert_eq!(json["nodes"][1]["extras"]["volume_m3"], 1e-4);
    let materials = &json["materials"];
    let transmission = &materials[1]["extensions"]["KHR_materials_transmission"];
    assert_eq!(transmission["transmissionFactor"], 0.5);
    let volume = &materials[1]["extensions"]["KHR_materials_volume"];
    let part = |k: usize| volume["attenuationColor"][k].as_f64().unwrap() as f32;
    assert_eq!([0, 1, 2].map(part), [0.5, 0.8, 0.7]);
    assert_eq!(volume["attenuationDistance"].as_f64().unwrap() as f32, 0.04);
    // The light's colour changes in the depth, so the face has none.
    let face = &materials[1]["pbrMetallicRoughness"]["baseColorFactor"];
    assert_eq!(
        face.as_array().map(|parts| parts.iter().all(|p| p == 1.0)),
        Some(true)
    );
    assert!(
        json["asset"]["generator"]
            .as_str()
            .unwrap()
            .starts_with("Frangible ")
    );
}

#[test]
fn shards_appear_when_the_plate_vanishes() {
    let (document, blob) = read(&write_glb(&recording()).unwrap());
    let animation = document.animations().next().unwrap();
    let mut switched = Vec::new();
    for channel in animation.channels() {
        if channel.target().property() != Property::Scale {
            continue;
        }
        assert_eq!(channel.sampler().interpolation(), Interpolation::Step);
        let reader = channel.reader(|_| Some(&blob));
        let times: Vec<f32> = reader.read_inputs().unwrap().collect();
        assert_eq!(times, [0.0, BREAK as f32 / 60.0]);
        let Some(ReadOutputs::Scales(scales)) = reader.read_outputs() else {
            panic!("no scales")
        };
        switched.push((
            channel.target().node().index(),
            scales.map(|s| s[0]).collect::<Vec<_>>(),
        ));
    }
    let hides = (0, vec![1.0, 0.0]);
    assert_eq!(switched, [hides, (1, vec![0.0, 1.0]), (2, vec![0.0, 1.0])]);
}

#[test]
fn resting_frames_are_dropped_and_rotations_never_flip() {
    let (document, blob) = read(&write_glb(&recording()).unwrap());
    let animation = document.animations().next().unwrap();
    // The plate and the shards translate, rotate and switch; the table rests.
    assert_eq!(animation.channels().count(), 9);
    for channel in animation
        .channels()
        .filter(|c| c.target().node().index() == 1)
    {
        let reader = channel.reader(|_| Some(&blob));
        let count = reader.read_inputs().unwrap().count();
        match reader.read_outputs().unwrap() {
            // Frames 4 to 7 move, 8 repeats, 9 ends the run.
            ReadOutputs::Translations(_) => assert_eq!(count, 5),
            ReadOutputs::Rotations(rotations) => {
                assert_eq!(count, 5);
                let turns: Vec<_> = rotations.into_f32().map(Quat::from_array).collect();
                assert!(turns.iter().all(|turn| turn.is_normalized()));
                assert!(turns.windows(2).all(|pair| pair[0].dot(pair[1]) > 0.0));
            }
            _ => assert_eq!(count, 2),
        }
    }
}

#[test]
fn the_same_recording_gives_the_same_bytes() {
    assert_eq!(
        write_glb(&recording()).unwrap(),
        write_glb(&recording()).unwrap()
    );
}

#[test]
fn marked_faces_carry_their_marks_and_others_do_not() {
    let mut marked = recording();
    let has = |recording: &Recording| {
        let bytes = write_glb(recording).unwrap();
        read(&bytes);
        let words = bytes.windows(7).filter(|word| word == b"\"_MARK\"");
        words.count()
    };
    marked.meshes[0].marks = vec![[1e-3, 0.0, 0.0, 500.0]; 4];
    assert_eq!(has(&marked), 0, "no surface shows them");
    marked.surfaces[1].grain = Grain::Marked;
    assert_eq!(has(&marked), 1);
    marked.meshes[0].marks.pop();
    assert!(matches!(write_glb(&marked), Err(ExportError::Recording(_))));
}

#[test]
fn an_empty_recording_is_still_a_file() {
    let empty = Recording {
        frame_rate: 60.0,
        frame_count: 1,
        ..Recording::default()
    };
    let file = gltf::Gltf::from_slice(&write_glb(&empty).unwrap()).unwrap();
    assert_eq!(file.animations().count(), 0);
}

/// A way to spoil a recording, and words the error must contain.
type Spoiled = (fn(&mut Recording), &'static [&'static str]);

#[test]
fn an_unsound_recording_is_an_error_that_names_the_place() {
    let cases: [Spoiled; 17] = [
        (|r| r.frame_count = 0, &["no frame"]),
        (|r| r.frame_rate = 0.0, &["frame rate", "above zero"]),
        (
            |r| r.meshes[1].positions[2].y = f32::NAN,
            &["position 2", "left", "NaN"],
        ),
        (
            |r| r.meshes[1].normals.truncate(3),
            &["normals", "left", "3"],
        ),
        (
            |r| r.meshes[1].uvs.truncate(2),
            &["texture coordinates", "left", "2"],
        ),
        (
            |r| r.meshes[2].uvs[3][1] = f32::INFINITY,
            &["row 3", "texture coordinates", "right", "inf"],
        ),
        (
            |r| r.meshes[2].parts[1].indices[4] = 4,
            &["index 4", "part 1", "right", "only 4"],
        ),
        (|r| r.nodes[0].mesh = 9, &["mesh of the node", "plate", "9"]),
        (
            |r| r.nodes[0].poses.truncate(3),
            &["pose list", "plate", "3", "10"],
        ),
        (
            |r| r.nodes[1].poses[6].rotation = Quat::from_array([0.0; 4]),
            &["frame 6", "left"],
        ),
        (|r| r.moments.at_rest = 10, &["at rest", "10"]),
        (
            |r| {
                r.blows.push(RecordedBlow {
                    node: 9,
                    ..RecordedBlow::default()
                });
            },
            &["node of blow 0", "9"],
        ),
        (
            |r| {
                let pulses = vec![RecordedPulse::default()];
                r.blows.push(RecordedBlow {
                    pulses,
                    ..RecordedBlow::default()
                });
            },
            &["time step of blow 0", "above zero"],
        ),
        (
            |r| {
                let crack = RecordedCrack {
                    places: vec![Vec3::ZERO],
                    times: Vec::new(),
                };
                r.blows.push(RecordedBlow {
                    cracks: vec![crack],
                    ..RecordedBlow::default()
                });
            },
            &["times of a crack of blow 0", "one per place"],
        ),
        (
            |r| {
                r.touches.push(RecordedTouch {
                    impulse: f64::NAN,
                    ..RecordedTouch::default()
                });
            },
            &["impulse of touch 0", "NaN"],
        ),
        (
            |r| r.slides.push(RecordedSlide::default()),
            &["duration of slide 0", "above zero"],
        ),
        (
            |r| r.camera.up = r.camera.target - r.camera.eye,
            &["camera", "up"],
        ),
    ];
    for (spoil, words) in cases {
        let mut bad = recording();
        spoil(&mut bad);
        let error = write_glb(&bad).unwrap_err();
        assert!(matches!(error, ExportError::Recording(_)));
        let message = error.to_string();
        for word in words {
            assert!(message.contains(word), "\"{message}\" lacks \"{word}\"");
        }
    }
    let mut bad = recording();
    bad.nodes[0].visible = 2..FRAMES + 1;
    assert!(matches!(
        bad.validate(),
        Err(RecordingError::BadIndex { index: 11, .. })
    ));
}
