//! Things that are made once for each asset.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::prelude::*;
use frangible::Asset as Baked;

use crate::FrangibleAsset;

/// Things made of assets, each kept until its asset is another.
pub(crate) struct PerAsset<T>(BTreeMap<AssetId<FrangibleAsset>, (Arc<Baked>, T)>);

impl<T> Default for PerAsset<T> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<T: Clone> PerAsset<T> {
    /// The one that was made of this asset, or a new one.
    pub(crate) fn of(
        &mut self,
        id: AssetId<FrangibleAsset>,
        baked: &Arc<Baked>,
        make: impl FnOnce() -> T,
    ) -> T {
        match self.0.get(&id) {
            Some((of, made)) if Arc::ptr_eq(of, baked) => made.clone(),
            _ => {
                let made = make();
                self.0.insert(id, (Arc::clone(baked), made.clone()));
                made
            }
        }
    }

    /// Forgets things that belong to assets that are gone.
    pub(crate) fn forget(&mut self, assets: &Assets<FrangibleAsset>) {
        self.0.retain(|id, _| assets.contains(*id));
    }
}
