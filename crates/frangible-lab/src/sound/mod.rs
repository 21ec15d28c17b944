//! Struck and broken things, heard: `frangible-lab sound` and `frangible-lab levels`.
//!
//! Closed forms and published spectra stand beside the synthesiser's results for baked bodies. The tests of `frangible-sound` check the radiation of
//! spheres, energies and onsets; here are whole bodies.

mod cup;
mod decays;
mod faces;
mod glazing;
mod landing;
mod levels;
mod objects;
mod scenes;
mod spectrum;

use serde_json::{Value, json};

use crate::{Progress, Result};
pub use cup::{Cup, FRICTIONS, Knocked};
pub use decays::{MaterialLoss, OctaveDecay};
pub use glazing::HeardGlass;
pub use landing::Landing;
pub use levels::HeardLevel;
pub use objects::{Object, Partial};
pub use scenes::{Drop, HeardScene};

/// Samples per second.
pub const RATE: f64 = 48_000.0;

/// Results of the measurement.
#[derive(Clone, Debug)]
pub struct Heard {
    /// Bodies struck once, with their partials.
    pub objects: Vec<Object>,
    /// The cup before and after it cracked.
    pub cup: Cup,
    /// Scenes.
    pub scenes: Vec<HeardScene>,
    /// The glass dropped from heights that double.
    pub drops: Vec<Drop>,
}

impl Heard {
    /// Computes everything: minutes. `hear` receives the share done, 0..=1.
    ///
    /// # Errors
    /// An error of the bake, of the scenes or of the synthesiser.
    pub fn compute(hear: Progress<'_>) -> Result<Self> {
        let objects = objects::all()?;
        hear(0.2);
        let cup = Cup::compute()?;
        hear(0.35);
        let mut scenes = Vec::new();
        for (i, name) in scenes::NAMES.into_iter().enumerate() {
            scenes.push(HeardScene::compute(name)?);
            hear(0.35 + 0.5 * (i + 1) as f64 / scenes::NAMES.len() as f64);
        }
        let drops = scenes::drops()?;
        hear(0.98);
        Ok(Self {
            objects,
            cup,
            scenes,
            drops,
        })
    }

    /// The numbers; the same build gives the same ones.
    #[must_use]
    pub fn data(&self) -> Value {
        let partials = self.objects.iter().flat_map(|object| {
            let row = |partial| json!({ "body": object.name, "partial": partial });
            object.partials.iter().map(row)
        });
        let decays = self
            .objects
            .iter()
            .map(|o| json!({ "body": o.name, "source": o.source, "decay_s": o.decay }));
        let cup = &self.cup;
        let mut cups = vec![
            ("whole".into(), &cup.whole),
            (
                "cracked, faces that run through each other".into(),
                &cup.open,
            ),
        ];
        let rubbing =
            |friction: f32| format!("cracked, faces that beat and rub, friction {friction:.2}");
        cups.extend(FRICTIONS.map(rubbing).into_iter().zip(&cup.rattling));
        let cups = cups
            .iter()
            .map(|(name, knocked)| json!({ "cup": name, "knocked": knocked }));
        let scenes = self.scenes.iter().map(|scene| {
            let mut row = json!(scene);
            row["sent_shares"] = json!(scene.sources.map(|[energy, ..]| energy / scene.lost));
            row
        });
        let [first, ..] = &self.drops[..] else {
            return Value::Null;
        };
        let drops = self.drops.iter().map(|[height, level, error]| {
            let fall = 10.0 * (height / first[0]).log10();
            json!({ "height_m": height, "fall_db": fall, "sound_db": level - first[1], "error_db": error })
        });
        json!({
            "partials": partials.collect::<Vec<_>>(),
            "decays": decays.collect::<Vec<_>>(),
            "cup": { "two_tones_hz": cup.two_tones, "speed_m_s": cup.speed, "places": cup.places },
            "cups": cups.collect::<Vec<_>>(),
            "scenes": scenes.collect::<Vec<_>>(),
            "drops": drops.collect::<Vec<_>>(),
        })
    }

    /// The sounds that are drawn as spectrograms: name and samples, Pa.
    #[must_use]
    pub fn sounds(&self) -> Vec<(&str, &[f32])> {
        let cups = [
            ("cup-whole", &self.cup.whole),
            ("cup-cracked", &self.cup.rattling[1]),
        ];
        let half = |k: &'_ Knocked| k.samples.len() / 2;
        let cups = cups
            .into_iter()
            .map(|(name, k)| (name, &k.samples[..half(k)]));
        let scenes = self.scenes.iter().map(|scene| {
            let end = (scene.long.min(4.0) * RATE) as usize;
            (&*scene.name, &scene.samples[..end.min(scene.samples.len())])
        });
        cups.chain(scenes).collect()
    }
}

/// Levels of scenes and of shards that land, and how long these ring.
#[derive(Clone, Debug)]
pub struct Levels {
    /// The scenes of the gallery, true to scale and by loudness.
    pub scenes: Vec<HeardLevel>,
    /// Shards that land.
    pub landings: Vec<Landing>,
    /// Losses of materials.
    pub materials: Vec<MaterialLoss>,
    /// Decay of shards of glass.
    pub shards: Vec<OctaveDecay>,
    /// A window of two glasses.
    pub glasses: Vec<HeardGlass>,
}

impl Levels {
    /// Computes everything: minutes. `hear` receives the share done, 0..=1.
    ///
    /// # Errors
    /// An error of the bake, of the scenes or of the synthesiser.
    pub fn compute(hear: Progress<'_>) -> Result<Self> {
        let (materials, shards) = (decays::materials(), decays::shards()?);
        let landings = landing::all()?;
        let glasses = glazing::all()?;
        hear(0.1);
        let scenes = levels::all(&|share| hear(0.1 + 0.9 * share))?;
        Ok(Self {
            scenes,
            landings,
            materials,
            shards,
            glasses,
        })
    }

    /// The numbers; the same build gives the same ones.
    #[must_use]
    pub fn data(&self) -> Value {
        let kept = self.scenes.iter().filter(|scene| scene.is_kept());
        let rows = self.scenes.iter().map(HeardLevel::row);
        json!({
            "levels": kept.flat_map(HeardLevel::data).collect::<Vec<_>>(),
            "gallery": rows.collect::<Vec<_>>(),
            "landings": self.landings,
            "materials": self.materials,
            "shards": self.shards,
            "glasses": self.glasses,
        })
    }

    /// The sounds that are drawn as spectrograms: name and samples, Pa.
    #[must_use]
    pub fn sounds(&self) -> Vec<(&str, &[f32])> {
        let glasses = self.glasses.iter();
        glasses
            .map(|glass| (glass.picture, &*glass.samples))
            .collect()
    }
}
