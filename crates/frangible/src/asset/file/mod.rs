//! Assets as files: `.frangible`, described in `docs/asset-format.md`.
//!
//! Sizes, the checksum, every index and every number are checked before a file is believed. The adjacency is stored, because
//! rebuilding it takes longer than loading the file.
//!
//! Until 0.1.0 there is one version of the format: what another version wrote is refused with a sentence that says how to make
//! it anew.

mod decode;
mod disk;
mod encode;
mod error;
mod foreign;
mod reader;
mod row;
mod sections;
mod writer;

pub use error::AssetFileError;
pub use writer::seal;

/// Version of the file format: the only one that this build reads and writes. Files are cheap to bake again, so there is no
/// conversion.
pub const FORMAT_VERSION: u32 = 8;

/// Options for writing an asset.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct SaveOptions {
    /// Mode shapes in half precision, half as large, rounded to about 1 part in 4000; no stress bounds, no offsets that are zero:
    /// they are found when the file is read. Default off: bit for bit.
    pub compact: bool,
}

impl SaveOptions {
    /// Mode shapes in half precision.
    #[must_use]
    pub const fn compact() -> Self {
        Self { compact: true }
    }
}

/// First bytes of every file.
const MAGIC: [u8; 8] = *b"FRANGIBL";
/// Offsets of the checksum, and of the first byte that it covers.
const CHECKSUM_AT: usize = 8;
const COVERED_FROM: usize = 16;
/// Length of magic, checksum, version, number of sections and file length, bytes.
const HEADER: usize = 32;
/// Length of one entry of the section table, bytes.
const ENTRY: usize = 24;
/// Every section starts at a multiple of this, bytes.
const ALIGNMENT: usize = 8;

/// XXH64 with seed zero: 40 MB take a few milliseconds, and every language has it.
fn checksum(covered: &[u8]) -> u64 {
    twox_hash::XxHash64::oneshot(0, covered)
}
