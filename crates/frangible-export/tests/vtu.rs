//! Tetrahedra with fields as .vtu: read back by a small reader that knows only VTK's description of the format.

use frangible_export::{ExportError, VtuCells, VtuField, VtuMesh, VtuValues, write_vtu};
use frangible_recording::glam::Vec3;

/// Text between two others.
fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let from = text.find(start).unwrap_or_else(|| panic!("no {start}")) + start.len();
    &text[from..from + text[from..].find(end).unwrap()]
}

/// The bytes of a data array, and its description.
fn array<'a>(file: &'a [u8], name: &str) -> (&'a [u8], String) {
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let at = file
        .windows(marker.len())
        .position(|w| w == marker)
        .unwrap();
    let head = std::str::from_utf8(&file[..at]).unwrap();
    let tag = head
        .split("<DataArray ")
        .find(|tag| tag.contains(&format!("Name=\"{name}\"")))
        .unwrap_or_else(|| panic!("no array {name}"));
    let offset: usize = between(tag, "offset=\"", "\"").parse().unwrap();
    let start = at + marker.len() + offset;
    let length = u64::from_le_bytes(file[start..start + 8].try_into().unwrap()) as usize;
    (&file[start + 8..start + 8 + length], tag.to_string())
}

fn numbers<T, const N: usize>(file: &[u8], name: &str, of: fn([u8; N]) -> T) -> Vec<T> {
    let (bytes, _) = array(file, name);
    bytes
        .chunks_exact(N)
        .map(|b| of(b.try_into().unwrap()))
        .collect()
}

fn points(count: usize) -> Vec<Vec3> {
    let number = |i: usize| ((i * 7919) % 101) as f32 / 7.0;
    (0..count)
        .map(|i| Vec3::new(number(3 * i), -number(3 * i + 1), number(3 * i + 2)))
        .collect()
}

#[test]
fn a_mesh_comes_back_as_it_was() {
    let points = points(13);
    let cells = [
        [0, 1, 2, 3, 4, 5, 6, 7, 8, 9],
        [12, 11, 10, 9, 8, 7, 6, 5, 4, 3],
    ];
    let shape: Vec<Vec3> = points.iter().map(|p| *p * -0.1).collect();
    let stress: Vec<f32> = (0..13).map(|i| 1e6 / (1.0 + i as f32)).collect();
    let mesh = VtuMesh {
        points: &points,
        cells: VtuCells::Quadratic(&cells),
        point_data: &[
            VtuField {
                name: "mode_01",
                values: VtuValues::Vectors(&shape),
            },
            VtuField {
                name: "stress",
                values: VtuValues::Scalars(&stress),
            },
        ],
        field_data: &[("frequencies", &[440.0, 0.1])],
    };
    let file = write_vtu(&mesh).unwrap();
    assert_eq!(
        numbers(&file, "frequencies", f64::from_le_bytes),
        [440.0, 0.1]
    );
    for (name, expected) in [("Points", &points), ("mode_01", &shape)] {
        let flat: Vec<f32> = expected.iter().flat_map(|p| p.to_array()).collect();
        assert_eq!(numbers(&file, name, f32::from_le_bytes), flat);
        assert!(array(&file, name).1.contains("NumberOfComponents=\"3\""));
    }
    assert_eq!(numbers(&file, "stress", f32::from_le_bytes), stress);
    let flat: Vec<i64> = cells.as_flattened().iter().map(|&v| i64::from(v)).collect();
    assert_eq!(numbers(&file, "connectivity", i64::from_le_bytes), flat);
    assert_eq!(numbers(&file, "offsets", i64::from_le_bytes), [10, 20]);
    assert_eq!(array(&file, "types").0, [24, 24]);
    assert!(file.ends_with(b"</AppendedData>\n</VTKFile>\n"));
    assert_eq!(file, write_vtu(&mesh).unwrap());
}

#[test]
fn linear_elements_have_their_own_number_and_names_are_escaped() {
    let points = points(4);
    let file = write_vtu(&VtuMesh {
        points: &points,
        cells: VtuCells::Linear(&[[0, 1, 2, 3]]),
        point_data: &[],
        field_data: &[("a < \"b\" & c\n", &[1.0])],
    })
    .unwrap();
    assert_eq!(array(&file, "types").0, [10]);
    assert_eq!(numbers(&file, "offsets", i64::from_le_bytes), [4]);
    let name = "a &lt; &quot;b&quot; &amp; c ";
    assert_eq!(numbers(&file, name, f64::from_le_bytes), [1.0]);
}

#[test]
fn meshes_that_do_not_fit_together_are_refused_by_name() {
    let sound = points(4);
    let mut holed = sound.clone();
    holed[2].y = f32::NAN;
    let refused = |points: &[Vec3], cell: [u32; 4], values: &[f32], number: f64| {
        let error = write_vtu(&VtuMesh {
            points,
            cells: VtuCells::Linear(&[cell]),
            point_data: &[VtuField {
                name: "heat",
                values: VtuValues::Scalars(values),
            }],
            field_data: &[("beat", &[number])],
        })
        .unwrap_err();
        assert!(matches!(error, ExportError::Grid(_)));
        error.to_string()
    };
    let (cell, ones) = ([0, 1, 2, 3], [1.0; 4]);
    assert!(refused(&holed, cell, &ones, 1.0).contains("node 2 lies at"));
    assert!(
        refused(&sound, [0, 1, 2, 4], &ones, 1.0)
            .contains("node 4, counted from 0, but there are only 4")
    );
    assert!(refused(&sound, cell, &[1.0; 3], 1.0).contains("`heat` has 3 values"));
    assert!(refused(&sound, cell, &[f32::INFINITY; 4], 1.0).contains("`heat`"));
    assert!(refused(&sound, cell, &ones, f64::NAN).contains("`beat`"));
}
