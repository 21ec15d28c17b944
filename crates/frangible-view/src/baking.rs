//! Baked bodies of scenes: each bake is kept, and another material is a rescaling.

use std::sync::Arc;

use frangible::Asset;
use frangible_scenes::{BakedBody, BodySource, BodySpec, Rescale, Scene, SceneError, Support};
#[cfg(feature = "bake")]
use frangible_scenes::{bake_until, open_sources};

use crate::error::ViewError;
use crate::jobs::Teller;
use crate::knobs::{Settings, turn_material};

/// Scenes whose bodies are kept.
const KEPT: usize = 12;

/// Everything that a bake depends on.
#[derive(Clone, PartialEq)]
struct BodyKey {
    source: BodySource,
    modes: usize,
    resolution: Option<usize>,
    supports: Vec<Support>,
    rescale: Rescale,
    poisson_ratio: f64,
}

impl BodyKey {
    fn of(body: &BodySpec) -> Self {
        Self {
            source: body.source.clone(),
            modes: body.modes,
            resolution: body.resolution,
            supports: body.supports.clone(),
            rescale: body.rescale.clone(),
            poisson_ratio: body.material.poisson_ratio,
        }
    }
}

/// Baked bodies of the last scenes.
#[derive(Default)]
pub(crate) struct Shelf(Vec<(Vec<BodyKey>, Vec<BakedBody>)>);

impl Shelf {
    /// The scene's bodies, if they were baked.
    pub(crate) fn find(&self, scene: &Scene) -> Option<&[BakedBody]> {
        let key = keys(scene);
        let found = self.0.iter().find(|(known, _)| *known == key);
        found.map(|(_, baked)| &baked[..])
    }

    /// Forgets bakes from files: the files may have changed.
    pub(crate) fn forget_files(&mut self) {
        let of_file =
            |key: &BodyKey| matches!(key.source, BodySource::Mesh { .. } | BodySource::Asset(_));
        self.0.retain(|(keys, _)| !keys.iter().any(of_file));
    }

    pub(crate) fn keep(&mut self, scene: &Scene, baked: Vec<BakedBody>) {
        self.0.push((keys(scene), baked));
        if self.0.len() > KEPT {
            self.0.remove(0);
        }
    }
}

/// Returns true if bodies that were baked for one scene serve the other.
#[must_use]
pub fn same_bakes(a: &Scene, b: &Scene) -> bool {
    keys(a) == keys(b)
}

fn keys(scene: &Scene) -> Vec<BodyKey> {
    scene.bodies.iter().map(BodyKey::of).collect()
}

/// The scene of a file, or of a body's file, with a body for each part of a mesh.
#[cfg(feature = "bake")]
pub(crate) fn scene_in(path: &std::path::Path) -> Result<Scene, SceneError> {
    let scene = frangible_scenes::scene_of_file(path)?;
    Ok(frangible_scenes::open_scene(&scene)?.0)
}

/// Refuses every file: without the bake none of its contents could be used.
#[cfg(not(feature = "bake"))]
pub(crate) fn scene_in(path: &std::path::Path) -> Result<Scene, SceneError> {
    Err(SceneError::NoBake {
        body: path.display().to_string(),
    })
}

/// Stands for the bake where this build has none: an error.
#[cfg(not(feature = "bake"))]
pub(crate) fn bake(scene: &Scene, _: &Teller) -> Result<Vec<BakedBody>, SceneError> {
    Err(SceneError::NoBake {
        body: scene.name.clone(),
    })
}

/// Bakes a scene's bodies and reports the progress.
#[cfg(feature = "bake")]
pub(crate) fn bake(scene: &Scene, teller: &Teller) -> Result<Vec<BakedBody>, SceneError> {
    teller.tell("reading".into(), 0.0);
    let opened = open_sources(scene)?;
    bake_until(scene, opened, &teller.cancel, &mut |progress| {
        teller.tell(progress.stage.to_string(), progress.fraction);
    })
}

/// The baked bodies, of the materials the scene asks for; a body that came baked brings its own, turned as
/// the knobs are.
pub(crate) fn of_wanted_material(
    scene: &Scene,
    baked: &[BakedBody],
    settings: Option<&[Settings; 2]>,
) -> Result<Vec<BakedBody>, ViewError> {
    let mut made: Vec<(Arc<Asset>, BakedBody)> = Vec::new();
    let mut all = Vec::new();
    for (body, baked) in scene.bodies.iter().zip(baked) {
        let mut wanted = match body.source {
            BodySource::Asset(_) => baked.asset.material().clone(),
            _ => body.material.clone(),
        };
        if let (BodySource::Asset(_), Some([now, own])) = (&body.source, settings) {
            turn_material(&mut wanted, now, own);
        }
        let known = made
            .iter()
            .find(|(from, to)| Arc::ptr_eq(from, &baked.asset) && *to.asset.material() == wanted);
        let one = match known {
            Some((_, to)) => to.clone(),
            None if *baked.asset.material() == wanted => baked.clone(),
            None => BakedBody {
                asset: Arc::new(frangible_bake::with_material(&baked.asset, &wanted)?),
                report: baked.report.clone(),
            },
        };
        made.push((Arc::clone(&baked.asset), one.clone()));
        all.push(one);
    }
    Ok(all)
}
