//! Vertex colours of every format that has them, and errors of damaged ones.

use frangible_mesh::{InputMesh, MeshFormat, parse_mesh};

const CORNERS: [[f32; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
const FACES: [[u16; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

fn read(format: MeshFormat, bytes: impl AsRef<[u8]>) -> InputMesh {
    let mesh = parse_mesh(format, bytes.as_ref(), None).unwrap();
    assert_eq!(mesh.triangles.len(), 4);
    assert!(mesh.colors.is_empty() || mesh.colors.len() == mesh.positions.len());
    mesh
}

/// `properties` behind the coordinates, and their numbers on each line.
fn ply(properties: &[&str], rows: [&str; 4]) -> String {
    let properties: String = properties
        .iter()
        .map(|p| format!("property {p}\n"))
        .collect();
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n{properties}\
         element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    );
    for ([x, y, z], row) in CORNERS.iter().zip(rows) {
        text += &format!("{x} {y} {z} {row}\n");
    }
    for [a, b, c] in FACES {
        text += &format!("3 {a} {b} {c}\n");
    }
    text
}

fn obj(rows: [&str; 4]) -> String {
    let mut text = String::new();
    for ([x, y, z], row) in CORNERS.iter().zip(rows) {
        text += &format!("v {x} {y} {z} {row}\n");
    }
    for face in FACES {
        let [a, b, c] = face.map(|v| v + 1);
        text += &format!("f {a} {b} {c}\n");
    }
    text
}

/// `accessor` is what tells COLOR_0 from others, `colors` its bytes.
fn glb(accessor: &str, colors: &[u8]) -> Vec<u8> {
    let mut buffer: Vec<u8> = CORNERS
        .iter()
        .flatten()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    buffer.extend(FACES.iter().flatten().flat_map(|v| v.to_le_bytes()));
    buffer.extend_from_slice(colors);
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"COLOR_0":2}},"indices":1}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
        {{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}},
        {{"bufferView":2,"count":4,{accessor}}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":24}},
        {{"buffer":0,"byteOffset":72,"byteLength":{}}}],
        "buffers":[{{"byteLength":{}}}]}}"#,
        colors.len(),
        buffer.len()
    )
    .into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend(((28 + json.len() + buffer.len()) as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", buffer)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

#[test]
fn ply_colors_are_shares_of_their_kind() {
    let rows = ["255 0 51", "0 255 0", "0 0 0", "255 255 255"];
    let bytes = read(
        MeshFormat::Ply,
        ply(&["uchar red", "uchar green", "uchar blue"], rows),
    );
    assert_eq!(bytes.colors[0], [1.0, 0.0, 0.2, 1.0]);
    assert_eq!(bytes.colors[2], [0.0, 0.0, 0.0, 1.0]);
    let rows = ["65535 0 13107 0", "0 0 0 0", "0 0 0 0", "0 0 0 65535"];
    let names = ["ushort red", "ushort green", "ushort blue", "ushort alpha"];
    let words = read(MeshFormat::Ply, ply(&names, rows));
    assert_eq!(words.colors[0], [1.0, 0.0, 0.2, 0.0]);
    let rows = ["0.25 0 1", "0 0 0", "0 0 0", "0 0 0"];
    let names = ["float red", "float green", "float blue"];
    let floats = read(MeshFormat::Ply, ply(&names, rows));
    assert_eq!(floats.colors[0], [0.25, 0.0, 1.0, 1.0]);
    // A single channel is enough; the others are full.
    let rows = ["0", "255", "255", "255"];
    let red = read(MeshFormat::Ply, ply(&["uchar red"], rows));
    assert_eq!(red.colors[0], [0.0, 1.0, 1.0, 1.0]);
    let plain = read(MeshFormat::Ply, ply(&["uchar quality"], rows));
    assert!(plain.colors.is_empty());
}

#[test]
fn ply_vertices_in_several_runs_keep_their_own_attributes() {
    let half = |count: usize, properties: &str| {
        format!(
            "element vertex {count}\nproperty float x\nproperty float y\nproperty float z\n{properties}"
        )
    };
    let faces = "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
    let list = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    let begin = "ply\nformat ascii 1.0\n";
    let (plain, rich) = (
        half(2, ""),
        half(
            2,
            "property float nx\nproperty float red\nproperty float s\n",
        ),
    );
    let first =
        format!("{begin}{plain}{rich}{faces}0 0 0\n1 0 0\n0 1 0 1 0.5 0.5\n0 0 1 0 0.25 0\n{list}");
    let last =
        format!("{begin}{rich}{plain}{faces}0 0 0 1 0.5 0.5\n1 0 0 0 0.25 0\n0 1 0\n0 0 1\n{list}");
    for (text, at) in [(first, [2, 3, 0]), (last, [0, 1, 2])] {
        let mesh = read(MeshFormat::Ply, text);
        assert_eq!(at.map(|v| mesh.colors[v][0]), [0.5, 0.25, 1.0]);
        assert_eq!((mesh.normals.len(), mesh.uvs.len()), (4, 4));
        assert_eq!(mesh.uvs[at[0]].x, 0.5);
        assert_eq!(mesh.normals[at[0]].x, 1.0);
    }
}

#[test]
fn obj_colors_stand_behind_the_coordinates() {
    let mesh = read(
        MeshFormat::Obj,
        obj(["", "1 0.5 0 # burnt", "0.7", "0 0 0"]),
    );
    assert_eq!(mesh.colors[0], [1.0; 4]);
    assert_eq!(mesh.colors[1], [1.0, 0.5, 0.0, 1.0]);
    assert_eq!(mesh.colors[2], [1.0; 4]);
    assert_eq!(mesh.colors[3], [0.0, 0.0, 0.0, 1.0]);
    let odd = read(
        MeshFormat::Obj,
        obj(["1 2", "red green blue", "1 1 1 1 1", "# 1 1 1"]),
    );
    assert!(odd.colors.is_empty());
    // Corners that a texture parts keep the colour of their place.
    let seam = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1\nvt 0 0\nvt 1 1\nf 1/1 3/1 2/1\nf 1/2 2/2 4/1\n\
                f 1/1 4/1 3/1\nf 2/1 3/1 4/1\n";
    let mesh = read(MeshFormat::Obj, seam);
    assert_eq!(mesh.positions.len(), 6);
    for (p, color) in mesh.positions.iter().zip(&mesh.colors) {
        let own = mesh.positions[..4].iter().position(|q| q == p).unwrap();
        assert_eq!(*color, mesh.colors[own]);
    }
}

#[test]
fn gltf_colors_come_in_six_forms() {
    let rows = [
        [1.0, 0.0, 0.2, 0.4],
        [0.0; 4],
        [1.0, 1.0, 1.0, 0.0],
        [0.6, 0.2, 0.4, 1.0],
    ];
    for width in [3, 4] {
        let shares = rows.iter().flat_map(|r| &r[..width]);
        let floats: Vec<u8> = shares
            .clone()
            .flat_map(|&x: &f32| x.to_le_bytes())
            .collect();
        let bytes: Vec<u8> = shares.clone().map(|x| (x * 255.0).round() as u8).collect();
        let words: Vec<u8> = shares
            .flat_map(|x| ((x * 65535.0).round() as u16).to_le_bytes())
            .collect();
        // Whole numbers are shares in this place, even where the file forgets to say so.
        for (kind, normalized, data) in [
            (5126, false, &floats),
            (5121, true, &bytes),
            (5121, false, &bytes),
            (5123, true, &words),
        ] {
            let accessor =
                format!(r#""componentType":{kind},"type":"VEC{width}","normalized":{normalized}"#);
            let mesh = read(MeshFormat::Gltf, glb(&accessor, data));
            for (found, wanted) in mesh.colors.iter().zip(rows) {
                let opacity = if width == 4 { wanted[3] } else { 1.0 };
                let wanted = [wanted[0], wanted[1], wanted[2], opacity];
                assert!(
                    found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-6),
                    "{found:?} {wanted:?}"
                );
            }
        }
    }
}

#[test]
fn damaged_colors_cost_no_shape_or_are_named() {
    let rows = ["nan 0 0", "inf 0 0", "7 -1 0.5", "0 0 0"];
    let names = ["float red", "float green", "float blue"];
    let mesh = read(MeshFormat::Ply, ply(&names, rows));
    assert_eq!(mesh.colors[..2], [[1.0; 4]; 2]);
    assert_eq!(mesh.colors[2], [1.0, 0.0, 0.5, 1.0]);
    let mesh = read(MeshFormat::Obj, obj(["nan 0 0", "9 9 9", "", ""]));
    assert_eq!(mesh.colors, [[1.0; 4]; 4]);
    let refused = |accessor: &str, data: &[u8]| {
        let bytes = glb(accessor, data);
        let error = parse_mesh(MeshFormat::Gltf, &bytes, None).unwrap_err();
        error.to_string()
    };
    let message = refused(r#""componentType":5126,"type":"VEC2""#, &[0; 32]);
    assert!(
        message.contains("accessor 2") && message.contains("3 or 4"),
        "{message}"
    );
    let message = refused(r#""componentType":5126,"type":"VEC4""#, &[0; 60]);
    assert!(message.contains("truncated"), "{message}");
    let message = refused(r#""componentType":9,"type":"VEC4""#, &[0; 64]);
    assert!(message.contains("accessor 2"), "{message}");
    // Fewer colours than vertices: the rest is white; more are passed over.
    for count in [1, 9] {
        let mut bytes = glb(
            r#""componentType":5121,"type":"VEC4","normalized":true"#,
            &[0; 36],
        );
        let key = br#""bufferView":2,"count":"#;
        let at = bytes.windows(key.len()).position(|w| w == key).unwrap();
        bytes[at + key.len()] = b'0' + count;
        let mesh = read(MeshFormat::Gltf, bytes);
        assert_eq!(mesh.colors[0], [0.0; 4]);
        let last = if count == 1 { [1.0; 4] } else { [0.0; 4] };
        assert_eq!(mesh.colors[3], last);
    }
}
