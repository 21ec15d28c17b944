//! A key that scene files had once.

use serde::Deserialize;
use serde::de::{Deserializer, Error, IgnoredAny};

/// The reach of release waves, κ: how far a crack releases follows from its length.
#[derive(Default)]
pub(super) struct Gone;

impl<'de> Deserialize<'de> for Gone {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        IgnoredAny::deserialize(deserializer)?;
        Err(D::Error::custom(
            "the knob `release_reach` is gone, since how far a crack releases the stress beside it now follows from its length: delete it",
        ))
    }
}
