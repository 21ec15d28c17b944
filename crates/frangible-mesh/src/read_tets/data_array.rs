//! The data of VTK's XML files: text, or numbers behind a header, in base64 or raw, perhaps compressed.

use std::borrow::Cow;

use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;

use super::cursor::{Coding, Cursor, integer_of, real_of};
use super::xml::Tag;
use crate::read::ReadError;

/// Encoding of all arrays of a file.
pub(super) struct Settings {
    coding: Coding,
    /// Bytes of a number of a header.
    header: usize,
    zlib: bool,
}

impl Settings {
    pub(super) fn of(tag: &Tag<'_>) -> Result<Self, ReadError> {
        let zlib = match tag.get("compressor") {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                return Err(ReadError::Unsupported(format!("the compressor {other}")));
            }
        };
        Ok(Self {
            coding: match tag.get("byte_order") {
                Some("BigEndian") => Coding::Big,
                _ => Coding::Little,
            },
            header: match tag.get("header_type") {
                Some("UInt64") => 8,
                _ => 4,
            },
            zlib,
        })
    }
}

/// Data after the tags.
#[derive(Default)]
pub(super) struct Arrays<'a> {
    bytes: &'a [u8],
    base64: bool,
}

impl<'a> Arrays<'a> {
    /// Finds the appended arrays, which begin behind an underscore.
    pub(super) fn appended(tag: &Tag<'_>, rest: &'a [u8]) -> Result<Self, ReadError> {
        let start = rest.iter().position(|b| !b.is_ascii_whitespace());
        let bytes = start.and_then(|at| rest[at..].strip_prefix(b"_"));
        Ok(Self {
            bytes: bytes.ok_or_else(|| {
                ReadError::malformed(tag.place(), "appended data must begin with an underscore")
            })?,
            base64: tag.get("encoding") != Some("raw"),
        })
    }
}

/// Numbers of one array.
pub(super) struct Layout<'a> {
    bytes: Cow<'a, [u8]>,
    coding: Coding,
    width: usize,
    real: bool,
    place: String,
}

impl<'a> Layout<'a> {
    pub(super) fn read(
        tag: &Tag<'a>,
        arrays: &Arrays<'a>,
        settings: &Settings,
    ) -> Result<Self, ReadError> {
        let wrong = |problem: String| ReadError::malformed(tag.place(), problem);
        let kind = tag.get("type").unwrap_or_default();
        let (width, real) = match kind {
            "Float32" => (4, true),
            "Float64" => (8, true),
            "Int8" | "UInt8" => (1, false),
            "Int16" | "UInt16" => (2, false),
            "Int32" | "UInt32" => (4, false),
            "Int64" | "UInt64" => (8, false),
            _ => return Err(wrong(format!("the number type “{kind}” is unknown"))),
        };
        let inline = || {
            let end = tag.text.iter().position(|&b| b == b'<');
            &tag.text[..end.unwrap_or(tag.text.len())]
        };
        let (bytes, coding) = match tag.get("format").unwrap_or("ascii") {
            "ascii" => (Cow::Borrowed(inline()), Coding::Text),
            "binary" => (Source::base64(inline()).array(settings)?, settings.coding),
            "appended" => {
                let offset = tag.get("offset").and_then(|o| o.trim().parse().ok());
                let start = offset.and_then(|o: usize| arrays.bytes.get(o..));
                let start = start.ok_or_else(|| wrong("its offset lies beyond the data".into()))?;
                let source = if arrays.base64 {
                    Source::base64(start)
                } else {
                    Source::Raw(start)
                };
                (source.array(settings)?, settings.coding)
            }
            other => return Err(wrong(format!("the format “{other}” is unknown"))),
        };
        Ok(Self {
            bytes,
            coding,
            width,
            real,
            place: format!("the array of {}", tag.place()),
        })
    }

    pub(super) fn reals(&self) -> Result<Vec<f64>, ReadError> {
        self.all(
            |cursor, place| cursor.real(8, place),
            |bytes| {
                if self.real {
                    real_of(bytes, self.coding)
                } else {
                    integer_of(bytes, self.coding) as f64
                }
            },
        )
    }

    pub(super) fn integers(&self) -> Result<Vec<i64>, ReadError> {
        self.all(
            |cursor, place| Ok(cursor.real(8, place)? as i64),
            |bytes| {
                if self.real {
                    real_of(bytes, self.coding) as i64
                } else {
                    integer_of(bytes, self.coding)
                }
            },
        )
    }

    fn all<T>(
        &self,
        mut word: impl FnMut(&mut Cursor<'_>, &str) -> Result<T, ReadError>,
        binary: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, ReadError> {
        if self.coding != Coding::Text {
            return Ok(self.bytes.chunks_exact(self.width).map(binary).collect());
        }
        let mut cursor = Cursor::new(&self.bytes);
        let mut values = Vec::new();
        while cursor.peek().is_some() {
            values.push(word(&mut cursor, &self.place)?);
        }
        Ok(values)
    }
}

/// Bytes in turn.
enum Source<'a> {
    Raw(&'a [u8]),
    /// Text that is left, and bytes that are decoded but not yet taken.
    Base64(&'a [u8], Vec<u8>),
}

impl<'a> Source<'a> {
    const fn base64(text: &'a [u8]) -> Self {
        Self::Base64(text, Vec::new())
    }

    fn take(&mut self, count: usize) -> Result<Cow<'a, [u8]>, ReadError> {
        let inside = "a data array";
        match self {
            Self::Raw(bytes) => {
                let (taken, rest) = bytes
                    .split_at_checked(count)
                    .ok_or_else(|| ReadError::truncated(inside))?;
                *bytes = rest;
                Ok(Cow::Borrowed(taken))
            }
            Self::Base64(text, decoded) => {
                while decoded.len() < count {
                    *text = decode_group(text, decoded)?;
                }
                let rest = decoded.split_off(count);
                Ok(Cow::Owned(std::mem::replace(decoded, rest)))
            }
        }
    }

    fn size(&mut self, settings: &Settings) -> Result<usize, ReadError> {
        let bytes = self.take(settings.header)?;
        let value = integer_of(&bytes, settings.coding);
        // A four-byte number is unsigned here.
        let value = if settings.header == 4 {
            value & 0xffff_ffff
        } else {
            value
        };
        usize::try_from(value)
            .map_err(|_| ReadError::malformed("a data array", "its size is negative"))
    }

    /// The numbers behind the header.
    fn array(mut self, settings: &Settings) -> Result<Cow<'a, [u8]>, ReadError> {
        if !settings.zlib {
            let size = self.size(settings)?;
            return self.take(size);
        }
        let blocks = self.size(settings)?;
        let full = self.size(settings)?;
        let last = self.size(settings)?;
        let mut sizes = Vec::new();
        for _ in 0..blocks {
            sizes.push(self.size(settings)?);
        }
        let mut all = Vec::new();
        for (block, &size) in sizes.iter().enumerate() {
            let limit = if block + 1 == blocks && last > 0 {
                last
            } else {
                full
            };
            crate::read::check_bytes((all.len() as u64).saturating_add(limit as u64))?;
            let packed = self.take(size)?;
            let plain = decompress_to_vec_zlib_with_limit(&packed, limit).map_err(|error| {
                let place = format!("block {} of a data array", block + 1);
                ReadError::malformed(place, format!("it cannot be decompressed ({error})"))
            })?;
            all.extend(plain);
        }
        Ok(Cow::Owned(all))
    }
}

/// Decodes the next four letters. A group may end early anywhere: header and data may be encoded one after the other.
fn decode_group<'a>(text: &'a [u8], out: &mut Vec<u8>) -> Result<&'a [u8], ReadError> {
    let (mut bits, mut letters, mut padding, mut used) = (0_u32, 0, 0, 0);
    for &byte in text {
        used += 1;
        let value = match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b'=' => {
                padding += 1;
                0
            }
            _ if byte.is_ascii_whitespace() => continue,
            b'<' => break,
            _ => {
                let problem = "a character that is not valid base64";
                return Err(ReadError::malformed("a data array", problem));
            }
        };
        bits = bits << 6 | u32::from(value);
        letters += 1;
        if letters == 4 {
            break;
        }
    }
    if letters < 4 || padding > 2 {
        return Err(ReadError::truncated("a base64 data array"));
    }
    let [_, bytes @ ..] = bits.to_be_bytes();
    out.extend(&bytes[..3 - padding]);
    Ok(&text[used..])
}
