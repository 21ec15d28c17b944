//! Small files of every format, written here byte by byte, and errors of damaged ones.

use std::fs;
use std::path::{Path, PathBuf};

use frangible_mesh::glam::{DVec3, Vec2, Vec3};
use frangible_mesh::{InputMesh, MeshFormat, ReadError, parse_mesh, read_mesh, repair};

mod formats;
mod looks;
mod numbers;
mod pose;
mod refused;
mod variants;

use numbers::Numbers;

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
    glb_of(json, buffer())
}

fn glb_of(json: &str, mut data: Vec<u8>) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    data.resize(data.len().next_multiple_of(4), 0);
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

/// `cargo test --release -p frangible-mesh --test tests five_million -- --ignored --nocapture`, for the figures.
#[test]
#[ignore = "writes 250 MB: `cargo xtask ci 'long tests'` runs it"]
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
