//! The GPU saves work; breaks and pieces are the CPU's to the bit.

use super::common::{Numbers, cracks_and_pieces, gpu, kinds, uneven};
use frangible::internals::{LookedAt, Stage, Vibration};
use frangible::{Body, Breakable, Contact, FractureConfig, Outcome, impact};
use frangible_lab::gpu::{Impact, initiation_on_cpu};

#[test]
fn cracks_and_pieces_are_the_same_bits_with_and_without_a_gpu() {
    let Some(gpu) = gpu() else { return };
    let mut numbers = Numbers(2);
    let (mut broke, mut cracked, mut held_by_gpu) = (0, 0, 0);
    for config in [
        FractureConfig::with_given_impulses(),
        FractureConfig::as_in_the_paper(),
    ] {
        for (name, kind) in kinds() {
            for kind in [kind.clone(), uneven(kind)] {
                let loaded = gpu.load(&kind).unwrap();
                let (mut bodies, contacts) = blows(&kind, &mut numbers, 8);
                // Bodies that a blow leaves with a crack get it once more.
                for (body, contacts) in bodies.iter_mut().zip(&contacts) {
                    if let Outcome::Held {
                        state: Some(state), ..
                    } = impact(body, contacts, &config).unwrap()
                    {
                        body.set_state(*state).unwrap();
                        cracked += 1;
                    }
                }
                let batch: Vec<Impact<'_>> = (bodies.iter().zip(&contacts))
                    .map(|(body, contacts)| Impact::new(&loaded, body, contacts))
                    .collect();
                let outcomes = gpu.impacts(&batch, &config).unwrap();
                for (i, outcome) in batch.iter().zip(&outcomes) {
                    let expected = impact(i.body, i.contacts, &config).unwrap();
                    assert_eq!(
                        cracks_and_pieces(outcome),
                        cracks_and_pieces(&expected),
                        "{name}"
                    );
                    broke += usize::from(matches!(outcome, Outcome::Broke(_)));
                    if let Outcome::Held { margin, .. } = outcome
                        && outcome.report().cracks == 0
                        && outcome.report().looked_at > LookedAt::Impulses
                    {
                        held_by_gpu += usize::from(*margin > 1.0);
                    }
                }
            }
        }
    }
    println!("{broke} broke, {held_by_gpu} held with a look, {cracked} had cracks");
    assert!(broke >= 10 && held_by_gpu >= 10, "{broke} {held_by_gpu}");
}

fn blows(kind: &Breakable, numbers: &mut Numbers, count: u64) -> (Vec<Body>, Vec<Vec<Contact>>) {
    let bodies = (0..count).map(|seed| kind.body(seed)).collect();
    let contacts = (0..count)
        .map(|k| {
            let speed = 16.0 * numbers.next().powi(3);
            let blow = |_| numbers.blow(kind.asset(), speed);
            (0..1 + k % 3).map(blow).collect()
        })
        .collect();
    (bodies, contacts)
}

/// Needs no GPU.
#[test]
fn passing_over_quiet_time_steps_changes_no_bits() {
    let config = FractureConfig::with_given_impulses();
    let mut broke = 0;
    for (name, kind) in kinds() {
        let (bodies, contacts) = blows(kind, &mut Numbers(2), 5);
        for (body, contacts) in bodies.iter().zip(&contacts) {
            let stage = Vibration::begin(body, contacts, &config).unwrap();
            let Stage::Vibrates(vibration) = stage else {
                continue;
            };
            let Some(first) = initiation_on_cpu(body, &vibration, &config, 0).first else {
                continue;
            };
            let expected = impact(body, contacts, &config).unwrap();
            broke += usize::from(matches!(expected, Outcome::Broke(_)));
            // Every place of a step in its batch of seven.
            for step in first.step.saturating_sub(7)..=first.step {
                let outcome = vibration.clone().end(body, &config, step);
                assert_eq!(
                    cracks_and_pieces(&outcome),
                    cracks_and_pieces(&expected),
                    "{name} {step}"
                );
            }
        }
    }
    assert!(broke >= 3, "{broke}");
}
