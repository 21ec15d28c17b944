//! Time steps that are looked at together.

/// Steps multiplied at once, side by side: what is multiplied with them is read from memory once for all of them.
pub(crate) const BATCH: usize = 16;

/// A bit for each step of a batch.
pub(crate) type Steps = u16;

/// The first of them is the last of the batch before, so that what happens between two steps lies within one batch.
pub(crate) const STRIDE: usize = BATCH - 1;

/// Lane of a step in its batch, 1..BATCH.
pub(crate) fn lane(step: usize) -> usize {
    step % STRIDE + 1
}

/// A value at each of the batch's steps.
pub(crate) type Lanes = [f32; BATCH];
