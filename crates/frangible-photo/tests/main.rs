//! Pictures of recordings.

mod pictures;
