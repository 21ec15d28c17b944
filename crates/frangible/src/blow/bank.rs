//! Many oscillators side by side, stepped through a tick under forces that grow linearly.

use crate::modal::Tick;

/// Numbers that are added up side by side.
const LANES: usize = 8;

/// What a tick does to each oscillator: struct of arrays, filled up with oscillators that never move.
#[derive(Clone, Debug, Default)]
pub(super) struct Bank {
    own: [Vec<f64>; 4],
    held: [Vec<f64>; 2],
    ramp: [Vec<f64>; 2],
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

    /// Forgets all but the first so many oscillators, and those that fill up their last group.
    pub(super) fn keep(&mut self, oscillators: usize) {
        self.x.truncate(padded(oscillators));
        self.v.truncate(padded(oscillators));
    }
}

/// Number of oscillators with those that fill up the last group.
pub(super) fn padded(oscillators: usize) -> usize {
    oscillators.next_multiple_of(LANES)
}

impl Bank {
    /// Oscillators of these (ω, rad/s; d, 1/s) through a tick of this length, s.
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

    /// A tick on, as if all forces stayed as they are. `drive`: how hard each force, N, pushes each oscillator.
    #[inline(always)]
    pub(super) fn coast(&self, state: &mut BankState, drive: &[Vec<f64>], forces: &[f64]) {
        let count = state.x.len();
        let [a, b, c, d] = self.own.each_ref().map(|row| &row[..count]);
        let (x, v) = (&mut state.x[..count], &mut state.v[..count]);
        for i in 0..count {
            let (old_x, old_v) = (x[i], v[i]);
            x[i] = a[i] * old_x + b[i] * old_v;
            v[i] = c[i] * old_x + d[i] * old_v;
        }
        self.push(state, &self.held, drive, forces);
    }

    /// What the tick makes of forces having grown by so much.
    #[inline(always)]
    pub(super) fn grow(&self, state: &mut BankState, drive: &[Vec<f64>], growth: &[f64]) {
        self.push(state, &self.ramp, drive, growth);
    }

    #[inline(always)]
    fn push(&self, state: &mut BankState, by: &[Vec<f64>; 2], drive: &[Vec<f64>], forces: &[f64]) {
        let count = state.x.len();
        let [on_x, on_v] = by.each_ref().map(|row| &row[..count]);
        let (x, v) = (&mut state.x[..count], &mut state.v[..count]);
        for (drive, &force) in drive.iter().zip(forces) {
            if force == 0.0 {
                continue;
            }
            let drive = &drive[..count];
            for i in 0..count {
                let push = drive[i] * force;
                x[i] += on_x[i] * push;
                v[i] += on_v[i] * push;
            }
        }
    }

    /// Σ gap x of what a unit growth of a force does in a tick: how far the contact gives way at once.
    pub(super) fn give(&self, gap: &[f64], drive: &[f64]) -> f64 {
        let terms = gap.iter().zip(drive).zip(&self.ramp[0]);
        terms.map(|((gap, drive), ramp)| gap * drive * ramp).sum()
    }
}

/// Σ a b, in a fixed order over eight lanes.
#[inline(always)]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a, _) = a.as_chunks::<LANES>();
    let (b, _) = b.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        for k in 0..LANES {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum()
}
