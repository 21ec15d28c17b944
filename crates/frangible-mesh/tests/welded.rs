//! Bodies welded across gaps, and tetrahedra with the volume of their solid.

use frangible_mesh::glam::{DMat3, DVec3};
use frangible_mesh::{
    MeshSolid, Resolution, Solid, Surface, TetOptions, VolumeAim, WeldedSolid, tetrahedralize,
};

use crate::common::{Ball, Block, check_sound};

fn cube(low: DVec3, high: DVec3) -> MeshSolid {
    let pick = |i: usize, k: usize| if i >> k & 1 == 0 { low[k] } else { high[k] };
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let surface = Surface {
        positions: (0..8)
            .map(|i| DVec3::new(pick(i, 0), pick(i, 1), pick(i, 2)))
            .collect(),
        triangles: quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
    };
    MeshSolid::new(&surface).unwrap()
}

/// Two cubes of 0.1 m, this far apart, welded across gaps of up to `gap`.
fn pair(apart: f64, gap: f64) -> WeldedSolid {
    let one = cube(DVec3::ZERO, DVec3::splat(0.1));
    let shift = DVec3::new(0.1 + apart, 0.0, 0.0);
    let two = cube(shift, shift + 0.1);
    WeldedSolid::new(vec![one, two], gap)
}

#[test]
fn a_gap_is_filled_up_to_its_width_and_no_farther() {
    let solid = pair(0.004, 0.004);
    for (p, inside) in [
        ([0.05, 0.05, 0.05], true),
        ([0.102, 0.05, 0.05], true),
        ([0.101, 0.001, 0.099], true),
        // Beside the gap and beyond the cubes there is nothing.
        ([0.102, -0.002, 0.05], false),
        ([0.102, 0.105, 0.05], false),
        ([-0.001, 0.05, 0.05], false),
        ([0.05, 0.05, 0.103], false),
    ] {
        assert_eq!(solid.inside(p.into()), inside, "{p:?}");
    }
    assert!(!pair(0.004, 0.0039).inside(DVec3::new(0.102, 0.05, 0.05)));
}

#[test]
fn welded_cubes_are_one_sound_body_with_the_gap_filled() {
    for (apart, tets) in [(0.002, 4000), (0.01, 20_000)] {
        let solid = pair(apart, apart);
        let mut options = TetOptions::default();
        options.resolution = Resolution::Tets(tets);
        let (body, report) = tetrahedralize(&solid, &options).unwrap();
        check_sound(&body);
        assert_eq!(report.pieces, 1);
        let whole = 0.1 * 0.1 * (0.2 + apart);
        // The rim of the gap bulges or sinks by less than a quarter of its width.
        assert!((report.volume / whole - 1.0).abs() < 0.01, "{report:?}");
    }
}

#[test]
fn tetrahedra_get_the_volume_of_their_solid_where_it_is_known() {
    let ball = Ball {
        centre: DVec3::new(3.0, 0.0, 0.0),
        radius: 0.1,
        wall: None,
    };
    let hollow = Ball {
        wall: Some(0.04),
        ..ball
    };
    for (ball, volume) in [(&ball, ball.volume()), (&hollow, hollow.volume())] {
        for tets in [1500, 12_000] {
            let with = |aim: VolumeAim| {
                let mut options = TetOptions::default();
                options.resolution = Resolution::Tets(tets);
                (options.irregular, options.volume) = (Some(1), aim);
                let (body, report) = tetrahedralize(ball, &options).unwrap();
                check_sound(&body);
                assert_eq!(report.lattice_volume.is_some(), aim != VolumeAim::Lattice);
                (body, report)
            };
            let (plain, before) = with(VolumeAim::Lattice);
            let (filled, after) = with(VolumeAim::Exact(volume));
            let (_, counted) = with(VolumeAim::Counted);
            let off = |v: f64| (v / volume - 1.0).abs();
            assert!(off(before.volume) > 2e-3, "{}", off(before.volume));
            assert!(off(after.volume) < 1e-8, "{}", off(after.volume));
            assert!(off(counted.volume) < 0.25 * off(before.volume));
            // Nodes move by a fraction of a cell, and none of the topology changes.
            assert_eq!(plain.tets, filled.tets);
            for (a, b) in plain.positions.iter().zip(&filled.positions) {
                let moved = a.distance(*b) / after.cell;
                assert!(moved < 0.25, "{moved}");
            }
        }
    }
}

#[test]
fn flat_faces_and_sharp_edges_stay_where_they_are() {
    let half = DVec3::new(0.1, 0.06, 0.04);
    let block = Block {
        half,
        turn: DMat3::IDENTITY,
    };
    let with = |aim: VolumeAim| {
        let mut options = TetOptions::default();
        options.resolution = Resolution::Tets(6000);
        (options.irregular, options.volume) = (Some(1), aim);
        tetrahedralize(&block, &options).unwrap().0
    };
    let before = with(VolumeAim::Lattice);
    let after = with(VolumeAim::Exact(8.0 * half.element_product()));
    assert!(before.positions.len() > 1000);
    // The lattice cuts off a few corners; nothing stands out to make up for them.
    assert!(before.volume() < 8.0 * half.element_product());
    assert_eq!(before.positions, after.positions);
}
