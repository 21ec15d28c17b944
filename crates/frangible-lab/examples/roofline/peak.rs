//! Peak rates of one thread of this machine, by small loops through the same dispatch (`pulp`) as the run time's.

use std::hint::black_box;
use std::time::Instant;

use pulp::{Arch, Simd, WithSimd};
use serde::Serialize;

/// Sums side by side, so that none waits for its last: more than the latency of a multiply-add times its rate.
const CHAINS: usize = 12;
/// Steps of each chain in one run: less than a millisecond.
const ROUNDS: usize = 200_000;
/// The best of so many runs counts: others may use the machine.
const RUNS: usize = 40;
/// Bytes that pass in one run, at least.
const PASSED: usize = 32 << 20;
/// Sizes of memory that are shown: half a processor's own second-level cache, its shared third, main memory.
pub(crate) const SIZES: [(&str, usize); 3] = [
    ("in the second-level cache", 512 << 10),
    ("in the third-level cache", 8 << 20),
    ("in main memory", 256 << 20),
];

/// A rate of arithmetic on one thread.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Arithmetic {
    /// f32, multiply and add as one instruction, operations a second (two each).
    pub(crate) fused: f64,
    /// f32, one multiplication and one addition: the run time's operations, whose bits must not depend on the processor.
    pub(crate) separate: f64,
    /// Operations in f64, one multiplication and one addition.
    pub(crate) double: f64,
    /// f32 numbers in a vector.
    pub(crate) lanes: usize,
}

/// Rates of memory of one size on one thread.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Memory {
    /// All arrays together, bytes.
    pub(crate) size: usize,
    /// Reading only, bytes a second.
    pub(crate) read: f64,
    /// a = b + s c, bytes a second: two arrays read, one written.
    pub(crate) triad: f64,
}

impl Arithmetic {
    /// Measures it.
    #[must_use]
    pub(crate) fn measure() -> Self {
        let arch = Arch::new();
        let operations = |lanes: usize| (2 * CHAINS * ROUNDS * lanes) as f64;
        let lanes = arch.dispatch(Lanes);
        let rate = |seconds: f64, lanes: usize| operations(lanes) / seconds;
        Self {
            fused: rate(fastest(|| arch.dispatch(Fused)), lanes),
            separate: rate(fastest(|| arch.dispatch(Separate)), lanes),
            double: rate(fastest(|| arch.dispatch(Double)), lanes / 2),
            lanes,
        }
    }
}

impl Memory {
    /// Measures memory of this size, bytes.
    #[must_use]
    pub(crate) fn measure(size: usize) -> Self {
        let arch = Arch::new();
        let numbers = (size / 4).max(CHAINS * 64);
        let rounds = PASSED.div_ceil(4 * numbers);
        let numbers_of = |count: usize| vec![black_box(0.5_f32); count];
        let read = {
            let from = numbers_of(numbers);
            let seconds = fastest(|| (0..rounds).map(|_| arch.dispatch(Read(&from))).sum::<f32>());
            (4 * numbers * rounds) as f64 / seconds
        };
        let third = numbers / 3;
        let (b, c) = (numbers_of(third), numbers_of(third));
        let mut a = numbers_of(third);
        let seconds = fastest(|| {
            for _ in 0..rounds {
                arch.dispatch(Triad(&mut a, &b, &c));
            }
            black_box(a[third / 2])
        });
        Self {
            size: 4 * numbers,
            read,
            triad: (12 * third * rounds) as f64 / seconds,
        }
    }
}

/// Shortest of some runs, s; the first warms up.
fn fastest(mut run: impl FnMut() -> f32) -> f64 {
    let mut times = (0..=RUNS).map(|_| {
        let clock = Instant::now();
        black_box(run());
        clock.elapsed().as_secs_f64()
    });
    times.next();
    times.fold(f64::INFINITY, f64::min)
}

struct Lanes;

impl WithSimd for Lanes {
    type Output = usize;

    fn with_simd<S: Simd>(self, _: S) -> usize {
        S::F32_LANES
    }
}

struct Fused;

impl WithSimd for Fused {
    type Output = f32;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f32 {
        let (scale, shift) = (
            simd.splat_f32s(black_box(0.75)),
            simd.splat_f32s(black_box(0.5)),
        );
        let mut sums = [simd.splat_f32s(black_box(1.0)); CHAINS];
        for _ in 0..ROUNDS {
            for sum in &mut sums {
                *sum = simd.mul_add_f32s(*sum, scale, shift);
            }
        }
        let mut all = sums[0];
        for sum in &sums[1..] {
            all = simd.add_f32s(all, *sum);
        }
        simd.reduce_sum_f32s(all)
    }
}

struct Separate;

impl WithSimd for Separate {
    type Output = f32;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f32 {
        let (scale, shift) = (
            simd.splat_f32s(black_box(0.75)),
            simd.splat_f32s(black_box(0.5)),
        );
        let mut sums = [simd.splat_f32s(black_box(1.0)); CHAINS];
        for _ in 0..ROUNDS {
            for sum in &mut sums {
                *sum = simd.add_f32s(simd.mul_f32s(*sum, scale), shift);
            }
        }
        let mut all = sums[0];
        for sum in &sums[1..] {
            all = simd.add_f32s(all, *sum);
        }
        simd.reduce_sum_f32s(all)
    }
}

struct Double;

impl WithSimd for Double {
    type Output = f32;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f32 {
        let (scale, shift) = (
            simd.splat_f64s(black_box(0.75)),
            simd.splat_f64s(black_box(0.5)),
        );
        let mut sums = [simd.splat_f64s(black_box(1.0)); CHAINS];
        for _ in 0..ROUNDS {
            for sum in &mut sums {
                *sum = simd.add_f64s(simd.mul_f64s(*sum, scale), shift);
            }
        }
        let mut all = sums[0];
        for sum in &sums[1..] {
            all = simd.add_f64s(all, *sum);
        }
        simd.reduce_sum_f64s(all) as f32
    }
}

struct Read<'a>(&'a [f32]);

impl WithSimd for Read<'_> {
    type Output = f32;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f32 {
        let (vectors, _) = S::as_simd_f32s(black_box(self.0));
        let mut sums = [simd.splat_f32s(0.0); CHAINS];
        for some in vectors.chunks_exact(CHAINS) {
            for (sum, x) in sums.iter_mut().zip(some) {
                *sum = simd.add_f32s(*sum, *x);
            }
        }
        let mut all = sums[0];
        for sum in &sums[1..] {
            all = simd.add_f32s(all, *sum);
        }
        simd.reduce_sum_f32s(all)
    }
}

struct Triad<'a>(&'a mut [f32], &'a [f32], &'a [f32]);

impl WithSimd for Triad<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (a, _) = S::as_mut_simd_f32s(black_box(self.0));
        let (b, _) = S::as_simd_f32s(black_box(self.1));
        let (c, _) = S::as_simd_f32s(black_box(self.2));
        let scale = simd.splat_f32s(black_box(0.25));
        for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
            *a = simd.add_f32s(*b, simd.mul_f32s(scale, *c));
        }
    }
}
