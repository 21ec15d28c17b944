//! Header of a PLY file.

use crate::read::ReadError;
use crate::read::text::{shown, words};

#[derive(Clone, Copy)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Kind {
    pub(super) fn is_whole(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }

    /// The largest whole number without a sign, which has the bits of −1; none for the other kinds.
    pub(super) fn all_bits(self) -> Option<i64> {
        match self {
            Self::U8 => Some(i64::from(u8::MAX)),
            Self::U16 => Some(i64::from(u16::MAX)),
            Self::U32 => Some(i64::from(u32::MAX)),
            // Beyond what the index of a corner can hold.
            Self::U64 => Some(i64::MAX),
            _ => None,
        }
    }
}

pub(super) struct Property {
    pub(super) name: Vec<u8>,
    pub(super) value: Kind,
    /// For lists: how their length is written.
    pub(super) count: Option<Kind>,
}

pub(super) struct Element {
    pub(super) name: Vec<u8>,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

/// Beginnings of lines that are passed over; some programs put a colon behind them.
const REMARKS: [&[u8]; 4] = [b"comment", b"obj_info", b"#", b"//"];

pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Names of image files, from remarks “TextureFile NAME”.
    pub(super) textures: Vec<String>,
}

impl Header {
    /// Largest number of vertices that there may be.
    pub(super) fn vertices(&self) -> u64 {
        let vertices = self.elements.iter().filter(|e| e.name == b"vertex");
        vertices.fold(0, |sum, e| sum.saturating_add(e.count))
    }

    /// The header, and the bytes behind it.
    pub(super) fn parse(bytes: &[u8]) -> Result<(Self, &[u8]), ReadError> {
        let mut rest = bytes;
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut textures = Vec::new();
        let first = bytes.iter().position(|&b| b == b'\n' || b == b'\r');
        let separator = match first.map(|end| &bytes[end..]) {
            Some([b'\r', b'\n', ..]) | None => b'\n',
            Some(end) => end[0],
        };
        for line in 1.. {
            let Some(end) = rest.iter().position(|&b| b == separator) else {
                return Err(ReadError::truncated("the header"));
            };
            let (text, after) = (&rest[..end], &rest[end + 1..]);
            rest = after;
            // Some programs write capitals.
            let small = text.to_ascii_lowercase();
            let words: Vec<&[u8]> = words(&small).collect();
            let bad = || {
                ReadError::malformed(
                    format!("line {line}"),
                    format!("“{}” is not a valid PLY header line", shown(text)),
                )
            };
            if line == 1 {
                if words != [b"ply"] {
                    return Err(ReadError::malformed(
                        "line 1",
                        "a PLY file begins with the line “ply”",
                    ));
                }
                continue;
            }
            match words.as_slice() {
                [b"end_header"] => break,
                [] => {}
                [b"comment", b"texturefile", ..] => textures.push(file_name(text)),
                [word, ..] if REMARKS.iter().any(|known| word.starts_with(known)) => {}
                [b"format", name, ..] => encoding = Some(encoding_named(name).ok_or_else(bad)?),
                [b"element", name, count, ..] => elements.push(Element {
                    name: name.to_vec(),
                    count: whole_number(count).ok_or_else(bad)?,
                    properties: Vec::new(),
                }),
                [b"property", b"list", count, value, name, ..] => {
                    let count = Some(kind_named(count).ok_or_else(bad)?);
                    let value = kind_named(value).ok_or_else(bad)?;
                    let name = name.to_vec();
                    let element = elements.last_mut().ok_or_else(bad)?;
                    element.properties.push(Property { name, value, count });
                }
                [b"property", value, name, ..] => {
                    let value = kind_named(value).ok_or_else(bad)?;
                    let name = name.to_vec();
                    let count = None;
                    let element = elements.last_mut().ok_or_else(bad)?;
                    element.properties.push(Property { name, value, count });
                }
                _ => return Err(bad()),
            }
        }
        let encoding = encoding
            .ok_or_else(|| ReadError::malformed("the header", "it has no line “format …”"))?;
        let header = Self {
            encoding,
            elements,
            textures,
        };
        Ok((header, rest))
    }
}

/// Text after the second word of a header line, spaces included.
fn file_name(line: &[u8]) -> String {
    let mut rest = line.trim_ascii();
    for _ in 0..2 {
        let end = rest.iter().position(u8::is_ascii_whitespace);
        rest = rest[end.unwrap_or(rest.len())..].trim_ascii_start();
    }
    String::from_utf8_lossy(rest).into_owned()
}

fn whole_number(word: &[u8]) -> Option<u64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

fn encoding_named(name: &[u8]) -> Option<Encoding> {
    match name {
        b"ascii" => Some(Encoding::Text),
        b"binary_little_endian" => Some(Encoding::LittleEndian),
        b"binary_big_endian" => Some(Encoding::BigEndian),
        _ => None,
    }
}

fn kind_named(name: &[u8]) -> Option<Kind> {
    Some(match name {
        b"char" | b"int8" => Kind::I8,
        b"uchar" | b"uint8" => Kind::U8,
        b"short" | b"int16" => Kind::I16,
        b"ushort" | b"uint16" => Kind::U16,
        b"int" | b"int32" => Kind::I32,
        b"uint" | b"uint32" => Kind::U32,
        b"int64" | b"long" => Kind::I64,
        b"uint64" | b"ulong" => Kind::U64,
        b"float" | b"float32" => Kind::F32,
        b"double" | b"float64" => Kind::F64,
        _ => return None,
    })
}
