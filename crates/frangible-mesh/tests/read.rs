//! Small files of every format, written here byte by byte, and what is wrong with damaged ones.

#![cfg(feature = "mesh-io")]

use std::fs;
use std::path::{Path, PathBuf};

use frangible_mesh::glam::{DVec3, Vec2, Vec3};
use frangible_mesh::{InputMesh, MeshFormat, ReadError, parse_mesh, read_mesh, repair};

/// A tetrahedron of volume 1/6, wound outwards.
const CORNERS: [[f32; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

fn parse(format: MeshFormat, bytes: impl AsRef<[u8]>) -> Result<InputMesh, ReadError> {
    parse_mesh(format, bytes.as_ref(), None)
}

fn read(format: MeshFormat, bytes: impl AsRef<[u8]>) -> InputMesh {
    parse(format, bytes).expect("a sound file")
}

fn message(format: MeshFormat, bytes: impl AsRef<[u8]>) -> String {
    parse(format, bytes)
        .expect_err("a damaged file")
        .to_string()
}

fn volume(mesh: &InputMesh) -> f64 {
    let corners = mesh
        .triangles
        .iter()
        .map(|t| t.map(|v| mesh.positions[v as usize]));
    corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

fn assert_is_tetrahedron(mesh: &InputMesh) {
    assert_eq!(mesh.triangles.len(), 4);
    assert!((volume(mesh) - 1.0 / 6.0).abs() < 1e-12);
    let (surface, report) = repair(mesh).expect("a solid");
    assert_eq!((surface.positions.len(), report.flipped), (4, 0));
    assert!(report.is_watertight());
}

/// A folder of its own for each test, gone afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path =
            std::env::temp_dir().join(format!("frangible-read-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a temporary folder");
        Self(path)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, bytes).expect("a temporary file");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn obj() -> String {
    let vertices = CORNERS.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat();
    let faces = FACES
        .map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1))
        .concat();
    format!("# by hand\no thing\n{vertices}{faces}")
}

fn stl(header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend(4_u32.to_le_bytes());
    for face in FACES {
        bytes.extend([0; 12]);
        bytes.extend(
            face.iter()
                .flat_map(|&v| CORNERS[v as usize])
                .flat_map(f32::to_le_bytes),
        );
        bytes.extend([0; 2]);
    }
    bytes
}

fn stl_text() -> String {
    let vertex = |v: u32| {
        format!(
            "   vertex {0:e} {1} {2}\r\n",
            CORNERS[v as usize][0], CORNERS[v as usize][1], CORNERS[v as usize][2]
        )
    };
    let facet = |f: [u32; 3]| {
        format!(
            " FACET normal 0 0 0\r\n  outer loop\r\n{}  endloop\r\n endfacet\r\n",
            f.map(vertex).concat()
        )
    };
    format!(
        "solid a vertex by name\r\n{}endsolid\r\n",
        FACES.map(facet).concat()
    )
}

fn ply_header(format: &str, list: &str) -> Vec<u8> {
    format!(
        "ply\nformat {format} 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nelement face 4\nproperty list uchar int {list}\nelement odd 1\nproperty short what\nend_header\n"
    )
    .into_bytes()
}

fn ply_text() -> Vec<u8> {
    let mut bytes = ply_header("ascii", "vertex_index");
    bytes.extend(
        CORNERS
            .map(|[x, y, z]| format!("{x} {y} {z} 7\n"))
            .concat()
            .bytes(),
    );
    bytes.extend(
        FACES
            .map(|[a, b, c]| format!("3 {a} {b} {c}\n"))
            .concat()
            .bytes(),
    );
    bytes.extend(b"5\n");
    bytes
}

fn ply_binary(is_big: bool) -> Vec<u8> {
    let order = |mut bytes: [u8; 4]| {
        if is_big {
            bytes.reverse();
        }
        bytes
    };
    let mut bytes = ply_header(
        if is_big {
            "binary_big_endian"
        } else {
            "binary_little_endian"
        },
        "vertex_indices",
    );
    for corner in CORNERS {
        bytes.extend(corner.iter().flat_map(|x| order(x.to_le_bytes())));
        bytes.push(7);
    }
    for face in FACES {
        bytes.push(3);
        bytes.extend(face.iter().flat_map(|v| order(v.to_le_bytes())));
    }
    bytes.extend([0, 5]);
    bytes
}

/// Positions, then indices of 16 bits.
fn buffer() -> Vec<u8> {
    let mut bytes: Vec<u8> = CORNERS
        .iter()
        .flatten()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    bytes.extend(
        FACES
            .iter()
            .flatten()
            .flat_map(|&v| (v as u16).to_le_bytes()),
    );
    bytes
}

fn gltf(nodes: &str, buffer: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":{nodes},
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],
        "materials":[{{"name":"red","pbrMetallicRoughness":{{"baseColorFactor":[1,0,0,1],"metallicFactor":0.25,"roughnessFactor":0.5}}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
                     {{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":24}}],
        "buffers":[{{"byteLength":72{buffer}}}]}}"#
    )
}

fn glb(json: &str) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let data = buffer();
    let mut bytes = b"glTF".to_vec();
    for word in [2, 28 + json.len() + data.len(), json.len()] {
        bytes.extend((word as u32).to_le_bytes());
    }
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(data);
    bytes
}

const ONE_NODE: &str = r#"[{"mesh":0}]"#;

#[test]
fn every_format_gives_the_same_tetrahedron() {
    use base64::Engine as _;
    let inline = base64::engine::general_purpose::STANDARD.encode(buffer());
    let inline = format!(r#","uri":"data:application/octet-stream;base64,{inline}""#);
    for (format, bytes) in [
        (MeshFormat::Obj, obj().into_bytes()),
        (MeshFormat::Stl, stl(b"by hand")),
        (MeshFormat::Stl, stl(b"solid in truth binary")),
        (MeshFormat::Stl, stl_text().into_bytes()),
        (MeshFormat::Ply, ply_text()),
        (MeshFormat::Ply, ply_binary(false)),
        (MeshFormat::Ply, ply_binary(true)),
        (MeshFormat::Gltf, gltf(ONE_NODE, &inline).into_bytes()),
        (MeshFormat::Gltf, glb(&gltf(ONE_NODE, ""))),
    ] {
        assert_is_tetrahedron(&read(format, &bytes));
        assert_eq!(MeshFormat::sniff(&bytes), Some(format));
    }
}

#[test]
fn the_content_decides_where_the_name_is_wrong_or_unknown() {
    let folder = Folder::new("sniff");
    for name in ["ball.obj", "ball", "ball.mesh", "ball.STL"] {
        assert_is_tetrahedron(&read_mesh(&folder.write(name, stl(b"solid"))).expect("an STL"));
    }
    assert_is_tetrahedron(&read_mesh(&folder.write("thing.txt", obj())).expect("an OBJ"));
    let unknown = read_mesh(&folder.write("notes.txt", "shopping list"))
        .expect_err("no mesh")
        .to_string();
    assert!(
        unknown.contains("notes.txt") && unknown.contains(".obj, .stl, .ply, .gltf and .glb"),
        "{unknown}"
    );
}

#[test]
fn files_beside_the_mesh_are_found() {
    let folder = Folder::new("beside");
    folder.write("the buffer.bin", buffer());
    let path = folder.write("a.gltf", gltf(ONE_NODE, r#","uri":"the%20buffer.bin""#));
    let mesh = read_mesh(&path).expect("a glTF");
    assert_is_tetrahedron(&mesh);
    let material = &mesh.materials[0];
    assert_eq!(
        (material.name.as_str(), material.base_color),
        ("red", [1.0, 0.0, 0.0, 1.0])
    );
    assert_eq!((material.metallic, material.roughness), (0.25, 0.5));

    folder.write(
        "a lib.mtl",
        "newmtl old wood\nKd 0.5 0.25 0.125\nd 0.5\nPr 0.25\nnewmtl other\nNs 0\n",
    );
    let text = obj()
        .replacen("f ", "mtllib a lib.mtl\nf ", 1)
        .replace("f 2", "usemtl old wood\nf 2");
    let mesh = read_mesh(&folder.write("a.obj", text)).expect("an OBJ");
    assert_eq!(mesh.materials[0].base_color, [0.5, 0.25, 0.125, 0.5]);
    assert_eq!(
        (mesh.materials[0].name.as_str(), mesh.materials[0].roughness),
        ("old wood", 0.25)
    );
    assert_eq!(mesh.material_of_triangle, [1, 1, 1, 0]);
    assert_eq!(mesh.materials.len(), 2);
}

#[test]
fn files_outside_the_folder_are_not_opened() {
    let folder = Folder::new("outside");
    for uri in [
        "../secret.bin",
        "/etc/hostname",
        "%2e%2e/secret.bin",
        "http://example.org/a.bin",
    ] {
        let path = folder.write("a.gltf", gltf(ONE_NODE, &format!(r#","uri":"{uri}""#)));
        assert!(read_mesh(&path).is_err(), "{uri}");
    }
}

#[test]
fn obj_polygons_and_negative_indices_and_seams() {
    // A unit cube of quads, its corners counted backwards, each face with texture corners of its own.
    let mut text = String::new();
    for i in 0..8 {
        text += &format!("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2 & 1);
    }
    text += "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    for (k, quad) in [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ]
    .iter()
    .enumerate()
    {
        let normal = ["0 0 -1", "0 0 1", "0 -1 0", "0 1 0", "-1 0 0", "1 0 0"][k];
        let [a, b, c, d] = quad.map(|v| v - 8);
        text += &format!("vn {normal}\nf {a}/1/-1 {b}/2/-1 {c}/3/-1 \\\n {d}/4/-1\n");
    }
    let mesh = read(MeshFormat::Obj, &text);
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (24, 12));
    assert!((volume(&mesh) - 1.0).abs() < 1e-12);
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
        let across = (b - a).cross(c - a).normalize().as_vec3();
        assert!(
            triangle
                .iter()
                .all(|&v| mesh.normals[v as usize].distance(across) < 1e-6)
        );
    }
    let corner = mesh
        .uvs
        .iter()
        .filter(|&&uv| uv == Vec2::new(0.0, 1.0))
        .count();
    assert_eq!(corner, 6);
    let (surface, report) = repair(&mesh).expect("a cube");
    assert_eq!((surface.positions.len(), report.welded), (8, 16));
    assert!(report.is_watertight());
}

#[test]
fn normals_that_some_corners_lack_are_completed() {
    let text = obj().replacen("f 1 3 2", "vn 0 0 -3\nf 1//1 3//1 2//1", 1);
    let mesh = read(MeshFormat::Obj, text);
    assert_eq!(mesh.normals[0], Vec3::NEG_Z);
    assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-6));
}

#[test]
fn coordinates_keep_their_double_precision() {
    let text = obj().replace("v 1 0 0", "v 1.000000000001 0 0");
    assert_eq!(
        read(MeshFormat::Obj, text).positions[1],
        DVec3::new(1.000_000_000_001, 0.0, 0.0)
    );
}

#[test]
fn mirrored_nodes_stay_outside_out_and_transforms_chain() {
    let nodes = r#"[{"children":[1,2],"translation":[10,0,0]},
        {"mesh":0,"scale":[-2,1,1]},
        {"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476],"translation":[0,5,0]}]"#;
    let mesh = read(MeshFormat::Gltf, glb(&gltf(nodes, "")));
    assert_eq!(mesh.triangles.len(), 8);
    let part = |range: std::ops::Range<usize>| {
        let triangles = mesh.triangles[range].to_vec();
        InputMesh {
            triangles,
            ..mesh.clone()
        }
    };
    assert!((volume(&part(0..4)) - 2.0 / 6.0).abs() < 1e-6);
    assert!((volume(&part(4..8)) - 1.0 / 6.0).abs() < 1e-6);
    assert!(mesh.positions[1].distance(DVec3::new(8.0, 0.0, 0.0)) < 1e-6);
    // A quarter turn about z takes x to y.
    assert!(mesh.positions[5].distance(DVec3::new(10.0, 6.0, 0.0)) < 1e-6);
}

#[test]
fn strips_and_fans_are_wound_as_their_triangles() {
    // A closed strip over the tetrahedron, and a fan of its first vertices.
    let strip = gltf(ONE_NODE, "").replace(r#""indices":1,"#, r#""mode":5,"#);
    assert_eq!(
        read(MeshFormat::Gltf, glb(&strip)).triangles,
        [[0, 1, 2], [2, 1, 3]]
    );
    let fan = gltf(ONE_NODE, "").replace(r#""indices":1,"#, r#""mode":6,"#);
    assert_eq!(
        read(MeshFormat::Gltf, glb(&fan)).triangles,
        [[0, 1, 2], [0, 2, 3]]
    );
}

#[test]
fn sparse_accessors_replace_rows() {
    let sparse = r#""count":4,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":3}}"#;
    let json = gltf(ONE_NODE, "").replace(r#""count":4,"type":"VEC3""#, sparse).replace(
        r#"{"buffer":0,"byteOffset":48,"byteLength":24}"#,
        r#"{"buffer":0,"byteOffset":48,"byteLength":24},{"buffer":0,"byteOffset":50,"byteLength":2},{"buffer":0,"byteOffset":12,"byteLength":12}"#,
    );
    // The index is the second of the first face, 2; the value the second position.
    let mesh = read(MeshFormat::Gltf, glb(&json));
    assert_eq!(mesh.positions, [DVec3::ZERO, DVec3::X, DVec3::X, DVec3::Z]);
}

#[test]
fn a_file_cut_anywhere_is_an_error_or_a_smaller_mesh() {
    for (format, bytes) in [
        (MeshFormat::Obj, obj().into_bytes()),
        (MeshFormat::Stl, stl(b"")),
        (MeshFormat::Stl, stl_text().into_bytes()),
        (MeshFormat::Ply, ply_text()),
        (MeshFormat::Ply, ply_binary(true)),
        (MeshFormat::Gltf, glb(&gltf(ONE_NODE, ""))),
    ] {
        for end in 0..bytes.len() {
            if let Ok(mesh) = parse(format, &bytes[..end]) {
                assert!(mesh.triangles.len() <= 4);
            }
        }
    }
    let cut = |format, bytes: &[u8]| message(format, &bytes[..bytes.len() - 20]);
    assert!(cut(MeshFormat::Stl, &stl(b"")).contains("cut off: it ends inside facet 4 of 4"));
    assert!(cut(MeshFormat::Ply, &ply_binary(true)).contains("cut off: it ends inside face 3"));
    assert!(
        cut(MeshFormat::Gltf, &glb(&gltf(ONE_NODE, "")))
            .contains("cut off: it ends inside the binary chunk")
    );
}

#[test]
fn damaged_files_say_what_is_wrong_where() {
    let text = obj();
    for (format, bytes, expected) in [
        (MeshFormat::Obj, String::new(), "the file is empty"),
        (
            MeshFormat::Obj,
            text.replace("f 2 3 4", "f 2 3 9"),
            "face 4 refers to vertex 9, but there are only 4",
        ),
        (
            MeshFormat::Obj,
            text.replace("f 2 3 4", "f 2 3 -5"),
            "face 4 refers to vertex -5",
        ),
        (
            MeshFormat::Obj,
            text.replace("f 2 3 4", "f 2 3 0"),
            "face 4 refers to vertex 0",
        ),
        (
            MeshFormat::Obj,
            text.replace("f 2 3 4", "f 2 3 4/7"),
            "face 4 refers to vertex 7, but there are only 0",
        ),
        (
            MeshFormat::Obj,
            text.replace("v 0 1 0", "v 0 nan 0"),
            "vertex 3 has a coordinate",
        ),
        (
            MeshFormat::Obj,
            text.replace("v 0 1 0", "v 0 1e999 0"),
            "vertex 3 has a coordinate",
        ),
        (
            MeshFormat::Obj,
            text.replace("v 0 1 0", "v 0 one 0"),
            "line 5: “one” is not a number",
        ),
        (
            MeshFormat::Obj,
            text.replace("v 0 1 0", "v 0 1"),
            "line 5: a number is missing",
        ),
        (
            MeshFormat::Obj,
            "v 0 0 0\nl 1 1\n".into(),
            "the file has no triangles",
        ),
        (
            MeshFormat::Ply,
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n".into(),
            "vertices have no y",
        ),
        (
            MeshFormat::Ply,
            "ply\nformat dense 1.0\n".into(),
            "line 2: “format dense 1.0” is no PLY header line",
        ),
        (
            MeshFormat::Ply,
            text.clone(),
            "line 1: a PLY file begins with",
        ),
        (
            MeshFormat::Gltf,
            "{\"asset\":7}".into(),
            "the JSON of the glTF",
        ),
        (
            MeshFormat::Gltf,
            gltf(ONE_NODE, ""),
            "buffer 0: it has neither a uri nor a binary chunk",
        ),
        (
            MeshFormat::Gltf,
            gltf(ONE_NODE, r#","uri":"a.bin""#),
            "which cannot be read from memory",
        ),
        (
            MeshFormat::Gltf,
            r#"{"asset":{"version":"2.0"}}"#.into(),
            "the file has no triangles",
        ),
    ] {
        let message = message(format, &bytes);
        assert!(message.contains(expected), "{message}");
    }
    let huge = |kind: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement {kind} 99999999\nproperty float x\nproperty float y\nproperty float z\nproperty list uchar int vertex_index\nend_header\n"
        )
    };
    assert!(
        message(MeshFormat::Ply, huge("face"))
            .contains("99999999 triangles, the limit is 20000000")
    );
    assert!(
        message(MeshFormat::Ply, huge("vertex"))
            .contains("99999999 vertices, the limit is 60000000")
    );
}

#[test]
fn damaged_gltf_says_what_is_wrong_where() {
    let sound = gltf(ONE_NODE, "");
    for (from, to, expected) in [
        (
            r#""count":4"#,
            r#""count":5000"#,
            "cut off: it ends inside accessor 0",
        ),
        (
            r#""count":4"#,
            r#""count":18446744073709551615"#,
            "vertices, the limit is",
        ),
        (
            r#""byteLength":48"#,
            r#""byteLength":4800"#,
            "cut off: it ends inside buffer view 0",
        ),
        (
            r#""count":4"#,
            r#""count":3"#,
            "refers to vertex 3, but there are only 3",
        ),
        (
            r#""POSITION":0"#,
            r#""POSITION":7"#,
            "accessor 7: there is none",
        ),
        (
            r#""mesh":0"#,
            r#""mesh":0,"children":[0]"#,
            "node 0: it is reached twice",
        ),
        (
            r#""material":0"#,
            r#""material":3"#,
            "material 3: there is none",
        ),
        (
            r#""asset""#,
            r#""extensionsRequired":["KHR_draco_mesh_compression"],"asset""#,
            "KHR_draco_mesh_compression, which is not supported",
        ),
    ] {
        assert!(sound.contains(from));
        let message = message(MeshFormat::Gltf, glb(&sound.replacen(from, to, 1)));
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn a_missing_file_suggests_its_neighbour() {
    let folder = Folder::new("missing");
    folder.write("stanford-bunny.obj", obj());
    let message = |name: &str| {
        read_mesh(&folder.0.join(name))
            .expect_err("nothing there")
            .to_string()
    };
    assert!(message("stanford-buny.obj").ends_with("did you mean stanford-bunny.obj?"));
    assert!(message("teapot.ply").ends_with("teapot.ply"));
    assert!(message(".").ends_with("is not a file; name a mesh file inside it"));
    assert!(matches!(
        read_mesh(Path::new("")),
        Err(ReadError::Missing { .. })
    ));
}

/// `cargo test --release --test read -- --ignored --nocapture`, for the figures.
#[test]
#[ignore = "writes 250 MB"]
fn five_million_triangles_are_read_and_repaired() {
    let folder = Folder::new("large");
    let (rows, around) = (1250_u32, 2000_u32);
    let point = |row: u32, k: u32| {
        let polar = std::f32::consts::PI * (0.001 + 0.998 * row as f32 / rows as f32);
        let turn = std::f32::consts::TAU * (k % around) as f32 / around as f32;
        [
            polar.sin() * turn.cos(),
            polar.cos(),
            -polar.sin() * turn.sin(),
        ]
    };
    let mut bytes = vec![0; 80];
    bytes.extend((2 * rows * around).to_le_bytes());
    for (row, k) in (0..rows).flat_map(|row| (0..around).map(move |k| (row, k))) {
        let [a, b, c, d] = [
            point(row, k),
            point(row + 1, k),
            point(row + 1, k + 1),
            point(row, k + 1),
        ];
        for triangle in [[a, b, c], [a, c, d]] {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
            bytes.extend([0; 2]);
        }
    }
    let path = folder.write("large.stl", bytes);
    let start = std::time::Instant::now();
    let mesh = read_mesh(&path).expect("an STL");
    println!(
        "read {} triangles in {:.2?}, peak {}",
        mesh.triangles.len(),
        start.elapsed(),
        peak_memory()
    );
    let start = std::time::Instant::now();
    let (surface, report) = repair(&mesh).expect("a surface");
    println!(
        "repaired in {:.2?}, peak {}: {report}",
        start.elapsed(),
        peak_memory()
    );
    assert_eq!(
        (surface.triangles.len(), report.boundary_loops),
        (5_000_000, 2)
    );
    assert_eq!(surface.positions.len() as u32, (rows + 1) * around);
}

/// The line of Linux's process status about the most memory held so far.
fn peak_memory() -> String {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    line.unwrap_or("not known").to_owned()
}

#[test]
fn groups_objects_and_materials_of_an_obj_are_named_parts() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\no cup\ng rim frame\nf 1 2 4 3\nusemtl clay\ng\nf 2 3 4\no lid\ng frame\nf 3 1 4\n";
    let mesh = read(MeshFormat::Obj, text);
    let parts = mesh.named_parts();
    let expected: [(&str, &[u32]); 5] = [
        ("clay", &[3, 4]),
        ("cup", &[1, 2, 3]),
        ("frame", &[1, 2, 4]),
        ("lid", &[4]),
        ("rim", &[1, 2]),
    ];
    let expected: Vec<(String, Vec<u32>)> = expected
        .into_iter()
        .map(|(name, triangles)| (name.to_string(), triangles.to_vec()))
        .collect();
    assert_eq!(parts, expected);
}

#[test]
fn faces_of_fewer_than_three_corners_are_passed_over_and_counted() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 7 8\nf 1 3 2\nf 1 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 4\n";
    let mesh = read(MeshFormat::Obj, text.replace("f 7 8", "f 3 4"));
    assert_eq!((mesh.triangles.len(), mesh.skipped_faces), (4, 3));
    let (surface, report) = frangible_mesh::repair(&mesh).unwrap();
    assert_eq!(surface.triangles.len(), 4);
    let note = report.to_string();
    assert_eq!(note, "passed over 3 faces of fewer than three corners");
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 5\n\
               property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n2 0 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
    let mesh = read(MeshFormat::Ply, ply);
    assert_eq!((mesh.triangles.len(), mesh.skipped_faces), (4, 1));
}
