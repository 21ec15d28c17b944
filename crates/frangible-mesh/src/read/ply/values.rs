//! The numbers behind a PLY header, one after another.

use super::header::{Encoding, Kind, Property};
use crate::read::ReadError;
use crate::read::text::{number, shown};

/// Reads numbers from the front of the bytes left; every whole number up to 2⁵³ fits into f64.
pub(super) struct Values<'a> {
    encoding: Encoding,
    rest: &'a [u8],
}

impl<'a> Values<'a> {
    pub(super) fn new(encoding: Encoding, rest: &'a [u8]) -> Self {
        Self { encoding, rest }
    }

    /// The next number; `place` says which row it belongs to.
    pub(super) fn next(
        &mut self,
        kind: Kind,
        place: impl Fn() -> String,
    ) -> Result<f64, ReadError> {
        let value = match self.encoding {
            Encoding::Text => return self.next_word(place),
            Encoding::LittleEndian => self.next_binary(kind, false),
            Encoding::BigEndian => self.next_binary(kind, true),
        };
        value.ok_or_else(|| ReadError::truncated(place()))
    }

    /// The length of a list.
    pub(super) fn list_length(
        &mut self,
        kind: Kind,
        place: impl Fn() -> String,
    ) -> Result<u64, ReadError> {
        let length = self.next(kind, &place)?;
        if !(length >= 0.0 && length.fract() == 0.0) {
            return Err(ReadError::malformed(
                place(),
                format!("{length} is not the length of a list"),
            ));
        }
        // Each value takes a byte at least.
        if length > self.rest.len() as f64 {
            return Err(ReadError::truncated(place()));
        }
        Ok(length as u64)
    }

    pub(super) fn skip(
        &mut self,
        property: &Property,
        place: impl Fn() -> String,
    ) -> Result<(), ReadError> {
        let count = match property.count {
            Some(count) => self.list_length(count, &place)?,
            None => 1,
        };
        for _ in 0..count {
            self.next(property.value, &place)?;
        }
        Ok(())
    }

    fn next_word(&mut self, place: impl Fn() -> String) -> Result<f64, ReadError> {
        let rest = self.rest.trim_ascii_start();
        let end = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        if word.is_empty() {
            return Err(ReadError::truncated(place()));
        }
        number(word).ok_or_else(|| {
            ReadError::malformed(place(), format!("“{}” is not a number", shown(word)))
        })
    }

    fn next_binary(&mut self, kind: Kind, is_big: bool) -> Option<f64> {
        Some(match kind {
            Kind::I8 => f64::from(i8::from_le_bytes(self.bytes(is_big)?)),
            Kind::U8 => f64::from(u8::from_le_bytes(self.bytes(is_big)?)),
            Kind::I16 => f64::from(i16::from_le_bytes(self.bytes(is_big)?)),
            Kind::U16 => f64::from(u16::from_le_bytes(self.bytes(is_big)?)),
            Kind::I32 => f64::from(i32::from_le_bytes(self.bytes(is_big)?)),
            Kind::U32 => f64::from(u32::from_le_bytes(self.bytes(is_big)?)),
            Kind::I64 => i64::from_le_bytes(self.bytes(is_big)?) as f64,
            Kind::U64 => u64::from_le_bytes(self.bytes(is_big)?) as f64,
            Kind::F32 => f64::from(f32::from_le_bytes(self.bytes(is_big)?)),
            Kind::F64 => f64::from_le_bytes(self.bytes(is_big)?),
        })
    }

    /// The next bytes, least significant first.
    fn bytes<const N: usize>(&mut self, is_big: bool) -> Option<[u8; N]> {
        let (&bytes, rest) = self.rest.split_first_chunk::<N>()?;
        self.rest = rest;
        let mut bytes = bytes;
        if is_big {
            bytes.reverse();
        }
        Some(bytes)
    }
}
