//! Features of single formats.

use super::*;

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
    assert_eq!(note, "skipped 3 faces with fewer than three vertices");
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 5\n\
               property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n2 0 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
    let mesh = read(MeshFormat::Ply, ply);
    assert_eq!((mesh.triangles.len(), mesh.skipped_faces), (4, 1));
}
