//! Every case of `frangible-lab verify` holds, and the published page says the same. One test per case, so that they run
//! side by side.

use frangible_lab::verify::{CASES, Check, Findings, case, report};

const PAGE: &str = include_str!("../../../docs/verification.md");

/// Computes the case; each of its checks passes and stands on the page.
fn holds(name: &str) -> Findings {
    let case = case(name).expect("a case of this name");
    let findings = case.run(&mut |_| {}).unwrap();
    let section = section(case.title);
    let rows: Vec<&str> = section.lines().filter(|line| is_row(line)).collect();
    assert_eq!(
        rows.len(),
        findings.checks.len(),
        "{name}: rows of the page; run `frangible-lab verify --write docs`"
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
        let cells: Vec<&str> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        assert_eq!(cells[0], check.name.replace('|', "\\|"), "{name}: {row}");
        assert_eq!(cells[5], "pass", "{name}: {row}");
        assert!(
            agrees(cells[2], check),
            "{name}: {row}, now {}",
            check.value
        );
    }
    findings
}

fn section(title: &str) -> &'static str {
    let heading = format!("\n## {title}\n");
    let from = PAGE
        .find(&heading)
        .unwrap_or_else(|| panic!("no section {title}; run `frangible-lab verify --write docs`"));
    let rest = &PAGE[from + heading.len()..];
    &rest[..rest.find("\n## ").unwrap_or(rest.len())]
}

fn is_row(line: &str) -> bool {
    line.starts_with("| ") && !line.starts_with("| case ")
}

/// The value on the page is that of the check, but for rounding on another machine: a per mille, or a tenth of the tolerance.
fn agrees(cell: &str, check: &Check) -> bool {
    if check.reference == 0.0 {
        // Rounding errors: that they pass is all they say.
        return true;
    }
    let value: f64 = cell
        .split(' ')
        .next()
        .and_then(|v| v.parse().ok())
        .unwrap_or(f64::NAN);
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
    let findings = holds("convergence");
    // The published plot is one of the plots, and whole.
    let committed = include_bytes!("../../../docs/verification/convergence.png");
    let picture = image::load_from_memory(committed).unwrap().into_rgb8();
    let drawn = findings.plots[0]
        .chart
        .draw(picture.width(), picture.height());
    let differ = picture.pixels().zip(drawn.pixels()).filter(|(a, b)| {
        let off = |i: usize| a.0[i].abs_diff(b.0[i]);
        off(0).max(off(1)).max(off(2)) > 64
    });
    // Markers may move by a part of a pixel where another machine rounds.
    let (count, all) = (
        differ.count(),
        (picture.width() * picture.height()) as usize,
    );
    assert!(
        count * 1000 < all,
        "{count} of {all} pixels; run `frangible-lab verify --write docs`"
    );
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
fn a_check_that_is_off_fails_the_page_and_says_so() {
    let case = case("scaling").unwrap();
    let mut findings = case.run(&mut |_| {}).unwrap();
    findings.checks[0].value *= 1.001;
    findings.checks[1].value = f64::NAN;
    let page = report::markdown(&[(case, findings)], "plots");
    assert!(page.contains("**3 of 5 checks pass.**"), "{page}");
    assert_eq!(page.matches("| FAIL |").count(), 2, "{page}");
}
