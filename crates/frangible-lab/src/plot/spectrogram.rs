//! Sound over time and frequency.

use image::{Rgb, RgbImage};

use super::canvas::{Canvas, Colour, text_width};
use super::fourier::transform;
use super::ticks::{label, linear};

/// Levels of the tones of a sound.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Distance of two frequencies, Hz.
    pub step: f64,
    /// Amplitude of each, from 0 on, in the unit of the samples.
    pub amplitudes: Vec<f32>,
}

/// A picture of the level of a sound over time and frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrogram<'a> {
    /// Heading.
    pub title: String,
    /// Samples of one channel.
    pub samples: &'a [f32],
    /// Samples per second.
    pub rate: f64,
    /// Highest frequency drawn, Hz.
    pub highest: f64,
    /// Times that are marked above, s.
    pub marks: Vec<f64>,
}

const INK: Colour = [40, 40, 40];
const MARK: Colour = [213, 94, 0];
/// Space around the plot, pixels: left, right, top, bottom.
const MARGINS: [u32; 4] = [74, 18, 44, 58];
/// Samples of a window.
const WINDOW: usize = 1024;
/// Range of levels that are drawn, dB below the loudest.
const RANGE: f32 = 90.0;
const LETTERS: [f64; 3] = [14.0, 12.0, 11.0];

impl Spectrum {
    /// The spectrum of samples under Hann's window, as long as the next power of two at least.
    #[must_use]
    pub fn of(samples: &[f32], rate: f64) -> Self {
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
    #[must_use]
    pub fn peak(&self, low: f64, high: f64) -> Option<(f64, f64)> {
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
}

impl Spectrogram<'_> {
    /// Draws it.
    #[must_use]
    pub fn draw(&self, width: u32, height: u32) -> RgbImage {
        let (width, height) = (width.max(320), height.max(240));
        let [left, right, top, bottom] = MARGINS;
        let (wide, high) = (width - left - right, height - top - bottom);
        let mut canvas = Canvas::new(width, height);
        let levels = self.levels(wide, high);
        let loudest = levels.iter().copied().fold(f32::MIN, f32::max);
        for (i, &level) in levels.iter().enumerate() {
            let (x, y) = (i as u32 / high, i as u32 % high);
            let share = ((level - loudest) / RANGE + 1.0).clamp(0.0, 1.0);
            canvas
                .0
                .put_pixel(left + x, top + high - 1 - y, Rgb(colour(share)));
        }
        self.draw_axes(&mut canvas, [left, top, wide, high].map(f64::from));
        canvas.0
    }

    /// Levels, dB, column after column from below.
    fn levels(&self, wide: u32, high: u32) -> Vec<f32> {
        let mut levels = Vec::with_capacity((wide * high) as usize);
        let mut buffer = vec![[0.0_f32; 2]; WINDOW];
        for x in 0..wide {
            let middle = self.samples.len() as f64 * (f64::from(x) + 0.5) / f64::from(wide);
            for (k, into) in buffer.iter_mut().enumerate() {
                let at = middle as i64 + k as i64 - WINDOW as i64 / 2;
                let sample = usize::try_from(at).ok().and_then(|at| self.samples.get(at));
                let angle = std::f32::consts::TAU * (k as f32 + 0.5) / WINDOW as f32;
                let window = 0.5 - 0.5 * angle.cos();
                *into = [window * sample.copied().unwrap_or(0.0), 0.0];
            }
            transform(&mut buffer);
            for y in 0..high {
                let frequency = self.highest * (f64::from(y) + 0.5) / f64::from(high);
                let bin = (frequency / self.rate * WINDOW as f64) as usize;
                let [re, im] = buffer[bin.min(WINDOW / 2)];
                let power = re * re + im * im;
                levels.push(10.0 * power.max(1e-20).log10());
            }
        }
        levels
    }

    fn draw_axes(&self, canvas: &mut Canvas, [left, top, wide, high]: [f64; 4]) {
        let [title, letters, digits] = LETTERS;
        let long = self.samples.len() as f64 / self.rate;
        let (right, base) = (left + wide, top + high);
        let across = |time: f64| left + wide * time / long.max(1e-9);
        for tick in linear(0.0, long)
            .1
            .labelled
            .into_iter()
            .filter(|&t| t <= long)
        {
            let text = label(tick);
            canvas.line([across(tick), base], [across(tick), base + 5.0], 1.2, INK);
            let start = across(tick) - 0.5 * text_width(&text, digits);
            canvas.text([start, base + 10.0 + digits], &text, digits, false, INK);
        }
        for tick in linear(0.0, self.highest).1.labelled {
            if tick > self.highest {
                continue;
            }
            let at = base - high * tick / self.highest;
            let text = label(tick / 1000.0);
            canvas.line([left - 5.0, at], [left, at], 1.2, INK);
            let start = left - 9.0 - text_width(&text, digits);
            canvas.text([start, at + 0.5 * digits], &text, digits, false, INK);
        }
        for &mark in self.marks.iter().filter(|&&m| (0.0..=long).contains(&m)) {
            canvas.line(
                [across(mark), top - 9.0],
                [across(mark), top - 1.0],
                1.2,
                MARK,
            );
        }
        for ends in [
            [left, top],
            [right, top],
            [right, base],
            [left, base],
            [left, top],
        ]
        .windows(2)
        {
            canvas.line(ends[0], ends[1], 1.0, INK);
        }
        let middle = |text: &str, height: f64| left + 0.5 * (wide - text_width(text, height));
        let heading = [middle(&self.title, title), top - 18.0];
        canvas.text(heading, &self.title, title, false, INK);
        let below = "time, s";
        canvas.text(
            [middle(below, letters), base + 44.0],
            below,
            letters,
            false,
            INK,
        );
        let beside = "frequency, kHz";
        let at = [22.0, top + 0.5 * (high + text_width(beside, letters))];
        canvas.text(at, beside, letters, true, INK);
    }
}

/// Colour of a level, from white by yellow and red to black: the louder the darker.
fn colour(share: f32) -> Colour {
    const STOPS: [[f32; 3]; 5] = [
        [255.0, 255.0, 255.0],
        [253.0, 226.0, 150.0],
        [232.0, 120.0, 60.0],
        [130.0, 30.0, 90.0],
        [15.0, 5.0, 30.0],
    ];
    let place = share * (STOPS.len() - 1) as f32;
    let first = (place as usize).min(STOPS.len() - 2);
    let rest = place - first as f32;
    std::array::from_fn(|i| {
        let (a, b) = (STOPS[first][i], STOPS[first + 1][i]);
        (a + rest * (b - a)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::{Spectrogram, Spectrum};

    #[test]
    fn a_tone_is_found_with_its_frequency_and_amplitude() {
        let rate = 48_000.0;
        let tone = |f: f64, k: usize| (std::f64::consts::TAU * f * k as f64 / rate).sin();
        let samples: Vec<f32> = (0..30_000)
            .map(|k| (0.5 * tone(1234.5, k) + 0.1 * tone(5000.0, k)) as f32)
            .collect();
        let spectrum = Spectrum::of(&samples, rate);
        for (low, high, frequency, amplitude) in [
            (100.0, 20_000.0, 1234.5, 0.5),
            (4000.0, 6000.0, 5000.0, 0.1),
        ] {
            let (f, a) = spectrum.peak(low, high).expect("a peak");
            assert!((f - frequency).abs() < 0.1, "{f}");
            // Between two bins a tone reads up to a sixteenth too low.
            assert!((a / amplitude - 1.0).abs() < 0.0625, "{a}");
        }
        assert_eq!(spectrum.peak(5.0, 1.0), None);
    }

    #[test]
    fn a_picture_is_drawn_of_anything() {
        for samples in [Vec::new(), vec![0.0; 3], vec![1.0; 9000]] {
            let picture = Spectrogram {
                title: "nothing".into(),
                samples: &samples,
                rate: 48_000.0,
                highest: 16_000.0,
                marks: vec![0.01, f64::NAN],
            };
            assert_eq!(picture.draw(10, 10).dimensions(), (320, 240));
        }
    }
}
