//! `frangible view`: a window.

use std::error::Error;

use crate::args::ViewArgs;

#[cfg(not(feature = "view"))]
pub(crate) fn run(_: &ViewArgs) -> Result<(), Box<dyn Error>> {
    Err(
        "the viewer requires a build with the renderer: cargo run --release --features view -- view"
            .into(),
    )
}

#[cfg(feature = "view")]
pub(crate) fn run(args: &ViewArgs) -> Result<(), Box<dyn Error>> {
    use frangible_recording::make_folder;
    use frangible_view::{Script, WindowOptions, run as open_window};

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
#[cfg(feature = "view")]
fn first(what: Option<&str>) -> frangible_view::Command {
    use frangible_scenes::SCENE_NAMES;
    use frangible_view::Command;

    match what {
        None => Command::Scene(SCENE_NAMES[0].into()),
        Some(name) if SCENE_NAMES.contains(&name) => Command::Scene(name.into()),
        Some(name) if name.contains(['.', '/']) || std::path::Path::new(name).exists() => {
            Command::Open(name.into())
        }
        Some(name) => Command::Scene(name.into()),
    }
}
