//! One breakable body: an asset and its own weak points.

use std::sync::Arc;

use crate::asset::Asset;
use crate::error::InputError;
use crate::rng::{Purpose, stream, uniform};

/// A body that may break: shares its asset with its like, has its own seed and weak points.
#[derive(Clone, Debug)]
pub struct Body {
    /// What it is.
    pub asset: Arc<Asset>,
    /// Seed of its weak points and of the roughness of its cracks.
    pub seed: u64,
    /// Its weak fracture tetrahedra, ascending: cracks start only there `[G12 §4.4]`.
    pub weak_tets: Vec<u32>,
}

impl Body {
    /// A body of this asset; `seed` decides its weak points.
    ///
    /// Weak points are a Poisson process of the material's density (1/m³): a tetrahedron of volume V is weak
    /// with probability 1 − exp(−density V).
    ///
    /// # Errors
    /// When the asset's arrays do not fit together, or a number of its material is unusable.
    pub fn new(asset: Arc<Asset>, seed: u64) -> Result<Self, InputError> {
        asset.validate()?;
        let mut rng = stream(seed, Purpose::WeakPoints, 0);
        let weak_tets = (0..asset.fracture.tets.len())
            .filter(|&e| {
                let expected = asset.material.weak_point_density * asset.fracture.volume(e);
                uniform(&mut rng) < -(-expected).exp_m1()
            })
            .map(|e| e as u32)
            .collect();
        Ok(Self {
            asset,
            seed,
            weak_tets,
        })
    }
}
