//! The level of files and of live playback.

use std::f64::consts::TAU;

use frangible_sound::{Leveller, Loudness, SoundError, TARGET, by_loudness, wav};

const RATE: f64 = 48_000.0;

/// A tone of a duration, s, with the same samples in both channels.
fn tone(seconds: f64, frequency: f64, size: impl Fn(f64) -> f64) -> Vec<f32> {
    let sample = |i: usize| {
        let time = i as f64 / RATE;
        (size(time) * (TAU * frequency * time).sin()) as f32
    };
    (0..(seconds * RATE) as usize)
        .flat_map(|i| [sample(i); 2])
        .collect()
}

/// Noise from −1 to 1: splitmix64.
fn noise(i: usize) -> f64 {
    let x = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Times of landings after a crash at 0.5 s, s, and their peaks below it, dB.
const LANDINGS: [(f64, f64); 4] = [(0.8, 36.0), (0.95, 44.0), (1.4, 50.0), (2.2, 56.0)];

/// A crash of 100 Pa that is over in milliseconds, rings 20 dB softer, and is followed by landings.
fn crash() -> Vec<f32> {
    // Over after 15 times its fall, long before numbers of f32 become inexact.
    let burst = |since: f64, fall: f64| match since / fall {
        over if (0.0..15.0).contains(&over) => (-over).exp(),
        _ => 0.0,
    };
    let pressure = |i: usize| {
        let time = i as f64 / RATE;
        let mut size = burst(time - 0.5, 1e-3) + 0.1 * burst(time - 0.5, 0.1);
        for (landing, softer) in LANDINGS {
            size += 10.0_f64.powf(-softer / 20.0) * burst(time - landing, 0.03);
        }
        100.0 * size * noise(i)
    };
    (0..3 * 48_000)
        .flat_map(|i| [pressure(i) as f32, 0.7 * pressure(i + 7) as f32])
        .collect()
}

/// Level of 20 ms from a time on, dB over 1.
fn short_time(samples: &[f32], from: f64) -> f64 {
    let first = (from * RATE) as usize * 2;
    let part = &samples[first..first + 2 * 960];
    let power: f64 = part.iter().map(|&s| f64::from(s).powi(2)).sum();
    10.0 * (power / part.len() as f64).log10()
}

#[test]
fn tones_and_gates_are_measured_as_tech_3341_asks() {
    let level = |dbfs: f64| move |_: f64| 10.0_f64.powf(dbfs / 20.0);
    for dbfs in [-23.0, -33.0] {
        let found = Loudness::of(&tone(20.0, 1000.0, level(dbfs)), 2, RATE).expect("a measure");
        let integrated = found.integrated.expect("loud enough");
        assert!((integrated - dbfs).abs() < 0.1, "{integrated} of {dbfs}");
        let peak = found.true_peak.expect("a peak");
        assert!((peak - dbfs).abs() < 0.1, "{peak} of {dbfs}");
    }
    // Soft parts before and after do not count.
    let parts = tone(80.0, 1000.0, |time| {
        let soft = !(10.0..70.0).contains(&time);
        10.0_f64.powf(if soft { -36.0 } else { -23.0 } / 20.0)
    });
    let found = Loudness::of(&parts, 2, RATE).expect("a measure").integrated;
    assert!(
        (found.expect("loud enough") + 23.0).abs() < 0.1,
        "{found:?}"
    );
}

#[test]
fn a_crash_and_its_landings_are_heard_at_one_loudness() {
    let crash = crash();
    let levelled = by_loudness(&crash, 2, RATE, TARGET).expect("a level");
    let found = levelled.loudness;
    let integrated = found.integrated.expect("loud enough");
    assert!((integrated - TARGET).abs() < 0.5, "{integrated} LUFS");
    assert!(found.true_peak.expect("a peak") < -0.99, "{found:?}");
    assert!(levelled.samples.iter().all(|s| s.abs() <= 1.0));
    assert_eq!(levelled.samples.len(), crash.len());
    assert_eq!(levelled.leveller.peak, f64::from(loudest(&crash)));
    for (landing, softer) in LANDINGS {
        let below = |samples: &[f32]| short_time(samples, 0.5) - short_time(samples, landing);
        let (before, after) = (below(&crash), below(&levelled.samples));
        println!("{softer} dB: {before:.1} before, {after:.1} after");
        assert!((0.0..30.0).contains(&after), "{after} dB below the crash");
        assert!(after < before - 10.0);
    }
    // Before the crash there was nothing, and there still is.
    assert!(levelled.samples[..2 * 23_900].iter().all(|&s| s == 0.0));
}

fn loudest(samples: &[f32]) -> f32 {
    samples.iter().fold(0.0, |most: f32, s| most.max(s.abs()))
}

#[test]
fn the_same_sound_gives_the_same_samples_however_loud_it_was() {
    let crash = crash();
    let softer: Vec<f32> = crash.iter().map(|p| p / 4096.0).collect();
    let [first, again, soft] = [&crash, &crash, &softer].map(|sound| {
        by_loudness(sound, 2, RATE, TARGET)
            .expect("a level")
            .samples
    });
    let bits = |samples: &[f32]| -> Vec<u32> { samples.iter().map(|s| s.to_bits()).collect() };
    assert!(bits(&first) == bits(&again));
    assert!(bits(&first) == bits(&soft));
}

#[test]
fn silence_clicks_and_numbers_that_are_none_have_clear_outcomes() {
    for silence in [vec![], vec![0.0; 2], vec![0.0; 96_000]] {
        let levelled = by_loudness(&silence, 2, RATE, TARGET).expect("silence is a sound");
        assert_eq!(levelled.samples, silence);
        assert_eq!(levelled.full_scale, None);
        assert_eq!(levelled.loudness.integrated, None);
        assert_eq!(levelled.loudness.true_peak, None);
    }
    // One sample cannot be as loud as a sound of 400 ms, and is not more than limited.
    let click = by_loudness(&[50.0], 1, RATE, TARGET).expect("a level");
    assert!(click.samples[0] > 0.3 && click.samples[0] <= 0.9);
    let loudness = click.loudness.integrated;
    assert!(
        loudness.is_none_or(|loudness| loudness < TARGET),
        "{click:?}"
    );
    assert!(click.leveller.reduction > 20.0);
    let error = by_loudness(&[0.0, 1.0, f32::NAN, 0.0], 2, RATE, TARGET).expect_err("NaN");
    assert!(error.to_string().contains("sample 2 is NaN"), "{error}");
    let refused = [
        (by_loudness(&[0.0; 3], 2, RATE, TARGET), "multiple of 2"),
        (by_loudness(&[0.0; 3], 3, RATE, TARGET), "1 or 2"),
        (by_loudness(&[0.0; 2], 2, 44_100.5, TARGET), "whole"),
        (by_loudness(&[0.0; 2], 2, RATE, 3.0), "-40 to -10"),
    ];
    for (refused, part) in refused {
        let error: SoundError = refused.map(|_| ()).expect_err("refused");
        assert!(error.to_string().contains(part), "{error}");
    }
    for (rate, channels, full_scale, part) in [
        (10.0, 2, 10.0, "8000"),
        (RATE, 0, 10.0, "1 or 2"),
        (RATE, 2, 0.0, "full scale"),
    ] {
        let error = Leveller::new(rate, channels, full_scale).expect_err("refused");
        assert!(error.to_string().contains(part), "{error}");
    }
}

/// Levels pressures of two channels in parts of so many samples.
fn live(pressures: &[f32], part: usize) -> (Leveller, Vec<f32>) {
    let mut leveller = Leveller::new(RATE, 2, Leveller::LIVE).expect("a leveller");
    let mut samples = Vec::new();
    for part in pressures.chunks(part) {
        leveller.level(part, &mut samples).expect("whole frames");
    }
    (leveller, samples)
}

#[test]
fn a_live_leveller_gives_the_same_in_whatever_parts_it_comes() {
    let crash = crash();
    let (leveller, whole) = live(&crash, crash.len());
    assert_eq!(whole.len(), crash.len());
    for part in [2, 2 * 37, 2 * 800] {
        assert!(live(&crash, part).1 == whole, "in parts of {part}");
    }
    assert_eq!(leveller.delay(), 47);
    let first = |samples: &[f32]| samples.iter().position(|&s| s != 0.0).expect("sound") / 2;
    assert_eq!(first(&whole), first(&crash) + leveller.delay());
    assert!(whole.iter().all(|s| s.abs() < 0.71));
    // White noise, which is bent, has the highest peaks between its samples that there are.
    let peak = Loudness::of(&whole, 2, RATE).expect("a measure").true_peak;
    assert!(peak.expect("a peak") < 0.5, "{peak:?}");
    for (landing, _) in LANDINGS {
        let below = |samples: &[f32], late: f64| {
            short_time(samples, 0.5 + late) - short_time(samples, landing + late)
        };
        let (before, after) = (below(&crash, 0.0), below(&whole, 1e-3));
        println!("live: {before:.1} dB before, {after:.1} after");
        assert!(after > 0.0 && after < before - 10.0);
    }
}

#[test]
fn soft_sounds_are_raised_by_18_decibels_and_no_more() {
    for (softer, raised) in [
        (0.0, 0.0),
        (10.0, 2.0),
        (26.0, 10.0),
        (42.0, 18.0),
        (100.0, 18.0),
    ] {
        let size = Leveller::LIVE * 10.0_f64.powf(-softer / 20.0);
        let (leveller, samples) = live(&tone(1.0, 1000.0, |_| 0.3 * size), 96_000);
        let level = 20.0 * f64::from(loudest(&samples[48_000..])).log10();
        // The tone is 10.46 dB below its size, of which half is made up for from 6 dB on.
        let below = softer + 10.457;
        let wanted = -below + (0.5 * (below - 6.0)).clamp(0.0, 18.0);
        let bent = if softer == 0.0 { 1.0 } else { 0.1 };
        assert!(
            (level - wanted).abs() < bent,
            "{softer}: {level} of {wanted} dB"
        );
        assert!(leveller.report().raised > raised - 0.1);
    }
}

#[test]
fn a_decay_is_slowed_by_no_more_than_ten_decibels_a_second() {
    for fall in [15.0, 30.0, 90.0] {
        let ring = tone(1.0, 2000.0, |time| 0.4 * 10.0_f64.powf(-fall * time / 20.0));
        let (_, samples) = live(&ring, 96_000);
        let heard = (short_time(&samples, 0.1) - short_time(&samples, 0.5)) / 0.4;
        let least = (fall - 10.0_f64).max(0.5 * fall);
        assert!((heard - least).abs() < 1.0, "{fall} became {heard} dB/s");
    }
}

#[test]
fn both_channels_have_one_gain_and_a_peak_is_not_seen_too_late() {
    // A soft tone, and a burst of 60 dB more in the left channel alone.
    let pressures: Vec<f32> = (0..48_000)
        .flat_map(|i| {
            let soft = 0.05 * noise(i / 8);
            let burst = if (24_000..24_100).contains(&i) {
                300.0
            } else {
                0.0
            };
            [(soft + burst * noise(i)) as f32, soft as f32]
        })
        .collect();
    let (leveller, samples) = live(&pressures, 512);
    let late = 2 * leveller.delay();
    assert!(samples.iter().all(|s| s.abs() < 0.71));
    for (out, heard) in samples[late..]
        .chunks_exact(2)
        .zip(pressures.chunks_exact(2))
    {
        if heard[0] == heard[1] {
            assert_eq!(out[0], out[1]);
        }
    }
    assert!(
        leveller.report().reduction > 28.0,
        "{:?}",
        leveller.report()
    );
    // No numbers and the largest numbers give no nonsense.
    let (_, wild) = live(&[f32::NAN, f32::MAX, f32::INFINITY, -f32::MAX, 0.0, 1.0], 2);
    assert!(wild.iter().all(|s| s.abs() < 0.71));
    let mut leveller = leveller;
    let error = leveller
        .level(&[1.0; 3], &mut Vec::new())
        .expect_err("half a frame");
    assert!(error.to_string().contains("multiple of 2"), "{error}");
}

#[test]
fn what_follows_a_click_is_raised_within_two_seconds() {
    // A click 40 dB above full scale, and a soft tone.
    let mut pressures = tone(2.0, 1000.0, |_| 0.01 * Leveller::LIVE);
    pressures[0] = 100.0 * Leveller::LIVE as f32;
    let (_, samples) = live(&pressures, 512);
    let gain = |from: f64| short_time(&samples, from) - short_time(&pressures, from);
    let full = 20.0 * Leveller::LIVE.log10();
    let [soon, later, at_last] = [0.1, 0.6, 1.9].map(|from| gain(from) + full);
    println!("{soon:.1}, {later:.1}, {at_last:.1} dB");
    assert!(soon < 1.0 && (2.0..4.0).contains(&later) && at_last > 15.0);
}

#[test]
fn a_few_thuds_reach_the_loudness() {
    // Four thuds of 300 Hz that are over in 30 ms each, within four seconds.
    let thuds = tone(4.0, 300.0, |time| (-(time % 1.0) / 6e-3).exp());
    let levelled = by_loudness(&thuds, 2, RATE, TARGET).expect("a level");
    let loudness = levelled.loudness.integrated.expect("loud enough");
    assert!((loudness - TARGET).abs() < 0.5, "{loudness} LUFS");
    assert!(levelled.loudness.true_peak.expect("a peak") < -0.99);
}

#[test]
fn a_true_level_is_the_pressures_over_the_loudest() {
    let crash = crash();
    let peak = loudest(&crash);
    let bytes = wav(&crash, 2, RATE, f64::from(peak)).expect("a file");
    let samples = bytes[44..].as_chunks::<2>().0;
    assert_eq!(samples.len(), crash.len());
    for (sample, pressure) in samples.iter().zip(&crash) {
        let share = f64::from(*pressure) / f64::from(peak);
        let wanted = (f64::from(i16::MAX) * share).round() as i16;
        assert_eq!(i16::from_le_bytes(*sample), wanted);
    }
}
