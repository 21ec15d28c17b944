//! A place in a file: words of text with their line, or binary numbers.

use crate::read::ReadError;
use crate::read::text::shown;

/// Encoding of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Coding {
    Text,
    Little,
    Big,
}

/// Reads forwards only; nothing is taken that is not there.
pub(crate) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Number of the line it is at, counted from 1.
    line: usize,
    /// Begins a comment that ends with its line; none where zero.
    comment: u8,
    pub(crate) coding: Coding,
}

impl<'a> Cursor<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            at: 0,
            line: 1,
            comment: 0,
            coding: Coding::Text,
        }
    }

    /// Text in which `#` begins a comment.
    pub(super) fn with_comments(bytes: &'a [u8]) -> Self {
        Self {
            comment: b'#',
            ..Self::new(bytes)
        }
    }

    /// Place of an error: a line of text, a byte of a binary file.
    pub(crate) fn place(&self) -> String {
        match self.coding {
            Coding::Text => format!("line {}", self.line),
            _ => format!("byte {}", self.at),
        }
    }

    pub(super) fn malformed(&self, problem: impl Into<String>) -> ReadError {
        ReadError::malformed(self.place(), problem)
    }

    /// The next word, over any line ends.
    pub(crate) fn word(&mut self) -> Option<&'a [u8]> {
        loop {
            let &byte = self.bytes.get(self.at)?;
            if byte == b'\n' {
                self.line += 1;
                self.at += 1;
            } else if byte.is_ascii_whitespace() {
                self.at += 1;
            } else if byte == self.comment {
                self.skip_to_line_end();
            } else {
                break;
            }
        }
        let rest = &self.bytes[self.at..];
        let end = |&b: &u8| b.is_ascii_whitespace() || b == self.comment && self.comment != 0;
        let length = rest.iter().position(end).unwrap_or(rest.len());
        self.at += length;
        Some(&rest[..length])
    }

    /// The next word without going past it.
    pub(super) fn peek(&self) -> Option<&'a [u8]> {
        let mut ahead = Cursor { ..*self };
        ahead.word()
    }

    fn skip_to_line_end(&mut self) {
        let rest = &self.bytes[self.at..];
        self.at += rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
    }

    /// Takes the rest of the line; the next thing read begins after its end.
    pub(super) fn rest_of_line(&mut self) -> Option<&'a [u8]> {
        if self.at >= self.bytes.len() {
            return None;
        }
        let start = self.at;
        self.skip_to_line_end();
        let line = &self.bytes[start..self.at];
        if self.at < self.bytes.len() {
            self.at += 1;
            self.line += 1;
        }
        let length = match self.comment {
            0 => line.len(),
            mark => line.iter().position(|&b| b == mark).unwrap_or(line.len()),
        };
        Some(line[..length].trim_ascii())
    }

    /// Takes the rest of the line up to a word with which, or with what follows it, something else begins.
    pub(crate) fn rest_of_line_before(&mut self, begins: impl Fn(&[u8]) -> bool) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let is_end = |&b: &u8| b == b'\n' || b == b'\r';
        let line = &rest[..rest.iter().position(is_end).unwrap_or(rest.len())];
        let starts = |&i: &usize| i == 0 || line[i - 1].is_ascii_whitespace();
        let mut words = (0..line.len()).filter(starts);
        let length = words.find(|&i| begins(&line[i..])).unwrap_or(line.len());
        self.at += length;
        line[..length].trim_ascii()
    }

    /// Goes past the next occurrence of `mark`, or to the end of the file.
    pub(super) fn skip_past(&mut self, mark: &[u8]) {
        let rest = &self.bytes[self.at..];
        let found = rest.windows(mark.len()).position(|w| w == mark);
        let passed = found.map_or(rest.len(), |at| at + mark.len());
        self.line += rest[..passed].iter().filter(|&&b| b == b'\n').count();
        self.at += passed;
    }

    /// The next `count` bytes.
    pub(super) fn take(&mut self, count: usize, inside: &str) -> Result<&'a [u8], ReadError> {
        let end = self.at.checked_add(count);
        let taken = end.and_then(|end| self.bytes.get(self.at..end));
        let taken = taken.ok_or_else(|| ReadError::truncated(inside))?;
        self.at += count;
        Ok(taken)
    }

    /// A whole number: a word of text, or `width` bytes.
    pub(super) fn integer(&mut self, width: usize, inside: &str) -> Result<i64, ReadError> {
        if self.coding != Coding::Text {
            let bytes = self.take(width, inside)?;
            return Ok(integer_of(bytes, self.coding));
        }
        let word = self.word().ok_or_else(|| ReadError::truncated(inside))?;
        let parsed = std::str::from_utf8(word).ok().and_then(|w| w.parse().ok());
        parsed.ok_or_else(|| {
            self.malformed(format!(
                "“{}” is not a whole number (inside {inside})",
                shown(word)
            ))
        })
    }

    /// A number that cannot be below zero: a count or an index.
    pub(super) fn count(&mut self, width: usize, inside: &str) -> Result<u64, ReadError> {
        let value = self.integer(width, inside)?;
        u64::try_from(value)
            .map_err(|_| self.malformed(format!("{value} is negative (inside {inside})")))
    }

    /// A number: a word of text, or `width` bytes.
    pub(super) fn real(&mut self, width: usize, inside: &str) -> Result<f64, ReadError> {
        if self.coding != Coding::Text {
            let bytes = self.take(width, inside)?;
            return Ok(real_of(bytes, self.coding));
        }
        let word = self.word().ok_or_else(|| ReadError::truncated(inside))?;
        crate::read::text::number(word).ok_or_else(|| {
            self.malformed(format!(
                "“{}” is not a number (inside {inside})",
                shown(word)
            ))
        })
    }
}

/// 1, 2, 4 or 8 bytes as a signed number; a single byte is unsigned, as the formats have types and colours only there.
pub(super) fn integer_of(bytes: &[u8], coding: Coding) -> i64 {
    if let [byte] = *bytes {
        return i64::from(byte);
    }
    let bits = bits_of(bytes, coding);
    let shift = 64 - 8 * bytes.len().min(8) as u32;
    if shift == 64 {
        return 0;
    }
    ((bits << shift) as i64) >> shift
}

/// 4 or 8 bytes as a number.
pub(super) fn real_of(bytes: &[u8], coding: Coding) -> f64 {
    let bits = bits_of(bytes, coding);
    if bytes.len() == 4 {
        f64::from(f32::from_bits(bits as u32))
    } else {
        f64::from_bits(bits)
    }
}

fn bits_of(bytes: &[u8], coding: Coding) -> u64 {
    let join = |bits: u64, &byte: &u8| bits << 8 | u64::from(byte);
    match coding {
        Coding::Big => bytes.iter().fold(0, join),
        _ => bytes.iter().rev().fold(0, join),
    }
}
