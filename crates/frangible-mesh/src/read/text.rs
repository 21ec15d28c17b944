//! Lines, words and numbers of text files.

use std::borrow::Cow;

use super::ReadError;

/// The lines of a file with their numbers from 1, ends trimmed. A backslash at the end joins the next line.
pub(crate) struct Lines<'a> {
    rest: Option<&'a [u8]>,
    separator: u8,
    number: usize,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self {
            rest: Some(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)),
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
