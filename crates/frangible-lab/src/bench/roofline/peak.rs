//! Peak rates of one thread of this machine, by small loops through the same dispatch (`pulp`) as the run time's.

use std::hint::black_box;
use std::time::Instant;

use pulp::{Arch, Simd, WithSimd};

/// Sums side by side, so that none waits for its last: more than the latency of a multiply-add times its rate.
const CHAINS: usize = 12;
/// Steps of each chain in one run: less than a millisecond.
const ROUNDS: usize = 200_000;
/// The best of so many runs counts: others may use the machine.
const RUNS: usize = 40;
/// Bytes that pass in one run, at least.
const PASSED: usize = 32 << 20;
/// A rate of arithmetic on one thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arithmetic {
    /// f32, one multiplication and one addition: the run time's operations, whose bits must not depend on the processor.
    pub(crate) separate: f64,
    /// Operations in f64, one multiplication and one addition.
    pub(crate) double: f64,
    /// f32 numbers in a vector.
    pub(crate) lanes: usize,
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
            separate: rate(fastest(|| arch.dispatch(Separate)), lanes),
            double: rate(fastest(|| arch.dispatch(Double)), lanes / 2),
            lanes,
        }
    }
}

/// Rate of reading memory of this size, bytes, on one thread: bytes a second.
pub(crate) fn read(size: usize) -> f64 {
    let arch = Arch::new();
    let numbers = (size / 4).max(CHAINS * 64);
    let rounds = PASSED.div_ceil(4 * numbers);
    let from = vec![black_box(0.5_f32); numbers];
    let seconds = fastest(|| (0..rounds).map(|_| arch.dispatch(Read(&from))).sum::<f32>());
    (4 * numbers * rounds) as f64 / seconds
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

/// A loop of multiplications and additions, each in a chain of its own.
macro_rules! arithmetic {
    ($name:ident, $splat:ident, $mul:ident, $add:ident, $sum:ident) => {
        struct $name;

        impl WithSimd for $name {
            type Output = f32;

            #[inline(always)]
            fn with_simd<S: Simd>(self, simd: S) -> f32 {
                let (scale, shift) = (simd.$splat(black_box(0.75)), simd.$splat(black_box(0.5)));
                let mut sums = [simd.$splat(black_box(1.0)); CHAINS];
                for _ in 0..ROUNDS {
                    for sum in &mut sums {
                        *sum = simd.$add(simd.$mul(*sum, scale), shift);
                    }
                }
                let all = sums.into_iter().reduce(|all, sum| simd.$add(all, sum));
                all.map_or(0.0, |all| simd.$sum(all) as f32)
            }
        }
    };
}

arithmetic!(Separate, splat_f32s, mul_f32s, add_f32s, reduce_sum_f32s);
arithmetic!(Double, splat_f64s, mul_f64s, add_f64s, reduce_sum_f64s);

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
