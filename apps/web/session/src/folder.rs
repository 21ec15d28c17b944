//! Scenes and bodies from the page's folder, bakes by other workers, files into the browser's downloads. In the session's worker the object
//! `frangible` has, besides what it has everywhere,
//!
//! | | |
//! |---|---|
//! | `scenes` | names of the scenes |
//! | `scene(name)` | a scene, TOML |
//! | `given()` | the files that the page was given: an array of arrays of name and bytes |
//! | `bodies(scene, tell)` | promise of the bodies of one of the page's scenes; `tell(what, share)` meanwhile |
//! | `bake(scene, tell)` | promise of the bodies of a scene as TOML; the bake is given up when `tell` returns false |
//! | `save(name, bytes)` | offers a file for download |
//! | `hear(samples, rate)` | plays the next samples: left and right in turn, −1 to 1 |
//!
//! Bodies are an array of two: the files, each once, and the number of the file of each body.

use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

use frangible::Asset;
use frangible_scenes::{
    BakedBody, Files, Scene, SceneError, parse_scene, scene_of_file_from, scene_to_toml,
};
use frangible_view::{Delivery, Host, ViewError, same_bakes};
use frangible_web::{Bridge, said};
use js_sys::{Array, Promise, Uint8Array};
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};

/// The page's folder.
pub(crate) struct Folder(pub(crate) Bridge);

impl Folder {
    /// A scene of the page.
    fn own(&self, name: &str) -> Option<Result<Scene, SceneError>> {
        let text = self.0.call("scene", &[name.into()]).ok()?.as_string()?;
        Some(parse_scene(&text, Path::new("")))
    }
}

impl Host for Folder {
    fn scene(&self, name: &str) -> Result<Scene, ViewError> {
        let scene = self.own(name).ok_or_else(|| {
            let known = self.0.names("scenes").join(", ");
            ViewError::NotNow(format!("this page has no scene `{name}`; it has {known}"))
        })?;
        Ok(scene?)
    }

    fn open(&self, path: &Path) -> Result<Scene, ViewError> {
        let given = self.0.call("given", &[]).map_err(ViewError::NotNow)?;
        Ok(scene_of_file_from(path, &files_of(&Array::from(&given)))?)
    }

    fn bring(&self, scene: &Scene, delivery: Delivery) {
        let own = self.own(&scene.name).and_then(Result::ok);
        let ready = own.is_some_and(|own| same_bakes(&own, scene));
        let (order, what) = match ready {
            true => (("bodies", scene.name.clone()), "fetching"),
            false => (("bake", scene_to_toml(scene)), "reading"),
        };
        delivery.tell(what, 0.0);
        spawn_local(deliver(self.0.clone(), order, delivery));
    }

    fn save(&self, name: &Path, bytes: &[u8]) -> Result<(), ViewError> {
        let name = name.display().to_string();
        let bytes = Uint8Array::from(bytes);
        let offered = self.0.call("save", &[name.into(), bytes.into()]);
        offered.map(drop).map_err(ViewError::NotNow)
    }
}

/// Has a function of the page's bring bodies, and hands them in.
async fn deliver(bridge: Bridge, (function, scene): (&str, String), delivery: Delivery) {
    let delivery = Rc::new(delivery);
    let told = Rc::clone(&delivery);
    let tell = Closure::<dyn FnMut(String, f64) -> bool>::new(move |what: String, share| {
        told.tell(&what, share);
        !told.is_unwanted()
    });
    let tell_function: JsValue = tell.as_ref().clone();
    let promise = bridge.call(function, &[scene.into(), tell_function]);
    let promise = promise.and_then(|promise| {
        let promise: Result<Promise, _> = promise.dyn_into();
        promise.map_err(|_| format!("`{function}` did not return a promise"))
    });
    let brought = match promise {
        Ok(promise) => JsFuture::from(promise).await.map_err(|error| said(&error)),
        Err(problem) => Err(problem),
    };
    drop(tell);
    let baked = brought.map_err(SceneError::Clash);
    let baked = baked.and_then(|bodies| read(&Array::from(&bodies)));
    if let Some(delivery) = Rc::into_inner(delivery) {
        delivery.finish(baked);
    }
}

/// Bodies, of which equal ones are one.
fn read(bodies: &Array) -> Result<Vec<BakedBody>, SceneError> {
    let files = Array::from(&bodies.get(0)).to_vec().into_iter();
    let assets = files.map(|bytes| Asset::from_bytes(&Uint8Array::new(&bytes).to_vec()));
    let assets: Vec<Arc<Asset>> = assets
        .map(|asset| asset.map(Arc::new))
        .collect::<Result<_, _>>()?;
    let numbers = Array::from(&bodies.get(1)).to_vec().into_iter();
    let of = numbers.filter_map(|number| assets.get(number.as_f64()? as usize));
    Ok(of
        .map(|asset| BakedBody {
            asset: Arc::clone(asset),
            report: None,
        })
        .collect())
}

/// Files that the page was given.
pub(crate) fn files_of(given: &Array) -> Files {
    let files = given.iter().filter_map(|pair| {
        let pair = Array::from(&pair);
        let name = PathBuf::from(pair.get(0).as_string()?);
        Some((name, Uint8Array::new(&pair.get(1)).to_vec()))
    });
    Files::Given(files.collect())
}
