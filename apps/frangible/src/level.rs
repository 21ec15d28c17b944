//! The level of a WAV file or of a film's sound.

use std::fmt::Write;

use frangible_scenes::Sounded;
use frangible_sound::{Level, SoundError, TARGET, wav};
use serde::Serialize;

/// Level of a sound file, for the report. All in dB, but for the loudness, LUFS.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct SoundReport {
    /// `loudness` or `true`.
    level: &'static str,
    /// Integrated loudness of the file by EBU R 128; `None` for silence.
    loudness_lufs: Option<f64>,
    true_peak_db: Option<f64>,
    /// Sound pressure level, dB over 20 µPa, of the loudest pressure, and of the pressure that is full scale; `None` for silence.
    loudest_db: Option<f64>,
    full_scale_db: Option<f64>,
    /// Largest reduction by the limiter, and largest gain of soft sounds.
    reduced_db: f64,
    raised_db: f64,
}

/// Encodes a sound as a WAV file at a level.
pub(crate) fn encoded(
    sounded: &Sounded,
    level: Level,
) -> Result<(Vec<u8>, SoundReport), SoundError> {
    let loudest = Some(sounded.peak_level()).filter(|_| sounded.loudest() > 0.0);
    if level == Level::True {
        let bytes = sounded.wav()?;
        let report = SoundReport {
            level: "true",
            loudness_lufs: None,
            true_peak_db: None,
            loudest_db: loudest,
            full_scale_db: loudest,
            reduced_db: 0.0,
            raised_db: 0.0,
        };
        return Ok((bytes, report));
    }
    let levelled = sounded.levelled(TARGET)?;
    let config = &sounded.config;
    let bytes = wav(
        &levelled.samples,
        config.listener.channels,
        config.rate,
        1.0,
    )?;
    let report = SoundReport {
        level: "loudness",
        loudness_lufs: levelled.loudness.integrated,
        true_peak_db: levelled.loudness.true_peak,
        loudest_db: loudest,
        full_scale_db: levelled.full_scale.map(|p| 20.0 * (p / 2e-5).log10()),
        reduced_db: levelled.leveller.reduction,
        raised_db: levelled.leveller.raised,
    };
    Ok((bytes, report))
}

impl SoundReport {
    /// The note of the report.
    pub(crate) fn note(&self) -> String {
        let Some(loudest) = self.loudest_db else {
            return "the sound is silent because nothing was struck".into();
        };
        if self.level == "true" {
            return format!("the loudest sample of the sound corresponds to {loudest:.0} dB");
        }
        let mut note = match self.loudness_lufs {
            Some(loudness) => format!("the sound is at {loudness:.1} LUFS"),
            None => "the sound is softer than -70 LUFS".into(),
        };
        if self.loudness_lufs.is_none_or(|l| (l - TARGET).abs() > 0.5) {
            let _ = write!(note, " and not at {TARGET:.0}, since it is short or sparse");
        }
        let _ = write!(
            note,
            "; the loudest sample, {loudest:.0} dB, is reduced by {:.0} dB and soft sounds are raised by up to {:.0} dB; `--level true` keeps their true levels",
            self.reduced_db, self.raised_db
        );
        note
    }
}
