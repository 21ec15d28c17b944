//! Colours, texture coordinates, materials and names of a mesh file, in the pieces of its body.

use std::fs;

use serde_json::{Value, json};

use crate::common::{Folder, frangible, text};

const PNG: &[u8] = b"\x89PNG\r\n\x1a\nnot looked at";

/// A plate of 200 × 10 × 200 mm whose further texture coordinates and colours are linear in place.
fn plate(folder: &Folder) -> String {
    let (mut rows, mut indices) = (Vec::new(), Vec::new());
    for axis in 0..3 {
        for high in [0.0_f32, 1.0] {
            let first = rows.len() as u16;
            for [u, v] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
                let mut share = [0.0; 3];
                (share[axis], share[(axis + 1) % 3], share[(axis + 2) % 3]) = (high, u, v);
                let mut normal = [0.0; 3];
                normal[axis] = 2.0 * high - 1.0;
                rows.push((share, normal));
            }
            let order = if high > 0.0 {
                [0, 1, 2, 0, 2, 3]
            } else {
                [0, 2, 1, 0, 3, 2]
            };
            indices.extend(order.map(|k| first + k));
        }
    }
    let place = |[x, y, z]: [f32; 3]| [0.2 * x, 0.01 * y, 0.2 * z];
    let all: [(&str, Vec<f32>); 6] = [
        ("VEC3", rows.iter().flat_map(|r| place(r.0)).collect()),
        ("VEC3", rows.iter().flat_map(|r| r.1).collect()),
        ("VEC2", rows.iter().flat_map(|r| [r.0[0], r.0[2]]).collect()),
        (
            "VEC2",
            rows.iter()
                .flat_map(|r| [3.0 * r.0[2], r.0[1] - r.0[0]])
                .collect(),
        ),
        (
            "VEC4",
            rows.iter()
                .flat_map(|r| [r.0[0], r.0[1], r.0[2], 1.0])
                .collect(),
        ),
        ("VEC4", [1.0, 0.0, 0.0, 1.0].repeat(rows.len())),
    ];
    let (mut bytes, mut views, mut accessors) = (Vec::new(), Vec::new(), Vec::new());
    for (shape, values) in &all {
        views.push(json!({"buffer": 0, "byteOffset": bytes.len(), "byteLength": 4 * values.len()}));
        bytes.extend(values.iter().flat_map(|x| x.to_le_bytes()));
        accessors.push(json!({"bufferView": views.len() - 1, "componentType": 5126, "count": rows.len(), "type": shape}));
    }
    views.push(json!({"buffer": 0, "byteOffset": bytes.len(), "byteLength": 2 * indices.len()}));
    bytes.extend(indices.iter().flat_map(|x| x.to_le_bytes()));
    accessors.push(
        json!({"bufferView": 6, "componentType": 5123, "count": indices.len(), "type": "SCALAR"}),
    );
    let file = json!({
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0, "name": "my plate"}],
        "meshes": [{"name": "plate mesh", "primitives": [{"indices": 6, "material": 0, "attributes": {
            "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "TEXCOORD_1": 3, "COLOR_0": 4, "TANGENT": 5}}]}],
        "materials": [{"name": "lamp glass", "doubleSided": true, "emissiveFactor": [0.5, 0.25, 0],
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": "glaze.png"}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": bytes.len(), "uri": "plate.bin"}],
    });
    fs::write(folder.0.join("plate.bin"), bytes).expect("the buffer");
    fs::write(folder.0.join("glaze.png"), PNG).expect("the image");
    let path = folder.0.join("plate.gltf");
    fs::write(&path, file.to_string()).expect("the glTF");
    path.to_string_lossy().into_owned()
}

/// The JSON and the binary chunk of a GLB.
fn read(path: &std::path::Path) -> (Value, Vec<u8>) {
    let glb = fs::read(path).expect("the GLB");
    let length = u32::from_le_bytes(glb[12..16].try_into().expect("four bytes")) as usize;
    let json = serde_json::from_slice(&glb[20..20 + length]).expect("JSON");
    (json, glb[28 + length..].to_vec())
}

/// Rows of an accessor of single precision.
fn rows((json, blob): &(Value, Vec<u8>), accessor: &Value, width: usize) -> Vec<Vec<f32>> {
    let accessor = &json["accessors"][accessor.as_u64().expect("an accessor") as usize];
    assert_eq!(accessor["componentType"], 5126);
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().expect("a view") as usize];
    let [start, length] =
        ["byteOffset", "byteLength"].map(|key| view[key].as_u64().expect("a number") as usize);
    let numbers = blob[start..start + length].chunks_exact(4);
    let numbers: Vec<f32> = numbers
        .map(|b| f32::from_le_bytes(b.try_into().expect("four bytes")))
        .collect();
    numbers.chunks_exact(width).map(<[f32]>::to_vec).collect()
}

fn indices((json, blob): &(Value, Vec<u8>), accessor: &Value) -> Vec<usize> {
    let accessor = &json["accessors"][accessor.as_u64().expect("an accessor") as usize];
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().expect("a view") as usize];
    let start = view["byteOffset"].as_u64().expect("a number") as usize;
    let count = accessor["count"].as_u64().expect("a number") as usize;
    assert_eq!(accessor["componentType"], 5123);
    let numbers = blob[start..start + 2 * count].chunks_exact(2);
    numbers
        .map(|b| usize::from(u16::from_le_bytes([b[0], b[1]])))
        .collect()
}

fn broken(folder: &Folder, file: &str, options: &[&str]) -> (Value, (Value, Vec<u8>)) {
    let given = [
        "break",
        file,
        "--material",
        "glass",
        "--drop",
        "1",
        "--json",
    ];
    let quick = [
        "--no-pictures",
        "--no-sound",
        "--modes",
        "20",
        "--resolution",
        "6000",
    ];
    let args = [&given[..], &quick, options].concat();
    let run = frangible(&args, Some(&folder.0.join("out")));
    assert!(run.status.success(), "{}", text(&run.stderr));
    let report = serde_json::from_slice(&run.stdout).expect("JSON");
    (report, read(&folder.0.join("out/plate.glb")))
}

fn pieces(json: &Value) -> Vec<&Value> {
    let meshes = json["meshes"].as_array().expect("meshes").iter();
    let name = |mesh: &Value| mesh["name"].as_str().map(str::to_owned).unwrap_or_default();
    meshes
        .filter(|mesh| name(mesh).starts_with("my plate piece "))
        .collect()
}

#[test]
fn pieces_have_the_looks_of_their_file_and_a_note_names_the_rest() {
    let folder = Folder::new("looks");
    let file = plate(&folder);
    let (report, glb) = broken(&folder, &file, &[]);
    let notes = report["notes"].to_string();
    assert!(
        notes.contains("plate.gltf: not kept: tangents\""),
        "{notes}"
    );
    let materials = glb.0["materials"].as_array().expect("materials");
    let lamp = materials
        .iter()
        .position(|m| m["name"] == "lamp glass")
        .expect("the material");
    let material = &materials[lamp];
    assert_eq!(material["doubleSided"], true);
    assert_eq!(material["emissiveFactor"], json!([0.5, 0.25, 0.0]));
    let texture = &material["pbrMetallicRoughness"]["baseColorTexture"];
    assert_eq!(texture["texCoord"], 1);
    let image = &glb.0["images"][0];
    assert_eq!(
        (&image["mimeType"], &image["name"]),
        (&json!("image/png"), &json!("glaze.png"))
    );
    let view = &glb.0["bufferViews"][image["bufferView"].as_u64().expect("a view") as usize];
    let start = view["byteOffset"].as_u64().expect("a number") as usize;
    assert_eq!(&glb.1[start..start + PNG.len()], PNG);

    let pieces = pieces(&glb.0);
    assert!(
        pieces.len() > 1 && pieces.len() as u64 == report["fragments"],
        "{}",
        pieces.len()
    );
    let mut checked = 0;
    for mesh in pieces {
        for primitive in mesh["primitives"].as_array().expect("primitives") {
            let attributes = &primitive["attributes"];
            let places = rows(&glb, &attributes["POSITION"], 3);
            let uvs = rows(&glb, &attributes["TEXCOORD_1"], 2);
            let colors = rows(&glb, &attributes["COLOR_0"], 4);
            assert_eq!((uvs.len(), colors.len()), (places.len(), places.len()));
            let used = indices(&glb, &primitive["indices"]);
            if primitive["material"].as_u64() != Some(lamp as u64) {
                assert!(
                    used.iter()
                        .all(|&v| colors[v] == [1.0; 4] && uvs[v] == [0.0; 2])
                );
                continue;
            }
            // Everything is linear in the place, but for the origin of the piece.
            let expected = |v: usize| {
                let [x, y, z] = [places[v][0] / 0.2, places[v][1] / 0.01, places[v][2] / 0.2];
                [
                    uvs[v][0] - 3.0 * z,
                    uvs[v][1] - y + x,
                    colors[v][0] - x,
                    colors[v][1] - y,
                    colors[v][2] - z,
                ]
            };
            for &v in &used {
                for (own, first) in expected(v).iter().zip(expected(used[0])) {
                    assert!((own - first).abs() < 2e-4, "{own} {first}");
                }
                checked += 1;
            }
        }
    }
    assert!(checked > 100, "{checked}");
    let (report, _) = broken(&folder, &file, &["--wall", "0.004"]);
    let notes = report["notes"].to_string();
    assert!(
        notes.contains("tangents; vertex colours; texture coordinates; materials"),
        "{notes}"
    );
}

#[test]
fn a_light_drawing_has_few_triangles_and_states_its_error() {
    let folder = Folder::new("light");
    let file = plate(&folder);
    let (full_report, full) = broken(&folder, &file, &[]);
    let (report, light) = broken(&folder, &file, &["--drawing", "light"]);
    assert_eq!(full_report["fragments"], report["fragments"]);
    let count = |glb: &(Value, Vec<u8>)| -> u64 {
        let primitives = pieces(&glb.0)
            .into_iter()
            .flat_map(|mesh| mesh["primitives"].as_array().cloned());
        let numbers = primitives.flatten().map(|primitive| {
            let accessor = primitive["indices"].as_u64().expect("an accessor") as usize;
            glb.0["accessors"][accessor]["count"]
                .as_u64()
                .expect("a number")
                / 3
        });
        numbers.sum()
    };
    let pieces = report["fragments"].as_u64().expect("a number");
    assert!(
        count(&light) <= 3 * 12 + 200 * pieces,
        "{} for {pieces}",
        count(&light)
    );
    assert!(
        2 * count(&light) < count(&full),
        "{} of {}",
        count(&light),
        count(&full)
    );
    let note = report["notes"]
        .as_array()
        .expect("notes")
        .iter()
        .find_map(|note| {
            note.as_str()
                .filter(|note| note.starts_with("light drawing: "))
        });
    let note = note.expect("a note");
    let share = note
        .split_once("away (")
        .and_then(|(_, rest)| rest.split_once(" % of the body"));
    let share: f64 = share.expect(note).0.parse().expect("a number");
    assert!(share <= 0.5, "{note}");
    assert!(
        note.contains(&format!("{} triangles", count(&light))),
        "{note}"
    );
    assert_eq!(
        light.0["extensionsRequired"],
        json!(["KHR_mesh_quantization"])
    );
    assert!(full.0.get("extensionsRequired").is_none());
    assert!(!light.0.to_string().contains("ends_inside"));
    assert!(light.1.len() < full.1.len());
    // A node of its own places each quantised mesh.
    let nodes = light.0["nodes"].as_array().expect("nodes");
    for node in nodes.iter().filter(|node| node.get("children").is_some()) {
        assert!(node.get("mesh").is_none());
        let child = &nodes[node["children"][0].as_u64().expect("a node") as usize];
        let mesh = &light.0["meshes"][child["mesh"].as_u64().expect("a mesh") as usize];
        let position = &mesh["primitives"][0]["attributes"]["POSITION"];
        let accessor = &light.0["accessors"][position.as_u64().expect("an accessor") as usize];
        assert_eq!(
            (&accessor["componentType"], &accessor["normalized"]),
            (&json!(5122), &json!(true))
        );
        let most = accessor["max"]
            .as_array()
            .expect("bounds")
            .iter()
            .filter_map(Value::as_i64)
            .max();
        let scale = child["scale"][0].as_f64().expect("a scale");
        assert!(
            most <= Some(32767) && scale > 0.0 && scale < 0.11,
            "{scale}"
        );
    }
}
