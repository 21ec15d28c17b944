//! The pipeline in the paper's mode agrees with the paper, element by element.

use frangible::internals::{DurationModel, Model, impact_traced};
use frangible::{FractureConfig, Outcome, impact};
use frangible_lab::reference::agreement::{MARGIN, Mismatch, compare, compare_first_start};
use frangible_lab::reference::bodies::{Case, baked_cases, impact as generate, linear_cases};
use frangible_lab::reference::{
    EnergyTest, Field, Initiation, Marks, Options, ReferenceError, first_crack, fracture,
};

/// Impacts on each body.
const IMPACTS: u64 = 30;

fn as_in_the_paper() -> FractureConfig {
    let mut config = FractureConfig::as_in_the_paper();
    config.crumb_share = 0.0;
    config
}

/// The first difference of one impact, and true if the body broke.
fn difference(
    case: &Case,
    number: u64,
    field: Field,
    options: &Options,
) -> (Result<(), Mismatch>, bool) {
    let (body, contacts) = generate(case, number).unwrap();
    let (outcome, trace) = impact_traced(&body, &contacts, &as_in_the_paper()).unwrap();
    let reference = fracture(&body, &contacts, field, options).unwrap();
    let broke = matches!(outcome, Outcome::Broke(_));
    (compare(outcome.report(), &trace, &reference), broke)
}

/// The first difference of one impact in our model, up to its first crack, and true if there was one.
fn first_difference(case: &Case, number: u64, field: Field) -> (Result<(), Mismatch>, bool) {
    let (body, contacts) = generate(case, number).unwrap();
    let config = FractureConfig::with_given_impulses();
    let (outcome, trace) = impact_traced(&body, &contacts, &config).unwrap();
    let options = Options::first_crack_of_ours();
    let reference = first_crack(&body, &contacts, field, &options).unwrap();
    let cracked = !trace.cracks.is_empty();
    (
        compare_first_start(outcome.report(), &trace, &reference),
        cracked,
    )
}

fn agree(what: &str, cases: &[Case], look: impl Fn(&Case, u64) -> (Result<(), Mismatch>, bool)) {
    let (mut tried, mut torn, mut inside) = (0, 0, 0);
    let mut outside = Vec::new();
    for case in cases {
        for number in 0..IMPACTS {
            let (same, tore) = look(case, number);
            tried += 1;
            torn += u32::from(tore);
            match same {
                Err(mismatch) if mismatch.margin < MARGIN => inside += 1,
                Err(mismatch) => outside.push((case.asset.name(), number, mismatch)),
                Ok(()) => {}
            }
        }
    }
    println!(
        "{what}: {tried} impacts, {torn} tore the body; mismatches outside the margin {}, inside {inside}",
        outside.len()
    );
    assert!(outside.is_empty(), "{outside:#?}");
    assert!(
        torn * 3 > tried,
        "only {torn} of {tried} impacts tore the body"
    );
    // Of thousands of decisions an impact, few fall within f32 of each other; more would hide a defect.
    assert!(
        inside * 6 < tried,
        "{inside} of {tried} differ inside the margin"
    );
}

#[test]
fn pipeline_and_paper_agree_where_linear_elements_carry_the_modes() {
    agree(
        "linear elements",
        &linear_cases().unwrap(),
        |case, number| difference(case, number, Field::Linear, &Options::default()),
    );
}

#[test]
fn pipeline_and_paper_agree_on_the_same_quadratic_field() {
    agree(
        "quadratic elements",
        &baked_cases().unwrap(),
        |case, number| difference(case, number, Field::Embedded, &Options::default()),
    );
}

#[test]
fn our_model_starts_its_first_crack_where_the_stress_says() {
    agree(
        "our model's first crack",
        &baked_cases().unwrap(),
        |case, number| first_difference(case, number, Field::Embedded),
    );
}

#[test]
fn both_fields_are_one_where_linear_elements_carry_the_modes() {
    for case in &linear_cases().unwrap()[..2] {
        for number in 0..10 {
            let (body, contacts) = generate(case, number).unwrap();
            let of = |field| fracture(&body, &contacts, field, &Options::default()).unwrap();
            let (linear, embedded) = (of(Field::Linear), of(Field::Embedded));
            // Mid-edge displacements and gradients are stored in f32.
            let relative = (linear.peak_stress / embedded.peak_stress - 1.0).abs();
            assert!(
                relative < 1e-4,
                "{} {number}: {relative}",
                case.asset.name()
            );
        }
    }
}

#[test]
fn another_reading_of_the_paper_is_noticed() {
    let default = Options::default();
    let readings = [
        Options {
            energy_test: EnergyTest::AsPrinted,
            ..default
        },
        Options {
            initiation: Initiation::NearestWeak,
            ..default
        },
        Options {
            marks: Marks::Nodes,
            ..default
        },
    ];
    let case = &linear_cases().unwrap()[1];
    for options in readings {
        let noticed = (0..12)
            .filter_map(|number| difference(case, number, Field::Linear, &options).0.err())
            .filter(|mismatch| mismatch.margin >= MARGIN)
            .count();
        assert!(noticed > 0, "{options:?}");
    }
}

#[test]
fn each_departure_that_the_paper_does_not_have_is_noticed() {
    let changes: [fn(&mut FractureConfig); 3] = [
        |c| c.duration = DurationModel::Hertz,
        |c| c.model = Model::Ours,
        |c| c.crumb_share = 0.01,
    ];
    let case = &linear_cases().unwrap()[1];
    for (i, change) in changes.iter().enumerate() {
        let mut config = as_in_the_paper();
        change(&mut config);
        let noticed = (0..20).any(|number| {
            let (body, contacts) = generate(case, number).unwrap();
            let (outcome, trace) = impact_traced(&body, &contacts, &config).unwrap();
            let reference = fracture(&body, &contacts, Field::Linear, &Options::default()).unwrap();
            compare(outcome.report(), &trace, &reference).is_err_and(|m| m.margin >= MARGIN)
        });
        assert!(noticed, "departure {i}");
    }
}

#[test]
fn tracing_changes_no_outcome() {
    let case = &linear_cases().unwrap()[1];
    for number in 0..10 {
        let (body, contacts) = generate(case, number).unwrap();
        for config in [as_in_the_paper(), FractureConfig::with_given_impulses()] {
            let plain = impact(&body, &contacts, &config).unwrap();
            let (traced, trace) = impact_traced(&body, &contacts, &config).unwrap();
            let (a, b) = (plain.report(), traced.report());
            assert_eq!((a.crack_area, a.cracks), (b.crack_area, b.cracks));
            assert_eq!(trace.cracks.len(), b.cracks);
            assert_eq!(
                trace.fragment_of_node.len(),
                case.asset.fracture().positions.len()
            );
        }
    }
}

/// The text's test has E_f < E_s after every element that joins; the printed one looks before it adds.
#[test]
fn only_the_texts_energy_test_keeps_the_balance() {
    let case = &linear_cases().unwrap()[1];
    let mut overdrawn = [0, 0];
    for number in 0..20 {
        let (body, contacts) = generate(case, number).unwrap();
        for (i, energy_test) in [EnergyTest::Text, EnergyTest::AsPrinted]
            .into_iter()
            .enumerate()
        {
            let options = Options {
                energy_test,
                ..Options::default()
            };
            let result = fracture(&body, &contacts, Field::Linear, &options).unwrap();
            let long = result.cracks.iter().filter(|c| c.elements.len() > 1);
            overdrawn[i] += long.filter(|c| c.spent >= c.available).count();
        }
    }
    assert_eq!(overdrawn[0], 0);
    assert!(overdrawn[1] > 0);
}

#[test]
fn linear_elements_want_an_asset_of_them() {
    let case = &baked_cases().unwrap()[0];
    let (body, contacts) = generate(case, 0).unwrap();
    let refused = fracture(&body, &contacts, Field::Linear, &Options::default());
    assert!(matches!(refused, Err(ReferenceError::OtherMesh { .. })));
}
