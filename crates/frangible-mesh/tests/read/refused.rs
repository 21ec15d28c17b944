//! Files that are damaged, absent or not to be opened.

use super::*;

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
    assert!(cut(MeshFormat::Stl, &stl(b"")).contains("truncated: it ends inside facet 4 of 4"));
    assert!(cut(MeshFormat::Ply, &ply_binary(true)).contains("truncated: it ends inside face 3"));
    assert!(
        cut(MeshFormat::Gltf, &glb(&gltf(ONE_NODE, "")))
            .contains("truncated: it ends inside the binary chunk")
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
            "line 2: “format dense 1.0” is not a valid PLY header line",
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
            "a separate file",
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
            .contains("99999999 triangles, but the limit is 20000000")
    );
    assert!(
        message(MeshFormat::Ply, huge("vertex"))
            .contains("99999999 vertices, but the limit is 60000000")
    );
}

#[test]
fn a_film_of_a_break_is_no_body() {
    let named = |generator: &str, name: &str| {
        let asset = format!(r#"{{"version":"2.0","generator":"{generator}"}}"#);
        let sound = gltf(ONE_NODE, "").replace(r#"{"version":"2.0"}"#, &asset);
        let name = format!(r#""meshes":[{{"name":"{name}","#);
        glb(&sound.replace(r#""meshes":[{"#, &name))
    };
    let film = named("Frangible 0.1.0", "glass piece 1");
    assert!(message(MeshFormat::Gltf, film).contains("an exported break with 1 pieces"));
    for (generator, name) in [("Blender", "glass piece 1"), ("Frangible 0.1.0", "glass")] {
        let mesh = read(MeshFormat::Gltf, named(generator, name));
        assert_eq!(mesh.triangles.len(), 4);
    }
}

#[test]
fn damaged_gltf_says_what_is_wrong_where() {
    let sound = gltf(ONE_NODE, "");
    for (from, to, expected) in [
        (
            r#""count":4"#,
            r#""count":5000"#,
            "truncated: it ends inside accessor 0",
        ),
        (
            r#""count":4"#,
            r#""count":18446744073709551615"#,
            "vertices, but the limit is",
        ),
        (
            r#""byteLength":48"#,
            r#""byteLength":4800"#,
            "truncated: it ends inside buffer view 0",
        ),
        (
            r#""count":4"#,
            r#""count":3"#,
            "refers to vertex 3, but there are only 3",
        ),
        (
            r#""POSITION":0"#,
            r#""POSITION":7"#,
            "accessor 7: it does not exist",
        ),
        (
            r#""mesh":0"#,
            r#""mesh":0,"children":[0]"#,
            "node 0: it occurs twice",
        ),
        (
            r#""material":0"#,
            r#""material":3"#,
            "material 3: it does not exist",
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
    assert!(message(".").ends_with("is not a file; give the path of a mesh file"));
    assert!(matches!(
        read_mesh(Path::new("")),
        Err(ReadError::Missing { .. })
    ));
}

#[test]
fn gltf_of_another_version_is_named_with_the_way_out() {
    let old = r#"{"asset":{"version":"1.0"},"scenes":{},"meshes":{"m":{}}}"#;
    let mut binary = glb(&gltf(ONE_NODE, ""));
    binary[4] = 1;
    for bytes in [
        old.as_bytes(),
        br#"{"asset":{"version":1.0},"meshes":{"m":{}}}"#,
        // Version 1.0 did not ask for a version.
        br#"{"meshes":{"m":{"primitives":[]}},"accessors":{}}"#,
        br#"{"asset":{"version":"1.1"}}"#,
        &binary,
    ] {
        let message = message(MeshFormat::Gltf, bytes);
        assert!(
            message.contains("glTF 1.") && message.contains("gltf-pipeline"),
            "{message}"
        );
    }
    let new = r#"{"asset":{"version":"3.0"},"meshes":{}}"#;
    assert!(message(MeshFormat::Gltf, new).contains("glTF 3.0"));
}

#[test]
fn addresses_of_the_web_are_to_be_downloaded_first() {
    for address in [
        "https://example.org/a.glb",
        "http://example.org/a.obj",
        "HTTPS://example.org/a.stl?x=1",
        "ftp://example.org/a.ply",
    ] {
        let message = read_mesh(Path::new(address))
            .expect_err("no file")
            .to_string();
        assert!(
            message.contains("download") && message.contains(address),
            "{message}"
        );
    }
    let tets = frangible_mesh::read_tets(Path::new("https://example.org/a.msh"));
    assert!(tets.expect_err("no file").to_string().contains("download"));
    let folder = Folder::new("address");
    let uri = r#","uri":"https://example.org/a.bin""#;
    let message = read_mesh(&folder.write("a.gltf", gltf(ONE_NODE, uri)))
        .expect_err("no buffer")
        .to_string();
    assert!(message.contains("buffer 0") && message.contains("download"));
}
