//! Tetrahedra without volume: few are mended, many refused.

use frangible_mesh::glam::DVec3;
use frangible_mesh::quality::volume;
use frangible_mesh::{MendedTets, TetInput, TetInputError, mend_tets};

use super::plain;
use crate::common::check_closed;

/// Volume of a cell of the sample.
const CELL: f64 = 1.0 / 256.0;

fn add(mesh: &mut TetInput, tet: [u32; 4]) {
    mesh.numbers.push(mesh.tets.len() as u64 + 1);
    mesh.tets.push(tet);
}

/// Mends, and finds the body sound, closed and of one surface.
fn mended(mesh: &TetInput) -> MendedTets {
    let mended = mend_tets(mesh).unwrap();
    assert_eq!(check_closed(&mended.body), 2, "{}", mended.mend);
    mended
}

#[test]
fn flat_tetrahedra_at_the_surface_are_dropped() {
    let sound = plain([2, 2, 2]);
    let corner = |x: f64, y: f64| {
        let at = DVec3::new(0.0, x, y);
        sound.positions.iter().position(|&p| p == at).unwrap() as u32
    };
    // A cap over a square of the side x = 0, one with a node twice, one whose nodes are doubled, and one within.
    let square = [
        corner(0.0, 0.0),
        corner(0.25, 0.0),
        corner(0.25, 0.125),
        corner(0.0, 0.125),
    ];
    let [a, b, c, d] = square;
    let inner = sound.tets[5];
    let copy = sound.positions.len() as u32;
    for (tet, doubles) in [
        ([a, b, c, d], false),
        ([a, c, b, d], false),
        ([a, b, c, c], false),
        ([inner[0], inner[1], inner[2], copy], true),
        ([a, a, a, a], false),
    ] {
        let mut mesh = sound.clone();
        if doubles {
            mesh.positions.push(mesh.positions[inner[2] as usize]);
        }
        add(&mut mesh, tet);
        let mended = mended(&mesh);
        assert_eq!((mended.mend.flat, mended.mend.lifted), (1, 0), "{tet:?}");
        assert!((mended.body.volume() - 8.0 * CELL).abs() < 1e-15);
        assert!(
            mended
                .mend
                .to_string()
                .contains("1 flat tetrahedra dropped")
        );
    }
}

#[test]
fn flat_and_folded_tetrahedra_inside_get_a_volume() {
    let sound = plain([4, 4, 4]);
    let wanted = 64.0 * CELL;
    let mut tried = 0;
    let middle = sound.positions.iter().sum::<DVec3>() / sound.positions.len() as f64;
    let nearest = |v: &u32| sound.positions[*v as usize].distance(middle);
    let node = (0..sound.positions.len() as u32)
        .min_by(|a, b| nearest(a).total_cmp(&nearest(b)))
        .unwrap();
    // The node inside goes to the middle of the face opposite to it, and through it.
    for e in (0..sound.tets.len()).filter(|&e| sound.tets[e].contains(&node)) {
        for past in [0.0, 1e-9, 0.02] {
            let mut mesh = sound.clone();
            let tet = mesh.tets[e];
            let face = tet.iter().filter(|v| **v != node);
            let foot = face.map(|&v| mesh.positions[v as usize]).sum::<DVec3>() / 3.0;
            let way = foot - mesh.positions[node as usize];
            mesh.positions[node as usize] += way * (1.0 + past);
            let mended = mended(&mesh);
            assert!(mended.mend.lifted >= 1, "{e}: {}", mended.mend);
            assert_eq!((mended.mend.turned, mended.mend.flat), (0, 0), "{e}");
            assert!(mended.mend.moved <= 0.1, "{}", mended.mend);
            assert_eq!(mended.body.tets.len(), sound.tets.len());
            // Nothing overlaps and nothing is left out.
            let sum: f64 = (0..mended.body.tets.len())
                .map(|e| volume(mended.body.corners(e)))
                .sum();
            assert!((sum - wanted).abs() < 1e-12, "{e}: {sum} for {wanted}");
            tried += 1;
        }
    }
    assert!(tried > 40, "{tried}");
}

#[test]
fn many_flat_tetrahedra_are_counted_and_refused() {
    let mut mesh = plain([2, 2, 2]);
    for e in 10..20 {
        mesh.tets[e][3] = mesh.tets[e][0];
    }
    mesh.numbers[10] = 77;
    let error = mend_tets(&mesh).unwrap_err();
    assert!(matches!(
        error,
        TetInputError::Flat {
            element: 77,
            count: 10,
            of: 48,
            ..
        }
    ));
    let message = error.to_string();
    assert!(
        message.contains("10 of 48") && message.contains("element 77"),
        "{message}"
    );
    let mut lone = plain([1, 1, 1]);
    lone.tets.truncate(1);
    lone.tets[0][1] = lone.tets[0][0];
    assert!(matches!(
        mend_tets(&lone),
        Err(TetInputError::Flat { count: 1, .. })
    ));
}
