//! The force pulse and its time steps `[G12 Eq. 3-5]`.
//!
//! `f(t) = a sin(u t)` for 0 ≤ t ≤ t_d, u = π/t_d, ∫ f dt = φ, so a = φ u / 2.
//! `[G12 Eq. 3]` prints Δt = 4π/Im ω_high, two whole periods; the sampling theorem it quotes gives half a period.
//! Here Δt = period of ω_high / `samples_per_period`, with ω_high the highest mode whose swing holds a share of
//! the stress that matters.

use std::f64::consts::{PI, TAU};

use super::Load;
use crate::asset::Asset;
use crate::config::FractureConfig;
use crate::motion::Pulse;

/// Least number of steps within a contact.
const MIN_CONTACT_STEPS: f64 = 16.0;

/// Most steps of one impact. The steps of a longer contact are longer: a body that is pushed over thousands of its periods follows the
/// force, which these steps show. The motion after the contact is cut there (the cut shows in the report's number of steps).
const MAX_STEPS: usize = 20_000;

/// The swings of the modes above ω_high together hold at most this share of the bounded stress.
const NEGLECTED_SHARE: f64 = 0.02;

/// Mode i is significantly excited when |ξ_i|/√λ_i reaches this share of the largest.
const SIGNIFICANT: f64 = 0.05;

/// Periods of the lowest significantly excited mode that are looked at.
const PERIODS: f64 = 1.5;

/// Shapes the pulse and chooses its steps.
#[must_use]
pub fn pulse(asset: &Asset, load: &Load, duration: f64, config: &FractureConfig) -> Pulse {
    let basis = &asset.modes;
    let u = PI / duration;
    // |q_i(t)| ≤ |ξ_i| min(1/√λ_i, 1.77 a/λ_i) for all t: 1.77 is the half-sine's largest response factor.
    let amplitude = |i: usize| {
        let lambda = basis.eigenvalues[i];
        load.modal_impulse[i].abs() * (1.0 / lambda.sqrt()).min(1.77 * 0.5 * u / lambda)
    };
    // A mode that is stiff for the pulse follows the force, ξ a sin(ut)/(λ − u²), which the steps within the contact
    // resolve, and swings about it by no more than twice ξ a u/(√λ (λ − u²)): only the swing needs samples of its own.
    let swing = |i: usize| {
        let lambda = basis.eigenvalues[i];
        let swing = load.modal_impulse[i].abs() * u * u / (lambda.sqrt() * (lambda - u * u));
        if lambda > 2.0 * u * u {
            swing.min(amplitude(i))
        } else {
            amplitude(i)
        }
    };
    let peak = |i: usize| f64::from(basis.peak_stress[i]);
    let total: f64 = (0..basis.followed()).map(|i| amplitude(i) * peak(i)).sum();
    let mut neglected = 0.0;
    let mut high = 0;
    for i in (0..basis.followed()).rev() {
        neglected += swing(i) * peak(i);
        if neglected > NEGLECTED_SHARE * total {
            high = i;
            break;
        }
    }
    // Without modes nothing swings, and the steps show the force alone.
    let period_of = |i: usize| match basis.eigenvalues.get(i) {
        Some(lambda) => TAU / lambda.sqrt(),
        None => duration,
    };
    let period = period_of(high);
    let contact_steps = (duration * config.samples_per_period / period)
        .ceil()
        .clamp(MIN_CONTACT_STEPS, MAX_STEPS as f64);
    let time_step = duration / contact_steps;
    let largest = (0..basis.followed()).map(amplitude).fold(0.0, f64::max);
    let low = (0..basis.followed())
        .find(|&i| amplitude(i) >= SIGNIFICANT * largest)
        .unwrap_or(0);
    let end = match config.is_paper() {
        true => duration,
        false => duration.max(PERIODS * period_of(low)),
    };
    let contact_steps = contact_steps as usize;
    let total_steps = if end > duration {
        ((end / time_step).ceil() as usize).clamp(contact_steps, MAX_STEPS)
    } else {
        // The quotient may round up to a step beyond the contact.
        contact_steps
    };
    Pulse {
        duration,
        amplitude: u / 2.0,
        time_step,
        contact_steps,
        total_steps,
        longest_step: period / config.samples_per_period,
    }
}
