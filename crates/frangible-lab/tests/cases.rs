//! Every case of `frangible-lab verify` holds, and the published data says the same. One test per case, so that they run
//! side by side.

use std::path::Path;

use frangible_lab::data::read;
use frangible_lab::verify::{CASES, Check, case};
use serde_json::Value;

/// Computes the case; each of its checks passes and stands in the data.
fn holds(name: &str) {
    let case = case(name).expect("a case of this name");
    let findings = case.run().unwrap();
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let data = read(&docs, "verification").unwrap();
    let rows = data["measured"][name]["checks"].as_array().expect("rows");
    let anew = "run `frangible-lab verify --write docs`";
    assert_eq!(
        rows.len(),
        findings.checks.len(),
        "{name}: rows of the data; {anew}"
    );
    for (check, row) in findings.checks.iter().zip(rows) {
        assert!(
            check.passes(),
            "{name}, {}: {} is not within {} of {}",
            check.name,
            check.value,
            check.tolerance,
            check.reference
        );
        assert_eq!(row["name"], check.name, "{name}: {row}; {anew}");
        assert!(
            agrees(row, check),
            "{name}: {row}, now {}; {anew}",
            check.value
        );
    }
}

/// The published value is that of the check, but for rounding on another machine: a per mille, or a tenth of the tolerance.
fn agrees(row: &Value, check: &Check) -> bool {
    if check.reference == 0.0 {
        // Rounding errors: that they pass is all they say.
        return true;
    }
    let value = row["value"].as_f64().unwrap_or(f64::NAN);
    (value / check.value - 1.0).abs() <= f64::max(1e-3, 0.1 * check.tolerance)
}

#[test]
fn a_free_bar_bends_twists_and_stretches_as_beam_theory_says() {
    holds("bar");
}

#[test]
fn a_free_square_plate_has_leissas_coefficients() {
    holds("plate");
}

#[test]
fn a_block_rings_as_a_series_of_polynomials_says() {
    holds("block");
}

#[test]
fn a_ball_twists_and_breathes_as_the_theory_says() {
    holds("ball");
}

#[test]
fn a_cantilever_rings_at_its_bending_frequencies() {
    holds("cantilever");
}

#[test]
fn linear_elements_lock_in_bending_and_quadratic_ones_converge() {
    holds("convergence");
}

#[test]
fn modes_are_orthonormal_and_solve_the_problem_and_six_are_null() {
    holds("basis");
}

#[test]
fn eigenvalues_and_shapes_scale_with_stiffness_density_and_size() {
    holds("scaling");
}

#[test]
fn the_recurrence_is_exact_for_any_damping_and_at_resonance() {
    holds("oscillator");
}

#[test]
fn two_steel_spheres_touch_as_long_as_hertz_says() {
    holds("contact");
}

#[test]
fn a_hit_plate_has_the_stress_of_all_its_modes() {
    holds("near-field");
}

#[test]
fn a_blow_is_zeners_on_a_plate_hertzs_on_a_block_and_st_venants_on_a_rod() {
    holds("blow");
}

#[test]
fn two_bodies_that_both_vibrate_share_one_force() {
    holds("two-bodies");
}

#[test]
fn every_case_is_tested_and_has_names_of_its_own() {
    let tests = include_str!("cases.rs");
    for case in CASES {
        assert!(
            tests.contains(&format!("holds(\"{}\")", case.name)),
            "{}",
            case.name
        );
        assert_eq!(
            CASES
                .iter()
                .filter(|c| c.name == case.name || c.title == case.title)
                .count(),
            1
        );
    }
}

#[test]
fn a_check_that_is_off_does_not_pass() {
    let case = case("scaling").unwrap();
    let mut checks = case.run().unwrap().checks;
    checks[0].value *= 1.001;
    checks[1].value = f64::NAN;
    assert_eq!(checks.iter().filter(|check| check.passes()).count(), 3);
}
