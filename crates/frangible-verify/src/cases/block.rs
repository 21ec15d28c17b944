//! A block without any thin side, against a series of polynomials.

use frangible_bake::{BakeError, Shape};

use crate::case::{Case, Findings};
use crate::check::hertz;
use crate::models::{GLASS, free_modes, quadratic};
use crate::ritz::box_frequencies;

/// Sides, m: no two alike, so that no two modes are.
const SIZE: [f64; 3] = [0.1, 0.08, 0.05];

pub(crate) const CASE: Case = Case {
    name: "block",
    title: "Free block",
    about: "A glass block, 100 × 80 × 50 mm, in quadratic elements 10 mm long: where no beam or plate theory holds. The \
        reference is a Ritz series of Legendre polynomials up to degree 10 in all three directions, the method by which \
        resonant ultrasound spectroscopy measures elastic constants; it has no elements.",
    compute,
};

const SERIES: &str = "Legendre series; W. M. Visscher et al., J. Acoust. Soc. Am. 90, 2154 (1991)";

fn compute(progress: &mut dyn FnMut(f64)) -> Result<Findings, BakeError> {
    let references = box_frequencies(SIZE, &GLASS, [10; 3], 20);
    progress(0.5);
    let modes = free_modes(&quadratic(&Shape::block(SIZE), 0.01, 5, &GLASS)?, 20)?;
    progress(1.0);
    let named = [0, 1, 2, 4, 9, 19].map(|i| {
        hertz(
            format!("mode {}", i + 1),
            modes.frequency(i),
            references[i],
            0.005,
            SERIES,
        )
    });
    let off = |i: &usize| (modes.frequency(*i) / references[*i] - 1.0).abs();
    let worst = (0..20).max_by(|a, b| off(a).total_cmp(&off(b)));
    let mut checks = named.to_vec();
    checks.extend(worst.map(|i| {
        hertz(
            "farthest off of the first twenty",
            modes.frequency(i),
            references[i],
            0.005,
            SERIES,
        )
    }));
    Ok(checks.into())
}
