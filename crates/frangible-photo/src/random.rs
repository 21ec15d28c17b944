//! Numbers that spread evenly over a pixel's paths.

use std::f32::consts::TAU;

use frangible_recording::glam::Vec3A;

/// Numbers of one path: its first pairs spread evenly over the paths of the pixel, the rest are as random as a hash.
pub(crate) struct Random {
    state: u32,
    /// Start of the pixel in each pair, and number of this path.
    pixel: u32,
    path: u32,
    pairs: u32,
}

/// Pairs that are spread; further on, paths have parted anyway.
const SPREAD_PAIRS: u32 = 6;

/// Steps of the two numbers of a pair from path to path: the powers of the plastic number's inverse, whose multiples fill the
/// unit square most evenly (Roberts 2018).
const STEPS: [f32; 2] = [0.754_877_7, 0.569_840_3];

impl Random {
    pub(crate) fn new(pixel: u32, path: u32) -> Self {
        Self {
            state: hash(pixel ^ hash(path.wrapping_add(0x9e37_79b9))),
            pixel: hash(pixel),
            path,
            pairs: 0,
        }
    }

    /// A number of 0..1.
    pub(crate) fn next(&mut self) -> f32 {
        self.state = hash(self.state.wrapping_add(0x9e37_79b9));
        unit(self.state)
    }

    /// Two numbers of 0..1.
    pub(crate) fn pair(&mut self) -> [f32; 2] {
        self.pairs += 1;
        if self.pairs > SPREAD_PAIRS {
            return [self.next(), self.next()];
        }
        let begin = hash(
            self.pixel
                .wrapping_add(self.pairs.wrapping_mul(0x85eb_ca6b)),
        );
        let begins = [unit(begin), unit(hash(begin))];
        std::array::from_fn(|k| (begins[k] + self.path as f32 * STEPS[k]).fract())
    }

    /// A direction around a normal, as likely as light from there counts on a matt face.
    pub(crate) fn matt(&mut self, normal: Vec3A) -> Vec3A {
        let [u, v] = self.pair();
        let radius = u.sqrt();
        let [across, along] = disc_axes(normal);
        let (sine, cosine) = (TAU * v).sin_cos();
        (across * (radius * cosine) + along * (radius * sine) + normal * (1.0 - u).sqrt())
            .normalize_or(normal)
    }

    /// A point of the unit disc.
    pub(crate) fn disc(&mut self) -> [f32; 2] {
        let [u, v] = self.pair();
        let (sine, cosine) = (TAU * v).sin_cos();
        [u.sqrt() * cosine, u.sqrt() * sine]
    }
}

/// Two unit vectors at right angles to a unit vector, and to each other.
pub(crate) fn disc_axes(normal: Vec3A) -> [Vec3A; 2] {
    let (across, along) = normal.any_orthonormal_pair();
    [across, along]
}

/// Mixes all bits (PCG, O'Neill 2014).
pub(crate) fn hash(number: u32) -> u32 {
    let state = number.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 / (1 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quarter_of_the_square_gets_its_share() {
        let mut counts = [0; 16];
        for path in 0..1600 {
            let [u, v] = Random::new(77, path).pair();
            assert!((0.0..1.0).contains(&u) && (0.0..1.0).contains(&v));
            counts[(4.0 * u) as usize * 4 + (4.0 * v) as usize] += 1;
        }
        // A random set of 1600 would scatter by 10 around 100.
        assert!(
            counts.iter().all(|&count| (92..=108).contains(&count)),
            "{counts:?}"
        );
    }

    #[test]
    fn matt_directions_have_the_mean_of_lamberts_law() {
        let normal = Vec3A::new(0.6, 0.0, 0.8);
        let mean = (0..4096)
            .map(|path| Random::new(5, path).matt(normal).dot(normal))
            .sum::<f32>()
            / 4096.0;
        assert!((mean - 2.0 / 3.0).abs() < 0.01, "{mean}");
    }
}
