//! The sections of the page on the level of scenes and of shards that land.

use std::fmt::Write;

use super::{HeardLevel, Landing, landing};
use crate::page::table;

/// The section on the level of scenes.
pub(super) fn levels_text(levels: &[HeardLevel], text: &mut String, folder: &str) {
    text.push_str(
            "## The level\n\nA crash and what lands after it are 30 to 50 dB apart. The ear takes both in; a file as loud as fits, played so that one \
             can bear the crash, has its landings below the noise of a room. WAV files and films are therefore levelled, and so is what viewer, page and Bevy play:\n\n\
             - The loudness by EBU R 128 is −16 LUFS, with a true peak of at most −1 dB. The gate of that measure leaves silence out. Files find their full scale by trial; \
               live it is 10 Pa, 114 dB, in the middle of those below, since what is to come is not known.\n\
             - Peaks below −6 dB of full scale are raised by half of what they lack, a ratio of 2 : 1, by at most 18 dB. The level on which that hangs rises at once and \
               falls by 20 dB/s, so that a decay becomes slower by at most 10 dB/s. Below −42 dB all is raised by the same 18 dB, and silence stays silence.\n\
             - Samples above −9 dB are bent more and more, up to −3 dB. What would be more than 12 dB above that is first taken back by the gain, which begins to fall a \
               millisecond before and returns with a time constant of 30 ms. A crash is bent for some milliseconds, in which it is noise, and stays louder than its landings; \
               a limiter that only turns the gain down would duck what rings after it.\n\n\
             `frangible break --level true`, `frangible film --level true` and `Level::True` in Bevy keep true levels. In the table, *true* is such a file, whose full scale is its peak. \
             Levels of 20 ms: the loudest of the crash, and how far below it are the loudest landing, the one in the middle, and the one that a tenth are softer than. A \
             landing is a touch more than 150 ms after the break.\n\n",
        );
    let number =
        |value: Option<f64>| value.map_or("–".into(), |value: f64| format!("{value:.1}"));
    let mut rows = Vec::new();
    for level in levels {
        for (which, name) in ["true", "loudness"].into_iter().enumerate() {
            let [first, middle, soft] = level.below(which);
            let loudness = level.loudness[which];
            rows.push(vec![
                if which == 0 {
                    level.name.clone()
                } else {
                    String::new()
                },
                name.into(),
                format!("{:.0}", level.full_scale[which]),
                number(loudness.integrated),
                number(loudness.true_peak),
                if which == 0 {
                    "–".into()
                } else {
                    format!("{:.0} / {:.0}", level.changed[0], level.changed[1])
                },
                format!("{:.0}", level.crash[which]),
                format!("{first:.0}, {middle:.0}, {soft:.0}"),
            ]);
        }
    }
    let head = [
        "scene",
        "level",
        "full scale, dB",
        "LUFS",
        "true peak, dB",
        "reduced / raised, dB",
        "crash, dB",
        "landings below it, dB",
    ];
    text.push_str(&table(&head, &rows));
    text.push_str("\nWhere the loudness is not reached, the sound is a few short thuds: the peak may lie at most 24 dB above full scale.\n");
    for level in levels {
        let _ = write!(
            text,
            "\n![The level of {0}]({folder}/level-{0}.png)",
            level.name
        );
    }
    text.push_str("\n\n");
}

/// The section on shards that land.
pub(super) fn landings_text(landings: &[Landing], text: &mut String) {
    text.push_str(
            "## Shards that land\n\nShards of glass, 3 mm thick and half again as long as wide, land on a corner on a stone floor, tilted by 45°, and are heard 1 m away: the loudest \
             pressure, and what a sound level meter set to *fast* shows at most. A rigid push would grow by 20 dB with ten times the speed and, with the same tones, \
             the mass. The decay is that of the lowest tone, with what it radiates and by the material alone, 2.2/(f η) with the loss factor η = 0.001 of glass: Cremer and \
             Heckl give 0.0006 to 0.002, and Kirby (J. Soc. Glass Technol. 38, 1954) found that it falls with frequency, up to 50 Hz. Damping that grows with the square of \
             the frequency, which suits the lowest tone of a wine glass, lets a shard of 10 kHz die six times too soon. No measured levels of single shards were found.\n\n",
        );
    let speeds = landing::speeds();
    let rows: Vec<Vec<String>> = (landings.iter())
        .map(|landing| {
            let mut row = vec![
                format!("{:.1}", 1e3 * landing.mass),
                format!("{:.0}", 1e3 * landing.side),
            ];
            for [peak, fast] in &landing.levels {
                row.push(format!("{peak:.0} / {fast:.0}"));
            }
            let [tone, decay, alone] = landing.lowest;
            let known = tone.is_finite();
            row.push(if known {
                format!("{tone:.0}")
            } else {
                "none".into()
            });
            row.push(if known {
                format!("{decay:.2} / {alone:.2}")
            } else {
                "–".into()
            });
            row
        })
        .collect();
    let head = [
        "mass, g".to_string(),
        "length, mm".into(),
        format!("{} m/s: peak / fast, dB", speeds[0]),
        format!("{} m/s", speeds[1]),
        format!("{} m/s", speeds[2]),
        "lowest tone, Hz".into(),
        "decay, in all / material, s".into(),
    ];
    text.push_str(&table(&head.each_ref().map(String::as_str), &rows));
    text.push('\n');
}
