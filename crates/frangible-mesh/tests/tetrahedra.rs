//! Promises of the mesher, on solids with known volumes.

use std::ops::ControlFlow;

use crate::common::{Ball, Block, check_sound};
use frangible_mesh::glam::{DMat3, DVec3};
use frangible_mesh::{
    Resolution, Solid, TetError, TetOptions, tetrahedralize, tetrahedralize_watched,
};

fn options(resolution: Resolution) -> TetOptions {
    let mut options = TetOptions::default();
    options.resolution = resolution;
    options.irregular = Some(1);
    options
}

fn ball(radius: f64, wall: Option<f64>) -> Ball {
    Ball {
        centre: DVec3::new(0.1, 0.2, 0.05),
        radius,
        wall,
    }
}

#[test]
fn a_ball_converges_to_its_volume_at_second_order() {
    let mut errors = Vec::new();
    for cell in [0.2, 0.1] {
        let ball = ball(1.0, None);
        let (body, report) = tetrahedralize(&ball, &options(Resolution::Cell(cell))).unwrap();
        assert_eq!(check_sound(&body), 2);
        errors.push((1.0 - report.volume / ball.volume()).abs());
    }
    assert!(
        errors[1] < 0.005 && errors[1] < 0.4 * errors[0],
        "{errors:?}"
    );
}

#[test]
fn the_wanted_number_of_tetrahedra_is_met_within_fifteen_per_cent() {
    for (name, solid) in [
        ("ball", Box::new(ball(0.03, None)) as Box<dyn Solid>),
        ("hollow ball", Box::new(ball(2.0, Some(1.0)))),
        ("slab", Box::new(Block::turned(DVec3::new(0.2, 0.2, 0.08)))),
    ] {
        for wanted in [3000, 20_000] {
            let (body, _) =
                tetrahedralize(solid.as_ref(), &options(Resolution::Tets(wanted))).unwrap();
            let ratio = body.tets.len() as f64 / wanted as f64;
            assert!(
                (0.85..=1.15).contains(&ratio),
                "{name}: {} for {wanted}",
                body.tets.len()
            );
        }
    }
}

#[test]
fn a_hollow_ball_keeps_both_its_surfaces_down_to_the_promised_wall() {
    for cells in [3.0, 2.0, frangible_mesh::CELLS_PER_WALL] {
        let ball = ball(1.0, Some(0.1 * cells));
        let (body, report) = tetrahedralize(&ball, &options(Resolution::Cell(0.1))).unwrap();
        assert_eq!(
            check_sound(&body),
            4,
            "two spheres at {cells} cells per wall"
        );
        assert!(
            (report.volume / ball.volume() - 1.0).abs() < 0.01,
            "{cells}: {report}"
        );
    }
}

#[test]
fn walls_given_refine_the_lattice_or_are_refused_with_the_number_they_need() {
    let ball = ball(1.0, Some(0.06));
    let mut thin = options(Resolution::Tets(5000));
    thin.wall = Some(0.06);
    let (body, report) = tetrahedralize(&ball, &thin).unwrap();
    assert_eq!(check_sound(&body), 4);
    assert!(report.cell <= 0.06 / frangible_mesh::CELLS_PER_WALL * 1.0001);
    thin.most = 20_000;
    match tetrahedralize(&ball, &thin) {
        Err(TetError::TooThin {
            wall,
            needed,
            limit,
        }) => {
            assert_eq!((wall, limit), (0.06, 20_000));
            assert!(
                needed.abs_diff(report.tets) < report.tets / 5,
                "{needed} of {}",
                report.tets
            );
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_block_keeps_its_edges_and_corners() {
    for block in [
        Block {
            half: DVec3::new(1.0, 0.8, 0.3),
            turn: DMat3::IDENTITY,
        },
        Block::turned(DVec3::new(1.0, 0.8, 0.3)),
    ] {
        let (body, report) = tetrahedralize(&block, &options(Resolution::Tets(20_000))).unwrap();
        assert_eq!(check_sound(&body), 2);
        let features = report.features;
        assert!(features.sharp > 300, "{features:?}");
        assert!(features.not_snapped * 10 < features.sharp, "{features:?}");
        assert!(
            (report.volume / block.volume() - 1.0).abs() < 0.003,
            "{report}"
        );
        let mut corners = 0;
        for c in 0..8 {
            let sign = DVec3::from_array(std::array::from_fn(|k| {
                if c >> k & 1 == 0 { -1.0 } else { 1.0 }
            }));
            let corner = block.turn * (sign * block.half);
            let near = body
                .positions
                .iter()
                .map(|p| p.distance(corner))
                .fold(f64::INFINITY, f64::min);
            corners += usize::from(near < 0.01 * report.cell);
        }
        println!("{report}; {corners} corners");
        assert!(corners >= 7, "{corners} of 8 corners");
    }
}

#[test]
fn the_bits_do_not_depend_on_the_number_of_threads() {
    let mesh = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            tetrahedralize(
                &Block::turned(DVec3::new(1.0, 0.5, 0.4)),
                &options(Resolution::Tets(8000)),
            )
            .unwrap()
            .0
        })
    };
    let (one, two) = (mesh(1), mesh(2));
    assert_eq!(one.tets, two.tets);
    let bits = |p: &[DVec3]| {
        p.iter()
            .flat_map(|p| p.to_array())
            .map(f64::to_bits)
            .collect::<Vec<_>>()
    };
    assert_eq!(bits(&one.positions), bits(&two.positions));
}

#[test]
fn different_seeds_give_different_interiors_of_the_same_body() {
    let mut a = options(Resolution::Tets(3000));
    let ball = ball(1.0, None);
    let first = tetrahedralize(&ball, &a).unwrap().0;
    a.irregular = Some(2);
    let second = tetrahedralize(&ball, &a).unwrap().0;
    assert_eq!(first.tets, second.tets);
    assert_ne!(first.positions, second.positions);
}

#[test]
fn two_balls_apart_are_refused_and_a_crumb_is_dropped_and_told() {
    struct Two(Ball, Ball);
    impl Solid for Two {
        fn bounds(&self) -> [DVec3; 2] {
            let ([a, b], [c, d]) = (self.0.bounds(), self.1.bounds());
            [a.min(c), b.max(d)]
        }
        fn signed_distance(&self, p: DVec3) -> f64 {
            self.0.signed_distance(p).min(self.1.signed_distance(p))
        }
    }
    let at = |x: f64, radius: f64| Ball {
        centre: DVec3::new(x, 0.0, 0.0),
        radius,
        wall: None,
    };
    let two = Two(at(-1.0, 0.5), at(1.0, 0.5));
    let result = tetrahedralize(&two, &options(Resolution::Tets(4000)));
    assert!(
        matches!(result, Err(TetError::Pieces { pieces: 2, .. })),
        "{result:?}"
    );
    let crumb = Two(at(-1.0, 0.5), at(1.0, 0.1));
    let (body, report) = tetrahedralize(&crumb, &options(Resolution::Tets(4000))).unwrap();
    check_sound(&body);
    assert!(report.pieces == 2 && report.kept > 0.98, "{report}");
    assert!(
        report.to_string().contains("1 disconnected piece"),
        "{report}"
    );
}

#[test]
fn numbers_that_cannot_be_used_are_refused() {
    let ball = ball(1.0, None);
    for resolution in [
        Resolution::Cell(0.0),
        Resolution::Cell(f64::NAN),
        Resolution::Cell(-1.0),
        Resolution::Tets(0),
    ] {
        let result = tetrahedralize(&ball, &options(resolution));
        assert!(
            matches!(result, Err(TetError::NotPositive { .. })),
            "{resolution:?}"
        );
    }
    assert!(matches!(
        tetrahedralize(&ball, &options(Resolution::Cell(1e-5))),
        Err(TetError::TooFine { .. })
    ));
    assert!(matches!(
        tetrahedralize(&ball, &options(Resolution::Cell(50.0))),
        Err(TetError::Nothing { .. })
    ));
    let nowhere = Ball {
        centre: DVec3::NAN,
        radius: 1.0,
        wall: None,
    };
    assert!(matches!(
        tetrahedralize(&nowhere, &TetOptions::default()),
        Err(TetError::NotPositive { .. })
    ));
}

#[test]
fn progress_rises_from_nought_to_one_and_changes_nothing() {
    let mut told = Vec::new();
    let watched = tetrahedralize_watched(
        &ball(1.0, None),
        &options(Resolution::Tets(3000)),
        &mut |share| {
            told.push(share);
            ControlFlow::Continue(())
        },
    );
    let (body, report) = watched.unwrap();
    assert!(told.is_sorted() && told.len() > 5, "{told:?}");
    assert_eq!((told[0], told[told.len() - 1]), (0.0, 1.0));
    let (plain, plain_report) =
        tetrahedralize(&ball(1.0, None), &options(Resolution::Tets(3000))).unwrap();
    assert_eq!((body.positions, body.tets), (plain.positions, plain.tets));
    assert_eq!(report, plain_report);
}

#[test]
fn a_stop_at_any_report_ends_the_work_there() {
    for stop_at in [0.0, 0.3, 0.7] {
        let mut calls_after = 0;
        let result = tetrahedralize_watched(
            &ball(1.0, None),
            &options(Resolution::Tets(3000)),
            &mut |share| {
                if share < stop_at {
                    return ControlFlow::Continue(());
                }
                calls_after += 1;
                ControlFlow::Break(())
            },
        );
        assert_eq!(result.err(), Some(TetError::Cancelled));
        assert_eq!(calls_after, 1);
    }
}
