//! Is the fracture real? Counts and distributions beside published experiments, by `frangible-lab experiments`.
//!
//! Here nothing passes or fails: there is no exact answer, only measurements on other bodies. [`Experiments::compute`] breaks some hundred bodies.

mod blow;
mod bodies;
mod fit;
mod masses;
mod pattern;
mod rear_star;
mod star;
mod variants;

pub(crate) use bodies::clamped;
pub use fit::{CutOffLaw, PowerLaw};
pub use masses::{MassPlan, MassRun, Masses};
pub use pattern::CrackPattern;
pub use rear_star::{RearStar, RearStarPlan, RearStars};
pub use star::{Count, StarImpact, StarPlan, StarRun, Stars};

use serde::Serialize;
use serde_json::Value;

use crate::{Progress, Result};

/// Results of all experiments.
#[derive(Clone, Debug, Serialize)]
pub struct Experiments {
    /// Radial cracks of thin plates.
    #[serde(serialize_with = "stars")]
    pub stars: Stars,
    /// Cracks of window glass from its rear face.
    pub rear_stars: RearStars,
    /// Masses of pieces.
    pub masses: Masses,
}

impl Experiments {
    /// Computes the plans; the same plans give the same bits on any number of threads. With the full plans it takes minutes.
    ///
    /// # Errors
    /// An error of the bake or of the impact.
    pub fn compute(
        stars: StarPlan,
        rear_stars: RearStarPlan,
        masses: MassPlan,
        hear: Progress<'_>,
    ) -> Result<Self> {
        let stars = Stars::compute(stars)?;
        hear(0.5);
        let rear_stars = RearStars::compute(rear_stars)?;
        hear(0.7);
        Ok(Self {
            stars,
            rear_stars,
            masses: Masses::compute(masses)?,
        })
    }
}

/// The numbers of the stars in place of every line of every crack.
fn stars<S: serde::Serializer>(stars: &Stars, to: S) -> std::result::Result<S::Ok, S::Error> {
    Value::serialize(&stars.data(), to)
}
