//! `.frangible` files as assets.

use bevy::asset::io::Reader;
use bevy::asset::{AssetLoader, LoadContext};
use bevy::prelude::*;
use frangible::internals::asset::{Image, RenderMaterial};
use frangible::{Asset as Baked, AssetFileError, Breakable as Kind, InputError};
use thiserror::Error;

use crate::meshes::authored;

/// A baked body, ready to be broken.
#[derive(Asset, TypePath, Clone)]
pub struct FrangibleAsset(pub Kind);

impl FrangibleAsset {
    /// Makes an asset from a body that the game has baked or loaded itself, with the scatter of strength of its material.
    ///
    /// # Errors
    /// The asset is invalid.
    pub fn new(baked: Baked) -> Result<Self, InputError> {
        Ok(Self(Kind::new(baked)?))
    }

    /// Materials of the file that was baked, which are also those of fragments: their names, colours, emission, sides and textures.
    #[must_use]
    pub fn materials(&self) -> &[RenderMaterial] {
        authored(self.0.asset()).map_or(&[], |surface| &surface.materials)
    }

    /// Files of the images of their textures, PNG and JPEG.
    #[must_use]
    pub fn images(&self) -> &[Image] {
        authored(self.0.asset()).map_or(&[], |surface| &surface.images)
    }

    /// Name of the mesh in its file, which may be empty.
    #[must_use]
    pub fn mesh_name(&self) -> &str {
        authored(self.0.asset()).map_or("", |surface| &surface.name)
    }
}

/// Loads `.frangible` files.
#[derive(Default, TypePath)]
pub struct FrangibleLoader;

/// Error of loading a `.frangible` file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The file cannot be read.
    #[error("the file cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// The file is not a baked body of this version.
    #[error(transparent)]
    File(#[from] AssetFileError),
    /// The body in the file is invalid.
    #[error(transparent)]
    Body(#[from] InputError),
}

impl AssetLoader for FrangibleLoader {
    type Asset = FrangibleAsset;
    type Settings = ();
    type Error = LoadError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        (): &(),
        _: &mut LoadContext<'_>,
    ) -> Result<FrangibleAsset, LoadError> {
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await?;
        let baked = Baked::from_bytes(&bytes)?;
        Ok(FrangibleAsset::new(baked)?)
    }

    fn extensions(&self) -> &[&str] {
        &["frangible"]
    }
}
