//! Sections put together: header, table, data.

use super::row::{Kind, Row};
use super::sections::Section;
use super::{ALIGNMENT, CHECKSUM_AT, COVERED_FROM, ENTRY, FORMAT_VERSION, HEADER, MAGIC, checksum};

struct Entry {
    id: u32,
    kind: Kind,
    columns: u16,
    /// Offset from the start of the data, bytes.
    offset: usize,
    length: usize,
}

/// Collects sections.
#[derive(Default)]
pub(super) struct Writer {
    entries: Vec<Entry>,
    data: Vec<u8>,
}

impl Writer {
    pub(super) fn text(&mut self, section: Section, text: &str) {
        self.rows(section, text.as_bytes());
    }

    pub(super) fn rows<T: Row>(&mut self, section: Section, rows: &[T]) {
        self.each(section, rows.iter().copied());
    }

    pub(super) fn each<T: Row>(
        &mut self,
        section: Section,
        rows: impl ExactSizeIterator<Item = T>,
    ) {
        let (offset, length) = (self.data.len(), rows.len() * T::SIZE);
        self.data.resize(offset + length, 0);
        let (_, free) = self.data.split_at_mut(offset);
        for (row, place) in rows.zip(free.chunks_exact_mut(T::SIZE)) {
            row.put(place);
        }
        self.data
            .resize(self.data.len().next_multiple_of(ALIGNMENT), 0);
        self.entries.push(Entry {
            id: section.id,
            kind: T::KIND,
            columns: T::COLUMNS as u16,
            offset,
            length,
        });
    }

    pub(super) fn finish(self) -> Vec<u8> {
        let start = HEADER + self.entries.len() * ENTRY;
        let mut bytes = Vec::with_capacity(start + self.data.len());
        bytes.extend(MAGIC);
        bytes.extend([0; COVERED_FROM - CHECKSUM_AT]);
        bytes.extend(FORMAT_VERSION.to_le_bytes());
        bytes.extend((self.entries.len() as u32).to_le_bytes());
        bytes.extend([0; 8]);
        for entry in &self.entries {
            bytes.extend(entry.id.to_le_bytes());
            bytes.extend((entry.kind as u16).to_le_bytes());
            bytes.extend(entry.columns.to_le_bytes());
            bytes.extend(((start + entry.offset) as u64).to_le_bytes());
            bytes.extend((entry.length as u64).to_le_bytes());
        }
        bytes.extend(&self.data);
        seal(&mut bytes);
        bytes
    }
}

/// Writes length and checksum into the header, so that altered bytes pass for a whole file. For tests.
pub fn seal(bytes: &mut [u8]) {
    let length = bytes.len() as u64;
    let Some((header, _)) = bytes.split_first_chunk_mut::<HEADER>() else {
        return;
    };
    header[24..].copy_from_slice(&length.to_le_bytes());
    if let Some((head, covered)) = bytes.split_at_mut_checked(COVERED_FROM) {
        head[CHECKSUM_AT..].copy_from_slice(&checksum(covered).to_le_bytes());
    }
}
