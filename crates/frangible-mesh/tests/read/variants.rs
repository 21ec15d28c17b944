//! Rare but sound ways to write each format: all give the same tetrahedron.

use super::*;

/// The tetrahedron as strips: one of all faces but the last, which stands alone; −1 begins anew.
const STRIPS: [&[i64]; 2] = [&[1, 0, 2, 3, 1, -1, 1, 2], &[-1, 0, 1, 3, 3, -1]];

/// Little-endian or big-endian bytes of a whole number.
fn whole(value: i64, size: usize, is_big: bool) -> Vec<u8> {
    let mut bytes = value.to_le_bytes()[..size].to_vec();
    if is_big {
        bytes.reverse();
    }
    bytes
}

fn strips_header(format: &str, kind: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
         element tristrips 2\nproperty uchar flags\nproperty list ushort {kind} vertex_indices\nend_header\n"
    )
}

#[test]
fn ply_strips_are_wound_as_their_triangles_and_begin_anew_at_minus_one() {
    let mut text = strips_header("ascii", "int");
    text += &CORNERS.map(|[x, y, z]| format!("{x} {y} {z}\n")).concat();
    for strip in STRIPS {
        let row: Vec<String> = strip.iter().map(ToString::to_string).collect();
        text += &format!("0 {} {}\n", strip.len(), row.join(" "));
    }
    let mesh = read(MeshFormat::Ply, &text);
    assert_is_tetrahedron(&mesh);
    let wrong = message(MeshFormat::Ply, text.replace("3 3 -1", "3 9 -1"));
    assert!(
        wrong.contains("refers to vertex 9, but there are only 4"),
        "{wrong}"
    );
    let wrong = message(MeshFormat::Ply, text.replace("3 3 -1", "3 -2 -1"));
    assert!(wrong.contains("refers to vertex -2"), "{wrong}");

    // In binary, whole numbers without a sign have all bits set in place of −1.
    for (kind, size) in [
        ("char", 1),
        ("uchar", 1),
        ("short", 2),
        ("uint16", 2),
        ("int", 4),
        ("uint", 4),
        ("int64", 8),
        ("uint64", 8),
    ] {
        for (order, is_big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
            let mut bytes = strips_header(order, kind).into_bytes();
            for x in CORNERS.iter().flatten() {
                bytes.extend(whole(i64::from(x.to_bits()), 4, is_big));
            }
            for strip in STRIPS {
                bytes.push(0);
                bytes.extend(whole(strip.len() as i64, 2, is_big));
                bytes.extend(strip.iter().flat_map(|&v| whole(v, size, is_big)));
            }
            assert_is_tetrahedron(&read(MeshFormat::Ply, &bytes));
        }
    }
}

#[test]
fn ply_headers_with_odd_lines_are_read() {
    let body = |skipped: &str| {
        let vertices = CORNERS.map(|[x, y, z]| format!("{x} {y} {z} 2 8 9\n"));
        let faces = FACES.map(|[a, b, c]| format!("0.5 3 {a} {b} {c}\n"));
        format!("{skipped}{}{}", vertices.concat(), faces.concat())
    };
    let sound = "ply\ncomment first of all\nformat ascii 1.0\nobj_info num_cols 4\n\nelement camera 2\nproperty float f\n\
                 comment in between\nproperty list uint16 double what\nelement vertex 4\nproperty float x\nproperty float y\n\
                 obj_info\nproperty double z\nproperty list int8 uchar ring\ncomment: what a scanner writes\n# by hand\n\
                 element face 4\nproperty float quality\nproperty list short uint vertex_index\ncomment last\nend_header\n";
    let text = format!("{sound}{}", body("1 2 3.5 4\n2 0\n"));
    let header_in_capitals = format!("{}{}", sound.to_ascii_uppercase(), body("1 2 3.5 4\n2 0\n"));
    for text in [
        text.clone(),
        text.replace('\n', "\r\n"),
        text.replace('\n', "\r"),
        text.replace('\n', " \t\n"),
        text.replace("vertex_index", "vertex_indices extra"),
        text.replace("vertex_index", "corners"),
        header_in_capitals,
    ] {
        assert_is_tetrahedron(&read(MeshFormat::Ply, &text));
        assert_eq!(MeshFormat::sniff(text.as_bytes()), Some(MeshFormat::Ply));
    }
    let points = sound
        .replace("face 4", "face 0")
        .replace("property list short uint vertex_index\n", "");
    let points = message(MeshFormat::Ply, format!("{points}{}", body("1 0\n2 0\n")));
    assert!(points.contains("the file has no triangles"), "{points}");
}

#[test]
fn text_stl_goes_by_words_not_lines() {
    let one_line = stl_text()
        .replace("\r\n", " ")
        .replace("solid a vertex by name", "solid s");
    let solids = format!("{one_line} {}", one_line.replace("solid s", "solid t u"));
    for text in [
        one_line.clone(),
        one_line.to_ascii_uppercase(),
        stl_text().to_ascii_uppercase(),
        stl_text()
            .replace(' ', "\n")
            .replace("a\nvertex\nby\nname", "a"),
        stl_text().replace("\r\n", "\r"),
        one_line.replace("facet normal 0 0 0", "facet"),
    ] {
        let mesh = read(MeshFormat::Stl, &text);
        assert_is_tetrahedron(&mesh);
        assert_eq!(MeshFormat::sniff(text.as_bytes()), Some(MeshFormat::Stl));
    }
    let mesh = read(MeshFormat::Stl, solids);
    let groups: Vec<_> = mesh
        .groups
        .iter()
        .map(|g| (&g.name[..], g.triangles.clone()))
        .collect();
    assert_eq!(groups, [("s", 0..4), ("t u", 4..8)]);
    let wrong = message(
        MeshFormat::Stl,
        one_line.replacen("vertex 0e0 1 0", "vertex 0e0 one 0", 1),
    );
    assert!(
        wrong.contains("line 1, facet 1: “one” is not a number"),
        "{wrong}"
    );
}

#[test]
fn binary_stl_counts_by_its_length_where_its_count_is_wrong() {
    for header in [&b"by hand"[..], b"solid in truth binary", b"SOLID"] {
        let counted = |count: u32, tail: &[u8]| {
            let mut bytes = stl(header);
            bytes[80..84].copy_from_slice(&count.to_le_bytes());
            bytes.extend(tail);
            bytes
        };
        for bytes in [
            counted(0, b""),
            counted(u32::MAX, b""),
            counted(0, b"\n"),
            counted(1, b""),
            counted(4, &[0; 100]),
            counted(4, b"\0\0some bytes"),
            counted(4, &[0; 70]),
        ] {
            assert_is_tetrahedron(&read(MeshFormat::Stl, bytes));
        }
        let cut = message(MeshFormat::Stl, counted(9, b""));
        assert!(
            cut.contains("truncated: it ends inside facet 5 of 9"),
            "{cut}"
        );
        let none = &counted(0, b"")[..84];
        assert!(message(MeshFormat::Stl, none).contains("no triangles"));
    }
}

fn utf16(text: &str, is_big: bool, mark: bool) -> Vec<u8> {
    let mark = if mark { "\u{feff}" } else { "" };
    let units = mark.encode_utf16().chain(text.encode_utf16());
    units
        .flat_map(|unit| {
            if is_big {
                unit.to_be_bytes()
            } else {
                unit.to_le_bytes()
            }
        })
        .collect()
}

#[test]
fn text_in_utf16_or_with_a_mark_is_read() {
    use base64::Engine as _;
    let inline = base64::engine::general_purpose::STANDARD.encode(buffer());
    let inline = format!(r#","uri":"data:application/octet-stream;base64,{inline}""#);
    let folder = Folder::new("utf16");
    for (format, name, text) in [
        (MeshFormat::Obj, "a.obj", obj()),
        (MeshFormat::Stl, "a.stl", stl_text()),
        (
            MeshFormat::Ply,
            "a.ply",
            String::from_utf8(ply_text()).expect("text"),
        ),
        (MeshFormat::Gltf, "a.gltf", gltf(ONE_NODE, &inline)),
    ] {
        let codings = [
            utf16(&text, false, true),
            utf16(&text, true, true),
            utf16(&text, false, false),
            utf16(&text, true, false),
            format!("\u{feff}{text}").into_bytes(),
        ];
        for bytes in codings {
            assert_is_tetrahedron(&read(format, &bytes));
            for name in [name, "a"] {
                assert_is_tetrahedron(&read_mesh(&folder.write(name, &bytes)).expect(name));
            }
            // Cut anywhere, also between the bytes of a letter.
            for end in 1..bytes.len().min(200) {
                let _ = parse(format, &bytes[..end]);
            }
        }
    }
}

#[test]
fn obj_keywords_may_be_capitals() {
    let folder = Folder::new("capitals");
    folder.write(
        "a.mtl",
        utf16("NEWMTL Red\nKD 1 0 0\nPM 0.25\n", false, true),
    );
    let text = obj().to_ascii_uppercase().replacen(
        "F 1 3 2",
        "MTLLIB a.mtl\nVT 0 0\nVN 0 0 -1\nUSEMTL Red\nG lid\nF -4/1/1 -2/1/1 \\\r\n -3/1/1",
        1,
    );
    assert_eq!(MeshFormat::sniff(text.as_bytes()), Some(MeshFormat::Obj));
    let mesh = read_mesh(&folder.write("a.obj", &text)).expect("an OBJ");
    assert_is_tetrahedron(&mesh);
    assert_eq!(mesh.materials[0].base_color, [1.0, 0.0, 0.0, 1.0]);
    assert_eq!(mesh.materials[0].metallic, 0.25);
    let names: Vec<&str> = mesh.groups.iter().map(|g| &g.name[..]).collect();
    assert_eq!(names, ["THING", "lid"]);
}

#[test]
fn sparse_accessors_without_a_base_begin_at_nought() {
    // All rows but the first, which is the origin; their numbers are those of the last face.
    let sparse = r#"{"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":3,
        "indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":0,"byteOffset":12}}}"#;
    let json = gltf(ONE_NODE, "")
        .replace(
            r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}"#,
            sparse,
        )
        .replace(
            r#""byteOffset":48,"byteLength":24}"#,
            r#""byteOffset":48,"byteLength":24},{"buffer":0,"byteOffset":66,"byteLength":6}"#,
        );
    assert_is_tetrahedron(&read(MeshFormat::Gltf, glb(&json)));
    let wrong = message(
        MeshFormat::Gltf,
        glb(&json.replace(r#""count":4"#, r#""count":40000000"#)),
    );
    assert!(
        wrong.contains("accessor 0: it has 40000000 elements"),
        "{wrong}"
    );
}

#[test]
fn a_changed_byte_of_a_rare_file_is_an_error_or_another_mesh() {
    let mut strips = strips_header("ascii", "int");
    strips += &CORNERS.map(|[x, y, z]| format!("{x} {y} {z}\n")).concat();
    strips += "0 5 1 0 2 3 1\n0 4 -1 0 1 3\n";
    let mut uncounted = stl(b"solid");
    uncounted[80] = 0;
    for (format, bytes) in [
        (MeshFormat::Ply, strips.into_bytes()),
        (
            MeshFormat::Stl,
            stl_text().replace("\r\n", " ").into_bytes(),
        ),
        (MeshFormat::Stl, uncounted),
        (MeshFormat::Obj, utf16(&obj(), true, true)),
    ] {
        for at in 0..bytes.len() {
            for flip in [0x01, 0x55, 0x80, 0xff] {
                let mut changed = bytes.clone();
                changed[at] ^= flip;
                if let Ok(mesh) = parse(format, &changed) {
                    let there = mesh.positions.len() as u32;
                    assert!(mesh.triangles.iter().flatten().all(|&v| v < there));
                }
            }
        }
    }
}
