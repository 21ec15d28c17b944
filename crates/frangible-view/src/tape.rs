//! Resamples the sound between a session and a loudspeaker: a tape that runs as fast as the scene.

/// Channels: left and right.
const CHANNELS: usize = 2;

/// Plays the sound of simulated time as fast as the scene runs: the slower, the deeper.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tape {
    /// The last sample that was read of each channel, and where the head is after it, in samples, 0 to 1.
    last: [f32; CHANNELS],
    head: f64,
}

impl Tape {
    /// Reads `heard`, left and right in turn, with steps of so many samples, and adds what it reads to `out`: the line between two
    /// samples where the steps are short, the mean over the way where they are long, which keeps out what is too high for the loudspeaker.
    pub(crate) fn read(&mut self, heard: &[f32], step: f64, out: &mut Vec<f32>) {
        let (mut sum, mut count) = ([0.0; CHANNELS], 0.0_f32);
        for frame in heard.as_chunks::<CHANNELS>().0 {
            while self.head < 1.0 {
                let share = self.head as f32;
                for channel in 0..CHANNELS {
                    let line = self.last[channel] * (1.0 - share) + frame[channel] * share;
                    let mean = (sum[channel] + line) / (count + 1.0);
                    out.push(mean);
                }
                (sum, count) = ([0.0; CHANNELS], 0.0);
                self.head += step;
            }
            self.head -= 1.0;
            for (sum, sample) in sum.iter_mut().zip(frame) {
                *sum += sample;
            }
            self.last = *frame;
            count += 1.0;
            if self.head < 1.0 {
                // The next sample to come out is on the line from here.
                (sum, count) = ([0.0; CHANNELS], 0.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn tone(period: f64, count: usize) -> Vec<f32> {
        let sample = |i: usize| (TAU * i as f64 / period).sin() as f32;
        (0..count).flat_map(|i| [sample(i), -sample(i)]).collect()
    }

    #[test]
    fn a_tape_at_half_the_speed_is_an_octave_deeper_in_whatever_parts_it_comes() {
        let track = tone(60.0, 3000);
        let (mut tape, mut slow) = (Tape::default(), Vec::new());
        for part in track.chunks(2 * 37) {
            tape.read(part, 0.5, &mut slow);
        }
        let (mut whole, mut at_once) = (Tape::default(), Vec::new());
        whole.read(&track, 0.5, &mut at_once);
        assert_eq!(slow, at_once);
        assert_eq!(slow.len(), 2 * track.len());
        // The first sample comes before the first of the track.
        let wanted = tone(120.0, 6000);
        let off = slow[4..].iter().zip(&wanted).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f32::max) < 0.06);
    }

    #[test]
    fn a_tape_at_its_own_speed_is_the_track_and_a_faster_one_is_shorter() {
        let track = tone(60.0, 3000);
        let (mut same, mut fast) = (Vec::new(), Vec::new());
        Tape::default().read(&track, 1.0, &mut same);
        assert_eq!(same[2..], track[..track.len() - 2]);
        Tape::default().read(&track, 4.0, &mut fast);
        assert_eq!(fast.len(), track.len() / 4);
    }
}
