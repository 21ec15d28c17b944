//! Seeded random numbers, one stream per purpose and item, so that nothing depends on order or threads.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Purpose of a stream of random numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Purpose {
    WeakPoints = 1,
    CrackDirection = 2,
    Roughness = 3,
    Strength = 4,
    Places = 5,
    Dice = 6,
    Clumps = 7,
}

/// The stream of one item.
pub(crate) fn stream(seed: u64, purpose: Purpose, item: u32) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream((purpose as u64) << 32 | u64::from(item));
    rng
}

/// Uniform in [0, 1).
pub(crate) fn uniform(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}
