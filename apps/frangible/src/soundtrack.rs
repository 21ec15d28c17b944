//! The sound of a film.
//!
//! It goes as fast as the picture, as a tape would: where the film is eight times slower the sound is three octaves deeper, which is what
//! slow motion has sounded like since there is any. Only at the break's own speed (`--slow 1`) is it what one hears.

use std::error::Error;

use frangible_photo::SlowMotion;
use frangible_scenes::{Run, Scene, Sounded, sound, sound_config};

/// Computes the sound of a film that lasts `seconds`.
pub(crate) fn soundtrack(
    run: &Run,
    scene: &Scene,
    film: &SlowMotion<'_>,
    seconds: f64,
) -> Result<Sounded, Box<dyn Error>> {
    let mut sounded = sound(run, scene, &sound_config(run, scene))?;
    let (rate, channels) = (sounded.config.rate, sounded.config.listener.channels);
    let frame_rate = f64::from(run.recording.frame_rate);
    let stands = film.stands_from();
    // While the last picture stands, ringing bodies ring on.
    let time = |at: f64| film.frame(at) / frame_rate + (at - stands).max(0.0);
    let count = (seconds * rate) as usize;
    let times: Vec<f64> = (0..=count).map(|i| time(i as f64 / rate) * rate).collect();
    let tracks: Vec<Vec<f32>> = (0..channels)
        .map(|channel| {
            let track = sounded.samples.iter().skip(channel).step_by(channels);
            let track: Vec<f32> = track.copied().collect();
            played(&track, &times)
        })
        .collect();
    sounded.samples = (0..count)
        .flat_map(|i| tracks.iter().map(move |track| track[i]))
        .collect();
    Ok(sounded)
}

/// Samples of a track as heard by a head that passes these places of it, in samples. Where the head is faster than the track it hears the mean over
/// its way, which removes frequencies too high for the film's sample rate; where it is slower, a linear interpolation between two samples; where it
/// stands, nothing.
fn played(track: &[f32], places: &[f64]) -> Vec<f32> {
    let mut sums = vec![0.0_f64];
    for &sample in track {
        sums.push(sums[sums.len() - 1] + f64::from(sample));
    }
    let until = |place: f64| {
        let place = place.clamp(0.0, track.len() as f64);
        let whole = (place as usize).min(track.len().saturating_sub(1));
        let sample = track.get(whole).copied().unwrap_or(0.0);
        sums[whole] + (place - whole as f64) * f64::from(sample)
    };
    let sample = |k: f64| match k {
        k if k < 0.0 => 0.0,
        k => track.get(k as usize).copied().unwrap_or(0.0),
    };
    let over = |way: &[f64]| {
        let long = way[1] - way[0];
        if long < 1e-6 {
            return 0.0;
        }
        if long < 0.999 {
            // A sample stands for the middle of its time.
            let at = 0.5 * (way[0] + way[1]) - 0.5;
            let (whole, share) = (at.floor(), (at - at.floor()) as f32);
            return sample(whole) * (1.0 - share) + sample(whole + 1.0) * share;
        }
        ((until(way[1]) - until(way[0])) / long) as f32
    };
    places.windows(2).map(over).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn half_the_speed_is_an_octave_deeper_and_as_loud() {
        let tone = |period: f64| move |i: usize| (TAU * i as f64 / period).sin() as f32;
        let track: Vec<f32> = (0..4000).map(tone(60.0)).collect();
        let places: Vec<f64> = (0..=4000).map(|i| 0.5 * f64::from(i)).collect();
        let wanted: Vec<f32> = (0..4000).map(tone(120.0)).collect();
        let found = played(&track, &places);
        let off = found
            .iter()
            .zip(&wanted)
            .skip(10)
            .map(|(a, b)| (a - b).abs());
        // A step of the slowed tone is 5 % of its size.
        assert!(off.fold(0.0, f32::max) < 0.06);
    }

    #[test]
    fn at_its_own_speed_it_is_the_track_and_where_it_stands_nothing() {
        let track = [0.1, -0.4, 0.8, 0.3];
        let found = played(&track, &[0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 5.0, 6.0]);
        let wanted = [0.1, -0.4, 0.8, 0.3, 0.0, 0.0, 0.0];
        let off = found.iter().zip(wanted).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f32::max) < 1e-6, "{found:?}");
        assert!(played(&[], &[0.0, 1.0]).iter().all(|&s| s == 0.0));
    }
}
