//! Bodies from the page's folder, files into the browser's downloads.

use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use frangible::Asset;
use frangible_scenes::{BakedBody, Scene, SceneError, parse_scene};
use frangible_view::{Delivery, Host, ViewError};
use js_sys::Uint8Array;
use wasm_bindgen::closure::Closure;

use crate::bridge::Bridge;

/// The page's folder.
pub(crate) struct Folder(pub(crate) Bridge);

impl Host for Folder {
    fn scene(&self, name: &str) -> Result<Scene, ViewError> {
        let text = self.0.scene(name).ok_or_else(|| {
            let known = self.0.scenes().join(", ");
            ViewError::NotNow(format!("this page has no scene `{name}`; it has {known}"))
        })?;
        Ok(parse_scene(&text, Path::new(""))?)
    }

    fn bring(&self, scene: &Scene, delivery: Delivery) {
        let (bridge, name) = (self.0.clone(), scene.name.clone());
        let bodies = scene.bodies.len();
        let delivery = Rc::new(delivery);
        delivery.tell(&format!("fetching {name}"), 0.0);
        wasm_bindgen_futures::spawn_local(async move {
            let told = Rc::clone(&delivery);
            let text = format!("fetching {name}");
            let tell = Closure::<dyn FnMut(f64)>::new(move |share| told.tell(&text, share));
            let function = tell.as_ref().clone().into();
            let fetched = bridge.bodies(&name, &function).await;
            drop(tell);
            let baked = fetched.map_err(|problem| SceneError::File {
                path: name.clone().into(),
                problem: format!("its bodies could not be fetched ({problem}); reload the page"),
            });
            let baked = baked.and_then(|files| read(&files, bodies));
            if let Some(delivery) = Rc::into_inner(delivery) {
                delivery.finish(baked);
            }
        });
    }

    fn save(&self, name: &Path, bytes: &[u8]) -> Result<(), ViewError> {
        let name = name.display().to_string();
        let bytes = Uint8Array::from(bytes);
        let offered = self.0.call("save", &[name.into(), bytes.into()]);
        offered.map(drop).map_err(ViewError::NotNow)
    }
}

/// A file of which first the first bytes of all words of four come, then the second, third and fourth ones.
fn from_planes(planes: &[u8]) -> Vec<u8> {
    let mut bytes = vec![0; planes.len()];
    let mut left = planes.iter();
    for plane in 0..4 {
        for (to, from) in bytes.iter_mut().skip(plane).step_by(4).zip(&mut left) {
            *to = *from;
        }
    }
    bytes
}

/// Baked bodies of a scene; equal ones come once.
fn read(files: &[Vec<u8>], bodies: usize) -> Result<Vec<BakedBody>, SceneError> {
    let mut baked = Vec::new();
    for bytes in files {
        baked.push(BakedBody {
            asset: Arc::new(Asset::from_bytes(&from_planes(bytes))?),
            report: None,
        });
    }
    if let [only] = &baked[..] {
        baked = vec![only.clone(); bodies];
    }
    Ok(baked)
}
