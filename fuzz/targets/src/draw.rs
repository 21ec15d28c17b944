//! Numbers and fracture configurations drawn from the fuzzer's bytes.
//!
//! The first byte decides: either every number is plausible, or some are arbitrary bits. After the last byte everything is drawn from zeros, which
//! stand for the plainest choice.

use frangible::FractureConfig;
use frangible::glam::Vec3;
use frangible::internals::DurationModel;
use frangible::internals::near_field::PlateTheory;

/// Bytes of an input, read one after the other.
pub(crate) struct Draw<'a> {
    bytes: std::slice::Iter<'a, u8>,
    /// If true, some numbers are arbitrary bits.
    odd: bool,
}

/// Numbers that arithmetic goes wrong with.
const ODD: [f64; 15] = [
    0.0,
    -0.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN_POSITIVE,
    5e-324,
    1e-45,
    3.4e38,
    -3.4e38,
    1.2e-38,
    1e18,
    1e-18,
];

impl<'a> Draw<'a> {
    /// Begins to read.
    pub(crate) fn new(data: &'a [u8]) -> Self {
        let mut draw = Self {
            bytes: data.iter(),
            odd: false,
        };
        draw.odd = draw.flag();
        draw
    }

    /// Returns true if all bytes were read.
    pub(crate) fn is_over(&self) -> bool {
        self.bytes.as_slice().is_empty()
    }

    /// The next byte.
    pub(crate) fn byte(&mut self) -> u8 {
        self.bytes.next().copied().unwrap_or(0)
    }

    /// Returns true if the next byte is odd.
    pub(crate) fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// A number below this one, which is 256 at most.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        usize::from(self.byte()) % end
    }

    /// Eight bytes.
    pub(crate) fn bits(&mut self) -> u64 {
        u64::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    /// A number from 0 to 1.
    fn share(&mut self) -> f64 {
        f64::from(u16::from_le_bytes([self.byte(), self.byte()])) / 65535.0
    }

    /// A number that may be any, or none where a plausible one is wanted.
    fn any(&mut self) -> Option<f64> {
        if !self.odd {
            return None;
        }
        match self.byte() {
            250..=252 => Some(ODD[self.below(ODD.len())]),
            253 | 254 => Some(f64::from_bits(self.bits())),
            255 => Some(f64::from(f32::from_bits(self.bits() as u32))),
            _ => None,
        }
    }

    /// Between these, which are above zero: every order of magnitude is as likely. Or any number.
    pub(crate) fn size(&mut self, least: f64, most: f64) -> f64 {
        match self.any() {
            Some(any) => any,
            None => least * (most / least).powf(self.share()),
        }
    }

    /// Between these. Or any number.
    pub(crate) fn between(&mut self, least: f64, most: f64) -> f64 {
        match self.any() {
            Some(any) => any,
            None => least + (most - least) * self.share(),
        }
    }

    /// A vector whose components are at most so large. Or any.
    pub(crate) fn vector(&mut self, most: f64) -> Vec3 {
        Vec3::from_array(std::array::from_fn(|_| self.between(-most, most) as f32))
    }

    /// A vector of any direction, and of length 1 unless it is odd.
    pub(crate) fn direction(&mut self) -> Vec3 {
        let v = self.vector(1.0);
        match v.try_normalize() {
            Some(unit) if !self.odd => unit,
            None if !self.odd => Vec3::NEG_Z,
            _ => v,
        }
    }

    /// Switches and numbers of the fracture, about one of the presets. Numbers that only make an impact take longer stay in a range in
    /// which it takes less than seconds.
    pub(crate) fn fracture(&mut self) -> FractureConfig {
        let preset = match self.below(3) {
            0 => FractureConfig::default(),
            1 => FractureConfig::with_given_impulses(),
            _ => FractureConfig::as_in_the_paper(),
        };
        let mut config = preset;
        if self.flag() {
            return config;
        }
        config.duration = match self.below(4) {
            0 => DurationModel::Integrated,
            1 => DurationModel::Hertz,
            2 => DurationModel::ModalHertz,
            _ => DurationModel::AsPrinted {
                c: self.size(1e-3, 10.0),
            },
        };
        config.near_field = match self.below(3) {
            0 => Some(PlateTheory::Layer),
            1 => Some(PlateTheory::Kirchhoff),
            _ => None,
        };
        config.samples_per_period = match self.between(0.5, 32.0) {
            long if long > 64.0 && long <= 1000.0 => 64.0,
            samples => samples,
        };
        config.crumb_share = self.between(0.0, 0.01);
        for switch in [
            &mut config.admissible_duration,
            &mut config.residual,
            &mut config.culling,
            &mut config.sized_flaws,
        ] {
            *switch ^= self.flag();
        }
        config
    }
}
