//! Long work tells how far it has come, and stops when asked.

mod common;

use std::ops::ControlFlow;

use common::Ball;
use frangible_mesh::glam::DVec3;
use frangible_mesh::{Resolution, TetError, TetOptions, tetrahedralize, tetrahedralize_watched};

fn ball() -> Ball {
    Ball {
        centre: DVec3::ZERO,
        radius: 1.0,
        wall: None,
    }
}

fn options() -> TetOptions {
    let mut options = TetOptions::default();
    options.resolution = Resolution::Tets(3000);
    options
}

#[test]
fn progress_rises_from_nought_to_one_and_changes_nothing() {
    let mut told = Vec::new();
    let watched = tetrahedralize_watched(&ball(), &options(), &mut |share| {
        told.push(share);
        ControlFlow::Continue(())
    });
    let (body, report) = watched.unwrap();
    assert!(told.is_sorted() && told.len() > 5, "{told:?}");
    assert_eq!((told[0], told[told.len() - 1]), (0.0, 1.0));
    let (plain, plain_report) = tetrahedralize(&ball(), &options()).unwrap();
    assert_eq!((body.positions, body.tets), (plain.positions, plain.tets));
    assert_eq!(report, plain_report);
}

#[test]
fn a_stop_at_any_report_ends_the_work_there() {
    for stop_at in [0.0, 0.3, 0.7] {
        let mut calls_after = 0;
        let result = tetrahedralize_watched(&ball(), &options(), &mut |share| {
            if share < stop_at {
                return ControlFlow::Continue(());
            }
            calls_after += 1;
            ControlFlow::Break(())
        });
        assert_eq!(result.err(), Some(TetError::Cancelled));
        assert_eq!(calls_after, 1);
    }
}
