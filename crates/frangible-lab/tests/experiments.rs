//! The counting of cracks and the fits, on patterns and samples whose answer is known; and a small run of everything.

use std::f64::consts::TAU;

use frangible::glam::DVec2;
use frangible_lab::verify::experiments::{
    CrackPattern, CutOffLaw, Experiments, MassPlan, PowerLaw, RearStarPlan, StarPlan,
};

/// Straight radial lines from 3 to 40 mm, in pieces of 1 mm, at these angles, with a sideways zigzag, m.
fn rays(angles: &[f64], zigzag: f64) -> Vec<[DVec2; 2]> {
    let mut pieces = Vec::new();
    for &angle in angles {
        let (out, side) = (DVec2::from_angle(angle), DVec2::from_angle(angle).perp());
        let at = |k: i32| 1e-3 * f64::from(k) * out + zigzag * f64::from(k % 2) * side;
        pieces.extend((3..40).map(|k| [at(k), at(k + 1)]));
    }
    pieces
}

/// A ring of this radius whose points lie in turn a little within and without, m.
fn ring(radius: f64, wobble: f64) -> Vec<[DVec2; 2]> {
    let at = |k: i32| {
        let sign = f64::from(k % 2) - 0.5;
        (radius + wobble * sign) * DVec2::from_angle(TAU * f64::from(k % 60) / 60.0)
    };
    (0..60).map(|k| [at(k), at(k + 1)]).collect()
}

#[test]
fn a_star_of_n_rays_has_n_radial_cracks_whatever_rings_cross_it() {
    const RADII: [f64; 3] = [0.01, 0.015, 0.02];
    for n in [0, 1, 2, 5, 8, 13] {
        // The last ray lies across the seam of the angles.
        let angles: Vec<f64> = (0..n)
            .map(|k| TAU * (f64::from(k) + 0.5) / f64::from(n))
            .collect();
        let mut pieces = rays(&angles, 2e-4);
        pieces.extend(ring(0.01, 4e-4));
        pieces.extend(ring(0.018, 0.0));
        let pattern = CrackPattern { pieces };
        for radius in RADII {
            let found = pattern.crossings(radius, 1e-3) as f64;
            assert_eq!(found, f64::from(n), "{n}, {radius} m");
        }
        assert_eq!(pattern.crossings(0.05, 1e-3), 0, "beyond the cracks");
    }
}

#[test]
fn rays_nearer_than_the_gap_are_one_crack() {
    let pattern = CrackPattern {
        pieces: rays(&[1.0, 1.02, 2.0, 6.27, 0.01], 0.0),
    };
    assert_eq!(pattern.crossings(0.02, 1e-3), 3);
    assert_eq!(pattern.crossings(0.02, 1e-5), 5);
}

#[test]
fn a_star_is_radial_and_rings_are_not() {
    let star = CrackPattern {
        pieces: rays(&[0.3, 2.0, 4.0], 0.0),
    };
    let [radial, all] = star.lengths(0.005, 0.035);
    assert!(
        (all - 0.09).abs() < 1e-12 && radial == all,
        "{radial} of {all}"
    );
    let rings = CrackPattern {
        pieces: ring(0.02, 2e-4),
    };
    let [radial, all] = rings.lengths(0.005, 0.035);
    assert!((all / (TAU * 0.02) - 1.0).abs() < 0.01, "{all}");
    assert_eq!(radial, 0.0);
}

/// Numbers in (0, 1), the same every time, by Weyl's sequence.
fn uniform() -> impl FnMut() -> f64 {
    let mut x = 0.0_f64;
    move || {
        x = (x + 0.618_033_988_749_894_9).fract();
        x.max(1e-9)
    }
}

#[test]
fn a_power_law_is_found_with_an_error_that_tells_its_scatter() {
    let speeds = [10.0, 14.0, 20.0, 28.0, 40.0, 56.0, 80.0, 113.0];
    let exact: Vec<(f64, f64)> = speeds.map(|v: f64| (v, 0.9 * v.sqrt())).into();
    let law = PowerLaw::fit(&exact).unwrap();
    assert!((law.exponent - 0.5).abs() < 1e-12 && law.exponent_error < 1e-12);
    assert!((law.at(50.0) - 0.9 * 50.0_f64.sqrt()).abs() < 1e-9);
    // Scattered by up to a fifth: the truth lies within three errors, and the error is of the right size.
    let mut u = uniform();
    let scattered: Vec<(f64, f64)> = exact
        .iter()
        .map(|(v, n)| (*v, n * (0.4 * (u() - 0.5)).exp()))
        .collect();
    let law = PowerLaw::fit(&scattered).unwrap();
    assert!((0.01..0.1).contains(&law.exponent_error), "{law:?}");
    assert!(
        (law.exponent - 0.5).abs() < 3.0 * law.exponent_error,
        "{law:?}"
    );
    assert_eq!(PowerLaw::fit(&[(1.0, 2.0), (2.0, 0.0), (3.0, 1.0)]), None);
}

/// A mass whose share of heavier ones is `share`, in units of the least, by bisection.
fn mass_above(share: f64, slope: f64, cut_off: f64) -> f64 {
    let above = |x: f64| x.powf(-slope) * (-(x - 1.0) / cut_off).exp();
    let (mut low, mut high) = (1.0, 1e12);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if above(middle) > share {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[test]
fn exponent_and_cut_off_are_found_again_in_samples_made_with_them() {
    const LEAST: f64 = 4e-4;
    for (exponent, cut_off) in [(1.5, 50.0), (5.0 / 3.0, 300.0), (1.17, 20.0)] {
        let mut u = uniform();
        let mut sample = || -> Vec<f64> {
            (0..20)
                .map(|_| LEAST * mass_above(u(), exponent - 1.0, cut_off))
                .chain([0.5 * LEAST])
                .collect()
        };
        let samples: Vec<Vec<f64>> = (0..100).map(|_| sample()).collect();
        let law = CutOffLaw::fit(&samples, LEAST).unwrap();
        assert_eq!(law.masses, 2000, "what is below the least does not count");
        assert!((law.exponent - exponent).abs() < 0.03, "{law:?}");
        assert!((law.cut_off / LEAST / cut_off - 1.0).abs() < 0.2, "{law:?}");
        assert!(law.distance < 0.03, "{law:?}");
        assert!((0.0..0.1).contains(&law.exponent_error), "{law:?}");
    }
}

#[test]
fn without_a_cut_off_the_law_is_a_power_law() {
    let mut u = uniform();
    let samples: Vec<Vec<f64>> = (0..50)
        .map(|_| (0..20).map(|_| u().powf(-2.0)).collect())
        .collect();
    let law = CutOffLaw::fit(&samples, 1.0).unwrap();
    assert!((law.exponent - 1.5).abs() < 0.03, "{law:?}");
    assert!(law.cut_off > 1e4, "{law:?}");
    assert_eq!(CutOffLaw::fit(&[vec![1.0; 9], vec![2.0]], 1.5), None);
}

#[test]
fn pieces_that_come_in_equal_bodies_count_once() {
    // Every body twice: twice as many pieces, but no more is known than from one of each.
    let mut u = uniform();
    let once: Vec<Vec<f64>> = (0..60)
        .map(|_| (0..10).map(|_| mass_above(u(), 0.5, 100.0)).collect())
        .collect();
    let twice: Vec<Vec<f64>> = once
        .iter()
        .map(|s| [s.clone(), s.clone()].concat())
        .collect();
    let (one, two) = (CutOffLaw::fit(&once, 1.0), CutOffLaw::fit(&twice, 1.0));
    let (one, two) = (one.unwrap(), two.unwrap());
    assert!((one.exponent - two.exponent).abs() < 1e-6);
    assert!((two.exponent_error / one.exponent_error - 1.0).abs() < 1e-6);
}

#[test]
fn a_small_run_gives_the_same_numbers_twice() {
    let compute = || {
        Experiments::compute(
            StarPlan::tiny(),
            RearStarPlan::tiny(),
            MassPlan::tiny(),
            &|_| {},
        )
        .unwrap()
    };
    let found = compute();
    let data = |found: &Experiments| serde_json::to_value(found).unwrap();
    assert_eq!(data(&found), data(&compute()));
    // The fastest ball cracks its plate, and more than a slow one does.
    let run = found.stars.measured().unwrap();
    assert_eq!(run.impacts.len(), 2);
    let length = |i: usize| run.impacts[i].lengths[1];
    assert!(
        length(1) > length(0) && length(1) > 0.05,
        "{} m, {} m",
        length(0),
        length(1)
    );
    // No bound hides a tension, and the effect of a ball grows with its speed.
    let tensions: Vec<f64> = found
        .rear_stars
        .results
        .iter()
        .flatten()
        .map(|r| r.tension_pa)
        .collect();
    assert!(tensions[0] > 0.0 && tensions.is_sorted(), "{tensions:?}");
    for masses in &found.masses.runs {
        for pieces in &masses.masses {
            assert!((pieces.iter().sum::<f64>() - 1.0).abs() < 1e-6);
            assert!(pieces.is_sorted_by(|a, b| a >= b));
        }
    }
}
