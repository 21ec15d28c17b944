//! `bodies FOLDER [SCENE …]`: the built-in scenes, or those named, with lighter bodies, so that a page fetches them in no time, and their
//! baked bodies, into a folder.
//! `list.json` there lists the bakes: for each scene its text, the files of its bodies, each once, and the number of the file of each body.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use frangible_scenes::{
    BakedBody, BodySource, SCENE_NAMES, Scene, SceneError, bake, compacted, save_asset,
    save_compact_asset, scene, scene_to_toml,
};

/// Scenes with other vibration modes and tetrahedra than [`USUAL`].
const OTHERS: [(&str, usize, usize); 6] = [
    // The one that the page opens with.
    ("pane", 18, 10_000),
    ("brick", 14, 5_000),
    ("hammer", 14, 5_000),
    // Two dozen of them.
    ("wall", 14, 3_000),
    // Their walls come apart with fewer.
    ("bottle", 20, 25_000),
    // With fewer modes it withstands the floor.
    ("bulb", 60, 25_000),
];

/// No page waits for its body: the stem comes apart with fewer tetrahedra than make a file of 58 MB.
const LEFT_OUT: &str = "wine-glass";

/// Vibration modes and tetrahedra of a body; where walls are thin it has as many tetrahedra as they need.
const USUAL: (usize, usize) = (30, 12_000);

/// Half precision serves where it changes no mode's peak stress by more than this share.
const MOST_CHANGE: f64 = 0.01;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let folder = words.next().map(PathBuf::from);
    let folder = folder.ok_or("name the folder: bodies FOLDER [SCENE …]")?;
    let named: Vec<String> = words.collect();
    let wanted = |name: &str| match named.is_empty() {
        true => name != LEFT_OUT,
        false => named.iter().any(|named| named == name),
    };
    let mut list = Vec::new();
    for name in SCENE_NAMES.into_iter().filter(|&name| wanted(name)) {
        let (scene, baked) = lightly_baked(name)?;
        let mut known: Vec<Arc<_>> = Vec::new();
        let (mut files, mut of) = (Vec::new(), Vec::new());
        for body in baked {
            let same = known.iter().position(|k| Arc::ptr_eq(k, &body.asset));
            of.push(same.unwrap_or(known.len()));
            if same.is_none() {
                let file = format!("{name}-{}.frangible", known.len() + 1);
                save(&body, &folder.join(&file))?;
                files.push(file);
                known.push(body.asset);
            }
        }
        eprintln!("baked {name}");
        let text = scene_to_toml(&scene);
        list.push(serde_json::json!({ "scene": name, "text": text, "files": files, "of": of }));
    }
    let text = serde_json::to_string_pretty(&list)?;
    Ok(fs::write(folder.join("list.json"), text)?)
}

/// A scene with lighter bodies, and those.
fn lightly_baked(name: &str) -> Result<(Scene, Vec<BakedBody>), SceneError> {
    let other = OTHERS.iter().find(|(known, ..)| *known == name);
    let (modes, mut tetrahedra) = other.map_or(USUAL, |&(_, modes, tets)| (modes, tets));
    loop {
        let mut scene = scene(name)?;
        for body in &mut scene.bodies {
            body.modes = body.modes.min(modes);
            match &mut body.source {
                BodySource::Ready { resolution, .. } => *resolution = Some(tetrahedra),
                _ => body.resolution = Some(tetrahedra),
            }
        }
        match bake(&scene) {
            Err(SceneError::ThinWalls { needed, .. }) if needed > tetrahedra => tetrahedra = needed,
            baked => return Ok((scene, baked?)),
        }
    }
}

fn save(body: &BakedBody, path: &Path) -> Result<(), SceneError> {
    let (compact, change) = compacted(&body.asset);
    match change <= MOST_CHANGE {
        true => save_compact_asset(&compact, path),
        false => save_asset(&body.asset, path),
    }
}
