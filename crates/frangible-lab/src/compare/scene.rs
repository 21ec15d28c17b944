//! The first blow of a scene that breaks something, by several methods.

use frangible::Fragment;
use frangible::internals::contact::approach_energy;
use frangible_photo::{SheetOptions, encode_png_within, sheet_of_frames};
use frangible_scenes::{FirstBreak, Scene, bake_opened, first_break, open_sources};
use serde_json::{Value, json};

use super::{Broken, Hit, Method, Options, compare};
use crate::{Progress, Result};

/// Scenes of the page.
pub const SCENES: [&str; 5] = ["glass", "pane", "vase", "rabbit", "piggy-bank"];

/// Runs of each method, of which the fastest counts.
const RUNS: usize = 3;
/// Spread of the drawn pieces, share of their distance from the body's middle.
const APART: f32 = 0.22;
/// Size limit of a picture, bytes.
const MOST_BYTES: usize = 900_000;

/// A scene's first break by each method, and the numbers of it.
///
/// # Errors
/// A scene that cannot be played, or in which nothing breaks.
pub fn broken_scene(
    scene: &Scene,
    methods: &[Method],
    options: &Options,
    hear: Progress<'_>,
) -> Result<(FirstBreak, Vec<Broken>, Value)> {
    let sources = open_sources(scene)?;
    let baked = bake_opened(scene, sources, &mut |p| hear(0.5 * p.fraction))?;
    let found = first_break(scene, &baked, &mut |share| hear(0.5 + 0.3 * share))?;
    let found = found.ok_or_else(|| {
        format!(
            "no impact breaks a body in the scene `{}` with seed {}; choose another seed (--seed) or a harder blow",
            scene.name, scene.seed
        )
    })?;
    let hit = Hit {
        body: &found.body,
        contacts: &found.contacts,
        config: &found.config,
    };
    let mut all = compare(hit, methods, options, &mut |_| {})?;
    for _ in 1..RUNS {
        let again = compare(hit, methods, options, &mut |_| {})?;
        for (known, new) in all.iter_mut().zip(&again) {
            known.seconds = known.seconds.min(new.seconds);
        }
    }
    let data = data(scene, &found, &all);
    Ok((found, all, data))
}

fn data(scene: &Scene, found: &FirstBreak, all: &[Broken]) -> Value {
    let asset = found.body.asset();
    let volume = asset.fracture().total_volume();
    let methods = all.iter().map(|broken| {
        let sum: f64 = broken.fragments.iter().map(|f| f.mass.volume).sum();
        json!({
            "method": broken.method.name(),
            "title": broken.method.title(),
            "pieces": broken.pieces(),
            "largest_share": broken.largest_share(),
            "crack_area_m2": broken.crack_area,
            "between_pieces_m2": broken.border_area,
            "energy_j": broken.energy,
            "strain_energy_j": broken.available,
            "seconds": broken.seconds,
            "volume_error": if broken.fragments.is_empty() { 0.0 } else { sum / volume - 1.0 },
        })
    });
    let contacts = found.contacts.iter();
    json!({
        "scene": scene.name,
        "seed": scene.seed,
        "body": found.name,
        "material": asset.material().name,
        "time_s": found.time,
        "contacts": found.contacts.len(),
        "impulse_n_s": contacts.clone().map(|c| f64::from(c.impulse)).sum::<f64>(),
        "approach_speed_m_s": contacts.map(|c| c.approach_speed).fold(0.0, f32::max),
        "approach_energy_j": approach_energy(&found.contacts),
        "volume_m3": asset.mass().volume,
        "methods": methods.collect::<Vec<_>>(),
    })
}

/// The body as it was hit, and the pieces of each method, as PNG.
///
/// # Errors
/// A picture that cannot be drawn.
pub fn picture(found: &FirstBreak, all: &[Broken]) -> Result<Vec<u8>> {
    let sets: Vec<&[Fragment]> = all.iter().map(|broken| &broken.fragments[..]).collect();
    let stills = found.stills(&sets, APART);
    let before = found.still_of_impact(stills.first().ok_or("no method to draw")?);
    let label = |broken: &Broken| match broken.pieces() {
        1 => format!("{}: held", broken.method.title()),
        n => format!("{}: {n} pieces", broken.method.title()),
    };
    let labels: Vec<String> = all.iter().map(label).collect();
    let mut cells = vec![(&before, 0, "the impact")];
    cells.extend(stills.iter().zip(&labels).map(|(s, l)| (s, 0, l.as_str())));
    let options = SheetOptions {
        cell_width: 420,
        cell_height: 340,
        columns: 3,
    };
    Ok(encode_png_within(
        &sheet_of_frames(&cells, &options)?,
        MOST_BYTES,
    )?)
}
