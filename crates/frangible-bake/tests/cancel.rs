//! Progress moves, and a bake ends when it is told to.

use std::ops::ControlFlow;

use frangible::Material;
use frangible_bake::eigen::lowest_modes;
use frangible_bake::fem::{Elasticity, Elements, QuadraticMesh, System, assemble};
use frangible_bake::{BakeError, BakeSpec, CancelToken, MeshSize, Shape, Stage, bake_with};

fn glass() -> BakeSpec {
    let material = Material::preset("glass").unwrap();
    let mut spec = BakeSpec::new("glass", Shape::drinking_glass(), material);
    let size = |edge| Some(MeshSize { edge, layers: 1 });
    (spec.analysis, spec.fracture) = (size(0.008), size(0.004));
    spec.modes = 60;
    spec
}

fn system() -> System {
    let spec = glass();
    let mesh = spec.shape.analysis_mesh(spec.analysis.unwrap()).unwrap();
    let mesh = QuadraticMesh::new(&mesh);
    let elements = Elements::Quadratic(&mesh.elements);
    assemble(&mesh.positions, elements, &Elasticity::from(&spec.material))
}

#[test]
fn progress_of_the_modes_rises_in_small_steps_to_one() {
    let mut shares = Vec::new();
    let modes = lowest_modes(&system(), 60, &mut |share| {
        shares.push(share);
        ControlFlow::Continue(())
    })
    .unwrap();
    assert!(shares.windows(2).all(|w| w[0] <= w[1]), "{shares:?}");
    assert_eq!((shares[0], shares[shares.len() - 1]), (0.0, 1.0));
    // One of 20 blocks at most between two calls, and the last stretch, which ends anywhere.
    let largest = shares.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
    assert!(largest < 0.35, "{shares:?}");
    let sum: f64 = modes.seconds.iter().map(|phase| phase.1).sum();
    assert!(sum > 0.0 && modes.seconds.iter().all(|phase| phase.1 >= 0.0));
}

#[test]
fn the_search_ends_wherever_it_is_told_to() {
    let system = system();
    for stop_at in [0.0, 0.03, 0.1, 0.3, 0.6, 1.0] {
        let mut calls_after = 0;
        let result = lowest_modes(&system, 60, &mut |share| {
            if share < stop_at {
                return ControlFlow::Continue(());
            }
            calls_after += 1;
            ControlFlow::Break(())
        });
        assert_eq!(result.unwrap_err(), BakeError::Cancelled);
        assert_eq!(calls_after, 1, "told once, at {stop_at}");
    }
}

#[test]
fn a_bake_ends_within_the_stage_in_which_it_is_cancelled() {
    for stop_in in [
        Stage::Mesh,
        Stage::Assemble,
        Stage::Modes,
        Stage::Embed,
        Stage::Stress,
    ] {
        let spec = glass();
        let token = spec.cancel.clone();
        let mut last = None;
        let result = bake_with(&spec, |progress| {
            last = Some(progress.stage);
            if progress.stage == stop_in {
                token.cancel();
            }
        });
        assert_eq!(result.err(), Some(BakeError::Cancelled));
        assert_eq!(last, Some(stop_in));
    }
}

#[test]
fn another_thread_can_cancel() {
    let spec = glass();
    let token: CancelToken = spec.cancel.clone();
    assert!(!token.is_cancelled());
    let (reached, is_reached) = std::sync::mpsc::channel();
    let (done, is_done) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        is_reached.recv().unwrap();
        token.cancel();
        done.send(()).unwrap();
    });
    let result = bake_with(&spec, |progress| {
        if progress.stage == Stage::Modes && progress.fraction == 0.0 {
            // Hold the bake until the other thread has had its turn.
            if reached.send(()).is_ok() {
                is_done.recv().ok();
            }
        }
    });
    assert_eq!(result.err(), Some(BakeError::Cancelled));
    assert_eq!(BakeError::Cancelled.to_string(), "the bake was cancelled");
}

#[test]
fn a_bake_that_nobody_cancels_tells_where_the_time_of_its_modes_went() {
    let report = bake_with(&glass(), |_| {}).unwrap().report;
    let modes = report
        .seconds
        .iter()
        .find(|s| s.0 == Stage::Modes)
        .unwrap()
        .1;
    let phases: f64 = report.mode_seconds.iter().map(|phase| phase.1).sum();
    assert!(
        phases > 0.5 * modes && phases <= modes,
        "{phases} of {modes} s"
    );
}
