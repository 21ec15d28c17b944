//! Lines, words and numbers of text files.

use std::borrow::Cow;

use super::ReadError;
use super::format::is_exactly_binary_stl;

/// Units of UTF-16 that must be letters of ASCII for a file without a mark to count as UTF-16.
const TELLING: usize = 8;

/// The bytes of a text file without its byte order mark, and in UTF-8 where they are UTF-16; other files as they are.
pub(crate) fn in_utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
    let is_ascii = |unit: u16| (1..128).contains(&unit);
    let starts = |unit: fn([u8; 2]) -> u16| {
        let start = bytes.get(..2 * TELLING).unwrap_or_default();
        let mut units = start.as_chunks().0.iter().map(|&pair| unit(pair));
        !start.is_empty() && units.all(is_ascii)
    };
    let unit: fn([u8; 2]) -> u16 = match bytes {
        _ if is_exactly_binary_stl(bytes) => return Cow::Borrowed(bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => return Cow::Borrowed(rest),
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ if starts(u16::from_le_bytes) => u16::from_le_bytes,
        _ if starts(u16::from_be_bytes) => u16::from_be_bytes,
        _ => return Cow::Borrowed(bytes),
    };
    let units = bytes.as_chunks().0.iter().map(|&pair| unit(pair));
    let text: String = char::decode_utf16(units.skip_while(|&unit| unit == 0xfeff))
        .map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER))
        .collect();
    Cow::Owned(text.into_bytes())
}

/// The lines of a file with their numbers from 1, ends trimmed. A backslash at the end joins the next line.
pub(crate) struct Lines<'a> {
    rest: Option<&'a [u8]>,
    separator: u8,
    number: usize,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self {
            rest: Some(bytes),
            separator: if bytes.contains(&b'\n') { b'\n' } else { b'\r' },
            number: 0,
        }
    }

    fn physical(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest?;
        self.number += 1;
        let line = match rest.iter().position(|&b| b == self.separator) {
            Some(end) => {
                self.rest = rest.get(end + 1..);
                rest.get(..end)?
            }
            None => {
                self.rest = None;
                rest
            }
        };
        Some(line.trim_ascii())
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let line = self.physical()?;
        let number = self.number;
        let Some(start) = line.strip_suffix(b"\\") else {
            return Some((number, Cow::Borrowed(line)));
        };
        let mut joined = start.to_vec();
        while let Some(more) = self.physical() {
            joined.push(b' ');
            match more.strip_suffix(b"\\") {
                Some(more) => joined.extend_from_slice(more),
                None => {
                    joined.extend_from_slice(more);
                    break;
                }
            }
        }
        Some((number, Cow::Owned(joined)))
    }
}

/// A keyword in small letters.
pub(crate) fn lower(word: &[u8]) -> Cow<'_, [u8]> {
    if word.iter().any(u8::is_ascii_uppercase) {
        Cow::Owned(word.to_ascii_lowercase())
    } else {
        Cow::Borrowed(word)
    }
}

/// Words between white space.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// A decimal number.
pub(crate) fn number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// The next word as a number, or an error that names the line.
pub(crate) fn next_number<'a>(
    words: &mut impl Iterator<Item = &'a [u8]>,
    line: usize,
) -> Result<f64, ReadError> {
    let Some(word) = words.next() else {
        return Err(ReadError::malformed(
            format!("line {line}"),
            "a number is missing",
        ));
    };
    number(word).ok_or_else(|| {
        let problem = format!("“{}” is not a number", shown(word));
        ReadError::malformed(format!("line {line}"), problem)
    })
}

/// A word fit for a message: not too long, without control characters.
pub(crate) fn shown(word: &[u8]) -> String {
    String::from_utf8_lossy(word.get(..40).unwrap_or(word))
        .chars()
        .map(|c| if c.is_control() { '?' } else { c })
        .collect()
}
