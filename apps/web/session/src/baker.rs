//! Bakes, in a worker of its own: the session goes on meanwhile, and ends the worker to give the bake up. The worker's script calls
//! `frangible_bake(scene, given, tell)`, with a scene as TOML, the files that were given, and `tell(stage, share)` for news.

use std::path::Path;
use std::sync::Arc;

use frangible::Asset;
use frangible_scenes::{CancelToken, SceneError, bake_until, open_sources_from, parse_scene};
use frangible_web::offer;
use js_sys::{Array, Function, Uint8Array};
use wasm_bindgen::JsValue;
use wasm_bindgen::closure::Closure;

use crate::folder::files_of;

/// Offers the function.
pub(crate) fn start() {
    let bake = Closure::<dyn Fn(String, Array, Function) -> Result<Array, JsValue>>::new(
        |scene: String, given: Array, tell: Function| {
            let bodies = bake(&scene, &given, &tell);
            bodies.map_err(|error| js_sys::Error::new(&error.to_string()).into())
        },
    );
    offer([("frangible_bake", bake.into_js_value())]);
}

/// Files of the scene's bodies, each once, and the number of the file of each body.
fn bake(scene: &str, given: &Array, tell: &Function) -> Result<Array, SceneError> {
    let say = |what: &str, share: f64| {
        // A listener that throws does not stop the bake.
        let _ = tell.call2(&JsValue::NULL, &what.into(), &share.into());
    };
    say("reading", 0.0);
    let scene = parse_scene(scene, Path::new(""))?;
    let opened = open_sources_from(&scene, &files_of(given))?;
    let baked = bake_until(&scene, opened, &CancelToken::default(), &mut |progress| {
        say(&progress.stage.to_string(), progress.fraction);
    })?;
    let mut known: Vec<Arc<Asset>> = Vec::new();
    let (files, numbers) = (Array::new(), Array::new());
    for body in baked {
        let same = known.iter().position(|k| Arc::ptr_eq(k, &body.asset));
        let number = same.unwrap_or_else(|| {
            files.push(&Uint8Array::from(&body.asset.to_bytes()[..]));
            known.push(body.asset);
            known.len() - 1
        });
        numbers.push(&(number as f64).into());
    }
    Ok(Array::of2(&files, &numbers))
}
