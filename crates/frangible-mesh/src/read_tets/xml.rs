//! The part of XML that VTK writes: tags with attributes, and text between them.

use crate::read::ReadError;

/// A tag and the text up to the next one.
pub(super) struct Tag<'a> {
    pub(super) name: String,
    /// `</name>`
    pub(super) closes: bool,
    attributes: Vec<(String, String)>,
    pub(super) text: &'a [u8],
    /// Number of the line it is at, counted from 1.
    line: usize,
}

impl Tag<'_> {
    pub(super) fn get(&self, attribute: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|a| a.0 == attribute)?;
        Some(&found.1)
    }

    pub(super) fn place(&self) -> String {
        format!("line {}", self.line)
    }
}

/// The tags of a file in turn.
pub(super) struct Tags<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl<'a> Tags<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            at: 0,
            line: 1,
        }
    }

    /// Bytes after the last tag.
    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    fn pass(&mut self, count: usize) -> &'a [u8] {
        let passed = &self.bytes[self.at..self.at + count];
        self.line += passed.iter().filter(|&&b| b == b'\n').count();
        self.at += count;
        passed
    }

    /// Leaves the text of the tag unread, so that raw data behind `<AppendedData>` are not looked at.
    pub(super) fn next_tag(&mut self) -> Result<Option<Tag<'a>>, ReadError> {
        loop {
            let Some(start) = self.rest().iter().position(|&b| b == b'<') else {
                return Ok(None);
            };
            self.pass(start);
            if self.rest().starts_with(b"<!--") {
                let end = self.rest().windows(3).position(|w| w == b"-->");
                let end = end.ok_or_else(|| ReadError::truncated("a comment"))?;
                self.pass(end + 3);
                continue;
            }
            let line = self.line;
            let end = self.rest().iter().position(|&b| b == b'>');
            let end = end.ok_or_else(|| ReadError::truncated("a tag"))?;
            let inside = self.pass(end + 1);
            let inside = &inside[1..end];
            if inside.starts_with(b"?") || inside.starts_with(b"!") {
                continue;
            }
            let text = self.rest();
            // The end of the text between two tags is looked for only where it is used.
            let inside = String::from_utf8_lossy(inside);
            let (closes, inside) = match inside.strip_prefix('/') {
                Some(rest) => (true, rest),
                None => (false, inside.as_ref()),
            };
            let inside = inside.trim_end_matches('/');
            let name_end = inside
                .find(|c: char| c.is_ascii_whitespace())
                .unwrap_or(inside.len());
            return Ok(Some(Tag {
                name: inside[..name_end].to_string(),
                closes,
                attributes: attributes(&inside[name_end..]),
                text,
                line,
            }));
        }
    }
}

/// Pairs of a name and a value in quotation marks.
fn attributes(mut text: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    while let Some((name, rest)) = text.split_once('=') {
        let rest = rest.trim_start();
        let Some(mark) = rest.chars().next().filter(|&c| c == '"' || c == '\'') else {
            break;
        };
        let Some((value, rest)) = rest[1..].split_once(mark) else {
            break;
        };
        found.push((name.trim().to_string(), value.to_string()));
        text = rest;
    }
    found
}
