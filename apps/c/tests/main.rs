//! The functions for C, called from Rust.
#![expect(unsafe_code, reason = "the functions that it calls take pointers")]
#![allow(
    clippy::undocumented_unsafe_blocks,
    clippy::multiple_unsafe_ops_per_block,
    reason = "each call gets references to locals"
)]

mod blows;
mod border;
mod header;
mod looks;
mod outcomes;

use std::ffi::CStr;
use std::ptr::null;

use frangible_c::*;

const PANE: &[u8] = include_bytes!("../../../crates/frangible/tests/bodies/pane.frangible");

const BLOCK: &[u8] = include_bytes!("../../../crates/frangible/tests/bodies/block.frangible");

const TILE: &[u8] = include_bytes!("../../../crates/frangible/tests/bodies/tile.frangible");

/// The text of the last failure of this thread.
fn text() -> String {
    let text = unsafe { CStr::from_ptr(frangible_error_text()) };
    text.to_str().expect("UTF-8").to_owned()
}

fn sound(status: frangible_status) {
    assert_eq!(status, frangible_status::Ok, "{}", text());
}

fn pane() -> frangible_breakable {
    kind(PANE)
}

fn kind(bytes: &[u8]) -> frangible_breakable {
    let mut kind = frangible_breakable::default();
    sound(unsafe { frangible_breakable_from_bytes(bytes.as_ptr(), bytes.len(), &mut kind) });
    kind
}

fn body(seed: u64) -> frangible_body {
    body_of(pane(), seed)
}

/// A body of a kind that is needed no more.
fn body_of(kind: frangible_breakable, seed: u64) -> frangible_body {
    let mut body = frangible_body::default();
    sound(unsafe { frangible_body_new(kind, seed, &mut body) });
    sound(frangible_breakable_free(kind));
    body
}

/// A steel ball of 130 g that flies along −z.
fn ball(speed: f64) -> frangible_striker {
    let mut ball = frangible_striker::default();
    sound(unsafe { frangible_striker_of(c"steel".as_ptr(), &mut ball) });
    ball.kind = FRANGIBLE_STRIKER_BALL;
    (ball.mass, ball.radius) = (0.13, 0.0158);
    ball.centre = [0.0, 0.0, 0.0188];
    ball.motion.linear = [0.0, 0.0, -speed];
    ball
}

fn at_middle(speed: f64) -> frangible_contact {
    frangible_contact {
        point: [0.0, 0.0, 0.003],
        normal: [0.0, 0.0, -1.0],
        speed,
        ..Default::default()
    }
}

/// A blow of these contacts by a ball.
fn hit(
    body: frangible_body,
    contacts: &[frangible_contact],
    by: &frangible_striker,
) -> frangible_outcome {
    let mut outcome = frangible_outcome::default();
    let (first, count) = (contacts.as_ptr(), contacts.len());
    sound(unsafe { frangible_body_impact(body, first, count, by, 1, null(), &mut outcome) });
    outcome
}

fn report(outcome: frangible_outcome) -> frangible_report {
    let mut report = frangible_report::default();
    sound(unsafe { frangible_outcome_report(outcome, &mut report) });
    report
}

fn masses(outcome: frangible_outcome) -> Vec<f64> {
    let mass = |k: usize| {
        let mut solid = frangible_solid::default();
        sound(unsafe { frangible_outcome_solid(outcome, k, &mut solid) });
        solid.mass
    };
    (0..report(outcome).fragments).map(mass).collect()
}
