//! Asset files (`.frangible`), as specified in `docs/asset-format.md`.
//!
//! Reading a file checks its sizes, the checksum, every index and every number. The adjacency is stored because rebuilding it
//! would take longer than loading the file.
//!
//! Only the current version of the format is supported. A file of another version is rejected with a message that says how to
//! bake it again.

mod decode;
mod disk;
mod drawn;
mod encode;
mod error;
mod foreign;
mod reader;
mod row;
mod sections;
mod writer;

pub use error::AssetFileError;
pub use writer::seal;

/// Version of the file format, the only one that this build reads and writes. There is no conversion from other versions, since
/// bodies can be baked again.
pub const FORMAT_VERSION: u32 = 8;

/// Options for writing an asset.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct SaveOptions {
    /// Writes a compact file: mode shapes in half precision, with a relative error of about 1/4000, without stress bounds and zero
    /// offsets, which are restored when the file is read. Default off: the asset is stored bit for bit.
    pub compact: bool,
}

impl SaveOptions {
    /// Returns options for a compact file, with mode shapes in half precision.
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
