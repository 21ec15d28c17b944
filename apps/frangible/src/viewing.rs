//! `frangible view`: a window.

use std::error::Error;
use std::path::Path;

use frangible_scenes::SCENE_NAMES;
use frangible_view::{Command, Script, WindowOptions, run as open_window};

use crate::args::ViewArgs;
use frangible_export::make_folder;

pub(crate) fn run(args: &ViewArgs) -> Result<(), Box<dyn Error>> {
    let script = args.script.as_deref().map(Script::read).transpose()?;
    if script.is_some() {
        // Before minutes of baking.
        make_folder(&args.shots, &[], "--shots")?;
    }
    open_window(WindowOptions {
        first: first(args.what.as_deref()),
        script: script.map(|script| script.into_folder(&args.shots)),
        folder: args.shots.clone(),
        size: args.size,
    })?;
    Ok(())
}

/// A name that is no file is a scene's, so that a mistake in it is answered with the scenes there are.
fn first(what: Option<&str>) -> Command {
    match what {
        None => Command::Scene(SCENE_NAMES[0].into()),
        Some(name) if SCENE_NAMES.contains(&name) => Command::Scene(name.into()),
        Some(name) if name.contains(['.', '/']) || Path::new(name).exists() => {
            Command::Open(name.into())
        }
        Some(name) => Command::Scene(name.into()),
    }
}
