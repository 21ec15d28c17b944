//! Rows of numbers as bytes, little-endian whatever the machine.

use glam::Vec3;

use crate::asset::half::Half;

/// Kind of a section's numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(u16)]
pub(super) enum Kind {
    /// UTF-8, one byte per row.
    Text = 1,
    /// Unsigned, 4 bytes.
    U32 = 2,
    /// IEEE 754 single precision.
    F32 = 3,
    /// IEEE 754 double precision.
    F64 = 4,
    /// IEEE 754 half precision.
    F16 = 5,
}

impl Kind {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::U32 => "u32",
            Self::F32 => "f32",
            Self::F64 => "f64",
            Self::F16 => "f16",
        }
    }

    pub(super) fn of(code: u16) -> Option<Self> {
        [Self::Text, Self::U32, Self::F32, Self::F64, Self::F16]
            .into_iter()
            .find(|&kind| kind as u16 == code)
    }
}

/// One row of a section: so many numbers of one kind.
pub(super) trait Row: Copy {
    /// Kind of the numbers.
    const KIND: Kind;
    /// Numbers per row.
    const COLUMNS: usize;
    /// Bytes of a row.
    const SIZE: usize;
    /// The row in the first `SIZE` of the bytes; zeros where they are too few.
    fn get(bytes: &[u8]) -> Self;
    /// Writes the row to the first `SIZE` of the bytes; nothing where they are too few.
    fn put(self, bytes: &mut [u8]);
}

macro_rules! number {
    ($number:ty, $kind:expr) => {
        impl Row for $number {
            const KIND: Kind = $kind;
            const COLUMNS: usize = 1;
            const SIZE: usize = size_of::<$number>();

            #[inline]
            fn get(bytes: &[u8]) -> Self {
                bytes
                    .first_chunk()
                    .map_or(Self::default(), |b| Self::from_le_bytes(*b))
            }

            #[inline]
            fn put(self, bytes: &mut [u8]) {
                if let Some(b) = bytes.first_chunk_mut() {
                    *b = self.to_le_bytes();
                }
            }
        }
    };
}

number!(u8, Kind::Text);
number!(u32, Kind::U32);
number!(f32, Kind::F32);
number!(f64, Kind::F64);

impl Row for Half {
    const KIND: Kind = Kind::F16;
    const COLUMNS: usize = 1;
    const SIZE: usize = 2;

    #[inline]
    fn get(bytes: &[u8]) -> Self {
        let bits = bytes.first_chunk();
        Self(bits.map_or(0, |b| u16::from_le_bytes(*b)))
    }

    #[inline]
    fn put(self, bytes: &mut [u8]) {
        if let Some(b) = bytes.first_chunk_mut() {
            *b = self.0.to_le_bytes();
        }
    }
}

impl<T: Row, const N: usize> Row for [T; N] {
    const KIND: Kind = T::KIND;
    const COLUMNS: usize = N * T::COLUMNS;
    const SIZE: usize = N * T::SIZE;

    #[inline]
    fn get(bytes: &[u8]) -> Self {
        std::array::from_fn(|i| T::get(bytes.get(i * T::SIZE..).unwrap_or_default()))
    }

    #[inline]
    fn put(self, bytes: &mut [u8]) {
        for (value, place) in self.into_iter().zip(bytes.chunks_exact_mut(T::SIZE)) {
            value.put(place);
        }
    }
}

impl Row for Vec3 {
    const KIND: Kind = Kind::F32;
    const COLUMNS: usize = 3;
    const SIZE: usize = 12;

    #[inline]
    fn get(bytes: &[u8]) -> Self {
        Self::from_array(Row::get(bytes))
    }

    #[inline]
    fn put(self, bytes: &mut [u8]) {
        self.to_array().put(bytes);
    }
}
