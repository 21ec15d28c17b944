//! Size of the bodies of Table 1 in files and in memory, counted by the allocator.
//!
//! `cargo run --release -p frangible-lab --example memory -- [BODY …]` prints JSON, for `docs/data/memory.json`.

use allocation_counter::measure as counted;
use frangible::internals::asset::SaveOptions;
use frangible::{Asset, Body, Breakable, FractureConfig, impact};
use frangible_lab::Result;
use frangible_lab::bench::cache::Cache;
use frangible_lab::bench::subjects::{MODES, Subject, chosen};
use frangible_lab::data::{Measures, stored};
use serde_json::{Value, json};

/// Number of bodies that are made to count the memory of one.
const BODIES: u64 = 16;

fn main() -> Result<()> {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let cache = Cache {
        folder: "target/bench".into(),
        rebake: false,
    };
    // The pig stands twice in the table.
    let subjects = chosen(&names)?.into_iter().filter(|s| s.file() == s.name);
    let bodies: Result<Vec<Value>> = subjects.map(|subject| of_body(subject, &cache)).collect();
    println!("{:#}", stored(Measures::Model, false, &bodies?)?);
    Ok(())
}

fn of_body(subject: &Subject, cache: &Cache) -> Result<Value> {
    let geometry = || subject.geometry();
    let baked = cache.body(subject.file(), MODES, subject.material, geometry)?;
    let (path, known) = (baked.path, baked.asset);
    let compact = known.to_bytes_with(&SaveOptions::compact()).len();
    let change = half_changes(&known);
    let contact = subject.contact(&known, subject.blow.speed_ours)?;
    drop(known);
    let mut loaded = None;
    let asset = counted(|| loaded = Some(Asset::load(&path)));
    let mut loaded = loaded.transpose()?;
    let mut kind = None;
    let prepared = counted(|| kind = loaded.take().map(Breakable::uniform));
    let Some(kind) = kind.transpose()? else {
        return Err("the body was not loaded".into());
    };
    let mut bodies: Vec<Body> = Vec::with_capacity(BODIES as usize);
    let own = counted(|| bodies.extend((1..=BODIES).map(|seed| kind.body(seed))));
    let mut broke = Ok(());
    let broken = counted(|| {
        broke = impact(
            &bodies[0],
            std::slice::from_ref(&contact),
            &FractureConfig::default(),
        )
        .map(drop);
    });
    broke?;
    let assets = kind.asset();
    Ok(json!({
        "body": subject.name,
        "tets": assets.fracture().tets.len(),
        "analysis_nodes": assets.analysis().nodes.len(),
        "weak_points": bodies[0].weak_tets().len(),
        "file_bytes": std::fs::metadata(&path)?.len(),
        "compact_bytes": compact,
        "compact_change": change,
        "asset_bytes": asset.bytes_current,
        "prepared_bytes": prepared.bytes_current,
        "body_bytes": own.bytes_current / BODIES as i64 + size_of::<Body>() as i64,
        "broken_bytes": broken.bytes_max,
    }))
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
