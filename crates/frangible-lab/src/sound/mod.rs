//! Struck and broken things, heard: `frangible-lab sound`.
//!
//! Closed forms and published spectra stand beside the synthesiser's results for baked bodies. The tests of `frangible-sound` check the radiation of
//! spheres, energies and onsets; here are whole bodies.

mod cost;
mod cup;
mod faces;
mod landing;
mod levels;
mod objects;
mod page;
mod page_levels;
mod scenes;

use std::error::Error;

pub use cost::Cost;
pub use cup::{Cup, FRICTIONS, Knocked};
pub use landing::Landing;
pub use levels::HeardLevel;
pub use objects::{Object, Partial};
pub use scenes::{Drop, HeardScene};

/// Samples per second.
const RATE: f64 = 48_000.0;

/// Results of the page.
#[derive(Clone, Debug)]
pub struct Heard {
    /// Bodies struck once, with their partials.
    pub objects: Vec<Object>,
    /// The cup before and after it cracked.
    pub cup: Cup,
    /// Scenes.
    pub scenes: Vec<HeardScene>,
    /// Scenes at two levels.
    pub levels: Vec<HeardLevel>,
    /// Shards that land.
    pub landings: Vec<Landing>,
    /// The glass dropped from heights that double.
    pub drops: Vec<Drop>,
    /// Computing time of a resonator.
    pub cost: Cost,
}

impl Heard {
    /// Computes everything: minutes. `hear` receives the share done, 0..=1.
    ///
    /// # Errors
    /// An error of the bake, of the scenes or of the synthesiser.
    pub fn compute(hear: &mut dyn FnMut(f64)) -> Result<Self, Box<dyn Error>> {
        let objects = objects::all()?;
        hear(0.2);
        let cup = Cup::compute()?;
        hear(0.35);
        let mut scenes = Vec::new();
        for (i, name) in scenes::NAMES.into_iter().enumerate() {
            scenes.push(HeardScene::compute(name)?);
            hear(0.35 + 0.5 * (i + 1) as f64 / scenes::NAMES.len() as f64);
        }
        let (levels, landings) = (levels::all()?, landing::all()?);
        hear(0.9);
        let drops = scenes::drops()?;
        hear(0.98);
        let cost = Cost::measure()?;
        Ok(Self {
            objects,
            cup,
            scenes,
            levels,
            landings,
            drops,
            cost,
        })
    }
}
