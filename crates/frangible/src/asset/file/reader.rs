//! Sections taken apart, trusting nothing.

use super::row::{Kind, Row};
use super::sections::Section;
use super::{
    ALIGNMENT, AssetFileError, CHECKSUM_AT, COVERED_FROM, ENTRY, FORMAT_VERSION, HEADER, MAGIC,
    checksum, foreign,
};

#[derive(Clone, Copy)]
struct Entry<'a> {
    id: u32,
    kind: u16,
    columns: u16,
    data: &'a [u8],
}

/// The sections of a file whose header, checksum and table are sound.
pub(super) struct Reader<'a> {
    /// Sorted by number.
    entries: Vec<Entry<'a>>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self, AssetFileError> {
        let count = header(bytes)?;
        // A count that the file has no room for ends here, before anything of its size is allocated.
        let table = count
            .checked_mul(ENTRY)
            .and_then(|length| bytes.get(HEADER..)?.get(..length))
            .ok_or_else(|| {
                let problem = format!("does not hold the {count} sections that the header states");
                AssetFileError::section("section table", problem)
            })?;
        let mut free = HEADER + table.len();
        let mut entries = Vec::with_capacity(count);
        for row in table.chunks_exact(ENTRY) {
            let (entry, end) = entry(bytes, row, free)?;
            entries.push(entry);
            free = end;
        }
        entries.sort_by_key(|e| e.id);
        if let Some(pair) = entries.windows(2).find(|pair| pair[0].id == pair[1].id) {
            return Err(fail(pair[0].id, "occurs twice"));
        }
        Ok(Self { entries })
    }

    pub(super) fn has(&self, section: Section) -> bool {
        self.find(section).is_some()
    }

    fn find(&self, section: Section) -> Option<&Entry<'a>> {
        let at = self.entries.binary_search_by_key(&section.id, |e| e.id);
        at.ok().and_then(|i| self.entries.get(i))
    }

    fn data<T: Row>(&self, section: Section) -> Result<&'a [u8], AssetFileError> {
        let fail = |problem: String| Err(AssetFileError::section(section.name, problem));
        let Some(entry) = self.find(section) else {
            return fail("is missing".into());
        };
        if entry.kind != T::KIND as u16 || usize::from(entry.columns) != T::COLUMNS {
            let kind = Kind::of(entry.kind).map_or("unknown", Kind::name);
            return fail(format!(
                "holds rows of {} {kind} numbers, not of {} {}",
                entry.columns,
                T::COLUMNS,
                T::KIND.name()
            ));
        }
        if !entry.data.len().is_multiple_of(T::SIZE) {
            return fail(format!(
                "has {} bytes, which is not a multiple of the row size of {}",
                entry.data.len(),
                T::SIZE
            ));
        }
        Ok(entry.data)
    }

    /// All rows of a section.
    pub(super) fn rows<T: Row>(&self, section: Section) -> Result<Vec<T>, AssetFileError> {
        Ok(self.each(section)?.collect())
    }

    /// The rows of a section, one after the other.
    pub(super) fn each<T: Row>(
        &self,
        section: Section,
    ) -> Result<impl ExactSizeIterator<Item = T> + use<'a, T>, AssetFileError> {
        Ok(self.data::<T>(section)?.chunks_exact(T::SIZE).map(T::get))
    }

    /// The only row of a section.
    pub(super) fn one<T: Row>(&self, section: Section) -> Result<T, AssetFileError> {
        let mut rows = self.each(section)?;
        match (rows.next(), rows.len()) {
            (Some(row), 0) => Ok(row),
            _ => Err(AssetFileError::section(
                section.name,
                "does not hold exactly one row",
            )),
        }
    }

    /// A section of UTF-8.
    pub(super) fn text(&self, section: Section) -> Result<&'a str, AssetFileError> {
        std::str::from_utf8(self.data::<u8>(section)?)
            .map_err(|_| AssetFileError::section(section.name, "is not UTF-8 text"))
    }
}

/// Checks all but the table, and gives the number of sections.
fn header(bytes: &[u8]) -> Result<usize, AssetFileError> {
    let found = bytes.len() as u64;
    let truncated = |expected: u64| AssetFileError::Truncated { expected, found };
    if !bytes.starts_with(&MAGIC) {
        if !bytes.is_empty() && MAGIC.starts_with(bytes) {
            return Err(truncated(HEADER as u64));
        }
        return Err(AssetFileError::NotAnAsset {
            looks_like: foreign::looks_like(bytes),
        });
    }
    let Some(header) = bytes.first_chunk::<HEADER>() else {
        return Err(truncated(HEADER as u64));
    };
    let version = u32::get(&header[16..]);
    if version != FORMAT_VERSION {
        return Err(AssetFileError::Version {
            found: version,
            supported: FORMAT_VERSION,
        });
    }
    let expected = long(&header[24..]);
    if found < expected {
        return Err(truncated(expected));
    }
    if found > expected {
        return Err(AssetFileError::TooLong { expected, found });
    }
    let stored = long(&header[CHECKSUM_AT..]);
    if stored != checksum(bytes.get(COVERED_FROM..).unwrap_or_default()) {
        return Err(AssetFileError::Checksum);
    }
    Ok(u32::get(&header[20..]) as usize)
}

/// One entry of the table, and the offset at which the next section may begin: sections follow one another.
fn entry<'a>(
    bytes: &'a [u8],
    row: &[u8],
    free: usize,
) -> Result<(Entry<'a>, usize), AssetFileError> {
    let [id, shape] = <[u32; 2]>::get(row);
    let [offset, length] = [8, 16].map(|at| long(row.get(at..).unwrap_or_default()));
    if !offset.is_multiple_of(ALIGNMENT as u64) {
        return Err(fail(
            id,
            &format!("starts at byte {offset}, which is not a multiple of {ALIGNMENT}"),
        ));
    }
    let start = usize::try_from(offset).unwrap_or(usize::MAX);
    let end = usize::try_from(offset.saturating_add(length)).unwrap_or(usize::MAX);
    if start < free {
        return Err(fail(
            id,
            &format!("starts at byte {offset}, inside the data before it"),
        ));
    }
    let Some(data) = bytes.get(start..end) else {
        return Err(fail(
            id,
            &format!("has {length} bytes from byte {offset} on, beyond the end of the file"),
        ));
    };
    let entry = Entry {
        id,
        kind: (shape & 0xffff) as u16,
        columns: (shape >> 16) as u16,
        data,
    };
    Ok((entry, end))
}

fn long(bytes: &[u8]) -> u64 {
    bytes.first_chunk().map_or(0, |b| u64::from_le_bytes(*b))
}

fn fail(id: u32, problem: &str) -> AssetFileError {
    AssetFileError::section(format!("number {id}"), problem)
}
