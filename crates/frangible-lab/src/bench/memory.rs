//! Size of bodies: in a file, in memory, and for each body that lives.
//!
//! Memory is counted by an allocator that the measuring program brings along (`examples/memory.rs`); it reports [`Counted`].

use frangible::internals::asset::SaveOptions;
use frangible::{Asset, Body, Breakable, FractureConfig, impact};
use serde::Serialize;

use crate::Result;
use crate::bench::cache::Cache;
use crate::bench::subjects::{MODES, Subject};

/// Number of bodies that are made to count the memory of one.
const BODIES: u64 = 16;

/// Count of an allocator while something ran, bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counted {
    /// Allocated and not given back.
    pub kept: u64,
    /// Most at a time.
    pub most: u64,
}

/// A body of Table 1, bytes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OfBody {
    /// Its name.
    pub name: &'static str,
    /// Its tetrahedra.
    pub tets: usize,
    /// Nodes of its analysis mesh.
    pub analysis_nodes: usize,
    /// Weak points of a body.
    pub weak_points: usize,
    /// Its file.
    pub file: usize,
    /// Its file with mode shapes of half precision.
    pub compact: usize,
    /// Largest relative change of a mode's peak stress by half precision.
    pub change: f64,
    /// The asset in memory.
    pub asset: u64,
    /// Data made once from the asset, bytes: trees, bounds, connections.
    pub prepared: u64,
    /// Each further body of its kind.
    pub body: u64,
    /// Most memory that its break takes beside all that, pieces included.
    pub broken: u64,
}

/// Measures a body.
///
/// # Errors
/// A body that does not bake, or whose file cannot be read.
pub fn measure(
    subject: &'static Subject,
    cache: &Cache,
    count: &mut dyn FnMut(&mut dyn FnMut()) -> Counted,
) -> Result<OfBody> {
    let geometry = || subject.geometry();
    let baked = cache.body(
        subject.file(),
        MODES,
        subject.material,
        geometry,
        &mut |_, _| {},
    )?;
    let (path, known) = (baked.path, baked.asset);
    let compact = known.to_bytes_with(&SaveOptions::compact()).len();
    let change = half_changes(&known);
    let contact = subject.contact(&known, subject.blow.speed_ours)?;
    drop(known);
    let mut loaded = None;
    let asset = count(&mut || loaded = Some(Asset::load(&path)));
    let mut loaded = loaded.transpose()?;
    let mut kind = None;
    let prepared = count(&mut || kind = loaded.take().map(Breakable::uniform));
    let Some(kind) = kind.transpose()? else {
        return Err(crate::Error::from(format!(
            "{} was not loaded",
            subject.name
        )));
    };
    let mut bodies: Vec<Body> = Vec::with_capacity(BODIES as usize);
    let own = count(&mut || bodies.extend((1..=BODIES).map(|seed| kind.body(seed))));
    let mut broke = Ok(());
    let broken = count(&mut || {
        broke = impact(
            &bodies[0],
            std::slice::from_ref(&contact),
            &FractureConfig::default(),
        )
        .map(drop);
    });
    broke?;
    let assets = kind.asset();
    Ok(OfBody {
        name: subject.name,
        tets: assets.fracture().tets.len(),
        analysis_nodes: assets.analysis().nodes.len(),
        weak_points: bodies[0].weak_tets().len(),
        file: std::fs::metadata(&path).map_or(0, |about| about.len() as usize),
        compact,
        change,
        asset: asset.kept,
        prepared: prepared.kept,
        body: own.kept / BODIES + size_of::<Body>() as u64,
        broken: broken.most,
    })
}

/// Largest relative change of a mode's peak stress when its shape is rounded to half precision.
fn half_changes(asset: &Asset) -> f64 {
    let halved = asset.clone().with_compact_shapes().restressed();
    let peaks = asset
        .modes()
        .peak_stress
        .iter()
        .zip(&halved.modes().peak_stress);
    peaks
        .map(|(&full, &half)| (f64::from(half) / f64::from(full) - 1.0).abs())
        .fold(0.0, f64::max)
}
