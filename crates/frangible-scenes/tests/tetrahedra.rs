//! Bodies from files of tetrahedra.

use frangible_bake::Shape;
use frangible_mesh::PartChoice;
use frangible_scenes::{Axis, BodySource, FileKind, Opened, open_source};

const MESH: &str = "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n80 0 0 0\n0 40 0 0\n0 0 20 0\n\
                    Tetrahedra 1\n1 2 3 4 3\nEnd\n";

#[test]
fn a_file_of_tetrahedra_is_taken_as_it_is_and_refuses_a_resolution() {
    let name = format!("frangible-tets-{}.mesh", std::process::id());
    let path = std::env::temp_dir().join(name);
    std::fs::write(&path, MESH).unwrap();
    assert_eq!(FileKind::of(&path).unwrap(), FileKind::Mesh);
    assert_eq!(Axis::up_in(&path), Axis::Z);
    let source = |size, resolution| BodySource::Mesh {
        path: path.clone(),
        size,
        up: Axis::Z,
        resolution,
        wall: None,
        parts: PartChoice::Auto,
    };
    let opened = open_source(&source(Some(0.08), None));
    let unsized_ = open_source(&source(None, None));
    let resolved = open_source(&source(Some(0.08), Some(9000)));
    std::fs::remove_file(&path).unwrap();
    let Opened::Shape { shape, .. } = opened.unwrap() else {
        panic!("it was not baked");
    };
    let Shape::Tets(tets) = shape else {
        panic!("it was meshed anew");
    };
    assert!((tets.body.volume() - 0.08 * 0.04 * 0.02 / 6.0).abs() < 1e-15);
    // z became y.
    let highest = tets.body.positions.iter().map(|p| p.y).fold(0.0, f64::max);
    assert!((highest - 0.02).abs() < 1e-15);
    assert_eq!(tets.group("volume 3").map(<[u32]>::len), Some(4));
    assert!(unsized_.unwrap_err().to_string().contains("--size"));
    assert!(resolved.unwrap_err().to_string().contains("resolution"));
}
