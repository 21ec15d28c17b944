//! Decrease of the error with the number of unknowns: linear against quadratic elements.

use frangible_bake::fem::{Cover, Elasticity, System, assemble_cover};
use frangible_bake::{BakeError, MeshSize, Shape};

use crate::verify::case::{Curve, Findings};
use crate::verify::check::{Check, check};
use crate::verify::models::{free_modes, linear, quadratic};
use crate::verify::ritz::first_box_frequency;

const SIZE: [f64; 3] = [0.4, 0.4, 0.01];

const MATERIAL: Elasticity = Elasticity {
    youngs_modulus: 100e9,
    poisson_ratio: 0.23,
    density: 2500.0,
};

const SERIES: &str = "Legendre series; W. M. Visscher et al., J. Acoust. Soc. Am. 90, 2154 (1991)";
const SAME_ELEMENTS: &str = "same elements in Python, SciPy eigsh";

/// A kind of element and how finely the plate was meshed with it.
struct Study {
    name: &'static str,
    points: Vec<Point>,
}

/// One mesh: squares along a side, or elements of a lattice; unknowns; frequency, Hz.
struct Point {
    size: usize,
    unknowns: usize,
    frequency: f64,
}

pub(super) fn compute() -> Result<Findings, BakeError> {
    let plate = Shape::block(SIZE);
    // The corners bend the mode within a thickness of the edges: degree 14 is 7e-4 too high, 32 lower by 3e-6.
    let reference = first_box_frequency(SIZE, &MATERIAL, [26, 26, 3]);
    let edge = |squares: usize| SIZE[0] / squares as f64;
    let body = plate.analysis_mesh(MeshSize {
        edge: edge(32),
        layers: 1,
    })?;
    let one_layer = study("T4, one layer", &[8, 16, 24, 32, 48], |n| {
        linear(&plate, edge(n), 1, &MATERIAL)
    })?;
    let two_layers = study("T4, two layers", &[8, 16, 24, 32, 44], |n| {
        linear(&plate, edge(n), 2, &MATERIAL)
    })?;
    let quadratic = study("T10, one layer", &[5, 6, 8, 12, 16, 22], |n| {
        quadratic(&plate, edge(n), 1, &MATERIAL)
    })?;
    let cover = study(
        "T10, covering lattice",
        &[60, 120, 250, 500, 1000, 2500],
        |n| Ok(assemble_cover(&Cover::new(&body, n)?, &MATERIAL)),
    )?;

    let mut checks = Vec::new();
    let of = |study: &Study, size: usize, reference: f64, tolerance: f64, source| {
        let point = study.points.iter().find(|p| p.size == size);
        let mesh = if study.name.ends_with("lattice") {
            format!("{size} elements")
        } else {
            format!("{size} × {size}")
        };
        let unknowns = point.map_or(0, |p| p.unknowns);
        let name = format!("{}, {mesh} ({unknowns} unknowns)", study.name);
        let found = point.map_or(f64::NAN, |p| p.frequency);
        check(name, "Hz", [found, reference], tolerance, source)
    };
    checks.push(of(&one_layer, 16, 828.0, 0.005, SAME_ELEMENTS));
    checks.push(of(&one_layer, 32, 559.0, 0.005, SAME_ELEMENTS));
    checks.push(of(&two_layers, 32, 490.0, 0.005, SAME_ELEMENTS));
    checks.push(of(&quadratic, 5, reference, 0.02, SERIES));
    checks.push(of(&quadratic, 8, reference, 0.01, SERIES));
    checks.push(of(&quadratic, 16, reference, 0.005, SERIES));
    checks.push(of(&cover, 1000, reference, 0.01, SERIES));
    checks.push(of(&cover, 2500, reference, 0.005, SERIES));
    checks.push(falls(&quadratic, reference));
    checks.push(falls(&cover, reference));
    let studies = [one_layer, two_layers, quadratic, cover];
    let curves = studies.iter().map(|study| curve(study, reference));
    Ok(Findings {
        checks,
        curves: curves.collect(),
    })
}

fn study(
    name: &'static str,
    sizes: &[usize],
    system: impl Fn(usize) -> Result<System, BakeError>,
) -> Result<Study, BakeError> {
    let point = |&size: &usize| {
        let system = system(size)?;
        Ok(Point {
            size,
            unknowns: system.unknowns(),
            frequency: free_modes(&system, 1)?.frequency(0),
        })
    };
    Ok(Study {
        name,
        points: sizes.iter().map(point).collect::<Result<_, BakeError>>()?,
    })
}

/// Number of refinements that brought the frequency no nearer.
fn falls(study: &Study, reference: f64) -> Check {
    let off = |p: &Point| (p.frequency / reference - 1.0).abs();
    let worse = study.points.windows(2).filter(|w| off(&w[1]) >= off(&w[0]));
    let name = format!("{}: refinements that do not help", study.name);
    check(
        name,
        "",
        [worse.count() as f64, 0.0],
        0.0,
        "a Ritz method converges",
    )
}

/// Error of the frequency over the number of unknowns.
fn curve(study: &Study, reference: f64) -> Curve {
    let error = |p: &Point| (p.frequency / reference - 1.0).abs();
    let points = study.points.iter();
    Curve {
        name: study.name,
        points: points.map(|p| [p.unknowns as f64, error(p)]).collect(),
    }
}
