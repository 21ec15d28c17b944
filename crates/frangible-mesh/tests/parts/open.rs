//! Surfaces with holes, and hostile ones.

use frangible_mesh::glam::DVec3;
use frangible_mesh::{InputMesh, PartChoice, Parts, Surface, repair};

use super::{boxes, chosen, counts, join};

#[test]
fn a_shell_with_a_hole_is_a_part_and_a_sheet_beside_it_is_not() {
    let mut mesh = boxes(&[([0.0; 3], [1.0; 3]), ([3.0, 0.0, 0.0], [4.0, 1.0, 1.0])]);
    // The second box has no lid.
    mesh.triangles.drain(14..16);
    mesh.groups.clear();
    let (parts, chosen) = chosen(&mesh, &PartChoice::Auto);
    assert_eq!(chosen.bodies.len(), 2);
    assert!(parts.list[0].is_exact && !parts.list[1].is_exact);
    assert_eq!(parts.mesh(&mesh, &[1]).triangles.len(), 10);

    let sheet = InputMesh {
        positions: [[7.0, 0.0], [8.0, 0.0], [7.0, 1.0]]
            .map(|[x, y]| DVec3::new(x, y, 0.3))
            .to_vec(),
        triangles: vec![[0, 1, 2]],
        ..InputMesh::default()
    };
    let mesh = join(mesh, &sheet);
    let parts = Parts::of(&mesh).unwrap();
    assert_eq!((parts.list.len(), parts.loose_sheets), (2, 1));
    // Alone it is what the file has.
    let parts = Parts::of(&sheet).err();
    assert_eq!(parts, None);
}

#[test]
fn a_soup_of_sheets_that_enclose_a_body_together_is_one_part() {
    let mut mesh = boxes(&[([0.0; 3], [1.0; 3])]);
    // Every triangle has its own corners, a little apart.
    let corners: Vec<DVec3> = (mesh.triangles.iter().enumerate())
        .flat_map(|(t, triangle)| {
            let shift = DVec3::splat(1e-4 * (t as f64 - 6.0) / 6.0);
            triangle.map(|v| mesh.positions[v as usize] + shift)
        })
        .collect();
    mesh.positions = corners;
    mesh.triangles = (0..12).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    assert_eq!(counts(&mesh), [1, 1]);
    // A speck far from it is counted, one inside it belongs to it.
    let far = boxes(&[([3.0; 3], [3.05; 3])]);
    let (_, with_speck) = chosen(&join(mesh.clone(), &far), &PartChoice::Auto);
    assert_eq!((with_speck.bodies.len(), with_speck.dropped), (1, 1));
    let within = boxes(&[([0.4; 3], [0.5; 3])]);
    assert_eq!(counts(&join(mesh, &within)), [1, 1]);
}

#[test]
fn hostile_meshes_are_refused_or_divided_and_never_panic() {
    let mut state = 7_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as u32
    };
    for _ in 0..300 {
        let vertices = 4 + next() % 9;
        let mut mesh = InputMesh::default();
        for _ in 0..vertices {
            let mut at = || f64::from(next() % 4) * 0.5;
            mesh.positions.push(DVec3::new(at(), at(), at()));
        }
        for _ in 0..3 + next() % 40 {
            mesh.triangles.push([0; 3].map(|_| next() % vertices));
        }
        let Ok(parts) = Parts::of(&mesh) else {
            continue;
        };
        for choice in [
            PartChoice::Auto,
            PartChoice::Separate,
            PartChoice::Largest,
            PartChoice::Weld { gap: Some(9.0) },
        ] {
            let chosen = parts.choose(&mesh, &choice).unwrap();
            assert!(!chosen.bodies.is_empty());
            for body in &chosen.bodies {
                let own: &InputMesh = &parts.mesh(&mesh, &body.parts);
                assert!(!own.triangles.is_empty());
                let _: Option<Surface> = repair(own).ok().map(|(surface, _)| surface);
            }
        }
    }
}
