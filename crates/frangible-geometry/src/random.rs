//! Random numbers of the tests.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Uniform in [0, 1), the same in every run.
pub(crate) fn numbers() -> impl FnMut() -> f32 {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    move || (rng.next_u32() >> 8) as f32 / (1_u32 << 24) as f32
}
