//! The page. Every number in it was computed.

use std::error::Error;
use std::fmt::Write;

use frangible_sound::CRACK_SHARE;

use super::page_levels::{landings_text, levels_text};
use super::scenes::SEEDS;
use super::{FRICTIONS, Heard, RATE};
use crate::page::{Page, table};
use crate::plot::{Spectrogram, png};

/// Size of the pictures, pixels.
const SIZE: (u32, u32) = (760, 420);

impl Heard {
    /// The page; its pictures lie in a folder beside it. Without timings but for the cost of a tone, so that the same build writes the same page.
    ///
    /// # Errors
    /// A picture that could not be encoded.
    pub fn page(&self, folder: &str) -> Result<Page, Box<dyn Error>> {
        let mut text = String::from(
            "# Sound\n\nWritten by `frangible-lab sound --write docs`, which computes it anew. Nothing passes or fails here; the tests of \
             `frangible-sound` check radiated power, decay, energy and onsets against closed forms.\n\n\
             `frangible break` writes the sound of a scene beside its animation at the level of its loudness ([below](#the-level)); \
             the viewer and its page play what happens as it comes, at a fixed full scale of 114 dB. The modes that decide where a body breaks ring on under the same \
             forces; what they send to the air follows in closed form from an equivalent sphere; pieces without modes of their own ring as a plate of \
             their size.\n\n",
        );
        self.partials(&mut text);
        self.cup_text(&mut text, folder);
        levels_text(&self.levels, &mut text, folder);
        landings_text(&self.landings, &mut text);
        self.scenes_text(&mut text, folder);
        limits(&mut text);
        let mut pictures = Vec::new();
        for (name, title, samples) in [
            ("cup-whole", "porcelain cup, whole", &self.cup.whole.samples),
            (
                "cup-cracked",
                "porcelain cup, cracked",
                &self.cup.rattling[1].samples,
            ),
        ] {
            let half = samples.len() / 2;
            pictures.push(picture(name, title, &samples[..half], &[])?);
        }
        for scene in &self.scenes {
            let end = (scene.long.min(4.0) * RATE) as usize;
            let samples = &scene.samples[..end.min(scene.samples.len())];
            pictures.push(picture(&scene.name, &scene.name, samples, &scene.blows)?);
        }
        for level in &self.levels {
            let chart = level.chart().draw(SIZE.0, SIZE.1);
            pictures.push((format!("level-{}", level.name), png(&chart)?));
        }
        Ok(Page { text, pictures })
    }

    fn partials(&self, text: &mut String) {
        text.push_str(
            "## Partials and decay\n\nEach body is baked, struck once and listened to at 1 m. *Heard* is the peak of the sound's spectrum; \
             *known* is the closed form or the published measurement, as a multiple of the first tone. The bodies of the last two are not those that \
             were measured, but of their kind. Decay is the time in which the first tone falls by 60 dB, by the damping and in the sound.\n\n",
        );
        let mut rows = Vec::new();
        for object in &self.objects {
            let first = object.partials[0];
            for (i, partial) in object.partials.iter().enumerate() {
                let ratio = partial.heard / first.heard;
                let cell = |s: String| if i == 0 { s } else { String::new() };
                rows.push(vec![
                    cell(object.name.into()),
                    format!("{:.1}", partial.mode),
                    format!("{:.1}", partial.heard),
                    format!("{ratio:.3}"),
                    format!("{:.3}", partial.known),
                    format!("{:+.1} %", 100.0 * (ratio / partial.known - 1.0)),
                    cell(format!("{:.2} / {:.2} s", object.decay[0], object.decay[1])),
                ]);
            }
        }
        let head = [
            "body",
            "mode, Hz",
            "heard, Hz",
            "ratio",
            "known",
            "off",
            "decay, damping / sound",
        ];
        text.push_str(&table(&head, &rows));
        text.push_str("\nSources:\n");
        for object in &self.objects {
            let _ = writeln!(text, "- {}: {}", object.name, object.source);
        }
        text.push('\n');
    }

    fn cup_text(&self, text: &mut String, folder: &str) {
        let cup = &self.cup;
        let [low, high] = cup.two_tones;
        let _ = write!(
            text,
            "## A cracked cup\n\nA mug has two tones, since its handle takes part in one swing of the wall and not in the other. Struck opposite the \
             handle this one sounds at {low:.0} Hz and an eighth of a turn away at {high:.0} Hz, {:.1} % higher; \"more than five percent\" was told of a \
             good mug (Palmer, PHYS-L, 1999).\n\nPotters knock at a cup to hear whether it is whole. A steel ball of 60 g at {:.2} m/s leaves this one in \
             one piece with cracks, and its modes are found anew with the cracks in it.\n\n",
            100.0 * (high / low - 1.0),
            cup.speed
        );
        let rattling = cup
            .rattling
            .iter()
            .zip(FRICTIONS)
            .map(|(knocked, friction)| {
                let name = format!("cracked, faces that beat and rub, friction {friction:.2}");
                (name, knocked)
            });
        let cups = [
            ("whole".to_string(), &cup.whole),
            (
                "cracked, faces that run through each other".to_string(),
                &cup.open,
            ),
        ];
        let rows: Vec<Vec<String>> = (cups.into_iter().chain(rattling))
            .map(|(name, knocked)| {
                let modes: Vec<String> = knocked.modes.iter().map(|f| format!("{f:.0}")).collect();
                vec![
                    name,
                    modes.join(", "),
                    format!("{:.0}", knocked.tone),
                    knocked.falls.map(|t| format!("{:.0}", 1e3 * t)).join(", "),
                    format!("{:.0} %", 100.0 * knocked.rubbed),
                ]
            })
            .collect();
        let head = [
            "cup",
            "lowest modes, Hz",
            "strongest tone, Hz",
            "10, 20, 30 dB less to come after, ms",
            "lost by friction",
        ];
        text.push_str(&table(&head, &rows));
        let sooner = cup.whole.falls[1] / cup.rattling[1].falls[1];
        let _ = writeln!(
            text,
            "\n![The whole cup]({folder}/cup-whole.png)\n![The cracked cup]({folder}/cup-cracked.png)\n\nThe first two rows are the linear ones: \
             the tones of a cup with cuts in it are lower, and it would ring on. But faces cannot run through each other. In the other rows they touch where \
             they close and rub where they slide, at {} places on the cracks. Each place is as stiff as the material between the nodes on its two sides, friction \
             is Coulomb's, and all modes that are heard are followed in steps of a microsecond. What beats shakes the modes that fade fastest, and what rubs \
             is lost at once: the sound of the cracked cup is lower *and* gone {:.0} times sooner than the whole cup's (20 dB less to come). Nothing here is \
             fitted; the coefficient of friction matters little between {:.2} and {:.2}. The picture is with {:.2}. Scenes do not have this: a body that holds \
             with cracks in it keeps the tones that it had.\n",
            cup.places, sooner, FRICTIONS[1], FRICTIONS[2], FRICTIONS[1]
        );
    }

    fn scenes_text(&self, text: &mut String, folder: &str) {
        let _ = write!(
            text,
            "## Scenes\n\nThe ears are where the camera is. *First sound* is when it should arrive by the time of the first contact and its way, and when \
             it does; a body is as large as its sound is early. The loudest pressure is the full \
             scale of the scene's WAV with `--level true`, in which nothing is bent. Cracks give {:.0} % of their energy to the modes on both sides, and the pieces \
             keep the velocities that the body had at their places: what of them is no motion as a whole rings on.\n\n",
            100.0 * CRACK_SHARE
        );
        let rows: Vec<Vec<String>> = (self.scenes.iter())
            .map(|scene| {
                vec![
                    scene.name.clone(),
                    scene.pieces.to_string(),
                    format!("{}, {}", scene.events[0], scene.events[1]),
                    format!("{:.2} / {:.2}", 1e3 * scene.onset[0], 1e3 * scene.onset[1]),
                    format!("{:.1}", scene.loudest),
                    format!("{:.1e}", scene.offset),
                    format!("{:.1}", scene.long),
                    format!("{}, {}", scene.most[0], scene.most[1]),
                ]
            })
            .collect();
        let head = [
            "scene",
            "pieces",
            "contacts, cracks",
            "first sound, ms: due / heard",
            "loudest, dB",
            "offset / RMS",
            "60 dB down after, s",
            "most bodies, tones",
        ];
        text.push_str(&table(&head, &rows));
        for scene in &self.scenes {
            let _ = write!(text, "\n![{0}]({folder}/{0}.png)", scene.name);
        }
        text.push_str("\n\nMarks above the pictures are blows.\n\n");
        self.sources_text(text);
        self.cost_text(text);
        text.push_str("## Energy and height\n\n");
        let rows: Vec<Vec<String>> = (self.drops.iter())
            .map(|[height, level, error]| {
                let first = self.drops[0];
                vec![
                    format!("{height:.1}"),
                    format!("{:+.1}", 10.0 * (height / first[0]).log10()),
                    format!("{:+.1} ± {error:.1}", level - first[1]),
                ]
            })
            .collect();
        let _ = write!(
            text,
            "The glass dropped from three heights, {SEEDS} seeds each. The energy of the fall grows by the second column, that of its sound at the left ear by the \
             third: the mean of its level, and the standard error.\n\n"
        );
        let head = ["height, m", "fall, dB", "sound, dB"];
        text.push_str(&table(&head, &rows));
        text.push('\n');
    }
}

impl Heard {
    fn cost_text(&self, text: &mut String) {
        let cost = &self.cost;
        let _ = write!(
            text,
            "## What a tone costs\n\nOn the machine that wrote this page, {} resonators of ringing shards: {:.2} ns per sample and resonator, with the \
             choice of what is heard and the ways to two ears. As many plain two-pole filters of f32, one after the other in one loop each and with \
             nothing else, take {:.2} ns, {:.1} times as long. A filter waits for its last sample; here eight go side by side.\n\n",
            cost.resonators,
            cost.ours,
            cost.plain,
            cost.plain / cost.ours
        );
    }

    fn sources_text(&self, text: &mut String) {
        text.push_str(
            "## Energy and level by source\n\nWhat a scene lost is the fall of its energy of motion and height; what it sends is found by 32 microphones on a \
             sphere about it, without a floor. Of an impact's energy 1e-4 to 1e-2 becomes sound. Levels are 1 m away, above the floor: the loudest single pressure, \
             which lasts a fraction of a millisecond, and what a sound level meter set to *fast* (125 ms) shows at most, without its filter A. Peaks as high are \
             measured: 125 to 143 dB (C) at the ears of people who throw bottles into troughs all day, whose mean is 83 to 100 dB (T. Ward, Health and \
             Safety Executive, Noise and kerbside glass collection).\n\n",
        );
        let rows: Vec<Vec<String>> = (self.scenes.iter())
            .map(|scene| {
                let mut row = vec![scene.name.clone(), format!("{:.2}", scene.lost)];
                for [energy, ..] in scene.sources {
                    row.push(format!("{:.1e}", energy / scene.lost));
                }
                for [_, peak, fast] in scene.sources {
                    row.push(format!("{peak:.0} / {fast:.0}"));
                }
                row
            })
            .collect();
        let head = [
            "scene",
            "lost, J",
            "sent, share",
            "blows",
            "cracks",
            "touches",
            "slides",
            "peak / fast, dB",
            "blows",
            "cracks",
            "touches",
            "slides",
        ];
        text.push_str(&table(&head, &rows));
        text.push('\n');
    }
}

fn limits(text: &mut String) {
    text.push_str(
        "## What is not there\n\n\
         - The floor does not hum under what slides or rolls on it.\n\
         - The bending that a body has when it breaks is lost, since the faces of its cracks press and rub on each other while they part; its pieces \
           keep its velocities and get what the cracks give them. A piece that springs back freely would be louder.\n\
         - When within a step of the rigid bodies two things touch is not known; a moment of the step is drawn for each touch.\n\
         - Pieces that cannot break again have the tones of a plate of their size and not their own.\n\
         - No cavities (the hollow of a bottle, which one blows on), no sound that bends around other bodies, no rooms.\n\
         - A tone's reflection from the floor is as loud as its direct sound in its direction, and walls that stand on the floor do not shake it.\n\
         - The damping of stone, ice, sugar, chocolate and rubber, the shares of the cracks' and of the friction's energy that become vibration, the \
           grain of the floor, and what supports take are estimates.\n",
    );
}

fn picture(
    name: &str,
    title: &str,
    samples: &[f32],
    marks: &[f64],
) -> Result<(String, Vec<u8>), Box<dyn Error>> {
    let picture = Spectrogram {
        title: title.into(),
        samples,
        rate: RATE,
        highest: 16_000.0,
        marks: marks.to_vec(),
    };
    Ok((name.into(), png(&picture.draw(SIZE.0, SIZE.1))?))
}
