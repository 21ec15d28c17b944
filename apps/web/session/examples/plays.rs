//! `plays FOLDER SCENE STEPS TIMES`: plays without a browser the scenes that the page's test plays in one. The scene, of those that `bodies` left in
//! the folder, runs TIMES times for so many steps. Each time it prints as JSON the number of whole bodies, the number of pieces, the masses of those
//! of the last break, kg, and the fingerprint of everything that moves; at the end the time that the last break took, s.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use frangible::Asset;
use frangible_scenes::{BakedBody, Scene, SceneError, parse_scene};
use frangible_view::{Command, Delivery, Host, Session, ViewError};
use serde_json::{Value, json};

/// Files that the example `bodies` left.
struct Baked {
    folder: PathBuf,
    list: Vec<Value>,
}

impl Baked {
    fn of(&self, name: &str) -> Option<&Value> {
        self.list.iter().find(|one| one["scene"] == name)
    }

    fn bodies(&self, name: &str) -> Option<Result<Vec<BakedBody>, SceneError>> {
        let known = self.of(name)?;
        let files = known["files"].as_array()?.iter().filter_map(Value::as_str);
        let assets: Result<Vec<_>, _> = files
            .map(|file| Asset::load(self.folder.join(file)).map(Arc::new))
            .collect();
        let assets = match assets {
            Ok(assets) => assets,
            Err(error) => return Some(Err(error.into())),
        };
        let of = known["of"].as_array()?.iter().filter_map(Value::as_u64);
        let bodies = of.map(|number| {
            Some(BakedBody {
                asset: Arc::clone(assets.get(number as usize)?),
                report: None,
            })
        });
        Some(Ok(bodies.collect::<Option<_>>()?))
    }
}

impl Host for Baked {
    fn scene(&self, name: &str) -> Result<Scene, ViewError> {
        let text = self.of(name).and_then(|known| known["text"].as_str());
        let text = text.ok_or_else(|| ViewError::NotNow(format!("`{name}` was not baked")))?;
        Ok(parse_scene(text, Path::new(""))?)
    }

    fn open(&self, path: &Path) -> Result<Scene, ViewError> {
        Err(refused(path))
    }

    fn bring(&self, scene: &Scene, delivery: Delivery) {
        let none = || Err(SceneError::Clash(format!("`{}` has no list", scene.name)));
        delivery.finish(self.bodies(&scene.name).unwrap_or_else(none));
    }

    fn save(&self, name: &Path, _: &[u8]) -> Result<(), ViewError> {
        Err(refused(name))
    }
}

fn refused(path: &Path) -> ViewError {
    ViewError::NotNow(format!("`{}` is not for here", path.display()))
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [folder, scene, steps, times] = &words[..] else {
        return Err("plays FOLDER SCENE STEPS TIMES".into());
    };
    let folder = PathBuf::from(folder);
    let list = serde_json::from_str(&std::fs::read_to_string(folder.join("list.json"))?)?;
    let mut session = Session::in_host(Box::new(Baked { folder, list }));
    session.apply(Command::Scene(scene.clone()))?;
    session.finish_jobs();
    let mut seen = Vec::new();
    for _ in 0..times.parse::<u32>()? {
        session.apply(Command::Step(steps.parse()?))?;
        let shown = session.shown();
        let masses = shown.blow.as_ref().map_or(&[][..], |blow| &blow.masses);
        let (whole, pieces) = (shown.whole, shown.pieces);
        let fingerprint = format!("{:016x}", shown.fingerprint);
        seen.push(json!({
            "whole": whole, "pieces": pieces, "masses": masses, "fingerprint": fingerprint,
        }));
    }
    let seconds = session.shown().break_step.fracture;
    println!("{}", json!({ "seen": seen, "fracture_seconds": seconds }));
    Ok(())
}
