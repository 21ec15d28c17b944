//! Half precision (IEEE 754 binary16) for mode shapes.

use super::Asset;
use crate::asset::StressBounds;
use crate::modal::ModalBasis;

/// A number of half precision, by its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Half(pub(super) u16);

impl Half {
    /// The nearest, ties to even; beyond 65 504 infinity.
    pub(super) fn of(x: f32) -> Self {
        let sign = (x.to_bits() >> 16) as u16 & 0x8000;
        let magnitude = x.to_bits() & 0x7fff_ffff;
        let bits = if magnitude > 0x7f80_0000 {
            0x7e00
        } else if magnitude >= 0x477f_f000 {
            0x7c00
        } else if magnitude < 0x3880_0000 {
            // Below 2⁻¹⁴: multiples of 2⁻²⁴. The product is exact, and at most 1024.
            (f32::from_bits(magnitude) * 16_777_216.0).round_ties_even() as u16
        } else {
            // Thirteen bits fewer in the mantissa, 112 less in the exponent; a carry runs on into the exponent.
            let rounded = magnitude + 0xfff + (magnitude >> 13 & 1);
            ((rounded - 0x3800_0000) >> 13) as u16
        };
        Self(sign | bits)
    }

    /// Its value, exactly.
    pub(super) fn value(self) -> f32 {
        let (exponent, mantissa) = (u32::from(self.0 >> 10 & 31), u32::from(self.0 & 0x3ff));
        let magnitude = match exponent {
            0 => mantissa as f32 / 16_777_216.0,
            31 => f32::from_bits(0x7f80_0000 | mantissa << 13),
            _ => f32::from_bits((exponent + 112) << 23 | mantissa << 13),
        };
        if self.0 >> 15 == 1 {
            -magnitude
        } else {
            magnitude
        }
    }
}

/// Divisor of each mode's column: the power of two that takes its largest number to 2¹⁴ … 2¹⁵. So numbers down to
/// 2⁻²⁸ of the largest keep all eleven bits, dividing rounds nothing, and rounding twice is rounding once.
pub(super) fn half_scales(modes: &ModalBasis) -> Vec<f32> {
    let count = modes.count();
    let mut largest = vec![0.0_f32; count];
    for row in modes.shapes.chunks(count.max(1)) {
        for (l, x) in largest.iter_mut().zip(row) {
            *l = l.max(x.abs());
        }
    }
    let scale = |l: f32| {
        // Within the normal numbers of f32, whatever the largest is.
        let exponent = libm::log2(f64::from(l)).ceil().clamp(-100.0, 127.0) - 15.0;
        libm::exp2(exponent) as f32
    };
    largest.into_iter().map(scale).collect()
}

impl Asset {
    /// Returns the asset with mode shapes rounded to half precision, as read back from a compact file: a relative spacing of 1/2048,
    /// so a relative error of at most 1/4096. Stress bounds are removed, and peak stresses are not updated; call
    /// [`Asset::restressed`] to recompute them.
    #[doc(hidden)]
    #[must_use]
    pub fn with_compact_shapes(mut self) -> Self {
        self.bounds = StressBounds::default();
        let scales = half_scales(&self.modes);
        for row in self.modes.shapes.chunks_mut(scales.len().max(1)) {
            for (x, scale) in row.iter_mut().zip(&scales) {
                *x = Half::of(*x / scale).value() * scale;
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::Half;

    /// From the definition, in f64.
    fn by_definition(bits: u16) -> f64 {
        let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
        let (exponent, mantissa) = (i32::from(bits >> 10 & 31), f64::from(bits & 0x3ff));
        match exponent {
            0 => sign * mantissa * 2_f64.powi(-24),
            31 if mantissa == 0.0 => sign * f64::INFINITY,
            31 => f64::NAN,
            _ => sign * (1.0 + mantissa / 1024.0) * 2_f64.powi(exponent - 15),
        }
    }

    #[test]
    fn all_numbers_have_their_value_and_come_back() {
        for bits in 0..=u16::MAX {
            let value = Half(bits).value();
            if by_definition(bits).is_nan() {
                assert!(value.is_nan() && Half::of(value).value().is_nan());
            } else {
                let expected = by_definition(bits) as f32;
                assert_eq!(value.to_bits(), expected.to_bits(), "{bits:#x}");
                assert_eq!(Half::of(value).0, bits);
            }
        }
    }

    #[test]
    fn numbers_between_go_to_the_nearest_and_ties_to_even() {
        // Infinity is the neighbour above 65 504 and lies at 65 536 for rounding.
        for bits in 0..0x7c00_u16 {
            let low = f64::from(Half(bits).value());
            let high = if bits == 0x7bff {
                65536.0
            } else {
                f64::from(Half(bits + 1).value())
            };
            let middle = ((low + high) / 2.0) as f32;
            let even = bits + (bits & 1);
            assert_eq!(Half::of(middle).0, even, "{bits:#x}");
            assert_eq!(Half::of(middle.next_down()).0, bits);
            assert_eq!(Half::of(middle.next_up()).0, bits + 1);
            assert_eq!(Half::of(-middle).0, even | 0x8000);
        }
    }
}
