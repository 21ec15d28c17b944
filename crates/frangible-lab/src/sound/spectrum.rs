//! Tones of a sound, by the Fourier transform of Cooley and Tukey.

use std::f64::consts::TAU;

/// Levels of the tones of a sound.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spectrum {
    /// Distance of two frequencies, Hz.
    step: f64,
    /// Amplitude of each, from 0 on, in the unit of the samples.
    amplitudes: Vec<f32>,
}

impl Spectrum {
    /// The spectrum of samples under Hann's window, as long as the next power of two at least.
    pub(super) fn of(samples: &[f32], rate: f64) -> Self {
        let long = samples.len().next_power_of_two().max(2);
        let n = samples.len().max(1) as f32;
        let window = |k: usize| 0.5 - 0.5 * (std::f32::consts::TAU * (k as f32 + 0.5) / n).cos();
        let mut buffer = vec![[0.0_f32; 2]; long];
        for (k, (into, sample)) in buffer.iter_mut().zip(samples).enumerate() {
            into[0] = sample * window(k);
        }
        transform(&mut buffer);
        Self {
            step: rate / long as f64,
            // The window's mean is one half.
            amplitudes: buffer[..long / 2]
                .iter()
                .map(|[re, im]| re.hypot(*im) * 4.0 / n)
                .collect(),
        }
    }

    /// The tone of the greatest amplitude between two frequencies, Hz, by a parabola through its logarithms; and its amplitude.
    pub(super) fn peak(&self, low: f64, high: f64) -> Option<(f64, f64)> {
        let first = (low / self.step).ceil().max(1.0) as usize;
        let last = ((high / self.step) as usize).min(self.amplitudes.len().saturating_sub(2));
        let at =
            (first..=last).max_by(|&a, &b| self.amplitudes[a].total_cmp(&self.amplitudes[b]))?;
        let [a, b, c] = [at - 1, at, at + 1].map(|k| f64::from(self.amplitudes[k]).max(1e-30).ln());
        let bend = a - 2.0 * b + c;
        let shift = if bend < 0.0 {
            0.5 * (a - c) / bend
        } else {
            0.0
        };
        Some(((at as f64 + shift) * self.step, b.exp()))
    }

    /// Mean of the frequencies, Hz, weighted by their power.
    pub(super) fn centroid(&self) -> f64 {
        let (mut sum, mut all) = (0.0, 0.0);
        for (k, &amplitude) in self.amplitudes.iter().enumerate() {
            let power = f64::from(amplitude).powi(2);
            sum += power * k as f64 * self.step;
            all += power;
        }
        sum / all.max(1e-30)
    }

    /// Level of the strongest tone over the middle one of those from 1 to 16 kHz, dB.
    pub(super) fn tonal(&self) -> f64 {
        let at = |frequency: f64| ((frequency / self.step) as usize).min(self.amplitudes.len());
        let mut heard = self.amplitudes[at(1e3)..at(1.6e4)].to_vec();
        heard.sort_by(f32::total_cmp);
        let (middle, most) = (heard.get(heard.len() / 2), heard.last());
        let ratio = middle
            .zip(most)
            .map_or(1.0, |(middle, most)| most / middle.max(1e-30));
        20.0 * f64::from(ratio).log10()
    }
}

/// Transforms complex numbers (real, imaginary) in place: Σ x_k e^{−2πi jk/n}. Their number is a power of two.
fn transform(values: &mut [[f32; 2]]) {
    let n = values.len();
    if n < 2 {
        return;
    }
    let bits = n.trailing_zeros();
    for i in 0..n {
        let j = i.reverse_bits() >> (usize::BITS - bits);
        if i < j {
            values.swap(i, j);
        }
    }
    let mut half = 1;
    while half < n {
        let turns: Vec<[f32; 2]> = (0..half)
            .map(|k| {
                let (sin, cos) = (0.5 * TAU * k as f64 / half as f64).sin_cos();
                [cos as f32, -sin as f32]
            })
            .collect();
        for block in values.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for ((a, b), [c, s]) in low.iter_mut().zip(high).zip(&turns) {
                let turned = [b[0] * c - b[1] * s, b[0] * s + b[1] * c];
                *b = [a[0] - turned[0], a[1] - turned[1]];
                *a = [a[0] + turned[0], a[1] + turned[1]];
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::transform;

    #[test]
    fn it_is_the_sum_that_defines_it() {
        let values: Vec<[f32; 2]> = (0..16)
            .map(|k| [((k * 7) % 5) as f32, (k % 3) as f32])
            .collect();
        let mut fast = values.clone();
        transform(&mut fast);
        for (j, found) in fast.iter().enumerate() {
            let mut sum = [0.0_f32; 2];
            for (k, [re, im]) in values.iter().enumerate() {
                let angle = -std::f32::consts::TAU * (j * k) as f32 / 16.0;
                let (s, c) = angle.sin_cos();
                sum = [sum[0] + re * c - im * s, sum[1] + re * s + im * c];
            }
            assert!((sum[0] - found[0]).abs() < 1e-3 && (sum[1] - found[1]).abs() < 1e-3);
        }
    }
}
