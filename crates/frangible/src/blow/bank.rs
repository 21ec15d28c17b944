//! A bank of oscillators, stepped together through a tick under linearly varying forces.
//!
//! A contact is coupled only to the modes and to the wall oscillators around it, not to those around other contacts. Each force therefore has
//! *spans*, ranges of whole groups of oscillators: those that it drives, and those that contribute to its gap.

use std::ops::Range;

use crate::modal::Tick;

/// Numbers that are added up side by side.
const LANES: usize = 8;

/// Coefficients of each oscillator's tick: struct of arrays, padded with oscillators that never move.
#[derive(Clone, Debug, Default)]
pub(super) struct Bank {
    own: [Vec<f64>; 4],
    held: [Vec<f64>; 2],
    ramp: [Vec<f64>; 2],
}

/// Push of each force on each oscillator, 1/√kg, and the spans of oscillators that it pushes.
#[derive(Clone, Copy)]
pub(super) struct Pushes<'a> {
    pub(super) drive: &'a [Vec<f64>],
    pub(super) spans: &'a [Vec<Range<usize>>],
}

impl Pushes<'_> {
    /// No pushes.
    pub(super) const NONE: Self = Self {
        drive: &[],
        spans: &[],
    };
}

/// ω q and q̇ of each oscillator.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct BankState {
    pub(super) x: Vec<f64>,
    pub(super) v: Vec<f64>,
}

impl BankState {
    /// At rest.
    pub(super) fn rest(oscillators: usize) -> Self {
        let zeros = vec![0.0; padded(oscillators)];
        Self {
            x: zeros.clone(),
            v: zeros,
        }
    }

    /// Keeps only the first `oscillators` oscillators and those that pad their last group.
    pub(super) fn keep(&mut self, oscillators: usize) {
        self.x.truncate(padded(oscillators));
        self.v.truncate(padded(oscillators));
    }
}

/// Spans of the groups of oscillators in which this row, of pushes or of what is felt, is not zero; adjacent groups are one span.
pub(super) fn spans(row: &[f64]) -> Vec<Range<usize>> {
    let mut spans: Vec<Range<usize>> = Vec::new();
    for first in (0..row.len()).step_by(LANES) {
        let group = first..first + LANES;
        if row[group.clone()].iter().all(|&x| x == 0.0) {
            continue;
        }
        match spans.last_mut().filter(|last| last.end == first) {
            Some(last) => last.end = group.end,
            None => spans.push(group),
        }
    }
    spans
}

/// Number of oscillators with those that pad the last group.
pub(super) fn padded(oscillators: usize) -> usize {
    oscillators.next_multiple_of(LANES)
}

impl Bank {
    /// Bank of oscillators with these (ω, rad/s; d, 1/s), for a tick of this length, s.
    pub(super) fn new(oscillators: &[(f64, f64)], tick: f64) -> Self {
        let count = padded(oscillators.len());
        let zeros = || vec![0.0; count];
        let mut bank = Self {
            own: std::array::from_fn(|_| zeros()),
            held: std::array::from_fn(|_| zeros()),
            ramp: std::array::from_fn(|_| zeros()),
        };
        for (i, &(frequency, damping)) in oscillators.iter().enumerate() {
            let Tick { own, held, ramp } = Tick::new(frequency, damping, tick);
            for (to, from) in bank.own.iter_mut().zip(own.as_flattened()) {
                to[i] = *from;
            }
            for k in 0..2 {
                bank.held[k][i] = held[k];
                bank.ramp[k][i] = ramp[k];
            }
        }
        bank
    }

    /// Steps the oscillators through a tick under constant forces.
    #[inline(always)]
    pub(super) fn coast(&self, state: &mut BankState, pushes: &Pushes<'_>, forces: &[f64]) {
        let count = state.x.len();
        // Written out: `array::map` would be a call of its own.
        let [a, b, c, d] = &self.own;
        let (a, b, c, d) = (&a[..count], &b[..count], &c[..count], &d[..count]);
        let (x, v) = (&mut state.x[..count], &mut state.v[..count]);
        for i in 0..count {
            let (old_x, old_v) = (x[i], v[i]);
            x[i] = a[i] * old_x + b[i] * old_v;
            v[i] = c[i] * old_x + d[i] * old_v;
        }
        self.push(state, &self.held, pushes, forces);
    }

    /// Adds the response over the tick to this growth of the forces.
    #[inline(always)]
    pub(super) fn grow(&self, state: &mut BankState, pushes: &Pushes<'_>, growth: &[f64]) {
        self.push(state, &self.ramp, pushes, growth);
    }

    #[inline(always)]
    fn push(&self, state: &mut BankState, by: &[Vec<f64>; 2], pushes: &Pushes<'_>, forces: &[f64]) {
        let rows = pushes.drive.iter().zip(pushes.spans);
        for ((drive, spans), &force) in rows.zip(forces) {
            if force == 0.0 {
                continue;
            }
            for span in spans {
                let drive = &drive[span.clone()];
                let (on_x, on_v) = (&by[0][span.clone()], &by[1][span.clone()]);
                let (x, v) = (&mut state.x[span.clone()], &mut state.v[span.clone()]);
                for i in 0..drive.len() {
                    let push = drive[i] * force;
                    x[i] += on_x[i] * push;
                    v[i] += on_v[i] * push;
                }
            }
        }
    }

    /// Adds the response over a tick to constant forces, times a factor, on consecutive oscillators from `first` on.
    #[inline(always)]
    pub(super) fn hold(&self, state: &mut BankState, first: usize, forces: &[f64], factor: f64) {
        let span = first..first + forces.len();
        let (on_x, on_v) = (&self.held[0][span.clone()], &self.held[1][span.clone()]);
        let (x, v) = (&mut state.x[span.clone()], &mut state.v[span]);
        for i in 0..forces.len() {
            let push = factor * forces[i];
            x[i] += on_x[i] * push;
            v[i] += on_v[i] * push;
        }
    }

    /// ω q of consecutive oscillators after a tick, per constant force on each.
    pub(super) fn held_by(&self, which: Range<usize>) -> &[f64] {
        &self.held[0][which]
    }

    /// ω q of consecutive oscillators after a tick in which a force that pushes them with `drive` has grown by a newton.
    pub(super) fn ramp_by(&self, which: Range<usize>, drive: &[f64]) -> impl Iterator<Item = f64> {
        let ramp = self.ramp[0][which.clone()].iter();
        ramp.zip(&drive[which]).map(|(ramp, drive)| ramp * drive)
    }

    /// Σ gap x of the response over a tick to constant forces on consecutive oscillators.
    pub(super) fn held_gap(&self, gap: &[f64], first: usize, forces: &[f64]) -> f64 {
        let terms = gap[first..].iter().zip(&self.held[0][first..]).zip(forces);
        terms.map(|((gap, held), force)| gap * held * force).sum()
    }

    /// Σ gap x of the response over a tick to a unit growth of a force: how far the contact gives way at once.
    pub(super) fn give(&self, gap: &[f64], drive: &[f64]) -> f64 {
        let terms = gap.iter().zip(drive).zip(&self.ramp[0]);
        terms.map(|((gap, drive), ramp)| gap * drive * ramp).sum()
    }
}

/// Σ a b, in a fixed order over eight lanes.
#[inline(always)]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    dot_over(a, b, std::slice::from_ref(&(0..a.len().min(b.len()))))
}

/// Σ a b over these spans, in a fixed order over eight lanes.
#[inline(always)]
pub(super) fn dot_over(a: &[f64], b: &[f64], spans: &[Range<usize>]) -> f64 {
    let mut sums = [0.0; LANES];
    for span in spans {
        let (a, _) = a[span.clone()].as_chunks::<LANES>();
        let (b, _) = b[span.clone()].as_chunks::<LANES>();
        for (a, b) in a.iter().zip(b) {
            for k in 0..LANES {
                sums[k] += a[k] * b[k];
            }
        }
    }
    sums.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_leave_out_what_a_force_does_not_reach_and_change_no_bit() {
        let count = 10 * LANES;
        let reaches = |i: usize| (3..20).contains(&i) || (40..56).contains(&i) || i == 79;
        let row = |scale: f64| -> Vec<f64> {
            let value = |i: usize| {
                if reaches(i) {
                    scale * (i as f64).sin()
                } else {
                    0.0
                }
            };
            (0..count).map(value).collect()
        };
        let (drive, gap) = (row(1.0), row(-0.3));
        let spans = vec![spans(&drive)];
        assert_eq!(spans[0], [0..24, 40..56, 72..80]);
        let oscillators: Vec<_> = (0..count).map(|i| (1e3 + 10.0 * i as f64, 5.0)).collect();
        let bank = Bank::new(&oscillators, 1e-5);
        let everywhere = vec![vec![0..count]];
        let drive = [drive];
        let swing = |spans: &[Vec<Range<usize>>]| {
            let pushes = Pushes {
                drive: &drive,
                spans,
            };
            let mut state = BankState::rest(count);
            let mut felt = Vec::new();
            for tick in 0..50 {
                bank.coast(&mut state, &pushes, &[f64::from(tick)]);
                bank.grow(&mut state, &pushes, &[1.0]);
                felt.push(dot_over(&gap, &state.x, &spans[0]).to_bits());
            }
            (state, felt)
        };
        let (state, felt) = swing(&spans);
        assert!(state.x[3] != 0.0 && felt.last() != Some(&0));
        assert_eq!((state, felt), swing(&everywhere));
    }
}
