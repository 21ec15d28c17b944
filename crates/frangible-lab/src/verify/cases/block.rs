//! A block without any thin side, against a series of polynomials.

use frangible_bake::{BakeError, Shape};

use crate::verify::case::Findings;
use crate::verify::check::check;
use crate::verify::models::{GLASS, covered, free_modes, quadratic};
use crate::verify::ritz::box_frequencies;

/// Sides, m: no two alike, so that no two modes are.
const SIZE: [f64; 3] = [0.1, 0.08, 0.05];

const SERIES: &str = "Legendre series; W. M. Visscher et al., J. Acoust. Soc. Am. 90, 2154 (1991)";
const WANTED: usize = 20;

pub(super) fn compute() -> Result<Findings, BakeError> {
    let references = box_frequencies(SIZE, &GLASS, [10; 3], WANTED);
    let block = Shape::block(SIZE);
    let mesh = free_modes(&quadratic(&block, 0.01, 5, &GLASS)?, WANTED)?;
    let lattice = free_modes(&covered(&block, 0.02, 1500, &GLASS)?, WANTED)?;
    let mut checks = Vec::new();
    for (what, modes, tolerance) in [("mesh", mesh, 0.025), ("lattice", lattice, 0.005)] {
        let mut add = |name: String, i: usize| {
            let (value, reference) = (modes.frequency(i), references[i]);
            checks.push(check(name, "Hz", [value, reference], tolerance, SERIES));
        };
        for i in [0, 1, 4, 9, 19] {
            add(format!("mode {}, {what}", i + 1), i);
        }
        let off = |i: &usize| (modes.frequency(*i) / references[*i] - 1.0).abs();
        if let Some(worst) = (0..WANTED).max_by(|a, b| off(a).total_cmp(&off(b))) {
            add(format!("farthest off of the first {WANTED}, {what}"), worst);
        }
    }
    Ok(checks.into())
}
