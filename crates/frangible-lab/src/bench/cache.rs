//! Bodies, baked once and kept as `.frangible` files.

use std::fs;
use std::path::{Path, PathBuf};

use frangible::{Asset, Material};
use frangible_bake::{BakeSpec, bake_with};

use crate::Result;
use crate::bench::subjects::Geometry;

/// Folder of baked bodies.
#[derive(Clone, Debug)]
pub struct Cache {
    /// Path of the folder.
    pub folder: PathBuf,
    /// If true, bakes even a body that is there.
    pub rebake: bool,
}

/// A baked body.
#[derive(Clone, Debug)]
pub struct Baked {
    /// Its file.
    pub path: PathBuf,
    /// The body.
    pub asset: Asset,
    /// Time of its bake, s.
    pub seconds: f64,
}

impl Cache {
    /// The body of this name, from its file or baked; the time of its bake stands in a file beside it. A file that cannot be read is baked anew.
    ///
    /// # Errors
    /// A body that does not bake, a folder that cannot be written.
    pub fn body(
        &self,
        name: &str,
        modes: usize,
        material: &str,
        geometry: impl FnOnce() -> Result<Geometry>,
    ) -> Result<Baked> {
        let wrong = |path: &Path| {
            let path = path.display().to_string();
            move |e| {
                format!(
                    "`{path}` cannot be used for the baked bodies: {e}; choose another folder with --cache DIR"
                )
            }
        };
        fs::create_dir_all(&self.folder).map_err(wrong(&self.folder))?;
        let path = self.folder.join(format!("{name}-{modes}.frangible"));
        let beside = path.with_extension("seconds");
        let material = Material::preset(material)?;
        if !self.rebake
            && let Ok(asset) = Asset::load(&path)
            && *asset.material() == material
            && let Some(seconds) = fs::read_to_string(&beside)
                .ok()
                .and_then(|s| s.trim().parse().ok())
        {
            return Ok(Baked {
                path,
                asset,
                seconds,
            });
        }
        let (shape, analysis, fracture) = geometry()?;
        let spec = BakeSpec {
            modes,
            analysis,
            fracture,
            ..BakeSpec::new(name, shape, material)
        };
        let frangible_bake::Baked { asset, report } = bake_with(&spec, |_| {})?;
        let seconds = report.seconds.iter().map(|(_, s)| s).sum();
        asset.save(&path)?;
        fs::write(&beside, format!("{seconds}\n")).map_err(wrong(&beside))?;
        Ok(Baked {
            path,
            asset,
            seconds,
        })
    }
}
