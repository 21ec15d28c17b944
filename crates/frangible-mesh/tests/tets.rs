//! Files of tetrahedra: every format and variant gives the same mesh, and what cannot be used is refused in words.

mod slivers;
mod write;

use frangible_mesh::{
    TetFormat, TetInput, TetInputError, mend_tets, parse_tetgen, parse_tets, read_tets,
};
use std::path::Path;
use write::{As, ENDS, Sample, medit, msh2, msh4, sample, tetgen};

fn read_tetgen([node, ele, face]: &[String; 3]) -> TetInput {
    parse_tetgen(node.as_bytes(), ele.as_bytes(), Some(face.as_bytes())).unwrap()
}

/// Every variant, by a name.
fn variants(s: &Sample) -> Vec<(String, TetInput)> {
    let mut all = Vec::new();
    let mut add = |name: String, format: TetFormat, bytes: Vec<u8>| {
        let read = parse_tets(format, &bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        all.push((name, read));
    };
    for (coding, name) in [(As::Text, "text"), (As::Little, "little"), (As::Big, "big")] {
        add(
            format!("msh 2.2 {name}"),
            TetFormat::Msh,
            msh2(s, coding, 1, 1),
        );
        add(
            format!("msh 2.2 {name} with gaps"),
            TetFormat::Msh,
            msh2(s, coding, 40, 3),
        );
        add(format!("msh 4.1 {name}"), TetFormat::Msh, msh4(s, coding));
    }
    add("medit".into(), TetFormat::Medit, medit(s));
    for first in [0, 1] {
        all.push((
            format!("tetgen from {first}"),
            read_tetgen(&tetgen(s, first)),
        ));
    }
    all
}

#[test]
fn every_format_and_variant_gives_the_mesh_that_was_written() {
    for quadratic in [false, true] {
        let s = sample([2, 1, 3], quadratic);
        for (name, read) in variants(&s) {
            let nodes: Vec<[f64; 3]> = read.positions.iter().map(|p| p.to_array()).collect();
            assert_eq!(nodes, s.nodes, "{name}");
            let corners: Vec<&[u32]> = s.tets.iter().map(|t| &t[..4]).collect();
            let found: Vec<&[u32]> = read.tets.iter().map(|t| &t[..]).collect();
            assert_eq!(found, corners, "{name}");
            assert_eq!(read.mid_edges.is_some(), quadratic, "{name}");
            for (e, six) in read.mid_edges.iter().flatten().enumerate() {
                assert_eq!(six, &s.tets[e][4..], "{name}");
                for (k, [a, b]) in ENDS.into_iter().enumerate() {
                    let [a, b] = [a, b].map(|i| read.positions[read.tets[e][i] as usize]);
                    assert_eq!(read.positions[six[k] as usize], 0.5 * (a + b), "{name}");
                }
            }
            assert_eq!(read.groups.len(), 2, "{name}");
            let named = name.starts_with("msh");
            let wanted = if named {
                ["the side", "body"]
            } else {
                ["surface 7", "volume 3"]
            };
            for (group, (wanted, dimension)) in
                read.groups.iter().zip(wanted.into_iter().zip([2, 3]))
            {
                assert_eq!(
                    (group.name.as_str(), group.dimension),
                    (wanted, dimension),
                    "{name}"
                );
            }
            assert_eq!(read.groups[1].members.len(), s.tets.len(), "{name}");
            let side: Vec<[u32; 3]> = read.groups[0]
                .members
                .iter()
                .map(|&f| read.faces[f as usize])
                .collect();
            assert_eq!(side, s.faces, "{name}");
        }
    }
}

#[test]
fn text_in_utf16_gives_the_same_mesh() {
    let s = sample([1, 1, 1], false);
    let wide = |bytes: &[u8], is_big: bool| -> Vec<u8> {
        let text = String::from_utf8(bytes.to_vec()).unwrap();
        let units = "\u{feff}".encode_utf16().chain(text.encode_utf16());
        let bytes = units.map(|u| {
            if is_big {
                u.to_be_bytes()
            } else {
                u.to_le_bytes()
            }
        });
        bytes.flatten().collect()
    };
    for is_big in [false, true] {
        for (format, bytes) in [
            (TetFormat::Msh, msh2(&s, As::Text, 1, 1)),
            (TetFormat::Medit, medit(&s)),
        ] {
            let read = parse_tets(format, &wide(&bytes, is_big)).unwrap();
            assert_eq!(read, parse_tets(format, &bytes).unwrap());
        }
        let files = tetgen(&s, 1);
        let [node, ele, face] = files.each_ref().map(|text| wide(text.as_bytes(), is_big));
        let read = parse_tetgen(&node, &ele, Some(&face)).unwrap();
        assert_eq!(read, read_tetgen(&files));
    }
}

#[test]
fn a_mended_body_has_the_volume_of_the_file_and_groups_of_its_nodes() {
    for quadratic in [false, true] {
        let s = sample([2, 1, 3], quadratic);
        for (name, read) in variants(&s) {
            let mended = mend_tets(&read).unwrap();
            // 2 × 1 × 3 cells of 1/8 × 1/4 × 1/8, sheared.
            assert!((mended.body.volume() - 6.0 / 256.0).abs() < 1e-15, "{name}");
            assert_eq!(mended.quadratic, quadratic, "{name}");
            assert_eq!(mended.mend.to_string(), "", "{name}");
            assert_eq!(mended.body.positions.len(), 3 * 2 * 4, "{name}: no middles");
            let side = &mended.groups[0].nodes;
            let on_side = mended.body.positions.iter().filter(|p| p.x == 0.0).count();
            assert_eq!(side.len(), on_side, "{name}");
            assert!(
                side.iter()
                    .all(|&v| mended.body.positions[v as usize].x == 0.0),
                "{name}"
            );
        }
    }
}

#[test]
fn a_file_cut_anywhere_is_an_error_or_a_sound_mesh() {
    let s = sample([1, 1, 1], true);
    let files = [
        (TetFormat::Msh, msh2(&s, As::Text, 1, 1)),
        (TetFormat::Msh, msh2(&s, As::Little, 1, 1)),
        (TetFormat::Msh, msh4(&s, As::Text)),
        (TetFormat::Msh, msh4(&s, As::Big)),
        (TetFormat::Medit, medit(&s)),
    ];
    for (format, bytes) in files {
        for end in 0..bytes.len() {
            if let Ok(read) = parse_tets(format, &bytes[..end]) {
                let _ = mend_tets(&read);
                assert!(
                    read.tets
                        .iter()
                        .flatten()
                        .all(|&v| (v as usize) < read.positions.len())
                );
            }
            // Every byte changed in turn as well.
            let mut changed = bytes.clone();
            changed[end] ^= 0x55;
            if let Ok(read) = parse_tets(format, &changed) {
                let _ = mend_tets(&read);
            }
        }
    }
}

#[test]
fn counts_beyond_the_file_are_refused_without_the_memory_for_them() {
    let huge = [
        (
            TetFormat::Msh,
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n99999999999999\n1 0 0 0\n",
        ),
        (
            TetFormat::Msh,
            "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n9999999999 9 9 9\n3 1 0 99999999999\n1 2",
        ),
        (
            TetFormat::Medit,
            "MeshVersionFormatted 2\nDimension 3\nVertices\n999999999999\n0 0 0 0",
        ),
    ];
    for (format, text) in huge {
        let message = parse_tets(format, text.as_bytes()).unwrap_err().to_string();
        assert!(message.contains("truncated"), "{message}");
    }
}

#[test]
fn refusals_name_the_culprit_and_the_mend() {
    let refused = |format, text: &str| parse_tets(format, text.as_bytes()).unwrap_err().to_string();
    let msh = |elements: &str| {
        refused(
            TetFormat::Msh,
            &format!(
                "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n1\n{elements}\n$EndElements\n"
            ),
        )
    };
    let cases = [
        (msh("1 5 2 0 1 1 2 3 4 1 2 3 4"), "hexahedra"),
        (msh("8 4 2 0 1 1 2 3 9"), "element 8: it refers to node 9"),
        (msh("1 2 2 0 1 1 2 3"), "no tetrahedra"),
        (
            msh("1 4 2 0 1 1 2 x 4"),
            "line 13: “x” is not a whole number",
        ),
        (msh("1 29 2 0 1 1 2 3 4"), "third or higher order"),
        (
            refused(TetFormat::Msh, "$MeshFormat\n4 0 8\n"),
            "2.2 or 4.1",
        ),
        (
            refused(TetFormat::Medit, "MeshVersionFormatted 2\nDimension 2\n"),
            "dimension 2",
        ),
    ];
    for (message, part) in cases {
        assert!(message.contains(part), "{message} lacks “{part}”");
    }
    let message = parse_tetgen(b"1 3 0 0\n1 0 0 a\n", b"", None)
        .unwrap_err()
        .to_string();
    assert!(message.contains(".node, line 2"), "{message}");
}

#[test]
fn a_vtk_file_is_refused_with_the_command_that_converts_it() {
    for name in ["part.vtu", "part.VTK"] {
        let message = read_tets(Path::new(name)).unwrap_err().to_string();
        assert!(
            message.contains(&format!("meshio convert {name}")),
            "{message}"
        );
    }
}

fn plain(counts: [usize; 3]) -> TetInput {
    parse_tets(TetFormat::Medit, &medit(&sample(counts, false))).unwrap()
}

#[test]
fn inside_out_doubled_and_unused_are_mended() {
    let mut mesh = plain([2, 2, 2]);
    let volume = mend_tets(&mesh).unwrap().body.volume();
    mesh.tets[3].swap(0, 1);
    mesh.tets[7].swap(2, 3);
    let copy = mesh.positions.len() as u32;
    mesh.positions
        .push(mesh.positions[mesh.tets[0][3] as usize]);
    mesh.tets[0][3] = copy;
    mesh.positions.push(glam::DVec3::splat(9.0));
    let mended = mend_tets(&mesh).unwrap();
    assert_eq!(
        (mended.mend.turned, mended.mend.welded, mended.mend.unused),
        (2, 1, 1)
    );
    assert!((mended.body.volume() - volume).abs() < 1e-15);
    assert!(
        (0..mended.body.tets.len())
            .all(|e| frangible_mesh::quality::volume(mended.body.corners(e)) > 0.0)
    );
}

#[test]
fn overlapping_loose_and_curved_elements_are_refused_by_their_number() {
    let mut shared = plain([1, 1, 1]);
    let far = shared.positions.len() as u32;
    shared.positions.push(glam::DVec3::new(0.05, 0.1, 9.0));
    let [a, b, c, _] = shared.tets[0];
    let faces = [
        [a, b, c],
        [a, b, shared.tets[0][3]],
        [a, c, shared.tets[0][3]],
        [b, c, shared.tets[0][3]],
    ];
    let inner = faces.into_iter().find(|f| {
        shared
            .tets
            .iter()
            .filter(|t| f.iter().all(|v| t.contains(v)))
            .count()
            == 2
    });
    let [a, b, c] = inner.unwrap();
    shared.tets.push([a, b, c, far]);
    shared.numbers.push(99);
    assert!(matches!(
        mend_tets(&shared),
        Err(TetInputError::SharedFace { element: 99 })
    ));

    let mut loose = plain([1, 1, 1]);
    let other: Vec<_> = loose
        .positions
        .iter()
        .map(|&p| p + glam::DVec3::X)
        .collect();
    let shift = loose.positions.len() as u32;
    loose.positions.extend(other);
    let more: Vec<_> = loose.tets.iter().map(|t| t.map(|v| v + shift)).collect();
    loose.tets.extend(more);
    assert!(matches!(
        mend_tets(&loose),
        Err(TetInputError::Pieces { pieces: 2, .. })
    ));

    let mut curved = parse_tets(TetFormat::Medit, &medit(&sample([1, 1, 1], true))).unwrap();
    let mid = curved.mid_edges.as_ref().unwrap()[0][0] as usize;
    curved.positions[mid].z += 0.01;
    let share = mend_tets(&curved).unwrap().mend.curved;
    assert!(share > 0.01 && share < 0.25);
    curved.positions[mid].z += 0.2;
    assert!(matches!(
        mend_tets(&curved),
        Err(TetInputError::Curved { .. })
    ));
}
